// SPDX-License-Identifier: Apache-2.0
import "uplot/dist/uPlot.min.css";
import "./style.css";

import { field_text } from "./cdr_fields";
import { Control } from "./control";
import { first_difference } from "./difference";
import type { Difference } from "./difference";
import { attempt, button, by_id, element, once_a_frame, tell_trouble_to } from "./elements";
import { embedded, has_embedded } from "./embedded";
import { Insides } from "./insides";
import { Inspector } from "./inspector";
import { listen_to_keys } from "./keys";
import { Lanes } from "./lanes";
import { LiveRun } from "./live";
import { MapView } from "./map_view";
import { Overview } from "./overview";
import { Plots } from "./plots";
import { Recording, tell_complaints_to } from "./recording";
import type { Run } from "./run";
import { Session } from "./session";
import { read_embedded, read_served, read_session } from "./sources";
import { run_colour, run_dash, theme, toggle_theme } from "./theme";
import { read_choices } from "./server";
import { Transport } from "./transport";
import { WhatIf } from "./what_if";

/// What there is to show is asked for before anything else is done.
const served = location.protocol.startsWith("http") && !has_embedded() ? read_session() : undefined;
served?.catch(() => undefined);

const session = new Session();
const map = new MapView(session);
new Lanes(session);
const transport = new Transport(session);
const plots = new Plots(session);

function notice(text: string): void {
  by_id("notice").textContent = text;
}
const message_of = (error: unknown): string => (error instanceof Error ? error.message : String(error));
tell_trouble_to((error) => notice(`not all of it can be shown: ${message_of(error)}`));

/// What of the recordings is left out, as long as they are shown: whenever it is found, each once.
function show_complaints(): void {
  const told = session.runs.filter(({ recording }) => recording.complaints.length > 0)
    .map(({ recording }) => `${recording.name}: ${recording.complaints.join("; ")}`).join(" · ");
  if (by_id("left-out").textContent !== told) by_id("left-out").textContent = told;
}
tell_complaints_to(once_a_frame(show_complaints));

// ---- panels ----

let what_if: WhatIf | undefined;
let control: Control | undefined;

function add_panel(name: string, title: string): HTMLElement {
  const panel = element("div", { id: `panel-${name}`, role: "tabpanel", "aria-label": title });
  const tab = button(title, title, () => show_panel(name));
  tab.id = `tab-${name}`;
  tab.setAttribute("role", "tab");
  by_id("tabs").append(tab);
  by_id("panels").append(panel);
  return panel;
}

function show_panel(name: string): void {
  for (const panel of by_id("panels").children) (panel as HTMLElement).hidden = panel.id !== `panel-${name}`;
  for (const tab of by_id("tabs").children) tab.setAttribute("aria-selected", String(tab.id === `tab-${name}`));
  what_if?.show_drawing();
  if (name === "insides") map.want_insides();
  session.tell("layers");
}

new Overview(session, add_panel("overview", "Overview"));
new Inspector(session, plots, add_panel("messages", "Messages"));
const insides = new Insides(session, map, add_panel("insides", "Insides"), location.protocol.startsWith("http") && !has_embedded());
show_panel("overview");

// ---- runs ----

function show_runs(): void {
  const worlds = new Set(session.runs.map((run) => run.world?.name));
  by_id("runs").replaceChildren(...session.runs.map((run) => {
    const swatch = element("canvas", { width: "26", height: "10" });
    const g = swatch.getContext("2d");
    if (g) {
      g.strokeStyle = run_colour(theme(), run.index);
      g.setLineDash(run_dash(run.index));
      g.lineWidth = 3;
      g.beginPath();
      g.moveTo(0, 5);
      g.lineTo(26, 5);
      g.stroke();
    }
    const box = element("input", { type: "checkbox", title: `Show or hide (${run.index + 1})` });
    box.checked = !session.hidden.has(run.index);
    box.addEventListener("change", () => toggle_run(run.index));
    const choose = button(run.recording.name, "Show the messages and lanes of this run", () => {
      session.chosen = run.index;
      show_runs();
      session.tell("runs");
    });
    choose.setAttribute("aria-pressed", String(session.chosen === run.index));
    const number = element("b", {}, session.runs.length > 1 ? String(run.index + 1) : "");
    return element("span", { role: "listitem", class: "run" }, box, number, swatch, choose, element("small", {}, run.outcome + (worlds.size > 1 ? ` in ${run.world?.name ?? "?"}` : "")));
  }));
  by_id("first-difference").hidden = session.runs.length < 2;
}

function toggle_run(index: number): void {
  if (index >= session.runs.length) return;
  if (session.hidden.has(index)) session.hidden.delete(index);
  else session.hidden.add(index);
  show_runs();
  session.tell("runs");
}

/// The first field in which the chosen run and the next shown one differ.
function compare(): Difference | undefined {
  const a = session.run;
  const b = session.shown.find((run) => run !== a) ?? session.runs.find((run) => run !== a);
  if (!a || !b) return undefined;
  // The earlier in the list is `a`, as on the command line.
  const [first, second] = a.index < b.index ? [a, b] : [b, a];
  const found = first_difference(first.recording, second.recording);
  notice(found
    ? `tick ${found.tick}, ${found.topic}.${found.field}: ${field_text(found.a)} | ${field_text(found.b)}`
    : "the two recordings hold the same samples");
  if (found) session.go_to(found.tick);
  return found;
}

let following = false;
let is_live = false;
/// Reads what has come, a piece a frame; of a run under way the newest tick stays chosen, unless
/// somebody looks elsewhere.
function follow(): void {
  if (following) return;
  following = true;
  const turn = (): void => {
    const at_newest = is_live && session.tick >= session.last_tick;
    let more = false;
    for (const run of session.runs) attempt(() => { more = run.follow(12) || more; });
    attempt(() => session.tell("data"));
    if (at_newest) attempt(() => session.go_to(Infinity));
    following = more;
    if (more) requestAnimationFrame(turn);
    else {
      show_runs();
      show_complaints();
    }
  };
  turn();
}

export async function open(name: string, read: (recording: Recording, on_piece: () => void) => Promise<void>): Promise<Run> {
  const run = session.add(new Recording(name));
  show_runs();
  try {
    await read(run.recording, follow);
  } catch (error) {
    notice(`${name}: ${message_of(error)}; shown is what came before`);
  }
  follow();
  return run;
}

async function add_what_if(): Promise<void> {
  const choices = await read_choices();
  what_if = new WhatIf(session, map, add_panel("what-if", "What if"), choices, ({ recording, name }) => open_served(recording, name, 1));
  const asked = what_if;
  insides.let_edit(choices, {
    label: "Branch with these rules", title: "Go on from the chosen tick with the rule base as it is written here",
    why_not: () => asked.why_no_branch(),
    use: async (rules) => {
      const { command, report } = await asked.branch_with(rules);
      return { said: `${report.outcome} after ${report.ticks} ticks`, command };
    },
  });
  show_panel(session.runs.length === 0 ? "what-if" : "overview");
}

async function open_served(id: number, name: string, files: number): Promise<Run> {
  const run = await open(name, (recording, on_piece) => read_served(id, files, recording, on_piece));
  run.served = id;
  session.tell("runs");
  return run;
}

/// Follows a run under way.
async function watch(): Promise<void> {
  let run: Run | undefined;
  is_live = true;
  const live = new LiveRun({
    grown: follow,
    again: (recording) => run?.restart(recording),
    ended: (how, missed) => {
      follow();
      control?.end();
      document.body.dataset["ended"] = how;
      notice(missed > 0 ? `${how}; while it ran, ${missed} ticks were too fast to be shown` : how);
    },
  });
  run = session.add(live.recording);
  // All that a gateway has.
  run.served = 0;
  show_runs();
  const choices = await read_choices();
  control = new Control(session, map, add_panel("control", "Control"), choices);
  const asked = control;
  insides.let_edit(choices, {
    label: "Use these rules from now on", title: "The run goes on with the rule base as it is written here, from the next tick that nobody has begun",
    use: (rules) => asked.use_rules(rules),
  });
  if (document.body.dataset["ended"] !== undefined) control.end();
  show_panel("overview");
}

async function begin(): Promise<void> {
  // The address carried the token once; now the cookie does.
  if (location.protocol.startsWith("http") && location.search !== "") history.replaceState(null, "", location.pathname);
  if (has_embedded()) {
    for (const { name, files } of embedded()) await open(name, (recording, on_piece) => read_embedded(files, recording, on_piece));
  } else if (served) {
    const { recordings, live } = await served;
    for (const { id, name, files } of recordings) await open_served(id, name, files);
    if (live) await watch();
    else await add_what_if();
  }
  session.go_to(session.last_tick);
  document.body.dataset["ready"] = "true";
}

// ---- keys ----

function redraw_theme(): void {
  toggle_theme();
  show_runs();
  session.tell("theme");
}

by_id("theme").addEventListener("click", redraw_theme);
by_id("help").addEventListener("click", () => by_id<HTMLDialogElement>("keys").showModal());
by_id("first-difference").addEventListener("click", () => compare());

const on_map = (event: KeyboardEvent): boolean => event.shiftKey;
listen_to_keys([
  { keys: [" "], shown: "space", what: "play or pause", act: () => session.set_playing(!session.playing) },
  { keys: ["ArrowRight"], shown: "→", what: "a tick on; with shift ten", act: (e) => session.go_to(session.tick + (on_map(e) ? 10 : 1)) },
  { keys: ["ArrowLeft"], shown: "←", what: "a tick back; with shift ten", act: (e) => session.go_to(session.tick - (on_map(e) ? 10 : 1)) },
  { keys: ["Home"], shown: "Home", what: "first tick", act: () => session.go_to(session.first_tick) },
  { keys: ["End"], shown: "End", what: "last tick", act: () => session.go_to(session.last_tick) },
  { keys: ["n"], shown: "n", what: "next event", act: () => transport.jump(true) },
  { keys: ["p"], shown: "p", what: "the event before", act: () => transport.jump(false) },
  { keys: [">", "."], shown: ">", what: "faster", act: () => transport.change_rate(true) },
  { keys: ["<", ","], shown: "<", what: "slower", act: () => transport.change_rate(false) },
  { keys: ["d"], shown: "d", what: "first field in which two runs differ", act: () => compare() },
  { keys: ["1", "2", "3", "4", "5", "6", "7", "8", "9"], shown: "1 … 9", what: "show or hide a run", act: (e) => toggle_run(Number(e.key) - 1) },
  { keys: ["o"], shown: "o", what: "overview", act: () => show_panel("overview") },
  { keys: ["i"], shown: "i", what: "messages of the tick", act: () => show_panel("messages") },
  { keys: ["x"], shown: "x", what: "insides of the tick, explained", act: () => show_panel("insides") },
  { keys: ["e"], shown: "e", what: "what if", act: () => show_panel("what-if") },
  { keys: ["b"], shown: "b", what: "branch from this tick", act: branch },
  { keys: ["c"], shown: "c", what: "control of a run under way", act: () => control && show_panel("control") },
  { keys: ["k"], shown: "k", what: "pause or resume a run under way", act: () => void control?.toggle() },
  { keys: ["j"], shown: "j", what: "a tick of a run that is paused", act: () => void control?.do_step() },
  { keys: ["g"], shown: "g", what: "a new target for a run under way: then click on the map, or move the cross there by arrows and press Enter", act: () => control?.choose_goal() },
  { keys: ["+", "="], shown: "+", what: "zoom in", act: () => map.zoom(1.3) },
  { keys: ["-"], shown: "-", what: "zoom out", act: () => map.zoom(1 / 1.3) },
  { keys: ["0", "f"], shown: "0", what: "the whole world", act: () => map.fit() },
  { keys: ["w", "a", "s", "W", "A", "S", "D"], shown: "w a s", what: "move the map up, left, down; D right", act: (e) => map.pan(...pan_of(e.key)) },
  { keys: ["m"], shown: "m", what: "measure; arrows move a cross on the map, Enter begins and ends", act: () => map.measure() },
  { keys: ["l"], shown: "l", what: "layers", act: open_layers },
  { keys: ["t"], shown: "t", what: "light or dark", act: redraw_theme },
  { keys: ["?"], shown: "?", what: "these keys", act: () => by_id<HTMLDialogElement>("keys").showModal() },
]);

/// Where there can be no branch, the panel says why.
function branch(): void {
  if (what_if && what_if.why_no_branch() !== "") show_panel("what-if");
  else void what_if?.branch();
}

function pan_of(key: string): [number, number] {
  switch (key.toLowerCase()) {
    case "w": return [0, -60];
    case "s": return [0, 60];
    case "a": return [-60, 0];
    default: return [60, 0];
  }
}

function open_layers(): void {
  const layers = by_id<HTMLDetailsElement>("layers");
  layers.open = !layers.open;
  if (layers.open) layers.querySelector("input")?.focus();
}

matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => session.tell("theme"));

/// For tests: what the page knows, in its own words.
Object.assign(window, { clew: { session, plots, compare, map } });
begin().catch((error: unknown) => notice(message_of(error)));
