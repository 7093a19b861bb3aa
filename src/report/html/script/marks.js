// What uPlot does not draw itself: markers of several shapes, bars of one sigma, lettered lines.
const SHAPES = [
  (p, x, y, r) => { p.moveTo(x + r, y); p.arc(x, y, r, 0, 2 * Math.PI); },
  (p, x, y, r) => { p.moveTo(x + r, y); p.arc(x, y, r, 0, 2 * Math.PI); },
  (p, x, y, r) => p.rect(x - r, y - r, 2 * r, 2 * r),
  (p, x, y, r) => { p.moveTo(x - r, y + r); p.lineTo(x + r, y + r); p.lineTo(x, y - 1.2 * r); p.closePath(); },
  (p, x, y, r) => p.rect(x - r, y - r, 2 * r, 2 * r),
  (p, x, y, r) => { p.moveTo(x - 1.3 * r, y); p.lineTo(x, y + 1.3 * r); p.lineTo(x + 1.3 * r, y); p.lineTo(x, y - 1.3 * r); p.closePath(); },
  (p, x, y, r) => { p.moveTo(x - r, y - r); p.lineTo(x + r, y + r); p.moveTo(x - r, y + r); p.lineTo(x + r, y - r); },
];
const HOLLOW = [1, 4, 6];

function markers(shape, size) {
  return (u, series, from, to) => {
    const path = new Path2D(), radius = 0.5 * size * devicePixelRatio;
    for (let i = from; i <= to; i++) {
      const x = u.data[0][i], y = u.data[series][i];
      if (y === null || y === undefined) continue;
      SHAPES[shape](path, u.valToPos(x, "x", true), u.valToPos(y, "y", true), radius);
    }
    return { stroke: path, fill: HOLLOW.includes(shape) ? new Path2D() : path, clip: null, flags: 3 };
  };
}

function drawErrors(u, sigmas) {
  const ctx = u.ctx, { left, top, width, height } = u.bbox;
  ctx.save();
  ctx.beginPath();
  ctx.rect(left, top, width, height);
  ctx.clip();
  ctx.lineWidth = devicePixelRatio;
  u.series.forEach((series, s) => {
    if (s === 0 || !sigmas[s] || !series.show) return;
    ctx.strokeStyle = series._color;
    ctx.globalAlpha = 0.6;
    ctx.beginPath();
    u.data[s].forEach((y, i) => {
      if (y === null || y === undefined || !(sigmas[s][i] > 0)) return;
      const x = u.valToPos(u.data[0][i], "x", true);
      ctx.moveTo(x, u.valToPos(y - sigmas[s][i], "y", true));
      ctx.lineTo(x, u.valToPos(y + sigmas[s][i], "y", true));
    });
    ctx.stroke();
  });
  ctx.restore();
}

function drawMarks(u, panel) {
  const ctx = u.ctx, { left, top, width, height } = u.bbox, ratio = devicePixelRatio;
  ctx.save();
  ctx.strokeStyle = ctx.fillStyle = css("--soft");
  ctx.lineWidth = ratio;
  ctx.font = `${13 * ratio}px system-ui, sans-serif`;
  ctx.textAlign = "center";
  ctx.globalAlpha = 0.8;
  for (const [at, letter] of panel.marks) {
    const x = u.valToPos(at, "x", true);
    if (x < left - 1 || x > left + width + 1) continue;
    ctx.setLineDash([3 * ratio, 3 * ratio]);
    ctx.beginPath();
    ctx.moveTo(x, top);
    ctx.lineTo(x, top + height);
    ctx.stroke();
    if (letter) ctx.fillText(letter, x, top - 5 * ratio);
  }
  if (panel.residuals) {
    const y = u.valToPos(0, "y", true);
    ctx.setLineDash([]);
    ctx.beginPath();
    ctx.moveTo(left, y);
    ctx.lineTo(left + width, y);
    ctx.stroke();
  }
  ctx.restore();
}
