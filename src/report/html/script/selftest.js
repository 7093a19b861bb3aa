// Asked for by #selftest: what a browser test wants to know of this page, as JSON in the page.
async function selftest() {
  const inked = (plot) => {
    const { width, height } = plot.ctx.canvas;
    const bytes = plot.ctx.getImageData(0, 0, width, height).data;
    let count = 0;
    for (let i = 3; i < bytes.length; i += 4) if (bytes[i] > 0) count += 1;
    return count;
  };
  // what the legend says with the pointer in the middle, and at each twentieth until something is there
  const hovered = (plot) => {
    for (let i = 1; i < 20; i++) {
      plot.setCursor({ left: plot.over.clientWidth * ((i + 9) % 20) / 20, top: 40 });
      const said = [...plot.root.querySelectorAll(".u-series:not(:first-child) .u-value")].map((node) => node.textContent);
      if (said.some((text) => /\d/.test(text))) return said.join("; ");
    }
    return "";
  };
  const pointed = () => [...document.querySelectorAll("figure[data-field]")].map((figure) => {
    const picture = figure.querySelector(".picture:not([hidden])"), box = picture.getBoundingClientRect();
    for (let i = 1; i < 40; i++) {
      const clientX = box.left + box.width * i / 40, clientY = box.top + box.height / 2;
      picture.dispatchEvent(new PointerEvent("pointermove", { clientX, clientY }));
      const said = figure.querySelector("output").textContent;
      if (said) return said;
    }
    return "";
  });
  // caption and number of seen pictures at each choice of a stress figure
  const captions = () => [...document.querySelectorAll("figure[data-field]")].flatMap((figure) => {
    const choice = figure.querySelector("select");
    const at = (value) => {
      choice.value = value;
      choice.dispatchEvent(new Event("change"));
      return [figure.querySelector("figcaption").textContent, figure.querySelectorAll(".picture:not([hidden])").length];
    };
    const found = [...choice.options].map((option) => at(option.value));
    at(0);
    return found;
  });
  // which part of the axis a drag over its middle half shows, and which a double click after it
  const zoomed = (plot) => {
    const span = () => plot.scales.x.max - plot.scales.x.min, whole = span();
    if (!plot.cursor.drag.x) return null;
    const width = plot.over.clientWidth;
    plot.setSelect({ left: width / 4, width: width / 2, top: 0, height: plot.over.clientHeight });
    return new Promise((done) => setTimeout(() => {
      const part = span() / whole;
      plot.over.dispatchEvent(new MouseEvent("dblclick", { bubbles: true }));
      setTimeout(() => done([part, span() / whole]), 5);
    }, 5));
  };
  const values = (plot) => JSON.stringify(plot.data.slice(1));
  const points = (plot) => plot.data.slice(1).flat().filter((v) => v !== null && v !== undefined).length;
  const report = charts.map(({ spec, chart }) => ({
    name: spec.name, title: spec.title,
    points: chart.plots().map(points), inked: chart.plots().map(inked),
    width: chart.plots().map((plot) => plot.width), hovered: chart.plots().map(hovered),
  }));
  for (const [i, { chart }] of charts.entries()) {
    report[i].zoomed = [];
    for (const plot of chart.plots()) report[i].zoomed.push(await zoomed(plot));
  }
  const worn = () => [...document.querySelectorAll("path[data-worn]")].map((path) => path.getAttribute("d")).join();
  const last = given.states.length - 1;
  if (document.querySelector(".slider")) {
    const input = document.querySelector(".slider input");
    const seen = () => charts.map(({ chart }) => chart.plots().map(values).join());
    const before = seen(), toothBefore = worn();
    input.value = Math.max(0, last - 1);
    input.dispatchEvent(new Event("input", { bubbles: true }));
    const after = seen(), toothAfter = worn();
    report.forEach((entry, i) => { entry.moved = before[i] !== after[i]; });
    sliders.set(last);
    const back = seen();
    report.forEach((entry, i) => { entry.returned = before[i] === back[i]; });
    report.push({ name: "tooth", moved: toothBefore !== toothAfter });
  }
  const node = element("pre", "", document.body);
  node.id = "selftest-result";
  node.textContent = JSON.stringify({ faults, pointed: pointed(), captions: captions(), states: given.states.length, overflow: document.documentElement.scrollWidth - innerWidth, charts: report });
}
