// The study at a glance: what to look at first, all slices and phases, the volume over time.
import { el, svg, titled } from "../dom.ts";
import { keyOf, ofKey, programsOwn, sideNames, sides, volumes, type Confidence, type Line, type SaidStudy, type Side } from "./study.ts";
import type { Drawing } from "./drawing.ts";

export type Go = (slice: number, phase: number, side?: Side) => void;

/** Borders that the program proposed and is not sure of, the least sure first. */
export function doubtfulKeys(drawing: Drawing, doubtful: number): { key: string; sure: number }[] {
  const found: { key: string; sure: number }[] = [];
  for (const sure of drawing.confidence)
    for (const side of sides) {
      const key = keyOf(sure.slice, sure.phase, side);
      if (sure[side] < doubtful && drawing.lines.get(key)?.how === "proposed") found.push({ key, sure: sure[side] });
    }
  return found.sort((a, b) => a.sure - b.sure);
}

export class FirstList {
  private readonly list = el("ul", { class: "first-list" });
  readonly section = titled("doubtful", "Look at these first", {}, this.list);
  constructor(private readonly study: SaidStudy, private readonly go: Go) {}

  /** `whole`: phase at which sentences about a slice are looked at. */
  show(drawing: Drawing, doubts: string[], whole: number): void {
    const item = (text: string, go: () => void) => el("li", {}, el("button", { type: "button", click: go }, text));
    const borders = doubtfulKeys(drawing, this.study.doubtful).map(({ key, sure }) => {
      const { slice, phase, side } = ofKey(key);
      return item(`slice ${slice}, phase ${phase}: ${sideNames[side]}, confidence ${sure.toFixed(2)}`, () => this.go(slice, phase, side));
    });
    const ends = (text: string) => Number(/ is left out/.test(text));  // base and apex before slices that are not used
    const sentences = doubts.filter((text) => !/ is doubtful in phase/.test(text)).sort((a, b) => ends(a) - ends(b)).map((text) => {
      const long = Number(/^long axis (\d+)/.exec(text)?.[1]);
      const slice = long ? this.study.slices.length + long : Number(/slice (\d+)/.exec(text)?.[1]);
      return slice ? item(text, () => this.go(slice, whole)) : el("li", {}, text);
    });
    const all = [...borders, ...sentences];
    this.list.replaceChildren(...(all.length > 0 ? all : [el("li", {}, "Nothing is doubtful.")]));
  }
}

type State = "none" | "doubtful" | "proposed" | "changed";
const stateColours: Record<State, string> = { none: "#8884", doubtful: "#ff7b1a", proposed: "#6fa8dc", changed: "#3ba55d" };
const cell = 14;

export class StudyMap {
  private readonly grid = svg("svg", { class: "map", role: "img" });
  private readonly rects = new Map<string, SVGRectElement>();
  private readonly cursor = svg("rect", { width: cell - 2, height: cell - 2, fill: "none", stroke: "var(--ink)", "stroke-width": 2.5 });
  readonly section: HTMLElement;

  constructor(private readonly study: SaidStudy, go: Go) {
    const { phases, slices, long_axis } = study;
    const rows = slices.length + long_axis.length;
    this.grid.setAttribute("viewBox", `-34 -16 ${phases * cell + 36} ${rows * cell + 18}`);
    for (let s = 1; s <= rows; ++s) {
      const called = s > slices.length ? `L${s - slices.length}` : String(s);
      this.grid.append(svg("text", { x: -6, y: s * cell - 4, "text-anchor": "end", "font-size": 10, fill: "var(--soft)" }, called));
      for (let t = 1; t <= phases; ++t) {
        const rect = svg("rect", { x: (t - 1) * cell + 1, y: (s - 1) * cell + 1, width: cell - 2, height: cell - 2, click: () => go(s, t) });
        this.rects.set(`${s}/${t}`, rect);
        this.grid.append(rect);
      }
    }
    this.grid.append(svg("text", { x: 0, y: -5, "font-size": 10, fill: "var(--soft)" }, "phase →"),
      svg("text", { x: -32, y: -5, "font-size": 10, fill: "var(--soft)" }, "slice"), this.cursor);
    const key = (state: State, text: string) => el("span", { class: "key" }, el("i", { style: `background:${stateColours[state]}` }), text);
    this.section = titled("map", "All slices and phases", {}, this.grid, el("p", { class: "help legend" }, key("doubtful", "doubtful"), key("proposed", "proposed"),
      key("changed", "corrected or drawn"), key("none", "no border"), ...(long_axis.length > 0 ? [el("span", {}, "L: long axes; coloured where landmarks are set")] : [])));
  }

  private state(drawing: Drawing, doubtful: Set<string>, s: number, t: number): State {
    const keys = sides.map((side) => keyOf(s, t, side));
    if (keys.some((key) => doubtful.has(key))) return "doubtful";
    const there = keys.map((key) => drawing.lines.get(key)).filter((line): line is Line => line !== undefined);
    return there.length === 0 ? "none" : there.some((line) => line.how !== "proposed") ? "changed" : "proposed";
  }

  private stateOfLong(drawing: Drawing, s: number): State {
    const marks = [...drawing.landmarks.values()].filter((mark) => mark.slice === s);
    return marks.length === 0 ? "none" : marks.some((mark) => mark.by !== programsOwn) ? "changed" : "proposed";
  }

  show(drawing: Drawing): void {
    const doubtful = new Set(doubtfulKeys(drawing, this.study.doubtful).map(({ key }) => key));
    const counts: Record<State, number> = { none: 0, doubtful: 0, proposed: 0, changed: 0 };
    for (const [place, rect] of this.rects) {
      const [s, t] = place.split("/").map(Number);
      const long = s > this.study.slices.length;
      const state = long ? this.stateOfLong(drawing, s) : this.state(drawing, doubtful, s, t);
      if (!long) ++counts[state];
      rect.setAttribute("fill", stateColours[state]);
    }
    this.grid.setAttribute("aria-label", `Pictures with borders: ${counts.doubtful} doubtful, ${counts.proposed} proposed, ${counts.changed} corrected or drawn; ${counts.none} without`);
  }

  point(slice: number, phase: number): void {
    this.cursor.setAttribute("x", String((phase - 1) * cell + 1));
    this.cursor.setAttribute("y", String((slice - 1) * cell + 1));
  }
}

const [chartWidth, chartHeight, left, bottom] = [340, 150, 34, 20];

export class VolumeCurve {
  private readonly chart = svg("svg", { class: "chart", viewBox: `0 0 ${chartWidth} ${chartHeight}`, role: "img" });
  private readonly figures = el("p", { class: "read", id: "volumes" });
  readonly section = titled("volume", "Volume of the cavity", {}, this.chart, this.figures);
  private readonly proposed: number[];
  now: number[] = [];

  constructor(private readonly study: SaidStudy, proposal: Map<string, Line>) {
    this.proposed = volumes(proposal, study.phases, study.spacing);
  }

  /** How much of a phase's volume lies in slices whose endocardium is doubtful. */
  private doubted(drawing: Drawing, phase: number): string {
    const doubtful = doubtfulKeys(drawing, this.study.doubtful).map(({ key }) => key)
      .filter((key) => ofKey(key).side === "endo" && ofKey(key).phase === phase);
    const within = volumes(new Map(doubtful.map((key) => [key, drawing.lines.get(key)!])), this.study.phases, this.study.spacing)[phase - 1];
    return within > 0 ? `, ${(100 * within / this.now[phase - 1]).toFixed(0)}% of it doubtful` : "";
  }

  show(drawing: Drawing, phase: number): void {
    const { phases, spacing } = this.study;
    this.now = volumes(drawing.lines, phases, spacing);
    const most = 1.08 * Math.max(...this.now, ...this.proposed, 1);
    const x = (t: number) => left + (chartWidth - left - 8) * t / Math.max(phases - 1, 1);
    const y = (v: number) => 6 + (chartHeight - bottom - 6) * (1 - v / most);
    const curve = (values: number[]) => values.map((v, t) => `${t ? "L" : "M"}${x(t).toFixed(1)} ${y(v).toFixed(1)}`).join("");
    const tick = [50, 100, 25, 10, 200].find((step) => most / step >= 2 && most / step <= 5) ?? most / 3;
    const marks: Node[] = [];
    for (let v = 0; v < most; v += tick)
      marks.push(svg("line", { x1: left, x2: chartWidth - 8, y1: y(v), y2: y(v), stroke: "var(--grid)" }),
        svg("text", { x: left - 4, y: y(v) + 4, "text-anchor": "end", "font-size": 10, fill: "var(--soft)" }, v.toFixed(0)));
    this.chart.replaceChildren(...marks,
      svg("text", { x: chartWidth - 8, y: chartHeight - 5, "text-anchor": "end", "font-size": 10, fill: "var(--soft)" }, "phase; dashed: as proposed"),
      svg("text", { x: 2, y: chartHeight - 5, "font-size": 10, fill: "var(--soft)" }, "ml"),
      svg("path", { d: curve(this.proposed), fill: "none", stroke: "var(--soft)", "stroke-dasharray": "3 3" }),
      svg("path", { d: curve(this.now), fill: "none", stroke: "var(--accent)", "stroke-width": 2, class: "now" }),
      svg("circle", { cx: x(phase - 1), cy: y(this.now[phase - 1]), r: 4.5, fill: "var(--accent)" }));
    const [largest, smallest] = [Math.max(...this.now), Math.min(...this.now)];
    const at = (v: number) => `${v.toFixed(1)} ml (phase ${this.now.indexOf(v) + 1}${this.doubted(drawing, this.now.indexOf(v) + 1)})`;
    const words = `${this.now[phase - 1].toFixed(1)} ml at phase ${phase}; largest ${at(largest)}, smallest ${at(smallest)}, ejection fraction ${largest > 0 ? (100 * (1 - smallest / largest)).toFixed(0) : "–"}%`;
    this.figures.textContent = words;
    this.chart.setAttribute("aria-label", words);
  }
}

/** The phase with the largest cavity. */
export const fullest = (values: number[]) => values.indexOf(Math.max(...values)) + 1;

export type { Confidence };
