// Curves against time, the pressure-volume loop, rotation, the muscle's law.
import { type Chart, drawChart, type DrawnChart, type Line } from "./chart.ts";
import { lineColours } from "./colours.ts";
import { type Case, type Row, value } from "./data.ts";
import { rowAt } from "./wall_section.ts";
import { el, figure, fileName, folded, missing, paperSwitch, section, table } from "./dom.ts";
import { curve, lawOf, type NamedLaw, publishedLaws } from "./muscle.ts";
import { shown } from "./quantities.ts";
import type { Shared, Timeline } from "./shared.ts";

const joined = (cases: Case[]) => cases.map((c) => c.name).join("-");
const column = (rows: Row[], name: string) => rows.map((row) => value(row[name]));

/** Where a case is at end-diastole and end-systole. */
function states(c: Case): { x: number; y: number; label: string; time: number }[] {
  return ([["ED", "end_diastole"], ["ES", "end_systole"]] as const).flatMap(([label, name]) => {
    const s = c.summary?.[name];
    return s ? [{ label, time: s.time_s, x: s.cavity_volume_ml, y: s.pressure_mmHg }] : [];
  });
}

export function curvesSection(cases: Case[], shared: Shared, time: Timeline): HTMLElement {
  const title = "Pressure, volume, tension, calcium";
  const shownCases = cases.map((c, number) => ({ c, number, rows: c.table("curves.csv") })).filter(({ rows }) => rows.length);
  if (!shownCases.length) return folded("curves", title, "curves.csv is missing: the beat has not begun.");
  const loads = shownCases.every(({ c }) => c.isLoaded);
  const course = loads ? "load (sequence of equilibria, no time)" : shownCases.some(({ c }) => c.isLoaded) ? "time (s); load where there is no time" : "time (s)";
  const help = "From curves.csv. There are no valves: pressure and activation are given, and the volume follows, so the path of pressure against volume " +
    "is no loop of a heart. " + (loads ? "The quasi-static engine goes from equilibrium to equilibrium: the axis counts its load, not time. " : "") +
    "Where a file has no value the curve has a gap: calcium between rest and peak of the quasi-static engine. The black line and the dots " +
    "are the moment that the 3-D view shows; point at a chart to read it.";
  const against = [
    { y: "cavity_volume_ml", title: "cavity volume (ml)" },
    { y: "pressure_mmHg", title: "endocardial pressure (mmHg)" },
    { y: "mean_active_tension_kPa", title: "mean active tension (kPa)" },
    { y: "calcium_uM", title: "calcium (µM)" },
  ];
  const drawn: { chart: DrawnChart; x: string; y: string }[] = [];
  const make = (caption: string, x: string, xTitle: string, y: string, yTitle: string) => {
    const chart: Chart = { x: xTitle, y: yTitle, zero: true,
      lines: shownCases.map(({ c, rows }, i): Line => ({ label: c.name, colour: lineColours[i], x: column(rows, x), y: column(rows, y) })) };
    if (x === "time_s" && shownCases.length === 1) chart.marks = states(shownCases[0].c).map(({ time: at, label }) => ({ x: at, label }));
    if (x !== "time_s") chart.points = shownCases.flatMap(({ c }) => states(c));
    const one = drawChart(chart);
    drawn.push({ chart: one, x, y });
    return figure(caption, fileName(joined(cases), y, "against", x), one.figure);
  };
  const figures = [make("pressure-volume path (no valves)", "cavity_volume_ml", "cavity volume (ml)", "pressure_mmHg", "endocardial pressure (mmHg)"),
    ...against.map(({ y, title: words }) => make(`${words} against ${loads ? "load" : "time"}`, "time_s", course, y, words))];
  const mark = () => shownCases.forEach(({ number, rows }, i) => {
    const t = time.time(number, shared.state.step);
    const row = rowAt(rows, t)!;
    for (const { chart, x, y } of drawn) {
      chart.dot(i, Number.isFinite(t) ? value(row[x]) : NaN, value(row[y]));
      if (x === "time_s" && shownCases.length === 1) chart.cursor(t);
    }
  });
  shared.onChange((_, changed) => changed.has("step") && mark());
  mark();
  return section("curves", title, help, el("div", { class: "figures" }, ...figures));
}

export function rotationSection(cases: Case[]): HTMLElement {
  const help = "Mean rotation of each short-axis slice about the long axis, anticlockwise seen from the apex positive, from " +
    "rotation.csv. A normal apex turns anticlockwise in systole, by about 10° from images, while the base turns clockwise by about " +
    "3° (Young & Cowan, J. Cardiovasc. Magn. Reson. 14:49, 2012); the model's base cannot turn.";
  const found = cases.map((c) => ({ c, rows: c.table("rotation.csv") })).filter(({ rows }) => rows.length);
  if (!found.length) return folded("rotation", "Rotation per slice", "rotation.csv is missing: there are no results yet.");
  const columns = [["end_diastole_to_end_systole_deg", "end-diastole to end-systole"], ["early_to_end_diastole_deg", "early to end-diastole"]];
  const lines = found.flatMap(({ c, rows }, i) => columns.map(([name, title], k): Line => ({
    label: cases.length > 1 ? `${c.name}: ${title}` : title, colour: lineColours[i], dashed: k === 1, dots: true,
    x: column(rows, "slice"), y: column(rows, name) })));
  const chart = drawChart({ x: "slice, from the base (1) to the apex (7)", y: "rotation (°)", lines, zero: true, width: 560 });
  return section("rotation", "Rotation per slice", help, el("div", { class: "figures" },
    figure("Rotation of the slices", fileName(joined(cases), "rotation"), chart.figure),
    el("p", { class: "help of-paper" }, "In the paper the healthy apex turns by 16°, the patient's by about 3°."),
    ...found.map(({ c, rows }) => table(fileName(c.name, "rotation"), ["slice", ...columns.map(([, title]) => `${title} (°)`)],
      rows.map((row) => [row.slice, ...columns.map(([name]) => shown(value(row[name])))]))), ...turnDifference(found)));
}

/** The second case less the first, slice by slice. */
function turnDifference(found: { c: Case; rows: Row[] }[]): HTMLElement[] {
  if (found.length < 2) return [];
  const [a, b] = found;
  const turn = (row: Row) => value(row.end_diastole_to_end_systole_deg);
  return [table(fileName(b.c.name, "minus", a.c.name, "rotation"), ["slice", `${a.c.name} (°)`, `${b.c.name} (°)`, "difference (°)"],
    a.rows.map((row, i) => [row.slice, shown(turn(row)), shown(turn(b.rows[i])), shown(turn(b.rows[i]) - turn(row))]))];
}

export function muscleSection(cases: Case[]): HTMLElement {
  const help = "Passive muscle pulled along the fibre with free sides: Cauchy stress against stretch, computed " +
    "here from the law and the parameters in summary.json. Excised muscle (Holzapfel & Ogden's fit) is far stiffer than what images of living hearts lead to.";
  const own = cases.map((c): Partial<NamedLaw> => ({ label: `${c.name} (this case)`, law: lawOf(c) }));
  const found = own.filter((law): law is NamedLaw => law.law !== undefined);
  const lines = [...found, ...publishedLaws].map(({ label, law }, i): Line =>
    ({ label, colour: lineColours[i], dashed: i >= found.length, ofPaper: label.startsWith("Gao"), ...curve(law) }));
  const chart = drawChart({ x: "fibre stretch", y: "Cauchy stress (kPa)", lines, zero: true, width: 640, height: 380 });
  return section("muscle", "Passive muscle", help, paperSwitch(),
    ...own.filter(({ law }) => !law).map(({ label }) => missing(`${label}: no summary.json, so the law's parameters are not known.`)),
    el("div", { class: "figures" }, figure("Stress against stretch along the fibre", fileName(joined(cases), "stress-stretch"), chart.figure)));
}
