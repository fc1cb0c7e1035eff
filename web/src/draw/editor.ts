// What is looked at, and what the hand does to it.
import { cutOf, passages } from "./crossing.ts";
import type { Drawing } from "./drawing.ts";
import { doubtfulKeys } from "./overview.ts";
import { Picture, handleStep } from "./picture.ts";
import { circle, distance, nearest, pulled, redrawn, resized } from "./shape.ts";
import { inSpace, keyOf, landmarkNames, ofKey, placeOn, planesOf, sideNames, sides, type How, type Line, type Place, type Plane, type SaidStudy, type Side } from "./study.ts";

/** What the pointer does: pull a part, resize, redraw, set points of a border, or set a landmark of this name. */
export type Tool = "pull" | "size" | "redraw" | "points" | string;

const grasp = 14;  // CSS pixels
const shortAxisAlone = "borders are drawn on short-axis slices; here landmarks are set";

export class Editor {
  readonly picture = new Picture();
  /** The slices, then the long-axis images: what `slice` counts, from 1. */
  readonly planes: Plane[];
  slice = 1;
  phase = 1;
  side: Side = "endo";
  tool: Tool = "pull";
  width = 12;  // of what a pull takes with it [mm]
  observer = "";
  showsLines = true;
  showsOriginal = false;
  private lastShort = 1;  // the short-axis slice that was looked at last
  private point: number | undefined;
  private stroke: Place[] = [];
  private held: ((at: Place) => void) | undefined;
  private letGo: (() => void) | undefined;
  private readonly greys = new Map<number, Uint8Array>();
  private moved: () => void = () => {};

  constructor(readonly study: SaidStudy, readonly drawing: Drawing, readonly proposal: Map<string, Line>, readonly say: (words: string) => void) {
    this.planes = planesOf(study);
    this.picture.listen((event) => this.press(event), (at) => this.held?.(at), () => this.release());
  }

  /** Is told of every move to another slice, phase, side or point. */
  onMove(tell: () => void): void { this.moved = tell; }

  hold(slice: number, greys: Uint8Array): void {
    this.greys.set(slice, greys);
    if (slice === this.slice) this.show();
  }

  get key(): string { return keyOf(this.slice, this.phase, this.side); }
  get line(): Line | undefined { return this.drawing.lines.get(this.key); }
  /** Where the hand wants the border to run. */
  get wanted(): Place[] { return this.drawing.points.get(this.key) ?? []; }
  get plane() { return this.planes[this.slice - 1]; }
  get isLongAxis(): boolean { return this.slice > this.study.slices.length; }
  /** What a slice is called. */
  called(slice: number): string { return slice > this.study.slices.length ? `long axis ${slice - this.study.slices.length}` : `slice ${slice}`; }
  /** The short-axis slice whose place a long-axis image shows. */
  get crossing(): number { return this.lastShort; }
  /** Which picture of the slice belongs to the phase, from 0: all cover one cycle evenly. */
  private get frame(): number {
    if (!this.isLongAxis) return this.phase - 1;
    const { phases } = this.study.long_axis[this.slice - this.study.slices.length - 1];
    return Math.round((this.phase - 1) * phases / this.study.phases) % phases;
  }
  get selected(): number | undefined { return this.point; }

  show(): void {
    const { slice, phase, plane } = this;
    const size = plane.columns * plane.rows;
    const ofSides = <T>(value: (key: string) => T) => Object.fromEntries(sides.map((side) => [side, value(keyOf(slice, phase, side))]));
    const doubtful = new Set(doubtfulKeys(this.drawing, this.study.doubtful).map(({ key }) => key));
    this.picture.show({ plane, greys: this.greys.get(slice)?.subarray(this.frame * size, (this.frame + 1) * size), ...(this.isLongAxis ? this.crossings() : {}),
      lines: this.showsLines ? ofSides((key) => this.drawing.lines.get(key)) : {}, doubtful: ofSides((key) => doubtful.has(key)),
      original: this.showsOriginal ? ofSides((key) => this.proposal.get(key)) : {},
      marks: [...this.drawing.landmarks.values()].filter((mark) => mark.slice === slice), side: this.side, point: this.point,
      wanted: this.showsLines ? this.wanted : [], stroke: this.stroke });
  }

  /** Where the short-axis slices lie on a long-axis image: the one looked at last, and the borders of all. */
  private crossings() {
    const { plane, study, phase, lastShort } = this;
    const ends = cutOf(plane, study.slices[lastShort - 1]);
    const of = (slice: number, side: Side) => {
      const line = this.drawing.lines.get(keyOf(slice, phase, side));
      const points = line?.points.map((p) => inSpace(study.slices[slice - 1], p)) ?? [];
      return passages(points, plane).map((at) => ({ at, side, here: slice === lastShort }));
    };
    return { cut: ends && { ends, name: this.called(lastShort) }, passages: this.showsLines ? study.slices.flatMap((_, i) => sides.flatMap((side) => of(i + 1, side))) : [] };
  }

  go(slice: number, phase: number, side = this.side): void {
    const [before, wasLong] = [this.slice, this.isLongAxis];
    this.slice = Math.min(this.planes.length, Math.max(1, slice));
    if (!this.isLongAxis) this.lastShort = this.slice;
    this.phase = (phase - 1 + this.study.phases) % this.study.phases + 1;
    this.side = side;
    this.point = undefined;
    this.show();
    if (this.isLongAxis ? this.slice !== before : wasLong) this.fit();  // places of another plane
    this.moved();
  }

  /** Shows the surroundings of all borders, or the whole picture. */
  fit(): void {
    const around = this.isLongAxis ? this.passagesOfAll() : this.bordersAround();
    const { columns, rows, spacing } = this.plane;
    if (around.length === 0) return this.picture.fit([0, 0], [columns * spacing[0], rows * spacing[1]]);
    const [us, vs] = [around.map(([u]) => u), around.map(([, v]) => v)];
    const span = (values: number[]) => values.reduce(([low, high], v) => [Math.min(low, v), Math.max(high, v)], [Infinity, -Infinity]);
    const [[a, c], [b, d]] = [span(us), span(vs)];
    const margin = this.isLongAxis ? 35 : 25;  // base and tip lie beyond the slices
    this.picture.fit([a - margin, b - margin], [c + margin, d + margin]);
  }

  private bordersAround(): Place[] {
    const all = [...this.drawing.lines].filter(([key]) => ofKey(key).slice === this.slice).flatMap(([, line]) => line.points as Place[]);
    return all.length > 0 ? all : [...this.drawing.lines.values()].flatMap((line) => line.points as Place[]);
  }

  private passagesOfAll(): Place[] {
    return [...this.drawing.lines].flatMap(([key, line]) => passages(line.points.map((p) => inSpace(this.study.slices[ofKey(key).slice - 1], p)), this.plane));
  }

  private stamp(how: How): Omit<Line, "points"> {
    return { how, by: this.observer, when: new Date().toISOString().replace(/\.\d+/, "") };
  }

  /** A border is given a shape by the hand, or for it. */
  private put(what: string, points: Place[], how: How, wanted: Place[] = [], goesOn?: string): void {
    this.drawing.change({ what, lines: [[this.key, { points, ...this.stamp(how) }]], points: [[this.key, wanted]] }, goesOn);
  }

  /** The points that the hand set, with one more in the place of those that a pull of it took along. */
  private wantedWith(at: Place): Place[] { return [...this.wanted.filter((place) => distance(place, at) >= this.width / 2), at]; }

  /** What the program drew through the points: they stay, for more. */
  redrawn(points: Place[]): void {
    this.point = undefined;
    this.put(`redraw the ${sideNames[this.side]} from points`, points, this.line ? this.corrected() : "drawn", this.wanted);
  }

  private corrected(): How { return this.line?.how === "drawn" ? "drawn" : "corrected"; }

  private press(event: PointerEvent): void {
    const at = this.picture.placeOf(event);
    if (event.button === 1) return this.pan(event);
    if (this.tool in landmarkNames) return this.mark(this.tool, at);
    if (this.isLongAxis) return this.pan(event);
    if (this.tool === "redraw") return this.startStroke(at);
    if (this.tool === "points") return this.startPoint(at);
    const side = this.grasped(at);
    if (!side) return this.pan(event);
    this.side = side;
    this.point = nearest(this.line!.points, at).point;
    this.startPull(at);
  }

  /** The border under the pointer, the selected one first. */
  private grasped(at: Place): Side | undefined {
    if (!this.showsLines) return undefined;
    const away = (side: Side) => {
      const line = this.drawing.lines.get(keyOf(this.slice, this.phase, side));
      return line ? nearest(line.points, at).away : Infinity;
    };
    const within = sides.filter((side) => away(side) < this.picture.mm(grasp));
    return within.sort((a, b) => away(a) - away(b))[0];
  }

  private pan(event: PointerEvent): void { this.letGo = this.picture.panWith(event); }

  private startPull(from: Place): void {
    const before = this.line!;
    const how = this.corrected();
    const key = this.key;
    let now: Place[] = before.points;
    this.moved();
    this.show();
    this.held = (at) => {
      const step: Place = [at[0] - from[0], at[1] - from[1]];
      now = this.tool === "size" ? resized(before.points, this.outwards(before.points, from, at)) : pulled(before.points, this.point!, step, this.width);
      this.drawing.lines.set(key, { ...before, points: now });  // seen at once; undone as one
      this.show();
      this.moved();
    };
    this.letGo = () => {
      this.drawing.lines.set(key, before);
      if (now === before.points) return this.show();
      if (this.tool === "size") this.put(`resize the ${sideNames[this.side]}`, now, how);
      else this.put(`pull the ${sideNames[this.side]}`, now, how, this.wantedWith(now[this.point!]));
    };
  }

  /** How far a place is farther than another from the middle of a line. */
  private outwards(points: Place[], from: Place, at: Place): number {
    const middle: Place = [points.reduce((s, p) => s + p[0], 0) / points.length, points.reduce((s, p) => s + p[1], 0) / points.length];
    return distance(at, middle) - distance(from, middle);
  }

  /** A point is taken where there is one, else set. */
  private startPoint(at: Place): void {
    const others = this.wanted.filter((place) => distance(place, at) > this.picture.mm(grasp));
    const set = (place: Place) => this.drawing.change({ what: `set a point of the ${sideNames[this.side]}`, points: [[this.key, [...others, place]]] }, `${this.key} set ${others.length}`);
    set(at);
    this.held = set;
    this.letGo = () => this.saySet();
  }

  private saySet(): void {
    const n = this.wanted.length;
    this.say(`${n} point${n === 1 ? "" : "s"} set for the ${sideNames[this.side]}: R redraws it through ${n === 1 ? "it" : "them"}`);
  }

  /** Without a pointer: the selected point of the border, or the middle of the picture. */
  setPoint(): void {
    if (this.isLongAxis) return this.say(shortAxisAlone);
    const at = this.point === undefined ? this.picture.centre : this.line?.points[this.point] ?? this.picture.centre;
    this.drawing.change({ what: `set a point of the ${sideNames[this.side]}`, points: [[this.key, [...this.wanted, at]]] });
    this.saySet();
  }

  dropPoints(): void {
    if (this.wanted.length > 0) this.drawing.change({ what: `drop the points of the ${sideNames[this.side]}`, points: [[this.key, undefined]] });
  }

  private startStroke(at: Place): void {
    this.stroke = [at];
    this.held = (next) => {
      if (distance(next, this.stroke.at(-1)!) < 0.7) return;
      this.stroke.push(next);
      this.show();
    };
    this.letGo = () => {
      const made = redrawn(this.line?.points, this.stroke);
      this.stroke = [];
      if (!made) return this.show();
      this.point = undefined;
      this.put(`redraw the ${sideNames[this.side]}`, made.points, made.whole ? "drawn" : this.corrected());
    };
  }

  private release(): void {
    const end = this.letGo;
    this.held = this.letGo = undefined;
    end?.();
  }

  mark(name: string, at: Place = this.picture.centre): void {
    const { by, when } = this.stamp("drawn");
    this.drawing.change({ what: `set the ${landmarkNames[name]}`, marks: [[name, { name, slice: this.slice, at, by, when }]] });
    this.say(`${landmarkNames[name]} set on ${this.called(this.slice)}`);
  }

  /** The point that the keys move: the next or the one before. */
  step(by: number): void {
    const line = this.line;
    if (this.isLongAxis) return this.say(shortAxisAlone);
    if (!line) return this.say(`slice ${this.slice}, phase ${this.phase} has no ${sideNames[this.side]}: A adds a circle`);
    const n = line.points.length;
    this.point = this.point === undefined ? 0 : (this.point + by * handleStep + n) % n;
    this.show();
    this.moved();
  }

  /** By so many mm along rows and columns: a landmark while it is the tool, else the selected point. */
  nudge(u: number, v: number): void {
    const mark = this.drawing.landmarks.get(this.tool);
    if (mark && mark.slice === this.slice)
      return this.drawing.change({ what: `move the ${landmarkNames[this.tool]}`, marks: [[this.tool, { ...mark, by: this.observer, when: this.stamp("corrected").when, at: [mark.at[0] + u, mark.at[1] + v] }]] }, `mark ${this.tool}`);
    if (this.point === undefined) return this.step(1);
    const line = this.line;
    if (!line) return;
    const points = pulled(line.points, this.point, [u, v], this.width);
    this.put(`move a point of the ${sideNames[this.side]}`, points, this.corrected(), this.wantedWith(points[this.point]), `${this.key} ${this.point}`);
  }

  grow(by: number): void {
    const line = this.line;
    if (line) this.put(`resize the ${sideNames[this.side]}`, resized(line.points, by), this.corrected(), [], `${this.key} size`);
  }

  /** The borders of this side on all slices of the phase. */
  growAll(by: number): void {
    const keys = this.study.slices.map((_, i) => keyOf(i + 1, this.phase, this.side)).filter((key) => this.drawing.lines.has(key));
    const lines = keys.map((key): [string, Line] => {
      const line = this.drawing.lines.get(key)!;
      return [key, { points: resized(line.points, by), ...this.stamp(line.how === "drawn" ? "drawn" : "corrected") }];
    });
    if (lines.length > 0) this.drawing.change({ what: `resize the ${sideNames[this.side]} on ${lines.length} slices`, lines }, `${this.phase} ${this.side} size`);
  }

  remove(): void {
    if (this.tool in landmarkNames && this.drawing.landmarks.has(this.tool))
      return this.drawing.change({ what: `delete the ${landmarkNames[this.tool]}`, marks: [[this.tool, undefined]] });
    if (!this.line) return;
    this.point = undefined;
    this.drawing.change({ what: `delete the ${sideNames[this.side]}`, lines: [[this.key, undefined]] });
  }

  /** Both borders of this slice and phase. */
  removeBoth(): void {
    const keys = sides.map((side) => keyOf(this.slice, this.phase, side)).filter((key) => this.drawing.lines.has(key));
    this.point = undefined;
    if (keys.length > 0) this.drawing.change({ what: "delete both borders", lines: keys.map((key) => [key, undefined]) });
  }

  /** A circle in the middle of what is seen, to be pulled into shape. */
  add(): void {
    if (this.isLongAxis) return this.say(shortAxisAlone);
    const other = this.drawing.lines.get(keyOf(this.slice, this.phase, this.side === "endo" ? "epi" : "endo"));
    const points = other ? resized(other.points, this.side === "endo" ? -8 : 8) : circle(this.picture.centre, this.side === "endo" ? 15 : 25);
    this.put(`new ${sideNames[this.side]}`, points, "drawn");
  }

  /** The border of this side to a slice or phase beside it, in the same place of space. */
  copy(slices: number, phases: number): void {
    const line = this.line;
    const slice = this.slice + slices;
    const to = this.study.slices[slice - 1];
    if (!line || !to) return this.say(line ? "there is no slice beyond" : `there is no ${sideNames[this.side]} to copy`);
    const points = line.points.map((p) => placeOn(to, inSpace(this.plane, p)));
    this.go(slice, this.phase + phases);
    this.put(`copy the ${sideNames[this.side]}`, points, "drawn");
  }

  backToProposal(): void {
    const line = this.proposal.get(this.key);
    if (!line) return this.say("the program proposed none here");
    this.point = undefined;
    this.drawing.change({ what: "back to the proposal", lines: [[this.key, line]] });
  }

  nextDoubtful(): void {
    const all = doubtfulKeys(this.drawing, this.study.doubtful);
    if (all.length === 0) return this.say("nothing is doubtful");
    const next = all[(all.findIndex(({ key }) => key === this.key) + 1) % all.length];
    const { slice, phase, side } = ofKey(next.key);
    this.go(slice, phase, side);
  }
}
