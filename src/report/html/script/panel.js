// One uPlot of a chart. Curves with a state belong to the slider: with `history` all up to its state are shown, without it
// one at a time in the place of its slot.
const DASHES = [[], [9, 5], [3, 3], [12, 4, 3, 4], [], [6, 3]];

function slotsOf(panel) {
  const slots = [];
  for (const curve of panel.curves) {
    const slot = curve.slot !== undefined && slots.find((s) => s.key === curve.slot);
    if (slot) slot.curves.push(curve);
    else slots.push({ key: curve.slot, curves: [curve] });
  }
  return slots;
}

// The slot's curve at a state; none where it has not come yet.
function shownAt(slot, panel, state) {
  const [first] = slot.curves;
  if (first.state === undefined) return first;
  if (panel.history) return first.state <= state ? first : null;
  return slot.curves.find((curve) => curve.state === state) || null;
}

// One axis for all curves: [xs, ys, sigmas] of each; a curve may have several points at one place.
function join(tables) {
  const times = new Map();
  for (const [xs] of tables) {
    const own = new Map();
    for (const x of xs) own.set(x, (own.get(x) || 0) + 1);
    own.forEach((n, x) => times.set(x, Math.max(n, times.get(x) || 0)));
  }
  const all = [], first = new Map();
  for (const x of [...times.keys()].sort((a, b) => a - b)) {
    first.set(x, all.length);
    for (let i = 0; i < times.get(x); i++) all.push(x);
  }
  const columns = tables.map(([xs, ...values]) => {
    const filled = values.map(() => new Array(all.length).fill(null)), used = new Map();
    xs.forEach((x, i) => {
      const n = used.get(x) || 0;
      used.set(x, n + 1);
      values.forEach((column, c) => { filled[c][first.get(x) + n] = column[i]; });
    });
    return filled;
  });
  return { all, columns };
}

function joined(panel, slots, state) {
  const tables = slots.map((slot) => {
    const curve = shownAt(slot, panel, state) || { x: null };
    const xs = curve.x === null ? [] : panel.xs[curve.x], ys = curve.x === null ? [] : curve.y;
    return [xs, ys, curve.e || ys.map(() => null)];
  });
  const { all, columns } = join(tables);
  const data = [all, ...columns.map(([ys]) => ys)];
  const sigmas = [null, ...columns.map(([, es]) => (es.some((e) => e > 0) ? es : null))];
  return { data, sigmas };
}

function spanX(panel) {
  if (panel.names.length) return [0.5, panel.names.length + 0.5];
  const all = panel.xs.flat().concat(panel.marks.map((mark) => mark[0]));
  return widened(Math.min(...all), Math.max(...all), 0);
}

// Of all states, so that the axis stands still while the slider moves; of curves that are not switched off.
function spanY(panel, shown) {
  let low = Infinity, high = -Infinity;
  const take = (v) => { if (isFinite(v) && (!panel.log || v > 0)) { low = Math.min(low, v); high = Math.max(high, v); } };
  for (const curve of panel.curves.filter(shown)) curve.y.forEach((y, i) => { const e = curve.e ? curve.e[i] : 0; take(y - e); take(y + e); });
  if (panel.residuals || (panel.zero && low > 0)) take(0);
  if (panel.log) return [low / 1.4, high * 1.4];
  const [a, b] = widened(low, high, 0.06);
  return panel.zero && low >= 0 ? [0, b] : [a, b];
}

function widened(low, high, air) {
  if (!(low <= high)) return [0, 1];
  const width = high > low ? air * (high - low) : 0.1 * Math.abs(high) || 1;
  return [low - width, high + width];
}

// The value of a series nearest to the cursor, if one is near.
function nearest(u, series, index, x) {
  if (series === 0) return index;
  const xs = u.data[0], ys = u.data[series], reach = 0.03 * (u.scales.x.max - u.scales.x.min);
  let best = null;
  for (const step of [-1, 1]) {
    for (let i = index; i >= 0 && i < xs.length && Math.abs(xs[i] - x) <= reach; i += step) {
      if (ys[i] === null || ys[i] === undefined) continue;
      if (best === null || Math.abs(xs[i] - x) < Math.abs(xs[best] - x)) best = i;
      break;
    }
  }
  return best;
}

function seriesOf(curve, panel) {
  const color = colorOf(curve.color), bare = curve.line === 0;
  const few = curve.y.length <= 12 && curve.marker >= 0;
  return {
    label: curve.label || "model",
    stroke: color,
    _color: color,
    _bare: bare,
    width: curve.line,
    dash: curve.color.k === undefined || bare ? [] : DASHES[curve.color.k % 6],
    spanGaps: true,
    paths: bare ? () => null : undefined,
    points: { show: bare || few, size: curve.small ? 5 : 8, stroke: color, fill: color, width: bare ? 1.5 : 1,
              paths: markers(Math.max(curve.marker, 0), curve.small ? 5 : 8) },
    value: (u, v) => significant(v, 4),
  };
}

function makePanel(panel, place) {
  const slots = slotsOf(panel), ink = css("--ink"), grid = css("--grid");
  let state = place.state, { data, sigmas } = joined(panel, slots, state);
  const font = "12px system-ui, sans-serif";
  const axis = { stroke: ink, font, labelFont: font, grid: { stroke: grid, width: 1 }, ticks: { stroke: grid, width: 1, size: 5 } };
  const values = (u, splits) => splits.map((v) => (v === null ? "" : tick(v, Math.abs(splits[1] - splits[0]) || 1)));
  const named = panel.names.length > 0;
  // what a drag has selected; nothing: the whole axis
  let zoom = null;
  const select = (u) => {
    const { left, width } = u.select;
    if (width < 3) return;
    const [min, max] = [u.posToVal(left, "x"), u.posToVal(left + width, "x")];
    zoom = [min, max];
    u.setScale("x", { min, max });
    u.setSelect({ left: 0, width: 0 }, false);
  };
  const plot = new uPlot({
    width: place.width,
    height: place.height,
    padding: [panel.marks.some((mark) => mark[1]) ? 20 : 8, place.x[1] >= 1e4 ? 30 : 14, 0, 0],
    scales: {
      x: { time: false, range: () => zoom || place.x },
      y: { distr: panel.log ? 3 : 1, range: (u) => spanY(panel, (curve) => {
        const series = u.series[1 + slots.findIndex((slot) => slot.curves.includes(curve))];
        return !series || series.show;
      }) },
    },
    axes: [
      { ...axis, show: place.last, label: place.width < 440 ? panel.brief : panel.x, labelSize: 22, size: 30,
        splits: named ? () => panel.names.map((_, i) => i + 1) : undefined,
        values: named ? (u, splits) => splits.map((v) => panel.names[v - 1] || "") : values },
      { ...axis, label: panel.y, labelSize: 20, size: 52,
        values: panel.log ? (u, splits) => splits.map((v) => (v === null ? "" : significant(v, 1))) : values },
    ],
    series: [
      { label: panel.short, value: (u, v) => (named ? panel.names[v - 1] || "" : significant(v, 4)) },
      ...slots.map((slot) => seriesOf(slot.curves[slot.curves.length - 1], panel)),
    ],
    cursor: {
      dataIdx: nearest,
      drag: { x: !named, y: false, setScale: false },
      bind: { dblclick: (u, target, handler) => (event) => { zoom = null; return handler(event); } },
      sync: { key: panel.x, scales: ["x", null] },
      points: { size: 7 },
    },
    hooks: {
      drawClear: [(u) => drawMarks(u, panel)],
      draw: [(u) => drawErrors(u, sigmas)],
      setSelect: [select],
    },
  }, data, place.host);
  const rows = plot.root.querySelectorAll(".u-legend .u-series");
  const many = panel.history && slots.length > 8;

  function dress() {
    slots.forEach((slot, i) => {
      const curve = shownAt(slot, panel, state), series = plot.series[i + 1], own = slot.curves[0];
      const current = own.state === undefined || !panel.history || own.state === state;
      series.width = series._bare ? 0 : panel.history ? (current ? 3 : 1.2) : own.line;
      const row = rows[i + 1];
      if (!row) return;
      row.style.display = curve === null || (many && !current) || (place.lower && !curve.label) ? "none" : "";
      if (curve) row.querySelector(".u-label").textContent = curve.label || "model";
      row.style.fontWeight = panel.history && current ? "600" : "";
    });
  }

  dress();
  plot.redraw();
  return {
    plot,
    show(next) {
      if (!slots.some((slot) => slot.curves[0].state !== undefined)) return;
      state = next;
      ({ data, sigmas } = joined(panel, slots, state));
      plot.setData(data, false);
      dress();
      plot.redraw(true, false);
    },
  };
}
