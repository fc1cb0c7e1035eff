// The borders, landmarks and scar as they stand, and every change of them, forth and back.
import type { Scar } from "./scar.ts";
import type { Confidence, Landmark, Line, Place } from "./study.ts";

/** What becomes of borders, points and landmarks; undefined: they are gone. A border that changes loses its points unless it is given some. */
export interface Change {
  what: string; lines?: [string, Line | undefined][]; points?: [string, Place[] | undefined][]; marks?: [string, Landmark | undefined][]; confidence?: Confidence[]; scar?: Scar;
}

type Step = { forth: Change; back: Change; goesOn?: string };

export class Drawing {
  lines: Map<string, Line>;
  landmarks: Map<string, Landmark>;
  /** Where the hand wants a border to run. */
  points = new Map<string, Place[]>();
  confidence: Confidence[];
  /** None without late enhancement. */
  scar: Scar | undefined;
  private readonly firstScar: Scar | undefined;
  private done: Step[] = [];
  private undone: Step[] = [];
  private kept: Step | undefined;  // the last step when it was saved
  private told: () => void = () => {};

  constructor(lines: Map<string, Line>, landmarks: Map<string, Landmark>, confidence: Confidence[], scar?: Scar, private readonly scarWasKept = false) {
    [this.lines, this.landmarks, this.confidence, this.scar, this.firstScar] = [lines, landmarks, confidence, scar, scar];
  }

  onChange(tell: () => void): void { this.told = tell; }

  /** How many changes lie between the beginning and now. */
  get changes(): number { return this.done.length; }
  get unsaved(): boolean { return this.done.at(-1) !== this.kept; }
  /** The scar, if there is one to keep: it was changed, or kept before. */
  get keptScar(): Scar | undefined { return this.scarWasKept || this.scar !== this.firstScar ? this.scar : undefined; }
  get canUndo(): boolean { return this.done.length > 0; }
  get canRedo(): boolean { return this.undone.length > 0; }

  private apply(change: Change): Change {
    const points = new Map([...(change.lines ?? []).map(([key]): [string, Place[] | undefined] => [key, undefined]), ...(change.points ?? [])]);
    const back: Change = { what: change.what, lines: change.lines?.map(([key]) => [key, this.lines.get(key)]), points: [...points.keys()].map((key) => [key, this.points.get(key)]),
      marks: change.marks?.map(([name]) => [name, this.landmarks.get(name)]), confidence: change.confidence && this.confidence, scar: change.scar && this.scar };
    for (const [key, line] of change.lines ?? []) line ? this.lines.set(key, line) : this.lines.delete(key);
    for (const [key, places] of points) places?.length ? this.points.set(key, places) : this.points.delete(key);
    for (const [name, mark] of change.marks ?? []) mark ? this.landmarks.set(name, mark) : this.landmarks.delete(name);
    if (change.confidence) this.confidence = change.confidence;
    if (change.scar) this.scar = change.scar;
    return back;
  }

  /** Does a change. Steps of one border that go on, such as taps of an arrow key, are one. */
  change(change: Change, goesOn?: string): void {
    const last = this.done.at(-1);
    const back = this.apply(change);
    if (goesOn && last?.goesOn === goesOn && last !== this.kept) last.forth = change;
    else this.done.push({ forth: change, back, goesOn });
    this.undone = [];
    this.told();
  }

  undo(): string | undefined {
    const step = this.done.pop();
    if (!step) return undefined;
    this.apply(step.back);
    this.undone.push(step);
    this.told();
    return step.forth.what;
  }

  redo(): string | undefined {
    const step = this.undone.pop();
    if (!step) return undefined;
    this.apply(step.forth);
    this.done.push(step);
    this.told();
    return step.forth.what;
  }

  nowKept(): void {
    this.kept = this.done.at(-1);
    this.told();
  }
}
