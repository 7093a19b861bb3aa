// A figure with one panel, or two over the same horizontal axis.
function makeChart(figure, spec, states) {
  const host = element("div", "live", figure);
  const panels = spec.lower ? [spec, spec.lower] : [spec];
  const spans = panels.map(spanX);
  const x = [Math.min(...spans.map((s) => s[0])), Math.max(...spans.map((s) => s[1]))];
  let state = states.length - 1, made = [], width = 0;

  function build() {
    made.forEach((panel) => panel.plot.destroy());
    width = host.clientWidth;
    const tall = Math.round(Math.min(Math.max(0.58 * width, 220), 330));
    made = panels.map((panel, i) => makePanel(panel, {
      host, width, x, state, lower: i > 0, last: i === panels.length - 1,
      height: i > 0 ? 170 : tall,
    }));
  }

  build();
  new ResizeObserver(() => { if (Math.abs(host.clientWidth - width) > 2) build(); }).observe(host);
  return {
    build,
    plots: () => made.map((panel) => panel.plot),
    show(next) {
      state = next;
      made.forEach((panel) => panel.show(next));
    },
  };
}
