// Colours of the page's own style, so that charts follow light and dark; numbers as the tables write them.
const dark = matchMedia("(prefers-color-scheme: dark)");
const RAMP = {
  light: [[122, 190, 70], [53, 175, 121], [33, 145, 140], [49, 104, 142], [68, 57, 131], [68, 1, 84]],
  dark: [[92, 84, 160], [72, 120, 176], [48, 152, 160], [60, 184, 132], [150, 212, 84], [248, 228, 66]],
};

function css(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

// `color` of the data: {k: number of a kind} or {t: 0 to 1 in time}.
function colorOf(color) {
  if (color.k !== undefined) return css("--k" + (color.k % 6));
  const ramp = dark.matches ? RAMP.dark : RAMP.light;
  const at = Math.min(Math.max(color.t, 0), 1) * (ramp.length - 1);
  const i = Math.min(Math.floor(at), ramp.length - 2);
  const mix = ramp[i].map((c, j) => Math.round(c + (at - i) * (ramp[i + 1][j] - c)));
  return `rgb(${mix})`;
}

function grouped(text) {
  const [whole, part] = text.replace("-", "\u2212").split(".");
  const digits = whole.replace(/(\d)(?=(\d{3})+$)/g, whole.length > 4 ? "$1\u202f" : "$1");
  return part === undefined ? digits : digits + "." + part;
}

function significant(value, digits) {
  if (value === null || value === undefined || !isFinite(value)) return "\u2013";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e7 || size < 1e-4) {
    const [mantissa, power] = value.toExponential(digits - 1).split("e");
    return mantissa.replace("-", "\u2212") + "e" + power.replace("+", "").replace("-", "\u2212");
  }
  const rounded = Number(value.toPrecision(digits));
  return grouped(rounded.toFixed(Math.max(0, digits - 1 - Math.floor(Math.log10(size)))));
}

function tick(value, step) {
  if (Math.abs(value) >= 1e7) return significant(value, 2);
  let digits = 0;
  while (digits < 9 && Math.abs(step * 10 ** digits - Math.round(step * 10 ** digits)) > 1e-6 * step * 10 ** digits) digits += 1;
  const text = value.toFixed(digits);
  return grouped(Number(text) === 0 ? "0" : text);
}

function element(tag, className, parent) {
  const node = document.createElement(tag);
  if (className) node.className = className;
  if (parent) parent.append(node);
  return node;
}
