"use strict";
// One cursor and one part of the axis that is shown, for all plots over the same quantity: "t" (time) or "s" (along the interface).

const axes = { t: { at: null, span: null }, s: { at: null, span: null } };
const plots = new Map(); // canvas -> its plot and where it was drawn

// The part of the data of a plot that is looked at.
function spanOf(plot) {
  return (axes[plot.axis] && axes[plot.axis].span) || null;
}

// What the curves of a plot are at x: the value of the nearest point of each.
function readings(plot, x) {
  return plot.curves.filter((curve) => curve.x.length).map((curve) => {
    let low = 0, high = curve.x.length - 1;
    while (high - low > 1) { const middle = (low + high) >> 1; if (curve.x[middle] <= x) low = middle; else high = middle; }
    const k = Math.abs(curve.x[high] - x) < Math.abs(curve.x[low] - x) ? high : low;
    return { name: curve.name || "", colour: curve.colour, x: curve.x[k], value: curve.y[k] };
  });
}

function wordsAt(plot, x) {
  return `${plot.x} = ${short(x)}: ` + readings(plot, x).map((one) => `${one.name ? one.name + " " : ""}${short(one.value)}`).join(", ");
}

// Draws the cursor over a plot; `drawn`: {box, across, place}.
function drawCursor(pen, canvas, plot, drawn) {
  plots.set(canvas, { plot, drawn });
  const at = axes[plot.axis] && axes[plot.axis].at;
  if (at === null || at === undefined || at < drawn.across[0] || at > drawn.across[1]) return;
  const x = Math.round(drawn.place(at, 0)[0]) + 0.5;
  pen.strokeStyle = theme.dim;
  pen.lineWidth = 1;
  pen.beginPath();
  pen.moveTo(x, drawn.box.top);
  pen.lineTo(x, drawn.box.bottom);
  pen.stroke();
  for (const one of readings(plot, at)) {
    const value = plot.map(one.value);
    if (value === null || value === undefined) continue;
    const [px, py] = drawn.place(one.x, value);
    if (py < drawn.box.top - 1 || py > drawn.box.bottom + 1) continue;
    pen.fillStyle = one.colour;
    pen.beginPath();
    pen.arc(px, py, 3, 0, 2 * Math.PI);
    pen.fill();
  }
}

function redraw(axis) {
  for (const [canvas, { plot }] of plots) if (plot.axis === axis && canvas.isConnected) drawPlot(canvas, plot);
  memory.stale = memory.stale || axis === "s"; // the shapes show the place too
}

function moveCursor(axis, x) {
  if (!axes[axis] || axes[axis].at === x) return;
  axes[axis].at = x;
  redraw(axis);
}

function setSpan(axis, span) {
  axes[axis].span = span;
  redraw(axis);
}

function under(event, drawn) {
  const part = (event.offsetX - drawn.box.left) / (drawn.box.right - drawn.box.left);
  return drawn.across[0] + Math.min(1, Math.max(0, part)) * (drawn.across[1] - drawn.across[0]);
}

// Closer to, or further from, where the cursor is.
function zoomPlot({ plot, drawn }, factor) {
  const [low, high] = drawn.across, middle = axes[plot.axis].at ?? (low + high) / 2;
  setSpan(plot.axis, factor === 0 ? null : [middle + (low - middle) * factor, middle + (high - middle) * factor]);
}

function pressKey(event, canvas) {
  const known = plots.get(canvas);
  if (!known || !axes[known.plot.axis]) return;
  const { plot, drawn } = known, [low, high] = drawn.across, now = axes[plot.axis].at, step = (event.shiftKey ? 0.1 : 0.01) * (high - low);
  const go = (x) => moveCursor(plot.axis, Math.min(high, Math.max(low, x)));
  const acts = { ArrowLeft: () => go((now ?? high) - step), ArrowRight: () => go((now ?? low) + step), Home: () => go(low), End: () => go(high),
    Escape: () => moveCursor(plot.axis, null), "+": () => zoomPlot(known, 0.7), "-": () => zoomPlot(known, 1 / 0.7), "0": () => zoomPlot(known, 0) };
  if (!acts[event.key]) return;
  event.preventDefault();
  acts[event.key]();
  const at = axes[plot.axis].at;
  $("said").textContent = at === null ? "" : `${plot.title}, ${wordsAt(plot, at)}`;
}

// Lets a canvas be pointed at, zoomed into by dragging along it, and be used with keys.
function makeReadable(canvas) {
  if (canvas.dataset.readable) return;
  canvas.dataset.readable = "yes";
  canvas.tabIndex = 0;
  let from = null;
  const of = () => plots.get(canvas);
  canvas.addEventListener("pointerdown", (event) => { if (of()) from = { x: under(event, of().drawn), px: event.offsetX }; });
  canvas.addEventListener("pointermove", (event) => { if (of()) moveCursor(of().plot.axis, under(event, of().drawn)); });
  canvas.addEventListener("pointerup", (event) => {
    if (from && of() && Math.abs(event.offsetX - from.px) > 12) setSpan(of().plot.axis, [from.x, under(event, of().drawn)].sort((a, b) => a - b));
    from = null;
  });
  canvas.addEventListener("pointerleave", () => { from = null; if (of()) moveCursor(of().plot.axis, null); });
  canvas.addEventListener("dblclick", () => { if (of()) setSpan(of().plot.axis, null); });
  canvas.addEventListener("keydown", (event) => pressKey(event, canvas));
}
