"use strict";
// Drawing on canvases: no state of the run is kept here.

const theme = {};
function readTheme() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["card", "ink", "dim", "rule", "grid", "gas", "solid", "projected", "busy", "idle", "good", "bad"]) {
    theme[name] = style.getPropertyValue("--" + name).trim();
  }
}

// A number for people: four digits at most.
function short(value) {
  if (value === null || value === undefined || !isFinite(value)) return "\u2013";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) return value.toExponential(2).replace("e+", "e");
  return String(Number(value.toPrecision(4)));
}

// A context in CSS pixels on a canvas as sharp as the screen; clears it.
function open(canvas) {
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  pen.font = "12px system-ui, 'DejaVu Sans', sans-serif";
  pen.lineJoin = "round";
  return { pen, width, height };
}

function ticks(low, high, count) {
  const raw = (high - low) / count, power = Math.pow(10, Math.floor(Math.log10(raw)));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999);
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) found.push(k * step);
  return found;
}

// Labels of an axis: with a common offset where the numbers differ in their last digits only.
function axis(low, high, count) {
  const few = ticks(low, high, count), at = few.length < 2 ? ticks(low, high, 2 * count) : few, size = Math.max(Math.abs(low), Math.abs(high));
  if (high - low < 1e-4 * size && at.length > 0) {
    const offset = at[0];
    return { offset, marks: at.map((v) => [v, v === offset ? "0" : (v - offset).toExponential(0).replace("e+", "e")]) };
  }
  return { offset: null, marks: at.map((v) => [v, Math.abs(v) < 1e-12 * size ? "0" : short(Number(v.toPrecision(6)))]) };
}

// Marks of a logarithmic axis between powers of ten: 1e-3, 2e-3, 5e-3 ... while there is room, else whole powers; even steps where less than two of them lie on it.
function logAxis(low, high, count) {
  const all = [];
  for (let power = Math.floor(low); power <= high; ++power) {
    for (const first of [1, 2, 5]) all.push([power + Math.log10(first), `${first}e${power}`]);
  }
  const within = all.filter(([place]) => place >= low && place <= high);
  if (within.length < 2) return { offset: null, marks: axis(10 ** low, 10 ** high, count).marks.filter(([value]) => value > 0).map(([value]) => [Math.log10(value), short(value)]) };
  if (within.length <= 2 * count) return { offset: null, marks: within };
  const whole = within.filter(([, label]) => label.startsWith("1")), every = Math.ceil(whole.length / (count + 1));
  return { offset: null, marks: whole.filter((_, k) => k % every === 0) };
}

const RELATIVE = 2e-6; // ranges that are smaller parts of their numbers are drawn as wide as that

// Range of the values, at least `tiny` wide: less is round-off.
function spread(values, tiny) {
  let low = Infinity, high = -Infinity;
  for (const value of values) {
    if (value === null || !isFinite(value)) continue;
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  if (low > high) return null;
  const least = leastSpread(low, high, tiny);
  if (high - low < least) { low -= least / 2; high += least / 2; }
  return [low, high];
}

function leastSpread(low, high, tiny) {
  return Math.max(RELATIVE * Math.max(Math.abs(low), Math.abs(high)), tiny || 0, 1e-300);
}

// Range of the values without a few that stand out: a spike at an end shall not press all else into a line. [low, high, whether any is cut]
function robustSpread(values, tiny) {
  const whole = spread(values, tiny);
  if (!whole) return null;
  const sorted = values.filter((value) => value !== null && isFinite(value)).sort((a, b) => a - b), n = sorted.length;
  const low = sorted[Math.floor(0.03 * (n - 1))], high = sorted[Math.ceil(0.97 * (n - 1))], room = 0.5 * (high - low);
  if (n < 12 || !(high - low > leastSpread(low, high, tiny)) || whole[1] - whole[0] < 4 * (high - low)) return [...whole, false];
  return [Math.max(whole[0], low - room), Math.min(whole[1], high + room), true];
}

// plot: {title, axis: "t" or "s", x (its label), curves: [{name, x, y, colour, dash, width}], log, floor (of a log plot: what is below is round-off),
// tiny (what is narrower is round-off), robust, strip: [[x from, colour]], value, nothing}. Says so where there is no data.
function drawPlot(canvas, plot) {
  makeReadable(canvas);
  const { pen, width, height } = open(canvas), floor = Math.log10(plot.floor || 0);
  pen.textBaseline = "top";
  plot.map = (v) => (!plot.log || v === null ? v : v > 0 || plot.floor ? Math.max(Math.log10(v), floor) : null);
  const span = spanOf(plot), within = (x) => !span || (x >= span[0] && x <= span[1]);
  const curves = plot.curves.map((c) => ({ ...c, y: c.y.map(plot.map) }));
  const across = span || spread(curves.flatMap((c) => c.x)), all = curves.flatMap((c) => c.y.filter((_, k) => within(c.x[k])));
  const up = plot.robust ? robustSpread(all, plot.tiny) : spread(all, plot.log ? 0 : plot.tiny);
  const at = axes[plot.axis] ? axes[plot.axis].at : null;
  drawTitle(pen, plot, at !== null && across && up ? wordsAt(plot, at) : plot.value || "", width, up && up[2]);
  if (!across || !up) {
    pen.fillStyle = theme.dim;
    pen.textAlign = "center";
    pen.fillText(plot.nothing || "nothing yet", width / 2, height / 2);
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", `${plot.title}: ${plot.nothing || "nothing yet"}`);
    plots.delete(canvas);
    return;
  }
  const pad = 0.06 * (up[1] - up[0]), under = plot.strip && plot.strip.length ? 2.5 * pad : pad; // a band covers no curve
  const [low, high] = [up[0] - under, up[1] + pad];
  const scale = (plot.log ? logAxis : axis)(low, high, Math.max(2, Math.floor(height / 42)));
  const box = { left: 58, right: width - 8, top: 20, bottom: height - 20 };
  const place = (x, y) => [box.left + ((x - across[0]) / (across[1] - across[0])) * (box.right - box.left),
                           box.bottom - ((y - low) / (high - low)) * (box.bottom - box.top)];
  drawFrame(pen, box, scale, across, place, plot);
  pen.save();
  pen.beginPath();
  pen.rect(box.left, box.top - 1, box.right - box.left + 1, box.bottom - box.top + 2);
  pen.clip();
  if (!plot.log && low < 0 && high > 0) drawZero(pen, box, place(0, 0)[1]);
  drawStrip(pen, box, plot.strip || [], place);
  for (const curve of curves) drawCurve(pen, curve, place);
  pen.restore();
  drawCursor(pen, canvas, plot, { box, across, place });
  const [least, most] = plot.log ? up.map((v) => Math.pow(10, v)) : up;
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", `${plot.title} over ${plot.x}, from ${short(least)} to ${short(most)}; the arrow keys read values`);
}

function drawTitle(pen, plot, said, width, cut) {
  pen.fillStyle = theme.ink;
  pen.textAlign = "left";
  pen.font = "600 12px system-ui, 'DejaVu Sans', sans-serif";
  pen.fillText(plot.title, 2, 1);
  const room = width - pen.measureText(plot.title).width - 16;
  pen.font = "11px system-ui, 'DejaVu Sans', sans-serif";
  const words = said || (cut ? "spikes are cut" : "");
  pen.textAlign = "right";
  if (words) pen.fillText(words, width - 4, 1, Math.max(40, room));
}

function drawZero(pen, box, y) {
  pen.strokeStyle = theme.dim;
  pen.lineWidth = 1;
  pen.beginPath();
  pen.moveTo(box.left, Math.round(y) + 0.5);
  pen.lineTo(box.right, Math.round(y) + 0.5);
  pen.stroke();
}

// A band at the lower edge in the colours of [x from, colour].
function drawStrip(pen, box, strip, place) {
  strip.forEach(([from, colour], k) => {
    const left = Math.max(box.left, place(from, 0)[0]), right = k + 1 < strip.length ? place(strip[k + 1][0], 0)[0] : box.right;
    pen.fillStyle = colour;
    if (right > left) pen.fillRect(left, box.bottom - 7, right - left + 0.5, 7);
  });
}

function drawFrame(pen, box, scale, across, place, plot) {
  pen.lineWidth = 1;
  pen.strokeStyle = theme.grid;
  pen.fillStyle = theme.dim;
  pen.textBaseline = "middle";
  pen.textAlign = "right";
  for (const [value, label] of scale.marks) {
    const y = Math.round(place(across[0], value)[1]) + 0.5;
    pen.beginPath();
    pen.moveTo(box.left, y);
    pen.lineTo(box.right, y);
    pen.stroke();
    pen.fillText(label, box.left - 6, y);
  }
  if (scale.offset !== null) {
    pen.textAlign = "left";
    pen.fillText(short(scale.offset) + " +", box.left + 4, box.top + 2);
  }
  pen.textBaseline = "top";
  pen.textAlign = "center";
  for (const [value, label] of axis(across[0], across[1], Math.max(2, Math.floor((box.right - box.left) / 110))).marks) {
    const x = Math.round(place(value, 0)[0]) + 0.5;
    pen.beginPath();
    pen.moveTo(x, box.top);
    pen.lineTo(x, box.bottom);
    pen.stroke();
    if (x < box.right - 22) pen.fillText(label, x, box.bottom + 5);
  }
  pen.textAlign = "right";
  pen.fillText(plot.x, box.right, box.bottom + 5);
  pen.strokeStyle = theme.rule;
  pen.strokeRect(box.left + 0.5, box.top + 0.5, box.right - box.left - 1, box.bottom - box.top);
}

function drawCurve(pen, curve, place) {
  pen.strokeStyle = curve.colour;
  pen.lineWidth = curve.width || 1.6;
  pen.setLineDash(curve.dash || []);
  pen.beginPath();
  let drawing = false, lonely = null;     // a curve of one point is a dot
  for (let k = 0; k < Math.min(curve.x.length, curve.y.length); ++k) {
    if (curve.y[k] === null || curve.y[k] === undefined) { drawing = false; continue; }
    const [x, y] = place(curve.x[k], curve.y[k]);
    if (drawing) pen.lineTo(x, y); else pen.moveTo(x, y);
    drawing = true;
    lonely = lonely === null ? [x, y] : undefined;
  }
  pen.stroke();
  pen.setLineDash([]);
  if (!lonely) return;
  pen.fillStyle = curve.colour;
  pen.beginPath();
  pen.arc(...lonely, 3, 0, 2 * Math.PI);
  pen.fill();
}

// Perceptually even colours from dark violet over green to yellow.
const COLOURS = [[68, 1, 84], [72, 40, 120], [62, 74, 137], [49, 104, 142], [38, 130, 142], [31, 158, 137], [53, 183, 121],
  [110, 206, 88], [181, 222, 43], [253, 231, 37]];
function colour(part) {
  const place = Math.min(Math.max(part, 0), 1) * (COLOURS.length - 1), k = Math.min(Math.floor(place), COLOURS.length - 2);
  const mix = COLOURS[k].map((c, i) => Math.round(c + (place - k) * (COLOURS[k + 1][i] - c)));
  return `rgb(${mix.join(",")})`;
}

function drawScale(canvas) {
  const { pen, width, height } = open(canvas);
  for (let x = 0; x < width; ++x) {
    pen.fillStyle = colour(x / width);
    pen.fillRect(x, 0, 1, height);
  }
}

// shapes: [{name, x1, x2, p, first: {x1, x2}, closed}]; drawn with equal scales, the first shape seen behind as a thin line.
function drawShapes(canvas, shapes, range) {
  const { pen, width, height } = open(canvas);
  const across = spread(shapes.flatMap((s) => [...s.x1, ...s.first.x1])), up = spread(shapes.flatMap((s) => [...s.x2, ...s.first.x2]));
  if (!across || !up) {
    pen.fillStyle = theme.dim;
    pen.textAlign = "center";
    pen.fillText("no interface was heard", width / 2, height / 2);
    return;
  }
  const margin = 34;
  const unit = Math.min((width - 2 * margin) / (across[1] - across[0]), (height - 2 * margin) / (up[1] - up[0]));
  const middle = [(across[0] + across[1]) / 2, (up[0] + up[1]) / 2];
  const place = (x, y) => [width / 2 + (x - middle[0]) * unit, height / 2 - (y - middle[1]) * unit];
  drawRuler(pen, unit, width, height);
  for (const shape of shapes) drawShape(pen, shape, range, place, width);
  canvas.setAttribute("aria-label", shapes.map((shape) => `${shape.name}: pressure from ${short(Math.min(...shape.p))} to ${short(Math.max(...shape.p))}`).join("; "));
}

function drawRuler(pen, unit, width, height) {
  const most = (0.3 * width) / unit, power = Math.pow(10, Math.floor(Math.log10(most)));
  const length = [5, 2, 1].map((m) => m * power).find((one) => one <= most);
  pen.strokeStyle = theme.dim;
  pen.fillStyle = theme.dim;
  pen.lineWidth = 1;
  pen.beginPath();
  pen.moveTo(10, height - 12);
  pen.lineTo(10 + length * unit, height - 12);
  pen.moveTo(10.5, height - 16);
  pen.lineTo(10.5, height - 8);
  pen.moveTo(10.5 + length * unit, height - 16);
  pen.lineTo(10.5 + length * unit, height - 8);
  pen.stroke();
  pen.textAlign = "left";
  pen.textBaseline = "bottom";
  pen.fillText(short(length), 16, height - 14);
}

// Its name stands beside its first point, on the side where there is room.
function drawShape(pen, shape, range, place, width) {
  if (shape.closed) {
    pen.fillStyle = theme.grid;
    pen.beginPath();
    shape.x1.forEach((x, k) => pen.lineTo(...place(x, shape.x2[k])));
    pen.fill();
  }
  pen.strokeStyle = theme.dim;
  pen.lineWidth = 1;
  pen.setLineDash([3, 4]);
  pen.beginPath();
  shape.first.x1.forEach((x, k) => pen.lineTo(...place(x, shape.first.x2[k])));
  pen.stroke();
  pen.setLineDash([]);
  pen.lineWidth = 5;
  pen.lineCap = "round";
  for (let k = 0; k + 1 < shape.x1.length; ++k) {
    const p = (shape.p[k] + shape.p[k + 1]) / 2;
    pen.strokeStyle = isFinite(p) && shape.p[k] !== null ? colour((p - range[0]) / (range[1] - range[0])) : theme.bad;
    pen.beginPath();
    pen.moveTo(...place(shape.x1[k], shape.x2[k]));
    pen.lineTo(...place(shape.x1[k + 1], shape.x2[k + 1]));
    pen.stroke();
  }
  drawPlaceAlong(pen, shape, place);
  const [x, y] = place(shape.x1[0], shape.x2[0]);
  pen.fillStyle = theme.ink;
  const fits = x + 9 + pen.measureText(shape.name).width <= width;
  pen.textAlign = fits ? "left" : "right";
  pen.textBaseline = "bottom";
  pen.fillText(shape.name, fits ? x + 9 : x - 9, y - 5);
}

// Where along the shape the cursor of the plots is.
function drawPlaceAlong(pen, shape, place) {
  const at = axes.s.at;
  if (!shape.chosen || at === null) return;
  const k = shape.s.reduce((best, s, i) => (Math.abs(s - at) < Math.abs(shape.s[best] - at) ? i : best), 0);
  const [x, y] = place(shape.x1[k], shape.x2[k]);
  pen.lineWidth = 2;
  pen.strokeStyle = theme.ink;
  pen.beginPath();
  pen.arc(x, y, 6, 0, 2 * Math.PI);
  pen.stroke();
}

// rows: [{name, points: [[time, share]]}] over the last `span` seconds before `now`.
function drawTimeline(canvas, rows, now, span) {
  canvas.style.height = 26 * Math.max(1, rows.length) + 22 + "px";
  const { pen, width, height } = open(canvas);
  const left = 110, right = width - 8;
  const place = (time) => right - ((now - time) / span) * (right - left);
  pen.textBaseline = "middle";
  rows.forEach((row, index) => {
    const top = 4 + 26 * index, tall = 20;
    pen.fillStyle = theme.ink;
    pen.textAlign = "right";
    pen.fillText(row.name.slice(0, 16), left - 10, top + tall / 2);
    row.points.forEach(([time, share], k) => {
      if (k === 0) return;
      const begin = Math.max(left, place(row.points[k - 1][0])), end = Math.min(right, place(time));
      if (end <= begin || time - row.points[k - 1][0] > 5) return;
      pen.fillStyle = theme.idle;
      pen.fillRect(begin, top, end - begin + 0.5, tall);
      pen.fillStyle = theme.busy;
      pen.fillRect(begin, top + (1 - share) * tall, end - begin + 0.5, share * tall);
    });
  });
  pen.fillStyle = theme.dim;
  pen.textAlign = "center";
  const room = pen.measureText("-00 s").width + 8, every = [10, 20, 30, 60].find((seconds) => (seconds / span) * (right - left) >= room + 12) || span; // "now" is moved to the left
  for (let ago = 0; ago <= span; ago += every) pen.fillText(ago === 0 ? "now" : `-${ago} s`, Math.min(place(now - ago), right - 12), height - 8);
}
