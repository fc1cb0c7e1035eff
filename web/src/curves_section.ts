// Curves against time, the pressure-volume path, rotation, passive muscle.
import { type Chart, drawChart, type DrawnChart, type Line } from "./chart.ts";
import { lineColours } from "./colours.ts";
import { type Case, type Row, rowAt, value } from "./data.ts";
import { el, figure, fileName, folded, missing, paperSwitch, section, table } from "./dom.ts";
import { heartOf, starNote } from "./orientation.ts";
import { shown, stateMark } from "./quantities.ts";
import type { Shared, Timeline } from "./shared.ts";

const joined = (cases: Case[]) => cases.map((c) => c.name).join("-");
const column = (rows: Row[], name: string) => rows.map((row) => value(row[name]));

/** Where a case is at its named moments. */
function states(c: Case): { x: number; y: number; label: string; time: number }[] {
  const rows = c.table("curves.csv");
  return c.moments.map(({ name, time }) => {
    const row = rowAt(rows, time);
    return { time, label: stateMark(name).label, x: value(row?.cavity_volume_ml), y: value(row?.pressure_mmHg) };
  });
}

/** A case with curves, and its number among all. */
interface Shown { c: Case; number: number; rows: Row[] }

const courseOf = (group: Shown[]) => (group[0].c.isLoaded ? "load (sequence of equilibria, no time)" : "time (s)");

export function curvesSection(cases: Case[], shared: Shared, time: Timeline): HTMLElement {
  const title = "Pressure, volume, tension, calcium";
  const shownCases: Shown[] = cases.map((c, number) => ({ c, number, rows: c.table("curves.csv") })).filter(({ rows }) => rows.length);
  if (!shownCases.length) return folded("curves", title, "curves.csv is missing: the beat has not begun.");
  const loads = shownCases.some(({ c }) => c.isLoaded);
  // load and time share no axis
  const groups = new Set(shownCases.map(({ c }) => c.isLoaded)).size > 1 ? shownCases.map((one) => [one]) : [shownCases];
  const beats = shownCases.every(({ c }) => c.isBeating);
  const help = "From curves.csv. " + (beats ? "Valves and a circulation set pressure and volume; the curves are those of one beat. " :
    "There are no valves: pressure and activation are given, and the volume follows, so the path of pressure against volume is no loop of a heart. ") + (loads ? "The quasi-static engine goes from equilibrium to equilibrium: the axis counts its load, not time. " : "") +
    "Where a file has no value the curve has a gap: calcium between rest and peak of the quasi-static engine. The line and the dots " +
    "are the moment that the 3-D view shows; point at a chart to read it.";
  const against = [
    { y: "cavity_volume_ml", title: "cavity volume (ml)" },
    { y: "pressure_mmHg", title: "endocardial pressure (mmHg)" },
    { y: "mean_active_tension_kPa", title: "mean active tension (kPa)" },
    { y: "calcium_uM", title: "calcium (µM)" },
  ];
  const drawn: { chart: DrawnChart; group: Shown[]; x: string; y: string }[] = [];
  const make = (group: Shown[], caption: string, x: string, xTitle: string, y: string, yTitle: string) => {
    const chart: Chart = { x: xTitle, y: yTitle, zero: true, lines: group.map(({ c, rows, number }): Line =>
      ({ label: c.name, colour: lineColours[number], x: column(rows, x), y: column(rows, y) })) };
    if (x === "time_s" && group.length === 1) chart.marks = states(group[0].c).map(({ time: at, label }) => ({ x: at, label }));
    if (x !== "time_s") chart.points = group.flatMap(({ c }) => states(c));
    const one = drawChart(chart);
    drawn.push({ chart: one, group, x, y });
    const names = group.map(({ c }) => c);
    return figure(`${names.map((c) => c.name).join(", ")}: ${caption}`, fileName(joined(names), y, "against", x), one.figure);
  };
  const figures = [make(shownCases, beats ? "pressure-volume loop" : "pressure-volume path (no valves)", "cavity_volume_ml", "cavity volume (ml)", "pressure_mmHg",
    "endocardial pressure (mmHg)"), ...against.flatMap(({ y, title: words }) => groups.map((group) =>
    make(group, `${words} against ${group[0].c.isLoaded ? "load" : "time"}`, "time_s", courseOf(group), y, words)))];
  const mark = () => {
    for (const { chart, group, x, y } of drawn)
      group.forEach(({ number, rows }, i) => {
        const t = time.time(number, shared.state.step);
        const row = rowAt(rows, t)!;
        chart.dot(i, Number.isFinite(t) ? value(row[x]) : NaN, value(row[y]));
        if (x === "time_s" && group.length === 1) chart.cursor(t);
      });
  };
  shared.onChange((_, changed) => changed.has("step") && mark());
  mark();
  return section("curves", title, help, el("div", { class: "figures" }, ...figures));
}

export function rotationSection(cases: Case[]): HTMLElement {
  const help = "Mean rotation of each short-axis slice about the long axis, anticlockwise seen from the apex positive, from " +
    "rotation.csv. A normal apex turns anticlockwise in systole, by about 10° from images, while the base turns clockwise by about " +
    "3° (Young & Cowan, J. Cardiovasc. Magn. Reson. 14:49, 2012); a base that is held (base.support) cannot turn.";
  const found = cases.map((c) => ({ c, rows: c.table("rotation.csv") })).filter(({ rows }) => rows.length);
  if (!found.length) return folded("rotation", "Rotation per slice", "rotation.csv is missing: there are no results yet.");
  const isAssumed = found.some(({ c }) => c.assumes("early diastole"));
  const columns = [["end_diastole_to_end_systole_deg", "end-diastole to end-systole"], ["early_to_end_diastole_deg", isAssumed ? "early* to end-diastole" : "early to end-diastole"]];
  const lines = found.flatMap(({ c, rows }, i) => columns.map(([name, title], k): Line => ({
    label: cases.length > 1 ? `${c.name}: ${title}` : title, colour: lineColours[i], dashed: k === 1, dots: true,
    x: column(rows, "slice"), y: column(rows, name) })));
  const starred = (end: string) => (found.some(({ c }) => c.assumes(end)) ? `${end}*` : end);
  const note = [...new Set(found.map(({ c }) => starNote({ ...heartOf(c), assumed: false })))].join("");  // heights hang on apex and base alone
  const chart = drawChart({ x: `slice, from the ${starred("base")} (1) to the ${starred("apex")} (7)`, y: "rotation (°)", lines, zero: true, width: 560 });
  return section("rotation", "Rotation per slice", help, el("div", { class: "figures" },
    figure([`${found.map(({ c }) => c.name).join(", ")}: rotation of the slices`, note, isAssumed && "* assumed: early diastole"].filter(Boolean).join("; "), fileName(joined(cases), "rotation"), chart.figure),
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
  const title = "Passive muscle";
  const none = "stress_stretch.csv is missing: there are no results yet.";
  const found = cases.map((c) => ({ c, rows: c.table("stress_stretch.csv") })).filter(({ rows }) => rows.length);
  if (!found.length) return folded("muscle", title, none);
  const help = "Passive muscle pulled along the fibre with free sides: Cauchy stress against stretch of this case's muscle and of published ones, from " +
    "stress_stretch.csv. Excised muscle (Holzapfel & Ogden's fit) is far stiffer than what images of living hearts lead to.";
  const absent = cases.filter((c) => !found.some((one) => one.c === c)).map((c) => missing(`${c.name}: ${none}`));
  const own = found.map(({ c, rows }) => ({ label: `${c.name} (this case)`, dashed: false, ofPaper: false, rows: rows.filter((r) => r.published === "no") }));
  const published = found[0].rows.filter((r) => r.published === "yes");
  const others = [...new Set(published.map((r) => r.muscle))].map((label) => ({ label, dashed: true, ofPaper: label.startsWith("Gao"),
    rows: published.filter((r) => r.muscle === label) })).sort((a, b) => Number(a.ofPaper) - Number(b.ofPaper));  // what is hidden stands last in the legend
  const lines = [...own, ...others].map(({ rows, ...line }, i): Line =>
    ({ ...line, colour: lineColours[i], x: column(rows, "fibre_stretch"), y: column(rows, "cauchy_stress_kPa") }));
  const chart = drawChart({ x: "fibre stretch", y: "Cauchy stress (kPa)", lines, zero: true, width: 640, height: 380 });
  return section("muscle", title, help, paperSwitch(), ...absent,
    el("div", { class: "figures" }, figure(`${found.map(({ c }) => c.name).join(", ")}: stress against stretch along the fibre`, fileName(joined(cases), "stress-stretch"), chart.figure)));
}
