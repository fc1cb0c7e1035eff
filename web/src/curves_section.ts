// Curves against time, the pressure-volume loop, rotation, passive muscle.
import { type Chart, drawChart, type DrawnChart, type Line } from "./chart.ts";
import { lineColours } from "./colours.ts";
import { type Case, type Row, value } from "./data.ts";
import { el, figure, fileName, missing, section, table } from "./dom.ts";
import { shown, stateTitle } from "./quantities.ts";
import type { Shared, Timeline } from "./shared.ts";

const joined = (cases: Case[]) => cases.map((c) => c.name).join("-");
const column = (rows: Row[], name: string) => rows.map((row) => value(row[name]));

export function curvesSection(cases: Case[], shared: Shared, time: Timeline): HTMLElement {
  const help = "From curves.csv. The loop runs anticlockwise: filling along the bottom, contraction against a given pressure. " +
    "The black line and the dots are the moment that the 3-D view shows; point at a chart to read it.";
  const shownCases = cases.map((c, number) => ({ c, number, rows: c.table("curves.csv") })).filter(({ rows }) => rows.length);
  if (!shownCases.length)
    return section("curves", "Pressure, volume, tension, calcium", help, missing("curves.csv is missing: the beat has not begun."));
  const against = [
    { y: "cavity_volume_ml", title: "cavity volume (ml)" },
    { y: "pressure_mmHg", title: "endocardial pressure (mmHg)" },
    { y: "mean_active_tension_kPa", title: "mean active tension (kPa)" },
    { y: "calcium_uM", title: "calcium (µM)" },
  ];
  const drawn: { chart: DrawnChart; x: string; y: string }[] = [];
  const make = (x: string, xTitle: string, y: string, yTitle: string) => {
    const chart: Chart = { x: xTitle, y: yTitle, zero: true,
      lines: shownCases.map(({ c, rows }, i): Line => ({ label: c.name, colour: lineColours[i], x: column(rows, x), y: column(rows, y) })) };
    if (x === "time_s" && cases.length === 1)
      chart.marks = cases[0].moments.map((m) => ({ x: m.time, label: stateTitle(m.name) }));
    const one = drawChart(chart);
    drawn.push({ chart: one, x, y });
    return figure(`${yTitle} against ${xTitle}`, fileName(joined(cases), y, "against", x), one.figure);
  };
  const figures = [make("cavity_volume_ml", "cavity volume (ml)", "pressure_mmHg", "endocardial pressure (mmHg)"),
    ...against.map(({ y, title }) => make("time_s", "time (s)", y, title))];
  const mark = () => shownCases.forEach(({ number, rows }, i) => {
    const t = time.time(number, shared.state.step);
    const row = rows.reduce((best, r) => (Math.abs(value(r.time_s) - t) < Math.abs(value(best.time_s) - t) ? r : best));
    for (const { chart, x, y } of drawn) {
      chart.dot(i, Number.isFinite(t) ? value(row[x]) : NaN, value(row[y]));
      if (x === "time_s" && shownCases.length === 1) chart.cursor(t);
    }
  });
  shared.onChange((_, changed) => changed.has("step") && mark());
  mark();
  return section("curves", "Pressure, volume, tension, calcium", help, el("div", { class: "figures" }, ...figures));
}

export function rotationSection(cases: Case[]): HTMLElement {
  const help = "Mean rotation of each short-axis slice about the long axis, anticlockwise seen from the apex positive, from " +
    "rotation.csv. A normal apex turns anticlockwise in systole, by about 10° from images, while the base turns clockwise by about " +
    "3° (Young & Cowan, J. Cardiovasc. Magn. Reson. 14:49, 2012); the model's base cannot turn. In the paper the healthy apex turns " +
    "by 16°, the patient's by about 3°.";
  const found = cases.map((c) => ({ c, rows: c.table("rotation.csv") })).filter(({ rows }) => rows.length);
  if (!found.length) return section("rotation", "Rotation per slice", help, missing("rotation.csv is missing: there are no results yet."));
  const columns = [["end_diastole_to_end_systole_deg", "end-diastole to end-systole"], ["early_to_end_diastole_deg", "early to end-diastole"]];
  const lines = found.flatMap(({ c, rows }, i) => columns.map(([name, title], k): Line => ({
    label: cases.length > 1 ? `${c.name}: ${title}` : title, colour: lineColours[i], dashed: k === 1, dots: true,
    x: column(rows, "slice"), y: column(rows, name) })));
  const chart = drawChart({ x: "slice, from the base (1) to the apex (7)", y: "rotation (°)", lines, zero: true, width: 560 });
  return section("rotation", "Rotation per slice", help, el("div", { class: "figures" },
    figure("Rotation of the slices", fileName(joined(cases), "rotation"), chart.figure),
    ...found.map(({ c, rows }) => table(fileName(c.name, "rotation"), ["slice", ...columns.map(([, title]) => `${title} (°)`)],
      rows.map((row) => [row.slice, ...columns.map(([name]) => shown(value(row[name])))])))));
}

export function muscleSection(cases: Case[]): HTMLElement {
  const help = "Passive muscle pulled along the fibre with free sides (the paper's Figure 5): Cauchy stress against stretch of this case's " +
    "muscle and of published ones, from stress_stretch.csv. The curves of Xi et al. (2011) and " +
    "Krishnamurthy et al. (2013), which the paper also shows, are not drawn: their numbers are not printed in it. " +
    "Excised muscle (Holzapfel & Ogden's fit) is far stiffer than what images of living hearts lead to.";
  const found = cases.map((c) => ({ c, rows: c.table("stress_stretch.csv") })).filter(({ rows }) => rows.length);
  const absent = cases.filter((c) => !found.some((one) => one.c === c))
    .map((c) => missing(`${c.name}: stress_stretch.csv is missing: there are no results yet.`));
  if (!found.length) return section("muscle", "Passive muscle", help, ...absent);
  const own = found.map(({ c, rows }) => ({ label: `${c.name} (this case)`, dashed: false, rows: rows.filter((r) => r.published === "no") }));
  const published = found[0].rows.filter((r) => r.published === "yes");
  const others = [...new Set(published.map((r) => r.muscle))].map((label) => ({ label, dashed: true, rows: published.filter((r) => r.muscle === label) }));
  const lines = [...own, ...others].map(({ label, dashed, rows }, i): Line =>
    ({ label, dashed, colour: lineColours[i], x: column(rows, "fibre_stretch"), y: column(rows, "cauchy_stress_kPa") }));
  const chart = drawChart({ x: "fibre stretch", y: "Cauchy stress (kPa)", lines, zero: true, width: 640, height: 380 });
  return section("muscle", "Passive muscle", help, ...absent,
    el("div", { class: "figures" }, figure("Stress against stretch along the fibre", fileName(joined(cases), "stress-stretch"), chart.figure)));
}
