"use strict";
// The page: keeps what it has heard, and draws it when there is something new.

const $ = (id) => document.getElementById(id);
const MOST = 1200; // points of a history; then every second one goes
const SPAN = 60;   // seconds of the timeline
const memory = { state: null, history: {}, timeline: {}, limiters: [], last: {}, chosen: null, connected: false, stale: true, drawn: "" };

function make(tag, properties, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

// ---- what is heard

function remember(name, t, value) {
  const list = (memory.history[name] ||= []);
  if (list.length && t <= list[list.length - 1][0]) return;
  list.push([t, value]);
  if (list.length <= MOST) return;
  const size = (entry) => (entry[1] === null ? Infinity : Math.abs(entry[1]));
  memory.history[name] = list.filter((entry, k) => k % 2 ? size(entry) >= size(list[k - 1]) : k + 1 >= list.length || size(entry) > size(list[k + 1]));
}

function hear(state) {
  const now = performance.now() / 1000;
  if (memory.state && memory.state.run !== state.run) location.reload();
  memory.state = state;
  if (state.t > 0) remember("dt", state.t, state.dt);
  const limiter = memory.limiters[memory.limiters.length - 1];
  if (state.limited_by && (!limiter || (limiter[1] !== state.limited_by && state.t > limiter[0]))) memory.limiters.push([state.t, state.limited_by]);
  for (const [name, side] of Object.entries(state.interfaces)) {
    for (const what of ["velocity_jump", "traction_jump", "shear", "gap", "power", "p_max"]) remember(`${name}.${what}`, state.t, side[what]);
  }
  for (const [name, program] of Object.entries(state.participants)) {
    const before = memory.last[name], line = (memory.timeline[name] ||= []);
    if (before) {
      const busy = program.compute_s - before.compute_s, idle = program.wait_s - before.wait_s;
      if (busy + idle > 0) line.push([now, Math.min(1, Math.max(0, busy / (busy + idle)))]);
      if (busy + idle > 0) memory.last[name] = program;
    } else {
      memory.last[name] = program;
    }
    while (line.length && line[0][0] < now - SPAN - 2) line.shift();
    if (program.role !== "coupler") remember(`${name}.proposed_dt`, program.t, program.proposed_dt);
  }
  memory.stale = true;
}

async function fetchPast() {
  const past = await (await fetch("api/history.json")).json();
  const now = performance.now() / 1000;
  memory.history = past.history;
  memory.limiters = past.limiters;
  memory.timeline = Object.fromEntries(Object.entries(past.timeline).map(([name, line]) => [name, line.map(([ago, share]) => [now - ago, share])]));
  memory.last = {};
  memory.stale = true;
}

function connect() {
  const source = new EventSource("api/events");
  source.onopen = () => {
    memory.connected = true;
    memory.stale = true;
    fetchPast().catch(() => {}); // what comes in from now on is enough
  };
  source.onmessage = (event) => {
    memory.connected = true;
    hear(JSON.parse(event.data));
  };
  source.onerror = () => { // the browser tries again by itself
    memory.connected = false;
    memory.stale = true;
    if (source.readyState === EventSource.CLOSED) setTimeout(connect, 2000);
  };
}

// ---- what is shown

const KIND = { running: "good", alive: "good", paused: "warning", aborted: "bad", lost: "bad", failed: "bad", stopped: "bad", silent: "bad" };

function duration(seconds) {
  if (seconds === null || seconds > 1e7) return "\u2013";
  if (seconds < 60) return `${Math.round(seconds)} s`;
  if (seconds < 3600) return `${Math.floor(seconds / 60)} min ${Math.round(seconds % 60)} s`;
  return `${Math.floor(seconds / 3600)} h ${Math.round((seconds % 3600) / 60)} min`;
}

function over(state) {
  return state && (state.status === "ended" || state.status === "aborted");
}

// The folder of a run has no profiles along its interfaces.
function withoutProfiles(state) {
  const sides = Object.values(state.interfaces);
  return over(state) && sides.length > 0 && sides.every((side) => side.s.length < 2);
}

function showHead(state) {
  const lost = !memory.connected;
  const status = state ? state.status : "connecting";
  $("status").textContent = lost && !over(state) ? (state ? "no connection" : "connecting") : status;
  $("status").className = `pill ${lost && state && !over(state) ? "bad" : KIND[status] || ""}`;
  const notices = [];
  if (state && state.abort) notices.push(`${state.abort.from} ended the run: ${state.abort.reason}`);
  if (state && state.non_finite.length) notices.push(`not finite: ${state.non_finite.join(", ")}`);
  if (state && state.status === "ended") notices.push("the run has ended; this is its last state" + (withoutProfiles(state) ? "; shapes and profiles are kept by fsi monitor --record" : ""));
  if (lost && state) notices.push(over(state) ? "the monitor has left" : "connection to the monitor lost; trying again. This is the last state heard");
  for (const button of document.querySelectorAll("[data-command]")) button.disabled = over(state) || lost;
  $("notice").hidden = !notices.length;
  $("notice").textContent = notices.join(" \u00b7 ");
  $("notice").className = `notice ${state && state.status === "ended" && !state.non_finite.length ? "calm" : ""}`;
  if (!state) return;
  document.title = `${Math.floor(100 * state.progress)} % ${state.case} \u00b7 AMP-FSI`;
  $("case").textContent = state.case;
  $("run").textContent = state.run;
  $("bar").style.width = `${100 * state.progress}%`;
  const facts = [["t", `${short(state.t)} of ${short(state.t_end)}`], ["step", state.step], ["dt", short(state.dt)], ["steps/s", short(state.steps_per_s)],
    ["left", over(state) ? "\u2013" : duration(state.remaining_s)], ["limited by", (state.dt_reason || "\u2013") + shareOf(state, state.limited_by)]];
  $("facts").replaceChildren(...facts.map(([name, value]) => make("div", {}, make("span", {}, name + " "), make("b", {}, String(value ?? "\u2013")))));
}

// Above the profiles, or above the histories where there are none.
function showTabs(names, state) {
  const place = $(withoutProfiles(state) ? "history-tabs" : "profile-tabs");
  if ($("tabs").parentElement !== place) place.append($("tabs"));
  const key = names.join("\n") + memory.chosen;
  if ($("tabs").dataset.key === key) return;
  $("tabs").dataset.key = key;
  $("tabs").replaceChildren(...(names.length > 1 ? names : []).map((name) => make("button", {
    className: name === memory.chosen ? "on" : "", textContent: name, onclick: () => { memory.chosen = name; memory.stale = true; } })));
}

function showShapes(state) {
  const factor = Number($("factor").value);
  const sides = Object.entries(state.interfaces).filter(([, side]) => side.s.length > 1);
  const range = spread(sides.flatMap(([, side]) => side.p_projected)) || [0, 1];
  $("p-low").textContent = sides.length ? short(range[0]) : "";
  $("p-high").textContent = sides.length ? short(range[1]) : "";
  drawScale($("scale"));
  drawShapes($("shape"), sides.map(([name, side]) => {
    const n = side.s.length, first = { x1: side.x_start.slice(0, n), x2: side.x_start.slice(n) };
    const moved = (from, x) => x.map((value, k) => from[k] + factor * (value - from[k]));
    return { name, p: side.p_projected, s: side.s, chosen: name === memory.chosen, closed: side.closed, first, x1: moved(first.x1, side.x.slice(0, n)), x2: moved(first.x2, side.x.slice(n)) };
  }), range);
  $("shape-note").textContent = sides.length ? "dashed: the shape at t = 0" : "";
}

const NO_STRESS = "none: this solid has no stress of its own";
const ROUND_OFF = 1e-14; // jumps that are smaller parts of what they compare are none
const STILL = 1e-11; // what varies by a smaller part of the gas's speed or pressure is drawn as what does not vary
// [name, title, what makes it round-off: null where the plot is not logarithmic]
const HISTORIES = [["velocity_jump", "velocity jump", (side) => side.velocity_scale], ["traction_jump", "traction jump", (side) => side.traction_scale],
  ["shear", "tangential traction of the solid", (side) => side.traction_scale], ["gap", "gap", (side) => side.s[side.s.length - 1]], ["power", "power", null],
  ["p_max", "largest pressure", null]];

function showHistories() {
  const side = memory.state.interfaces[memory.chosen], wanted = side ? HISTORIES : [];
  $("history-section").hidden = !side;
  if ($("histories").children.length !== wanted.length) $("histories").replaceChildren(...wanted.map(() => make("canvas", {})));
  $("history-of").textContent = memory.chosen || "";
  wanted.forEach(([what, title, scale], k) => {
    const known = memory.history[`${memory.chosen}.${what}`] || [], none = OF_STRESS.includes(what) && !hasStress(side);
    const list = none || (scale && known.every(([, value]) => !value)) ? [] : known; // a logarithmic axis has no zero
    drawPlot($("histories").children[k], { title: title + (scale ? ", log" : ""), axis: "t", x: "t", log: scale !== null, floor: scale ? ROUND_OFF * scale(side) : 0,
      tiny: what === "power" ? STILL * side.velocity_scale * side.traction_scale * side.s[side.s.length - 1] : 0,
      nothing: none ? NO_STRESS : known.length ? "zero" : "nothing yet", value: list.length ? short(list[list.length - 1][1]) : "",
      curves: [{ x: list.map((e) => e[0]), y: list.map((e) => e[1]), colour: theme.projected }] });
  });
}

function showProfiles(side) {
  const minus = $("minus").value === "1";
  const curves = (gas, solid, projected) => {
    const shown = (values) => (minus ? values.map((v, k) => (v === null || projected[k] === null ? null : v - projected[k])) : values);
    return [{ name: "projected", x: side.s, y: shown(projected), colour: theme.projected, width: 2.2 },
      { name: "gas", x: gas.length ? side.s : [], y: shown(gas), colour: theme.gas, dash: [6, 4] },
      { name: "solid", x: solid.length ? side.s : [], y: shown(solid), colour: theme.solid, dash: [2, 4], width: 2 }];
  };
  const none = { axis: "s", x: "s", curves: [], nothing: "no interface" };
  const title = (name) => (minus && side ? `${name} minus projected` : name);
  const draw = (canvas, name, sets, scale) => drawPlot($(canvas), side ? { title: title(name), axis: "s", x: "s", robust: true, tiny: STILL * scale, curves: curves(...sets), nothing: side.s.length ? NO_STRESS : "was not recorded" } : { title: name, ...none });
  draw("pressure", "pressure p", side && [side.p_predicted, side.p_predicted_solid, side.p_projected], side && side.traction_scale);
  draw("velocity", "normal velocity v_n", side && [side.v_predicted_gas, side.v_predicted, side.v_projected], side && side.velocity_scale);
  const free = side && side.w_tangential.map(() => 0); // the gas has no viscosity: the projection takes it away
  draw("shear", "tangential traction w_t", side && [[], side.w_tangential, free], side && side.traction_scale);
}

function show() {
  requestAnimationFrame(show);
  if (live.stale || (memory.stale && !live.frames.length)) {
    readTheme();
    live.stale = false;
    if (!$("live").hidden) drawLive();
  }
  const moving = memory.connected && !over(memory.state);
  const now = performance.now() / 1000;
  if (!memory.stale) return;
  memory.stale = false;
  readTheme();
  const state = memory.state;
  showHead(state);
  if (!state) return;
  const names = Object.keys(state.interfaces);
  if (!names.includes(memory.chosen)) memory.chosen = names[0] || null;
  const alone = !names.length && Object.values(state.participants).some((program) => program.role !== "coupler" && program.step > 0);
  for (const section of document.querySelectorAll("section.wide")) section.hidden = alone || withoutProfiles(state); // a solver without interfaces
  $("timeline-section").hidden = over(state) && !Object.values(memory.timeline).some((line) => line.length > 1);
  showTabs(names, state);
  showShapes(state);
  showProfiles(state.interfaces[memory.chosen]);
  showHistories();
  const ends = Object.values(memory.timeline).flatMap((line) => line.slice(-1).map((e) => e[0]));
  drawTimeline($("timeline"), Object.entries(memory.timeline).map(([name, points]) => ({ name, points })), moving || !ends.length ? now : Math.max(...ends), SPAN);
  showProposals(state);
  showTables(state);
  showTraffic(state);
}

// ---- buttons

function prepareControls() {
  const token = new URLSearchParams(location.hash.slice(1)).get("token");
  $("controls").hidden = !token;
  $("controls").onclick = async (event) => {
    const command = event.target.dataset.command;
    if (!command || (command === "stop" && !confirm("Stop the run after this step?"))) return;
    const answer = await fetch(`api/control?command=${command}`, { method: "POST", headers: { "X-AMP-FSI-Token": token } });
    if (!answer.ok) alert(await answer.text());
  };
}

function prepareTheme() {
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  const set = (name) => { document.documentElement.dataset.theme = name; memory.stale = live.stale = true; };
  const wanted = new URLSearchParams(location.search).get("theme");
  set(wanted || (dark.matches ? "dark" : "light"));
  dark.onchange = () => set(dark.matches ? "dark" : "light");
  $("theme").onclick = () => set(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
}

prepareTheme();
prepareControls();
prepareLive();
$("factor").onchange = $("minus").onchange = window.onresize = () => { memory.stale = live.stale = true; };
connect();
show();
