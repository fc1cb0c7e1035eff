// Heartbeats on a circulation: pressure-volume loops, the Wiggers diagram of the last beat, and the beats' measures.
import { type Chart, drawChart, type DrawnChart, drawStack, type Line } from "./chart.ts";
import { lineColours } from "./colours.ts";
import { type Case, type Row, rowBetween, value } from "./data.ts";
import { el, figure, fileName, folded, section, table } from "./dom.ts";
import { beatMeasures, label, nothingBelow, shown } from "./quantities.ts";
import type { Shared, Timeline } from "./shared.ts";

/** Valve events in their order: the column of beats.csv [ms from the beat's beginning] and a short name. */
const events = [["mitral_closes_ms", "MC"], ["aortic_opens_ms", "AO"], ["aortic_closes_ms", "AC"], ["mitral_opens_ms", "MO"]];

const eventWords = "MC, MO: the mitral valve closes, opens; AO, AC: the aortic valve opens, closes";

const column = (rows: Row[], name: string) => rows.map((row) => value(row[name]));

/** The beats of cycle.csv; each begins with the sample that ends the one before it. */
function beatsOf(rows: Row[]): Row[][] {
  const beats: Row[][] = [];
  for (const [k, row] of rows.entries()) {
    const beat = value(row.beat);
    if (beat < 1) continue;
    if (beats.length < beat) beats.push([rows[k - 1]]);
    beats[beats.length - 1].push(row);
  }
  return beats;
}

/** A case's heartbeats; times of the last are from its beginning. */
interface Heartbeats {
  c: Case;
  number: number;  // of the case
  before: Row[][];
  last: Row[];
  count: number;
  measures: Row[];  // of every whole beat
  muscle: Row[];    // rows of curves.csv in the last beat
}

function heartbeatsOf(c: Case, number: number): Heartbeats | undefined {
  const beats = beatsOf(c.table("cycle.csv"));
  const last = beats.at(-1);
  if (!last) return undefined;
  const inside = (row: Row) => value(row.time_s) >= c.begin - 1e-9 && value(row.time_s) <= value(last.at(-1)!.time_s) + 1e-9;
  return { c, number, before: beats.slice(0, -1), last, count: beats.length, measures: c.table("beats.csv"), muscle: c.table("curves.csv").filter(inside) };
}

const timesIn = (h: Heartbeats, rows: Row[]) => column(rows, "time_s").map((t) => t - h.c.begin);

/** A column of the last beat at a time from its beginning, between its samples. */
function at(h: Heartbeats, name: string, time: number): number {
  const times = timesIn(h, h.last);
  const k = times.findIndex((t) => t >= time);
  if (k < 1) return value(h.last[Math.max(0, k)][name]);
  const share = (time - times[k - 1]) / (times[k] - times[k - 1]);
  return (1 - share) * value(h.last[k - 1][name]) + share * value(h.last[k][name]);
}

/** Valve events of the last beat, if it is a whole one. */
function valveEvents(h: Heartbeats): { time: number; label: string }[] {
  const row = h.measures[h.count - 1];
  const period = value(h.last.at(-1)!.time_s) - h.c.begin;
  const after = (time: number) => (time < 0 ? time + period : time);  // one before the beat, as at its end
  return events.map(([name, words]) => ({ time: after(value(row?.[name]) / 1000), label: words })).filter(({ time }) => Number.isFinite(time));
}

/** Loops: of one case all beats, the last one in colour with its valve events; of two their last beats. */
function loops(all: Heartbeats[]): Chart {
  const lines: Line[] = all.map((h, i) => ({ label: all.length > 1 ? `${h.c.name}, beat ${h.count}` : `beat ${h.count}`, colour: lineColours[i],
    x: column(h.last, "volume_ml"), y: column(h.last, "pressure_mmHg") }));
  const [one] = all;
  const joined = (name: string) => one.before.flatMap((rows) => [...column(rows, name), NaN]);
  if (all.length === 1 && one.before.length) lines.push({ label: "beats before", colour: "#949494", x: joined("volume_ml"), y: joined("pressure_mmHg"), behind: true });
  return { x: "cavity volume (ml)", y: "pressure (mmHg)", lines, zero: true,
    points: all.length > 1 ? [] : valveEvents(one).map(({ time, label: words }) => ({ x: at(one, "volume_ml", time), y: at(one, "pressure_mmHg", time), label: words })) };
}

/** The panels of the Wiggers diagram, one above the other over the time of the last beat. */
function wiggers(h: Heartbeats): Chart[] {
  const x = timesIn(h, h.last);
  const reach: [number, number] = [x[0], x.at(-1)!];
  const source = { closed_loop: "left atrium", windkessel: "venous source" }[h.c.parameter("circulation.kind") ?? ""] ?? "before the mitral valve";
  const marks = valveEvents(h).map(({ time, label: words }) => ({ x: time, label: words }));
  const panel = (y: string, height: number, names: [string, string][]): Chart => ({ x: "", y, height, width: 560, reach, zero: true, marks: marks.map((m) => ({ ...m, label: "" })),
    lines: names.map(([name, words], i): Line => ({ label: words, colour: lineColours[i], x, y: column(h.last, name) })) });
  const ofMuscle = (y: string, name: string, words: string): Chart => ({ ...panel(y, 120, []),
    lines: [{ label: words, colour: lineColours[0], x: timesIn(h, h.muscle), y: column(h.muscle, name) }] });
  const muscle = [{ y: "Ca (µM)", name: "calcium_uM", words: "calcium" }, { y: "T (kPa)", name: "mean_active_tension_kPa", words: "mean active tension" }]
    .filter(({ name }) => column(h.muscle, name).some(Number.isFinite)).map(({ y, name, words }) => ofMuscle(y, name, words));
  const panels = [
    { ...panel("p (mmHg)", 250, [["pressure_mmHg", "ventricle"], ["aortic_pressure_mmHg", "aorta"],
      ["filling_pressure_mmHg", source]]), marks },
    { ...panel("V (ml)", 140, [["volume_ml", "volume of the cavity"]]), zero: false },
    panel("Q (ml/s)", 160, [["mitral_flow_ml_per_s", "flow through the mitral valve"], ["aortic_flow_ml_per_s", "through the aortic valve"]]),
    ...muscle];
  panels[panels.length - 1] = { ...panels.at(-1)!, x: "time in the beat (s)", height: panels.at(-1)!.height! + 22 };
  return panels;
}

/** A table of the last beat: of one case with the change from the beat before it, of two with their difference. */
function measuresTable(all: Heartbeats[]): HTMLElement {
  const of = (h: Heartbeats, name: string, back = 1) => value(h.measures.at(-back)?.[name]);
  const [a, b] = all;
  const columns = b ? [...all.map((h) => h.c.name), "difference"] : [`beat ${a.measures.length}`, "change from the beat before"];
  const cells = (name: string) => (b ? [shown(of(a, name), 4), shown(of(b, name), 4), shown(of(b, name) - of(a, name))]
    : [shown(of(a, name), 4), shown(nothingBelow(1e-4 * Math.abs(of(a, name)), of(a, name) - of(a, name, 2)))]);
  return table(fileName(...all.map((h) => h.c.name), "beat"), ["measure", ...columns, "definition"],
    beatMeasures.map((m) => [label(m), ...cells(m.name), m.help]));
}

/** beats.csv. */
const allBeats = (h: Heartbeats) => el("details", { class: "more" }, el("summary", {}, `All beats of ${h.c.name}`),
  table(fileName(h.c.name, "beats"), ["beat", ...beatMeasures.map(label)], h.measures.map((row) => [row.beat, ...beatMeasures.map((m) => shown(value(row[m.name])))])));

/** Moves the dot of every loop and the line of every Wiggers diagram to the time that the 3-D view shows. */
function follow(all: Heartbeats[], loop: DrawnChart, diagrams: DrawnChart[], shared: Shared, time: Timeline): void {
  const times = all.map((h) => timesIn(h, h.last));
  const mark = () => all.forEach((h, i) => {
    const t = time.time(h.number, shared.state.step) - h.c.begin;
    const row = rowBetween(h.last, times[i], t);
    loop.dot(i, Number.isFinite(t) ? value(row?.volume_ml) : NaN, value(row?.pressure_mmHg));
    diagrams[i].cursor(t);
  });
  shared.onChange((_, changed) => changed.has("step") && mark());
  mark();
}

export function heartbeatSection(cases: Case[], shared: Shared, time: Timeline): HTMLElement {
  const found = cases.map(heartbeatsOf).filter((h): h is Heartbeats => h !== undefined);
  const title = "Heartbeats";
  if (!found.length) return folded("heartbeats", title, "cycle.csv is missing: this is not a run of heartbeats (protocol.kind = \"cycle\"), or its first beat has not begun.");
  const loop = drawChart(loops(found));
  const diagrams = found.map((h) => drawStack(wiggers(h), `Wiggers diagram of beat ${h.count} of ${h.c.name}`));
  follow(found, loop, diagrams, shared, time);
  const names = found.map((h) => h.c.name);
  const help = "The wall joined to a circulation, from cycle.csv, beats.csv and curves.csv: the loops of all beats with the last one in colour (of two cases " +
    "their last ones), and the Wiggers diagram of the last beat. Valves open and close where the pressure across them changes its sign. The dot and the " +
    "line are the time that the 3-D view shows; point at a chart to read it.";
  const whole = found.filter((h) => h.measures.length);
  return section("heartbeats", title, help, el("div", { class: "figures" },
    figure(`${names.join(", ")}: pressure-volume loops. ${found.length > 1 ? "" : eventWords}`, fileName(...names, "pressure_volume"), loop.figure),
    ...found.map((h, i) => figure(`${h.c.name}: Wiggers diagram of beat ${h.count}. ${eventWords}`, fileName(h.c.name, "wiggers"), diagrams[i].figure))),
  whole.length ? measuresTable(whole) : undefined, ...whole.map(allBeats));
}
