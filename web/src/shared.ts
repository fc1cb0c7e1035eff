// What all views show together: one quantity, one moment, one region, one cut.
import { Case, type Selection } from "./data.ts";
import type { Scale } from "./colours.ts";
import { quantity } from "./quantities.ts";
import { value } from "./data.ts";

export interface Cut { kind: "none" | "long" | "short"; angle: number; height: number }  // degrees, mm

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
}

function nearest(times: number[], time: number): number {
  return times.reduce((best, t, i) => (Math.abs(t - time) < Math.abs(times[best] - time) ? i : best), 0);
}

/** One case: its frames. Two: 40 steps up to end-diastole and 40 from there, in each case's own time. */
export function timeline(cases: Case[]): Timeline {
  const times = cases.map((c) => c.wall?.times ?? []);
  if (cases.length === 1)
    return { count: Math.max(1, times[0].length), start: Math.max(0, times[0].length - 1),
      frame: (_, step) => (times[0].length ? step : undefined), time: (_, step) => times[0][step] ?? NaN };
  const half = 40;
  const at = (n: number, step: number) => {
    const end = times[n].at(-1) ?? NaN;
    const ed = cases[n].timeOf("end_diastole") ?? end;
    return step <= half ? (step / half) * ed : ed + (step / half - 1) * (end - ed);
  };
  return { count: 2 * half + 1, start: 2 * half,
    frame: (n, step) => (times[n].length ? nearest(times[n], at(n, step)) : undefined),
    time: (n, step) => times[n][nearest(times[n], at(n, step))] };
}

function reach(name: string, low: number, high: number): Scale {
  const q = quantity(name);
  if (!q.signed) return { min: low < -1e-6 * Math.abs(high) ? low : 0, max: high, diverging: false };
  const most = Math.max(Math.abs(low - q.middle), Math.abs(high - q.middle));
  return { min: q.middle - most, max: q.middle + most, diverging: true };
}

const smallest = (values: number[]) => values.reduce((a, b) => (b < a ? b : a), Infinity);
const greatest = (values: number[]) => values.reduce((a, b) => (b > a ? b : a), -Infinity);

/** Moments that any case has regional values at. */
export const statesOf = (cases: Case[]) => [...new Set(cases.flatMap((c) => c.states))];

/** Of the 3-D view: the 1st to 99th percentile over the wall at the moments with regional values, of all cases. */
export function wallScale(cases: Case[], name: string): Scale {
  if (name === "infarct") return { min: 0, max: 1, diverging: false };
  const found = cases.flatMap((c) => c.states.flatMap((state) => {
    const row = c.row(state, "whole", "wall", name);
    return [value(row?.p1), value(row?.p99)];
  })).filter(Number.isFinite);
  const fallback = cases.flatMap((c) => (c.wall?.quantities.includes(name) ? c.wall.range(name) : []));
  const values = found.length ? found : fallback;
  return values.length ? reach(name, smallest(values), greatest(values)) : { min: 0, max: 1, diverging: false };
}

/** Of a bull's-eye: the regional means at its state, of all cases. */
export function regionScale(cases: Case[], name: string, state: string): Scale {
  const means = cases.flatMap((c) => c.regions)
    .filter((r) => r.state === state && r.quantity === name && (r.scheme === "sector" || r.scheme === "aha17"))
    .map((r) => value(r.mean)).filter(Number.isFinite);
  return means.length ? reach(name, smallest(means), greatest(means)) : { min: 0, max: 1, diverging: false };
}
