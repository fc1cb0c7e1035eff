// What all views show together: one quantity, one moment, one region, one cut.
import { type Case, nearest, type Selection, value } from "./data.ts";
import type { Scale } from "./colours.ts";
import { quantity, stateMark } from "./quantities.ts";

export interface Cut { kind: "none" | "long" | "short"; angle: number; height: number }  // degrees from the septum, mm

export interface State {
  quantity: string;
  step: number;
  cut: Cut;
  fibres: boolean;
  selection?: Selection;
  fixed: boolean;   // the selection stays when the pointer leaves
  range?: [number, number];
}

export class Shared {
  private listeners: ((state: State, changed: Set<keyof State>) => void)[] = [];
  constructor(readonly state: State) {}

  onChange(listener: (state: State, changed: Set<keyof State>) => void): void {
    this.listeners.push(listener);
  }

  set(change: Partial<State>): void {
    Object.assign(this.state, change);
    const changed = new Set(Object.keys(change) as (keyof State)[]);
    for (const listener of this.listeners) listener(this.state, changed);
  }

  /** Points at a region; a fixed one gives way only to another fixed one, or to itself (it is let go). */
  pick(selection: Selection | undefined, fixed: boolean): void {
    const now = this.state.selection;
    const same = now && selection && now.scheme === selection.scheme && now.index === selection.index;
    if (fixed) this.set(same && this.state.fixed ? { selection: undefined, fixed: false } : { selection, fixed: !!selection });
    else if (!this.state.fixed && !(same || (!now && !selection))) this.set({ selection });
  }
}

/** The moments that the time slider goes through. */
export interface Timeline {
  count: number;
  /** Frame of a case; undefined when the case has none. */
  frame: (number: number, step: number) => number | undefined;
  time: (number: number, step: number) => number;
  start: number;  // the step to begin with
  marks: { step: number; label: string; title: string }[];  // named moments
}

function ownTimeline(c: Case, times: number[]): Timeline {
  const last = Math.max(0, times.length - 1);
  const marks = times.length ? c.moments.map((m) => ({ step: nearest(times, m.time), ...stateMark(m.name) })) : [];
  const end = c.timeOf("end_systole");
  return { count: last + 1, start: times.length && end !== undefined ? nearest(times, end) : last, marks,
    frame: (_, step) => (times.length ? step : undefined), time: (_, step) => times[step] ?? NaN };
}

/** Two cases of heartbeats: 80 steps through each one's last beat, beginning where the first one's ejection ends. */
function beatsTimeline(cases: Case[], times: number[][]): Timeline {
  const count = 81;
  const at = (n: number, step: number) => times[n][0] + (step / (count - 1)) * (times[n].at(-1)! - times[n][0]);
  const end = cases[0].timeOf("end_systole") ?? NaN;
  return { count, marks: [], start: nearest(Array.from({ length: count }, (_, step) => at(0, step)), end),
    frame: (n, step) => nearest(times[n], at(n, step)), time: (n, step) => times[n][nearest(times[n], at(n, step))] };
}

/** Where the times of two cases agree: their beginnings, every moment that all of them come to, and their ends, in each case's own time. */
function knotsOf(cases: Case[], times: number[][]): { name: string; at: number[] }[] {
  const ends = times.map((t) => t.at(-1));  // undefined without a wall
  const common = cases[0].moments.map((m) => ({ name: m.name, at: cases.map((c) => c.timeOf(m.name) ?? NaN) }))
    .filter(({ at }) => at.every((t, n) => t <= (ends[n] ?? Infinity) + 1e-5));
  const ended = common.at(-1)?.at.every((t, n) => Math.abs(t - (ends[n] ?? t)) < 1e-5);
  return [{ name: "", at: cases.map(() => 0) }, ...common, ...(ended ? [] : [{ name: "", at: ends.map((t) => t ?? NaN) }])];
}

/** One case: its frames. Two: 40 steps from moment to moment, in each case's own time; of heartbeats even steps. */
export function timeline(cases: Case[]): Timeline {
  const times = cases.map((c) => c.wall?.times ?? []);
  if (cases.length === 1) return ownTimeline(cases[0], times[0]);
  if (cases.every((c, n) => c.isBeating && times[n].length)) return beatsTimeline(cases, times);
  const each = 40;
  const knots = knotsOf(cases, times);
  const last = each * (knots.length - 1);
  const at = (n: number, step: number) => {
    const k = Math.min(Math.floor(step / each), knots.length - 2);
    return knots[k].at[n] + (step / each - k) * (knots[k + 1].at[n] - knots[k].at[n]);
  };
  const marks = knots.flatMap(({ name }, k) => (name ? [{ step: k * each, ...stateMark(name) }] : []));
  const start = knots.findIndex(({ name }) => name === "end_systole");
  return { count: last + 1, start: start < 0 ? last : start * each, marks,
    frame: (n, step) => (times[n].length ? nearest(times[n], at(n, step)) : undefined),
    time: (n, step) => times[n][nearest(times[n], at(n, step))] };
}

/** Moments that any case has regional values at. */
export const statesOf = (cases: Case[]) => [...new Set(cases.flatMap((c) => c.states))];

function reach(name: string, low: number, high: number): Scale {
  const { signed: diverging, middle, floor } = quantity(name);
  if (!diverging) return { min: low < -1e-6 * Math.abs(high) ? low : 0, max: high, diverging, middle, floor };
  const most = Math.max(Math.abs(low - middle), Math.abs(high - middle));
  return { min: middle - most, max: middle + most, diverging, middle, floor };
}

const smallest = (values: number[]) => values.reduce((a, b) => (b < a ? b : a), Infinity);
const greatest = (values: number[]) => values.reduce((a, b) => (b > a ? b : a), -Infinity);

/** One scale of a quantity for wall and bull's-eyes, all moments with regional values and all cases: the 1st to 99th percentile over the wall. */
export function scaleOf(cases: Case[], name: string): Scale {
  if (name === "infarct") return reach(name, 0, 1);
  const found = cases.flatMap((c) => c.states.flatMap((state) => {
    const row = c.row(state, "whole", "wall", name);
    return [value(row?.p1), value(row?.p99)];
  })).filter(Number.isFinite);
  const fallback = cases.flatMap((c) => (c.wall?.quantities.includes(name) ? c.wall.range(name) : []));
  const values = found.length ? found : fallback;
  return values.length ? reach(name, smallest(values), greatest(values)) : reach(name, 0, 1);
}
