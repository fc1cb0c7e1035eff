// Strain and stress of each AHA segment over the beat.
import { drawChart, type DrawnChart, type Line } from "./chart.ts";
import { lineColours } from "./colours.ts";
import { type Case, type Row, value } from "./data.ts";
import { el, figure, fileName, folded, missing, section } from "./dom.ts";
import { heartOf, marked, starNote } from "./orientation.ts";
import { label, type Quantity, quantity, stateMark } from "./quantities.ts";
import type { Shared, Timeline } from "./shared.ts";

/** Segments of a ring, by their numbers, and their colours: a wall has one from base to apex. The apex is drawn with the ring beside it. */
const rings = [{ name: "base", first: 1, last: 6, colours: [0, 1, 2, 3, 4, 5] }, { name: "middle", first: 7, last: 12, colours: [0, 1, 2, 3, 4, 5] },
  { name: "apex", first: 13, last: 17, colours: [0, 2, 3, 5, 4] }];

/** A case's rows of every segment. */
interface Courses { c: Case; number: number; segments: Row[][] }

function coursesOf(c: Case, number: number): Courses {
  const rows = c.table("segments_over_time.csv");
  const segments = Array.from({ length: rings.at(-1)!.last }, (_, i) => rows.filter((row) => Number(row.segment) === i + 1));
  return { c, number, segments };
}

const columnOf = (q: Quantity) => (q.unit === "1" ? q.name : `${q.name}_${q.unit}`);

/** Strains begin anew, from nothing, at end-diastole. A heartbeat comes to it soon after its beginning, and its strains are drawn from there on. */
function points(c: Case, rows: Row[], q: Quantity): { x: number[]; y: number[] } {
  const end = q.name.endsWith("_strain") ? c.timeOf("end_diastole") ?? Infinity : Infinity;
  const all = rows.map((row) => [value(row.time_s), value(row[columnOf(q)])]);
  const [until, after] = [all.filter(([t]) => t <= end + 1e-5), all.filter(([t]) => t > end + 1e-5)];
  const drawn = after.length ? [...(c.isBeating ? [] : [...until, [end, NaN]]), [end, 0], ...after] : until;
  return { x: drawn.map(([t]) => t - c.begin), y: drawn.map(([, y]) => y) };
}

/** The charts of a case, one per ring, over one range of values. */
function drawCourses(courses: Courses, q: Quantity, shared: Shared): { chart: DrawnChart; element: HTMLElement }[] {
  const { c, segments } = courses;
  const heart = heartOf(c);
  const all = segments.map((rows) => points(c, rows, q));
  const high = all.flatMap(({ y }) => y).filter(Number.isFinite);
  return rings.map(({ name, first, last, colours }) => {
    const lines = all.slice(first - 1, last).map((course, i): Line => ({ ...course, colour: lineColours[colours[i]],
      label: `${first + i} ${marked(segments[first + i - 1][0]?.name ?? "", heart.assumed)}`,
      pick: (isOver) => shared.pick(isOver ? { scheme: "aha17", index: first + i - 1 } : undefined, false) }));
    const chart = drawChart({ x: c.isBeating ? "time in the beat (s)" : c.isLoaded ? "load (sequence of equilibria, no time)" : "time (s)", y: label(q), lines, zero: true,
      also: [Math.min(...high), Math.max(...high)], marks: c.moments.map((m) => ({ x: m.time - c.begin, label: stateMark(m.name).label })) });
    const caption = [`${c.name}: ${q.title} of the segments of the ${marked(name, heart.ends.includes(name))}`, starNote(heart)].filter(Boolean).join("; ");
    return { chart, element: figure(caption, fileName(c.name, q.name, "segments", name), chart.figure) };
  });
}

const help = "The mean over each AHA segment, weighted by undeformed volume, at every moment that the run wrote, from segments_over_time.csv; of heartbeats over the last. " +
  "The quantity is that of the 3-D view. Strains are from end-diastole after it; before it from early diastole (or the wall without load), which is not drawn of heartbeats. The line is the time that the 3-D view " +
  "shows; point at a curve to outline its segment there and in the bull's-eyes.";

export function segmentsSection(cases: Case[], shared: Shared, time: Timeline): HTMLElement {
  const title = "Segments over time";
  const found = cases.map(coursesOf).filter(({ segments }) => segments[0].length);
  if (!found.length) return folded("segments", title, "segments_over_time.csv is missing: the run has no results, or its frames are gone.");
  const place = el("div", { class: "figures" });
  let drawn: { chart: DrawnChart; courses: Courses }[] = [];
  const mark = () => drawn.forEach(({ chart, courses }) => chart.cursor(time.time(courses.number, shared.state.step) - courses.c.begin));
  const draw = () => {
    const q = quantity(shared.state.quantity);
    const has = found.filter(({ segments }) => columnOf(q) in segments[0][0]);
    const charts = has.flatMap((courses) => drawCourses(courses, q, shared).map((one) => ({ ...one, courses })));
    drawn = charts;
    place.replaceChildren(...(charts.length ? charts.map(({ element }) => element) : [missing(`${q.title}: strains and stresses alone have curves; choose one in the 3-D view.`)]));
    mark();
  };
  const choose = () => {
    const { selection } = shared.state;
    place.querySelectorAll("svg.chart g.line").forEach((line, i) => line.classList.toggle("chosen", selection?.scheme === "aha17" && selection.index === i % rings.at(-1)!.last));
  };
  shared.onChange((_, changed) => {
    if (changed.has("quantity")) draw();
    else if (changed.has("step")) mark();
    if (changed.has("quantity") || changed.has("selection")) choose();
  });
  draw();
  return section("segments", title, help, place);
}
