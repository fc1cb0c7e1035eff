// Heartbeats on a circulation: pressure-volume loops and the Wiggers diagram of the last beat.
import { type Chart, drawChart, type Line } from "./chart.ts";
import { lineColours } from "./colours.ts";
import { type Case, type Row, value } from "./data.ts";
import { el, figure, fileName, folded, section, table } from "./dom.ts";
import { shown } from "./quantities.ts";

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

const column = (rows: Row[], name: string) => rows.map((row) => value(row[name]));

function loops(beats: Row[][]): Chart {
  const before = beats.slice(0, -1);
  const joined = (name: string) => before.flatMap((rows) => [...column(rows, name), NaN]);
  const last = beats[beats.length - 1];
  const lines: Line[] = [];
  if (before.length) lines.push({ label: "beats before", colour: "#949494", x: joined("volume_ml"), y: joined("pressure_mmHg") });
  lines.push({ label: `beat ${beats.length}`, colour: lineColours[0], x: column(last, "volume_ml"), y: column(last, "pressure_mmHg") });
  return { x: "cavity volume (ml)", y: "pressure (mmHg)", lines, zero: true };
}

/** Curves of the last beat against time, with the moments at which valves open and close. */
function againstTime(c: Case, last: Row[], y: string, names: [string, string][]): Chart {
  const begin = value(last[0].time_s);
  const marks = c.moments.filter(({ time }) => time >= begin)
    .map(({ name, time }) => ({ x: time, label: { end_diastole: "mitral closes", end_systole: "aortic closes", aortic_opening: "aortic opens", mitral_opening: "mitral opens" }[name] ?? name }));
  return { x: "time (s)", y, zero: true, width: 560, marks,
    lines: names.map(([name, label], i): Line => ({ label, colour: lineColours[i], x: column(last, "time_s"), y: column(last, name) })) };
}

const measures: [string, string][] = [["edv_ml", "end-diastolic volume (ml)"], ["esv_ml", "end-systolic volume (ml)"], ["ejection_fraction", "ejection fraction"],
  ["peak_pressure_mmHg", "peak pressure (mmHg)"], ["aortic_systolic_mmHg", "aorta, systolic (mmHg)"], ["aortic_diastolic_mmHg", "aorta, diastolic (mmHg)"],
  ["isovolumic_contraction_ms", "isovolumic contraction (ms)"], ["ejection_time_ms", "ejection (ms)"], ["isovolumic_relaxation_ms", "isovolumic relaxation (ms)"]];

function figuresOf(c: Case): HTMLElement[] {
  const beats = beatsOf(c.table("cycle.csv"));
  const last = beats[beats.length - 1];
  const make = (caption: string, name: string, chart: Chart) => figure(`${c.name}: ${caption}`, fileName(c.name, name), drawChart(chart).figure);
  const which = `beat ${beats.length}`;
  return [
    make("pressure-volume loops", "pressure_volume", loops(beats)),
    make(`Wiggers diagram, pressures of ${which}`, "wiggers_pressures", againstTime(c, last, "pressure (mmHg)",
      [["pressure_mmHg", "ventricle"], ["aortic_pressure_mmHg", "aorta"], ["filling_pressure_mmHg", "before the mitral valve"]])),
    make(`Wiggers diagram, volume of ${which}`, "wiggers_volume", againstTime(c, last, "cavity volume (ml)", [["volume_ml", "ventricle"]])),
    make(`Wiggers diagram, flows of ${which}`, "wiggers_flows", againstTime(c, last, "flow (ml/s)",
      [["mitral_flow_ml_per_s", "mitral valve"], ["aortic_flow_ml_per_s", "aortic valve"]])),
  ];
}

export function heartbeatSection(cases: Case[]): HTMLElement {
  const found = cases.filter((c) => beatsOf(c.table("cycle.csv")).length);
  const title = "Heartbeats";
  if (!found.length) return folded("heartbeats", title, "cycle.csv is missing: this is not a run of heartbeats (protocol.kind = \"cycle\"), or its first beat has not begun.");
  const help = "The wall joined to a circulation, from cycle.csv and beats.csv: loops of all beats, the last one in colour, and pressures, volume and " +
    "flows of the last one. Valves open and close where the pressure across them changes its sign.";
  return section("heartbeats", title, help, el("div", { class: "figures" }, ...found.flatMap(figuresOf)),
    ...found.filter((c) => c.table("beats.csv").length).map((c) => table(fileName(c.name, "beats"), ["beat", ...measures.map(([, words]) => words)],
      c.table("beats.csv").map((row) => [row.beat, ...measures.map(([name]) => shown(value(row[name])))]))));
}
