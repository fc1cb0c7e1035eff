// The enhanced slices: the threshold that the program is asked for, and the brush that corrects it.
import type { Drawing } from "./drawing.ts";
import { Refused, Stopped, type Keeper } from "./keeper.ts";
import { Picture } from "./picture.ts";
import { distance } from "./shape.ts";
import { brushed, fullestSlice, isCorrected, isRemote, isScar, proposedAgain, runsOf, scarVolume, type Brush, type Rule, type SaidScar, type Scar, type Wall } from "./scar.ts";
import { keyOf, sides, toldPoints, type Line, type Place, type SaidStudy } from "./study.ts";

const shades: Record<"scar" | "remote", [number, number, number, number]> = { scar: [255, 60, 40, 120], remote: [60, 230, 120, 110] };

export class ScarEditor {
  readonly picture = new Picture("enhanced");
  slice: number;
  brush: Brush = "scar";
  radius = 3;  // mm
  rule: Rule;
  deviations: number;
  showsScar = true;
  private at: Place | undefined;
  private strokes = 0;
  private painting: ((at: Place) => void) | undefined;
  private letGo: (() => void) | undefined;
  private busy = false;
  private again: (() => Promise<void>) | undefined;
  /** The borders that each wall was taken from. */
  private readonly taken = new WeakMap<(Wall | null)[], (Line | undefined)[]>();
  private readonly greys = new Map<number, Uint8Array>();
  private moved: () => void = () => {};

  constructor(readonly said: SaidScar, readonly study: SaidStudy, readonly drawing: Drawing, private readonly source: Keeper, readonly say: (words: string) => void,
    private readonly observer: () => string) {
    this.slice = fullestSlice(this.scar);
    this.rule = said.saved ? "level" : said.rule;
    this.deviations = said.deviations;
    this.taken.set(this.scar.walls, this.linesOfPhase(this.scar.phase));
    this.picture.listen((event) => this.press(event), (at) => this.follow(at), () => this.release());
    this.picture.canvas.addEventListener("pointerleave", () => { this.at = undefined; this.show(); });
  }

  onMove(tell: () => void): void { this.moved = tell; }

  hold(slice: number, greys: Uint8Array): void {
    this.greys.set(slice, greys);
    if (slice === this.slice) this.show();
  }

  get scar(): Scar { return this.drawing.scar!; }
  get planes() { return this.said.slices; }
  get plane() { return this.planes[this.slice - 1]; }
  /** Whether the program is there, which alone knows the threshold. */
  get asks(): boolean { return this.source.scar !== undefined; }
  get here() { return this.scar.slices[this.slice - 1]; }

  show(): void {
    const { here, plane } = this;
    const wall = this.scar.walls[this.slice - 1];
    const line = (points: Place[]): Line => ({ points, how: "proposed", by: "", when: "" });
    this.picture.show({ plane, greys: this.greys.get(this.slice), lines: wall ? { ...(wall.endo.length ? { endo: line(wall.endo) } : {}), epi: line(wall.epi) } : {}, doubtful: {}, original: {},
      marks: [], side: undefined, point: undefined, wanted: [], stroke: [], brush: this.at && { at: this.at, radius: this.radius },
      tint: this.showsScar ? (n) => (isScar(here, n) ? shades.scar : isRemote(here, n) ? shades.remote : undefined) : undefined });
  }

  go(slice: number): void {
    this.slice = Math.min(this.planes.length, Math.max(1, slice));
    this.show();
    this.moved();
  }

  /** Shows the surroundings of the wall, or the whole picture. */
  fit(): void {
    const all = this.scar.walls.flatMap((wall) => (wall ? wall.epi : []));
    const { columns, rows, spacing } = this.plane;
    if (all.length === 0) return this.picture.fit([0, 0], [columns * spacing[0], rows * spacing[1]]);
    const ends = (d: 0 | 1) => [Math.min(...all.map((p) => p[d])), Math.max(...all.map((p) => p[d]))];
    const [[a, c], [b, d]] = [ends(0), ends(1)];
    this.picture.fit([a - 15, b - 15], [c + 15, d + 15]);
  }

  /** What stands, in words. */
  words(): string {
    const { scar, wall } = scarVolume(this.scar, this.planes);
    const from = { remote: `${this.deviations} deviations above remote muscle`, brightest: "half of the brightest in the wall", level: "chosen" }[this.rule];
    const hasWall = this.scar.walls[this.slice - 1] ? (isCorrected(this.here) ? `corrected${this.here.by ? ` by ${this.here.by}` : ""}` : "as proposed") : "no wall here";
    return `enhanced slice ${this.slice} of ${this.planes.length}: ${hasWall}; threshold ${this.scar.threshold.toPrecision(4)} (${from}); scar ${scar.toFixed(1)} ml, ${
      wall > 0 ? (100 * scar / wall).toFixed(0) : "–"}% of the wall; wall of phase ${this.scar.phase}${this.stale ? ", whose borders have changed since" : ""}`;
  }

  private linesOfPhase(phase: number): (Line | undefined)[] {
    return this.study.slices.flatMap((_, s) => sides.map((side) => this.drawing.lines.get(keyOf(s + 1, phase, side))));
  }
  /** Whether the borders are others than those that the wall was taken from. */
  get stale(): boolean { return this.linesOfPhase(this.scar.phase).some((line, i) => line !== this.taken.get(this.scar.walls)?.[i]); }

  private follow(at: Place): void {
    this.at = at;
    this.painting?.(at);
    this.show();
  }

  private press(event: PointerEvent): void {
    if (event.button !== 1) return this.startStroke(this.picture.placeOf(event));
    this.painting = () => {};
    this.letGo = this.picture.panWith(event);
  }

  private startStroke(from: Place): void {
    const before = this.scar;
    const number = this.slice - 1;
    let now = before;
    let last = from;
    const dab = (at: Place) => {
      const steps = Math.max(1, Math.ceil(distance(last, at) / Math.max(0.5 * this.radius, 0.2)));
      let slice = now.slices[number];
      for (let k = 1; k <= steps; ++k)
        slice = brushed(slice, this.plane, [last[0] + k * (at[0] - last[0]) / steps, last[1] + k * (at[1] - last[1]) / steps], this.radius, this.brush);
      last = at;
      const when = new Date().toISOString().replace(/\.\d+/, "");
      now = { ...now, slices: now.slices.map((old, s) => (s === number ? { ...slice, by: this.observer(), when } : old)) };
      this.drawing.scar = now;  // seen at once; undone as one
      this.moved();
    };
    dab(from);
    this.show();
    this.painting = dab;
    this.letGo = () => {
      this.drawing.scar = before;
      const stroke = `stroke ${++this.strokes}`;
      this.drawing.change({ what: `brush ${this.brush === "scar" ? "scar" : this.brush === "remote" ? "remote muscle" : "muscle"}`, scar: now }, stroke);
      if (this.brush === "remote" && this.rule === "remote") this.propose(stroke);
    };
  }

  private release(): void {
    const end = this.letGo;
    this.painting = this.letGo = undefined;
    end?.();
  }

  /** Without a pointer: the brush in the middle of the picture, or where the keys moved it. */
  moveBrush(u: number, v: number): void {
    const [x, y] = this.at ?? this.picture.centre;
    this.at = [x + u, y + v];
    this.show();
  }
  dab(): void {
    this.at ??= this.picture.centre;
    this.startStroke(this.at);
    this.release();
  }

  /** Lets the program find the scar by the rule that is chosen; the last wish counts if there are several while it works. */
  propose(goesOn = "threshold", level = this.scar.threshold): void {
    this.ask(async () => {
      const map = await this.source.scar!(this.wish(this.scar.walls, level));
      this.drawing.change({ what: "set the threshold", scar: proposedAgain(this.scar, this.planes, map) }, goesOn);
      this.say(`Scar is brighter than ${map.threshold.toPrecision(4)} now.`);
    });
  }

  /** Takes the wall from the borders of a phase, as they stand. */
  takeWall(phase: number): void {
    this.ask(async () => {
      const lines = this.linesOfPhase(phase);
      const contours = this.study.slices.flatMap((plane, s) => sides.flatMap((side) => {
        const line = this.drawing.lines.get(keyOf(s + 1, phase, side));
        return line ? [{ slice: s + 1, side, ...line, points: toldPoints(plane, line.points) }] : [];
      }));
      const walls = await this.source.wall!(JSON.stringify({ contours }));
      const map = await this.source.scar!(this.wish(walls, this.scar.threshold));
      this.taken.set(walls, lines);
      this.drawing.change({ what: `take the wall of phase ${phase}`, scar: proposedAgain(this.scar, this.planes, map, walls, phase) });
      this.say(`The wall is that of phase ${phase} now.`);
    });
  }

  private wish(walls: (Wall | null)[], level: number): string {
    return JSON.stringify({ rule: this.rule, deviations: this.deviations, level, walls,
      remote: this.scar.slices.map((slice, s) => runsOf(this.planes[s], (n) => slice.wall[n] === 1 && slice.remote[n] === 1)) });
  }

  setLevel(level: number): void {
    this.rule = "level";
    this.propose("threshold", level);
  }

  setRule(rule: Rule): void {
    this.rule = rule;
    this.propose();
  }

  setDeviations(deviations: number): void {
    this.deviations = deviations;
    if (this.rule === "remote") this.propose();
  }

  private ask(question: () => Promise<void>): void {
    if (!this.asks) return this.say("This page is a file: only ventricle draw itself can find the scar. The brush works.");
    if (this.busy) { this.again = question; return; }
    this.busy = true;
    question().catch((error: unknown) => {
      if (error instanceof Stopped) this.say("ventricle draw does not answer.");
      else if (error instanceof Refused) this.say(error.message);
      else throw error;
    }).finally(() => {
      this.busy = false;
      const next = this.again;
      this.again = undefined;
      if (next) this.ask(next);
      else this.moved();
    });
  }
}
