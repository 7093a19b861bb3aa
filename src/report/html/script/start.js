// Sets everything in motion; what fails is said on the page and leaves the pictures that need no script.
const faults = [];
addEventListener("error", (event) => faults.push(String(event.message)));
const given = JSON.parse(document.getElementById("live-data").textContent);
const charts = [], movable = [];

document.querySelectorAll("figure[data-chart]").forEach((figure) => {
  const spec = given.charts[Number(figure.dataset.chart)];
  try {
    figure.classList.add("scripted");
    const chart = makeChart(figure, spec, given.states);
    charts.push({ spec, chart, figure });
    movable.push(chart);
  } catch (error) {
    figure.classList.remove("scripted");
    faults.push(`${spec.title}: ${error}`);
  }
});
document.querySelectorAll("figure[data-tooth]").forEach((figure) => movable.push(makeTooth(figure, given)));
document.querySelectorAll("figure[data-field]").forEach(makeField);
const sliders = makeSliders(given.states, (state) => movable.forEach((part) => part.show(state)));
// paper shows the last state, as the plots that need no script do
addEventListener("beforeprint", () => { if (given.states.length) sliders.set(given.states.length - 1); });
document.querySelectorAll(".scripts").forEach((node) => { node.hidden = false; });
dark.addEventListener("change", () => charts.forEach(({ chart }) => chart.build()));
if (location.hash === "#selftest") setTimeout(selftest, 50);
