"use strict";
// Tables of the programs, the interfaces and the messages at them, and who proposes which step.

function row(tag, cells) {
  return make("tr", {}, ...cells.map((cell) => {
    const element = make(tag, {});
    element.append(cell instanceof Node ? cell : String(cell));
    return element;
  }));
}

function count(value) {
  if (value === null) return "\u2013";
  for (const [size, unit] of [[1e9, "G"], [1e6, "M"], [1e3, "k"]]) if (value >= size) return `${short(Number((value / size).toPrecision(3)))} ${unit}`;
  return short(Number(value.toPrecision(3)));
}

function meter(share) {
  if (share === null) return "\u2013";
  const fill = make("i", {});
  fill.style.width = `${100 * share}%`;
  return make("span", {}, make("span", { className: "meter" }, fill), `${Math.round(100 * share)} / ${100 - Math.round(100 * share)} %`);
}

function health(program) {
  const h = program.health, noise = program.noise ? `, WARNING: ${program.noise}` : "";
  if (program.role === "fluid") return `min \u03c1 ${short(h.min_rho)}, min p ${short(h.min_p)}, cells ${short(h.min_cell_quality)}, first order ${h.first_order_fallbacks}, floors ${h.floors}${noise}`;
  return program.role === "solid" ? `min det F ${short(h.min_det_F)}${noise}` : "";
}

// Who limits the step stands out.
function proposal(state, name, program) {
  if (program.role === "coupler" || (program.proposed_dt === null && over(state))) return "\u2013";
  const text = program.proposed_dt === null ? "no limit" : short(program.proposed_dt), limits = name === state.limited_by;
  const proposals = Object.values(state.participants || {}).map((one) => one.proposed_dt).filter((proposal) => proposal !== null && isFinite(proposal));
  const fill = make("i", { className: limits ? "limits" : "" }), part = program.proposed_dt === null ? 1 : program.proposed_dt / Math.max(...proposals, program.proposed_dt);
  fill.style.width = `${100 * part}%`;
  return make(limits ? "b" : "span", { className: limits ? "limiter" : "", title: program.dt_reason }, make("span", { className: "meter short" }, fill), limits ? `${text} limits` : text);
}

function showTraffic(state) {
  const rows = Object.entries(state.participants).flatMap(([name, program]) => program.traffic.map((one) => [one, name]));
  rows.sort((a, b) => (a[0].interface < b[0].interface ? -1 : a[0].interface > b[0].interface ? 1 : 0));
  $("traffic-section").hidden = !rows.length;
  const warn = (value) => make("span", { className: value > 0 ? "warning" : "" }, String(value));
  $("traffic").replaceChildren(row("th", ["interface", "from", "to", "messages/s", "bytes/s", "bytes each", "messages", "missing", "dropped", "latency p50 / p99"]),
    ...rows.map(([one, to]) => row("td", [one.interface, one.from, to, count(one.messages_per_s), count(one.bytes_per_s),
      one.messages ? count(one.bytes / one.messages) : "\u2013", one.messages, warn(one.missing), warn(one.dropped),
      one.latency_p99_us ? `${short(Math.round(one.latency_p50_us))} / ${short(Math.round(one.latency_p99_us))} \u00b5s` : "\u2013"])));
}

const SETTING_COLOUR = "dim";

// The first gas and the first solid have the colours they have along the interface.
function coloursOf(programs) {
  const own = { fluid: ["gas"], solid: ["solid"] }, others = ["good", "busy", "bad"];
  return programs.map(({ role }) => theme[(own[role] || []).shift() || others.shift() || "ink"]);
}

// Whose proposal is well below the step that others limit divides it.
function takesSubsteps(state, name) {
  return name !== state.limited_by && state.participants[name].proposed_dt !== null && state.participants[name].proposed_dt < 0.9 * state.dt;
}

// ", 98 % of the steps" a program or a setting limited so far.
function shareOf(state, by) {
  const total = Object.values(state.limits || {}).reduce((sum, steps) => sum + steps, 0);
  return total && state.limits[by] ? `, ${short(Number((100 * state.limits[by] / total).toPrecision(3)))} % of the steps` : "";
}

// What everybody proposed, and what was agreed on.
function showProposals(state) {
  const names = Object.keys(state.participants).filter((name) => state.participants[name].role !== "coupler");
  const colours = coloursOf(names.map((name) => state.participants[name]));
  const curves = names.map((name, k) => ({ name, list: memory.history[`${name}.proposed_dt`] || [], colour: colours[k] }));
  curves.push({ name: "agreed on", list: memory.history.dt || [], colour: theme.projected, dash: [2, 3] });
  const colourOf = (name) => (names.includes(name) ? colours[names.indexOf(name)] : theme[SETTING_COLOUR]);
  drawPlot($("proposals"), { title: "dt, log; below: who limits it", axis: "t", x: "t", log: true, nothing: "no step was proposed yet",
    strip: memory.limiters.map(([t, name]) => [t, colourOf(name)]),
    curves: curves.map(({ list, ...rest }) => ({ x: list.map((e) => e[0]), y: list.map((e) => e[1]), ...rest })) });
  const shares = Object.keys(state.limits || {}).filter((name) => state.limits[name]).map((name) => `${name}${shareOf(state, name)}`).join("; ");
  const words = names.map((name) => (takesSubsteps(state, name) ? `${name} (takes substeps)` : name)), key = words.join("\n") + theme.gas + shares;
  if ($("proposals-legend").dataset.key === key) return;
  $("proposals-legend").dataset.key = key;
  const mark = (colour, style) => { const line = make("i", {}); line.style.borderTop = `2.5px ${style} ${colour}`; return line; };
  $("proposals-legend").replaceChildren(...words.flatMap((text, k) => [mark(colours[k], "solid"), text]), mark(theme.projected, "dotted"), "agreed on",
    mark(theme[SETTING_COLOUR], "solid"), "a setting", make("span", { className: "dim" }, shares ? `\u00b7 limited by ${shares}` : ""));
}

// Of a rigid body or a beam, say, there is nothing that the gas's traction could be compared with.
const OF_STRESS = ["traction_jump", "shear"];
function hasStress(side) {
  return side.s.length < 2 || side.p_predicted_solid.length > 0;
}

function showTables(state) {
  const head = row("th", ["", "state", "step", "proposes dt", "computing / waiting", "points/s", "steps/s", "messages/s", "bytes/s", "others' answer p50 / p99", "health"]);
  const rows = Object.entries(state.participants).map(([name, p]) => row("td", [name,
    make("span", { className: KIND[p.standing] || "" }, p.standing), p.step, proposal(state, name, p), meter(p.computing_now ?? p.computing_share),
    p.point_updates_per_s > 0 ? count(p.point_updates_per_s) : "\u2013", short(p.steps_per_s), count(p.bus.messages_per_s), count(p.bus.bytes_per_s),
    p.bus.round_trip_p99_us > 0 ? `${short(p.bus.round_trip_p50_us / 1e3)} / ${short(p.bus.round_trip_p99_us / 1e3)} ms` : "\u2013", health(p)]));
  $("programs").replaceChildren(head, ...rows);
  const sides = Object.entries(state.interfaces);
  $("interface-section").hidden = !sides.length;
  $("interfaces").replaceChildren(row("th", ["", "velocity jump", "traction jump", "tangential traction", "gap", "power", "p min", "p max", "v_n min", "v_n max"]),
    ...sides.map(([name, s]) => row("td", [name, ...["velocity_jump", "traction_jump", "shear", "gap", "power", "p_min", "p_max", "v_min", "v_max"].map(
      (what) => (OF_STRESS.includes(what) && !hasStress(s) ? "\u2013" : short(s[what])))])));
}
