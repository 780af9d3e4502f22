"use strict";
// The live picture: asks the monitor for pictures while somebody can see them, keeps what came, and draws one moment of it.

const MOST_BYTES = 96e6;   // of pictures that are kept; then every second moment goes
const MOST_BACK = 8;       // moments
const SHARPEST = 1.5;      // pixels of the raster per CSS pixel, at most
const UNITS = { pressure: "p", speed: "|v|", density: "\u03c1", schlieren: "|grad \u03c1|", stress: "|P|" };
const live = {
  frames: [], outlines: new Map(), bytes: 0, version: 0, at: null, box: null, wanted: null, stale: true, seen: false, raster: null, drawn: [], cursor: null,
  limits: {}, // by "ROLE.QUANTITY": {mode, low, high, seen: [low, high]}
};

// ---- what is asked for and kept

function wishesOf() {
  const wishes = ["coupler.outline"];
  if ($("gas-quantity").value) wishes.push("fluid." + $("gas-quantity").value);
  if ($("solid-quantity").value) wishes.push("solid." + $("solid-quantity").value);
  return wishes;
}

function limitsOf(picture) {
  return (live.limits[`${picture.role}.${picture.quantity}`] ||= { mode: "seen", low: 0, high: 1, seen: [Infinity, -Infinity] });
}

// One moment is everything of one step. Interfaces alone are none: they wait until a field of their step comes.
function keep(picture) {
  if (picture.role === "coupler" && !live.frames.some((one) => one.step === picture.step)) {
    live.outlines.set(picture.step, picture);
    if (live.outlines.size > 64) live.outlines.delete(live.outlines.keys().next().value);
    return;
  }
  const limits = limitsOf(picture);
  limits.seen = [Math.min(limits.seen[0], picture.low), Math.max(limits.seen[1], picture.high)];
  let frame = live.frames.find((one) => one.step === picture.step);
  if (!frame) {
    frame = { step: picture.step, t: picture.t, pictures: new Map() };
    if (live.outlines.has(picture.step)) frame.pictures.set("coupler", live.outlines.get(picture.step));
    live.frames.push(frame);
    live.frames.sort((a, b) => a.step - b.step);
  }
  const before = frame.pictures.get(picture.from);
  live.bytes += picture.bytes - (before ? before.bytes : 0);
  frame.pictures.set(picture.from, picture);
  if (live.bytes > MOST_BYTES) thinOut();
  live.stale = true;
}

function thinOut() {
  live.frames = live.frames.filter((frame, k) => k % 2 === 0 || k + 3 > live.frames.length || frame === live.at);
  live.bytes = live.frames.reduce((sum, frame) => sum + [...frame.pictures.values()].reduce((bytes, picture) => bytes + picture.bytes, 0), 0);
}

// The moment that is shown: the one chosen, else the newest of those of which most is there. Where a run pauses, the interfaces
// are not sent: the rims of the solids stand for them.
function currentFrame() {
  if (live.at) return live.at;
  const goesOn = memory.state && memory.state.status === "running";
  const count = (frame) => frame.pictures.size - (!goesOn && frame.pictures.has("coupler") ? 1 : 0);
  const latest = live.frames.slice(-MOST_BACK), most = Math.max(0, ...latest.map(count));
  return latest.filter((frame) => count(frame) === most).pop() || null;
}

// The pictures of a moment. A program that had no time to draw one, or whose picture was lost, is shown as it was shortly before.
function picturesAt(frame) {
  const found = new Map(frame.pictures), k = live.frames.indexOf(frame);
  for (let back = 1; back <= MOST_BACK && k - back >= 0; ++back) {
    for (const [from, picture] of live.frames[k - back].pictures) if (!found.has(from)) found.set(from, picture);
  }
  return [...found.values()];
}

function visible() {
  return live.seen && document.visibilityState === "visible";
}

// Asks again and again, each time for what is newer; an answer comes when there is something.
async function watchRun() {
  for (;;) {
    const wishes = wishesOf().join(",");
    if (wishes !== live.wanted) live.version = 0;
    live.wanted = wishes;
    if (!visible()) { await new Promise((wake) => setTimeout(wake, 200)); continue; }
    try {
      const answer = await fetch(`api/pictures?after=${live.version}&wish=${wishes}`);
      if (!answer.ok) throw new Error(answer.statusText);
      decode(await answer.arrayBuffer()).forEach(keep);
      live.version = Number(answer.headers.get("X-AMP-FSI-Version"));
    } catch (error) {
      live.version = 0;
      await new Promise((wake) => setTimeout(wake, 1000));
    }
  }
}

// ---- what is drawn

function rangeOf(picture) {
  const limits = limitsOf(picture);
  if (limits.mode === "fixed") return [limits.low, limits.high];
  if (picture.quantity === "schlieren") return [0, limits.mode === "now" ? picture.high : limits.seen[1]]; // a gradient of zero is white
  const [low, high] = limits.mode === "now" ? [picture.low, picture.high] : limits.seen;
  return [low, Math.max(high, low + STILL * scaleOf(picture))];
}

// What speeds and stresses are compared with, 0 where nobody says: round-off shall not have all the colours.
function scaleOf(picture) {
  const name = { speed: "velocity_scale", pressure: "traction_scale", stress: "traction_scale" }[picture.quantity];
  const sides = memory.state ? Object.values(memory.state.interfaces) : [];
  return Math.max(0, ...sides.map((side) => side[name] || 0));
}

function mapOf(picture) {
  return picture.quantity === "schlieren" ? "schlieren" : picture.role === "fluid" ? "gas" : "solid";
}

// The gas first, then the solids, so that a solid hides what lies under it.
function layersOf(frame) {
  const shown = { fluid: $("gas-quantity").value, solid: $("solid-quantity").value };
  const all = picturesAt(frame).filter((picture) => shown[picture.role]);
  return all.sort((a, b) => (a.role > b.role ? 1 : a.role < b.role ? -1 : 0));
}

// The interfaces at the step of the solids that are drawn; of a moment from a file the rims of the solids.
function outlineOf(layers, frame) {
  const solids = layers.filter((picture) => picture.role === "solid"), { step } = solids[0] || frame;
  const same = live.frames.find((one) => one.step === step), heard = same && same.pictures.get("coupler");
  return heard || (solids.length ? { grids: solids.flatMap(rimsOf) } : undefined);
}

function drawLive() {
  const frame = currentFrame(), canvas = $("picture");
  showScrubber(frame);
  if (!frame) { sayNothing(canvas); return; }
  const layers = layersOf(frame), outline = outlineOf(layers, frame);
  const whole = extentOf([...layers, ...(outline ? [outline] : [])]);
  if (!whole) { sayNothing(canvas); return; }
  live.whole = whole;
  const { pen, width, height } = open(canvas), ratio = Math.min(window.devicePixelRatio || 1, SHARPEST);
  const w = Math.max(1, Math.round(width * ratio)), h = Math.max(1, Math.round(height * ratio)), margin = 0.02;
  const box = live.box || [whole[0] - margin * (whole[1] - whole[0]), whole[1] + margin * (whole[1] - whole[0]), whole[2] - margin * (whole[3] - whole[2]), whole[3] + margin * (whole[3] - whole[2])];
  const view = viewOf(box, w, h), place = (x, y) => toRaster(view, x, y).map((value) => value / ratio);
  live.raster = makeRaster(w, h);
  live.view = { ...view, ratio };
  live.drawn = layers;
  const scales = [null];
  layers.forEach((picture, k) => {
    const [low, high] = rangeOf(picture);
    scales.push({ table: tableOf(mapOf(picture)), low, high });
    rasterise(live.raster, picture, view, k + 1);
  });
  const sheet = new OffscreenCanvas(w, h);
  sheet.getContext("2d").putImageData(imageOf(live.raster, scales), 0, 0);
  pen.drawImage(sheet, 0, 0, width, height);
  drawLayers(pen, layers, outline, place);
  drawRuler(pen, view.unit / ratio, width, height);
  showBars(layers);
  canvas.setAttribute("aria-label", layers.map((picture) => `${picture.quantity} of ${picture.from} from ${short(picture.low)} to ${short(picture.high)}`).join(", ") + ` at t = ${short(frame.t)}`);
  showCursor();
}

function sayNothing(canvas) {
  const { pen, width, height } = open(canvas);
  pen.fillStyle = theme.dim;
  pen.textAlign = "center";
  pen.fillText(over(memory.state) ? "no picture was recorded" : "waiting for the first picture", width / 2, height / 2);
}

function drawLayers(pen, layers, outline, place) {
  const stroke = (colour, lineWidth, path) => {
    pen.strokeStyle = colour;
    pen.lineWidth = lineWidth;
    pen.beginPath();
    path();
    pen.stroke();
  };
  if ($("layer-grids").checked) for (const picture of layers) stroke("rgba(128,128,128,0.55)", 0.6, () => drawGridLines(pen, picture, place, 64));
  if (!outline || !$("layer-outlines").checked) return;
  stroke("#ffffff", 3, () => drawOutlines(pen, outline, place));
  stroke("#000000", 1.3, () => drawOutlines(pen, outline, place));
}

// ---- colour bars with their limits, one per role

function showBars(layers) {
  for (const [role, id] of [["fluid", "gas"], ["solid", "solid"]]) {
    const picture = layers.find((one) => one.role === role);
    $(`${id}-bar`).hidden = !picture;
    if (!picture) continue;
    const limits = limitsOf(picture), [low, high] = rangeOf(picture);
    $(`${id}-name`).textContent = `${picture.quantity} ${UNITS[picture.quantity] || ""}`;
    $(`${id}-limits`).value = limits.mode;
    for (const [name, value] of [["low", low], ["high", high]]) {
      const field = $(`${id}-${name}`);
      field.disabled = limits.mode !== "fixed";
      if (document.activeElement !== field) field.value = short(value) === "\u2013" ? "" : Math.abs(value) < STILL * Math.max(Math.abs(low), Math.abs(high)) ? 0 : Number(value.toPrecision(4));
    }
    const { pen, width, height } = open($(`${id}-scale`)), table = mapOf(picture);
    for (let x = 0; x < width; ++x) {
      pen.fillStyle = `rgb(${mapped(table, x / width).join(",")})`;
      pen.fillRect(x, 0, 1.5, height);
    }
  }
}

function prepareBar(role, id) {
  const chosen = () => { // what is drawn, or about to be
    const frame = currentFrame();
    return frame && layersOf(frame).find((picture) => picture.role === role);
  };
  $(`${id}-limits`).onchange = () => {
    const picture = chosen();
    if (!picture) return;
    const limits = limitsOf(picture), [low, high] = rangeOf(picture);
    Object.assign(limits, { mode: $(`${id}-limits`).value, low, high });
    if (limits.mode === "seen") limits.seen = rangeSeen(picture);
    live.stale = true;
  };
  for (const name of ["low", "high"]) {
    $(`${id}-${name}`).oninput = (event) => {
      const value = Number(event.target.value);
      if (chosen() && event.target.value !== "" && isFinite(value)) limitsOf(chosen())[name] = value;
      live.stale = true;
    };
  }
}

// Of what is recorded: what went out of memory no longer counts.
function rangeSeen(picture) {
  const all = live.frames.flatMap((frame) => [...frame.pictures.values()]).filter((one) => one.role === picture.role && one.quantity === picture.quantity);
  return [Math.min(...all.map((one) => one.low)), Math.max(...all.map((one) => one.high))];
}

// ---- time

function showScrubber(frame) {
  const k = frame ? live.frames.indexOf(frame) : 0, slider = $("moment");
  slider.max = Math.max(0, live.frames.length - 1);
  slider.value = k;
  slider.setAttribute("aria-valuetext", frame ? `t = ${short(frame.t)}` : "nothing recorded");
  $("follow").classList.toggle("on", !live.at);
  $("follow").setAttribute("aria-pressed", String(!live.at));
  $("moment-note").textContent = frame ? `t = ${short(frame.t)}, step ${frame.step}; moment ${k + 1} of ${live.frames.length}${missingAt(frame)}` : "";
}

// What was chosen when it could no longer be drawn.
function missingAt(frame) {
  if (!live.at && !over(memory.state)) return ""; // it will come
  const wanted = { fluid: $("gas-quantity").value, solid: $("solid-quantity").value };
  const missing = new Set(picturesAt(frame).filter((one) => wanted[one.role] && one.quantity !== wanted[one.role]).map((one) => wanted[one.role]));
  return missing.size ? `; no ${[...missing].join(", no ")} was recorded then` : "";
}

function choose(k) {
  live.at = live.frames[Math.min(Math.max(k, 0), live.frames.length - 1)] || null;
  live.stale = true;
}

// Plays what was recorded, from the moment shown, or from the beginning where that is the last.
function play() {
  if (live.playing) { clearInterval(live.playing); live.playing = null; $("play").textContent = "\u25b6"; return; }
  if (!live.frames.length) return;
  const start = live.frames.indexOf(currentFrame());
  choose(start >= live.frames.length - 2 ? 0 : start);
  $("play").textContent = "\u23f8";
  live.playing = setInterval(() => {
    const k = live.frames.indexOf(live.at);
    if (k < 0 || k + 1 >= live.frames.length) play(); else choose(k + 1);
  }, 100);
}

// ---- zoom, cursor, keys

function zoom(factor, x, y) {
  if (!live.whole) return;
  const box = live.box || live.whole, cx = x ?? (box[0] + box[1]) / 2, cy = y ?? (box[2] + box[3]) / 2;
  live.box = [cx + (box[0] - cx) * factor, cx + (box[1] - cx) * factor, cy + (box[2] - cy) * factor, cy + (box[3] - cy) * factor];
  live.stale = true;
}

function pan(dx, dy) {
  if (!live.whole) return;
  const box = live.box || live.whole;
  live.box = [box[0] + dx, box[1] + dx, box[2] + dy, box[3] + dy];
  live.stale = true;
}

function placeUnder(event) {
  const edge = $("picture").getBoundingClientRect(), { unit, left, top, ratio } = live.view;
  const x = (event.clientX - edge.left) * ratio, y = (event.clientY - edge.top) * ratio;
  return { x: left + x / unit, y: top - y / unit };
}

// What is under the cursor.
function showCursor() {
  const note = $("picture-value");
  if (!live.cursor || !live.raster) { note.textContent = "\u00a0"; return; }
  const [x, y] = toRaster(live.view, live.cursor.x, live.cursor.y).map(Math.floor), { width, height } = live.raster;
  const owner = x >= 0 && y >= 0 && x < width && y < height ? live.raster.owner[y * width + x] : 0, picture = live.drawn[owner - 1];
  note.textContent = `(${short(live.cursor.x)}, ${short(live.cursor.y)})` + (picture ? `: ${picture.from}, ${UNITS[picture.quantity] || picture.quantity} = ${short(live.raster.value[y * width + x])}` : "");
}

function prepareCanvas() {
  const canvas = $("picture");
  let grip = null;
  canvas.onpointerdown = (event) => { if (live.view) grip = placeUnder(event); };
  canvas.onpointermove = (event) => {
    if (!live.view) return;
    const place = placeUnder(event);
    if (grip && event.buttons) pan(grip.x - place.x, grip.y - place.y);
    live.cursor = place;
    showCursor();
  };
  window.addEventListener("pointerup", () => { grip = null; });
  canvas.onpointerleave = () => { live.cursor = null; showCursor(); };
  canvas.ondblclick = (event) => { if (live.view) { const place = placeUnder(event); zoom(0.5, place.x, place.y); } };
  canvas.addEventListener("wheel", (event) => {
    if (document.activeElement !== canvas || !live.view) return; // else the page scrolls
    event.preventDefault();
    const place = placeUnder(event);
    zoom(Math.pow(1.0015, event.deltaY), place.x, place.y);
  }, { passive: false });
  canvas.onkeydown = (event) => {
    const box = live.box || live.whole || [0, 1, 0, 1], dx = 0.1 * (box[1] - box[0]), dy = 0.1 * (box[3] - box[2]);
    const acts = { "+": () => zoom(0.8), "-": () => zoom(1.25), "0": () => { live.box = null; live.stale = true; }, ArrowLeft: () => pan(-dx, 0), ArrowRight: () => pan(dx, 0), ArrowUp: () => pan(0, dy), ArrowDown: () => pan(0, -dy), " ": play };
    if (!acts[event.key]) return;
    event.preventDefault();
    acts[event.key]();
  };
}

function prepareLive() {
  prepareBar("fluid", "gas");
  prepareBar("solid", "solid");
  prepareCanvas();
  for (const id of ["gas-quantity", "solid-quantity", "layer-outlines", "layer-grids"]) $(id).onchange = () => { live.stale = true; };
  $("zoom-in").onclick = () => zoom(0.7);
  $("zoom-out").onclick = () => zoom(1 / 0.7);
  $("zoom-all").onclick = () => { live.box = null; live.stale = true; };
  $("moment").oninput = () => choose(Number($("moment").value));
  $("follow").onclick = () => { if (live.playing) play(); live.at = null; live.stale = true; };
  $("play").onclick = play;
  new IntersectionObserver((entries) => { live.seen = entries[entries.length - 1].isIntersecting; }).observe($("live"));
  watchRun();
}
