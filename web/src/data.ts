// What the program wrote into the page, decoded.

import { stateTitle } from "./quantities.ts";

export type Row = Record<string, string>;

/** offset + sum_k course_k(t) step shape_k(i); see src/lv/page/modes.hpp. */
interface ModesJson { offset: number; step: number; largest_error: number; courses: number[][]; shapes: string[]; min?: number; max?: number }
interface Packed { step: number; values: string }

export interface Reach { radius: number; bottom: number; top: number }

/** A picture of the four-chamber view at a frame, whose middle lies on the long axis half-way between bottom and top of the reach. */
interface OpeningJson { png: string; width_mm: number; frame: number }

interface WallJson {
  reach: Reach;
  opening?: OpeningJson;
  nodes_per_cell: number;
  nodes: number;
  order?: number;  // 2: eight consecutive cells are the parts of a quadratic element; without: 1
  times: number[];
  cells: string;
  skin: string;
  skin_cells: string;
  undeformed: Packed;
  f0?: Packed;
  infarct?: Packed;
  slice?: string;
  sector?: string;
  aha17?: string;
  displacement: ModesJson;
  quantities: Record<string, ModesJson>;
}

interface FlowJson {
  plane_deg?: number;  // of the long-axis plane about z, from x; velocities are along it, across it and along z
  cells: [number, number];
  lower: [number, number];
  spacing: [number, number];
  times: number[];
  velocity: { step: number; frames: string[] };
  pressure: { step: number; frames: string[] };
}

/** A cine image with lines over it; points are x, y, x, y ... in its pixels. */
export interface Outlined {
  state: string;
  slice: string; // number of a short-axis slice, or "long axis 1"
  phase: number;
  columns: number;
  rows: number;
  spacing_i_mm: number;
  spacing_j_mm: number;
  along_row?: number[];     // unit vectors in image space
  along_column?: number[];
  png: string;
  lines: { source: "model" | "contours"; contour: string; points: number[] }[];
}

interface CaseJson {
  folder: string;
  name?: string;           // of the case, as its run left it
  complete: boolean;
  state: string[];
  files: Record<string, string>;
  septum_deg?: number;     // angle of the middle of the septum about the long axis, from x
  engine?: string;         // as the case file calls it
  wall?: WallJson;
  flow?: FlowJson;
  has_blood?: boolean;     // there are frames of the blood
  pictures?: string;  // id of the element with them
}

function text(id: string): string {
  return document.getElementById(id)!.textContent!;
}

/** Whether the browser has read all of an element: while it reads one, the page holds its beginning. */
function isRead(id: string): boolean {
  const element = document.getElementById(id);
  return element !== null && (element.nextSibling !== null || document.readyState !== "loading");
}

const parsed = new Promise((done) => document.addEventListener("DOMContentLoaded", done));
/** The arrays of the first picture have been read; they stand before all others. */
const wallData = new Promise((done) => addEventListener("wall-data", done));

/** The text of an element after the script; these stand in the order in which they are needed. */
async function laterText(id: string): Promise<string> {
  if (!isRead(id)) await wallData;
  if (!isRead(id)) await parsed;
  return text(id);
}

/** Undoes src/lv/page/packing.hpp. */
async function unpacked(id: string, bytes: 2 | 4): Promise<Int16Array | Int32Array> {
  const letters = atob(await laterText(id));
  const packed = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; ++i) packed[i] = letters.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const planes = new Uint8Array(await new Response(stream).arrayBuffer());
  const count = planes.length / bytes;
  const values = bytes === 2 ? new Int16Array(count) : new Int32Array(count);
  let sum = 0;
  for (let i = 0; i < count; ++i) {
    let difference = planes[i] | (planes[count + i] << 8);
    if (bytes === 4) difference |= (planes[2 * count + i] << 16) | (planes[3 * count + i] << 24);
    values[i] = sum = (sum + difference) | 0;
  }
  return values;
}

export const shorts = (id: string) => unpacked(id, 2) as Promise<Int16Array>;
const wholes = (id: string) => unpacked(id, 4) as Promise<Int32Array>;

async function scaled(packed: Packed): Promise<Float32Array> {
  return Float32Array.from(await shorts(packed.values), (n) => n * packed.step);
}

/** A field over time. */
export class Series {
  private constructor(private json: ModesJson, private shapes: Int16Array[], readonly size: number) {}

  static async read(json: ModesJson, size: number): Promise<Series> {
    return new Series(json, await Promise.all(json.shapes.map(shorts)), size);
  }

  /** The field at a frame, added to `out`. */
  addTo(out: Float32Array, frame: number): Float32Array {
    const { offset } = this.json;
    for (let i = 0; i < out.length; ++i) out[i] += offset;
    this.shapes.forEach((shape, k) => {
      const factor = this.json.courses[k][frame] * this.json.step;
      for (let i = 0; i < shape.length; ++i) out[i] += factor * shape[i];
    });
    return out;
  }
}

/** Regions a cell belongs to, in the words of regions.csv. */
export type Scheme = "sector" | "aha17";
export interface Selection { scheme: Scheme; index: number }

export const sectorsPerRing: Record<Scheme, number[]> = { sector: [6, 6, 6, 6, 6, 4, 4], aha17: [6, 6, 4, 1] };

export class Wall {
  readonly cells!: Int32Array;
  readonly skin!: Int32Array;
  readonly skinCells!: Int32Array;
  readonly undeformed!: Float32Array;
  readonly infarct?: Float32Array;
  private displacement!: Series;
  private regions!: Partial<Record<Scheme, Int16Array>>;
  private loading?: Promise<void>;

  constructor(private json: WallJson) {}

  /** Reads the arrays, once. Until then nothing is known but what the getters of single numbers and of names say. */
  load(): Promise<void> { return (this.loading ??= this.read()); }

  private async read(): Promise<void> {
    const { json } = this;
    const [cells, skin, skinCells, undeformed, infarct, displacement, slice, sector, aha17] = await Promise.all([
      wholes(json.cells), wholes(json.skin), wholes(json.skin_cells), scaled(json.undeformed),
      json.infarct && scaled(json.infarct),
      Series.read(json.displacement, 3 * json.nodes),
      json.slice ? shorts(json.slice) : undefined, json.sector ? shorts(json.sector) : undefined,
      json.aha17 ? shorts(json.aha17) : undefined]);
    const regions: Partial<Record<Scheme, Int16Array>> = {};
    if (slice && sector) {
      const start = [0, 6, 12, 18, 24, 30, 34];
      regions.sector = slice.map((s, c) => start[s - 1] + sector[c] - 1);
    }
    if (aha17) regions.aha17 = aha17.map((a) => a - 1);
    Object.assign(this, { cells, skin, skinCells, undeformed, infarct, displacement, regions });
  }

  /** Of the wall about the long axis, at all moments [mm]. */
  get reach(): Reach { return this.json.reach; }
  /** What the page opens with, as the program has drawn it. */
  get opening(): OpeningJson | undefined { return this.json.opening; }
  get nodes(): number { return this.json.nodes; }
  get times(): number[] { return this.json.times; }
  get nodesPerCell(): number { return this.json.nodes_per_cell; }
  get order(): number { return this.json.order ?? 1; }
  get nodesPerFace(): number { return this.nodesPerCell === 8 ? 4 : 3; }
  get quantities(): string[] { return Object.keys(this.json.quantities); }

  range(quantity: string): [number, number] {
    const { min, max } = this.json.quantities[quantity];
    return [min!, max!];
  }

  /** x, then y, then z of the nodes at a frame [mm]. */
  positions(frame: number): Float32Array {
    return this.displacement.addTo(this.undeformed.slice(), frame);
  }

  series(quantity: string): Promise<Series> {
    return Series.read(this.json.quantities[quantity], this.nodes);
  }

  /** Fibre directions of the cells, by component; undefined when there are none. */
  async fibres(): Promise<Float32Array | undefined> { return this.json.f0 && scaled(this.json.f0); }

  /** Number of the region that each cell lies in, from 0. */
  region(scheme: Scheme): Int16Array | undefined { return this.regions[scheme]; }

  /** Whether more than half of each region is infarcted, by the mean of M over its cells; undefined without an infarct. */
  infarctedRegions(scheme: Scheme): boolean[] | undefined {
    const [M, regions, n] = [this.infarct, this.regions?.[scheme], this.nodesPerCell];
    if (!M || !regions) return undefined;
    const all = sectorsPerRing[scheme].reduce((sum, count) => sum + count, 0);
    const [cells, infarcted] = [new Array<number>(all).fill(0), new Array<number>(all).fill(0)];
    regions.forEach((region, c) => {
      ++cells[region];
      for (let i = n * c; i < n * (c + 1); ++i) infarcted[region] += M[this.cells[i]] / n;
    });
    return infarcted.map((sum, region) => sum > 0.5 * cells[region]);
  }
}

/** A named moment of a beat, from moments.csv. */
export interface Moment { name: string; time: number }

export class Case {
  readonly regions: Row[];
  readonly moments: Moment[];
  private readonly phases: { name: string; end: number }[] = [];  // as far as curves.csv goes
  private readonly tables = new Map<string, Row[]>();  // that have been read
  private lastBeat?: { number: number; begin: number };
  private readonly regional = new Map<string, Row>();  // rows of regions.csv by what they are of
  name: string;
  readonly wall?: Wall;
  private constructor(readonly json: CaseJson, readonly summary: any) {
    this.name = summary?.case ?? json.name ?? json.folder;
    this.wall = json.wall && new Wall(json.wall);
    this.regions = this.table("regions.csv");
    for (const r of this.regions) this.regional.set([r.state, r.scheme, r.region, r.quantity].join("/"), r);
    this.moments = this.table("moments.csv").map((r) => ({ name: r.moment, time: value(r.time_s) }));
    for (const r of this.table("curves.csv")) {
      if (this.phases.at(-1)?.name !== r.phase) this.phases.push({ name: r.phase, end: 0 });
      this.phases.at(-1)!.end = value(r.time_s);
    }
  }

  static read(number: number): Case {
    const json: CaseJson = JSON.parse(text(`case${number}`));
    const summary = json.files["summary.json"] ? JSON.parse(json.files["summary.json"]) : undefined;
    return new Case(json, summary);
  }

  /** Cine images with outlines; none for a case without images. */
  async pictures(): Promise<Outlined[]> {
    const id = this.json.pictures;
    return id ? JSON.parse(await laterText(id)) : [];
  }

  get flow(): FlowJson | undefined { return this.json.flow; }
  table(file: string): Row[] {
    if (!this.tables.has(file)) this.tables.set(file, csv(this.json.files[file]));
    return this.tables.get(file)!;
  }

  /** Steps of the quasi-static engine are loads, not moments. */
  get isLoaded(): boolean { return this.json.engine === "quasi_static"; }

  /** Heartbeats of a circulation: the frames are those of the last. */
  get isBeating(): boolean { return this.table("cycle.csv").length > 0; }

  /** The beat of the frames, the last of heartbeats: its number and when it begins [s]; beat 0 from 0 s where there is none. */
  private get beat(): { number: number; begin: number } {
    if (!this.lastBeat) {
      const rows = this.table("cycle.csv");
      const number = value(rows.at(-1)?.beat ?? "0");
      this.lastBeat = { number, begin: number > 0 ? value(rows[rows.findIndex((row) => value(row.beat) === number) - 1].time_s) : 0 };
    }
    return this.lastBeat;
  }

  /** When the beat of the frames begins [s]. */
  get begin(): number { return this.beat.begin; }

  /** A time in words: "0.212 s of beat 9", "0.850 s"; empty where steps are loads. */
  clock(t: number): string {
    if (this.isLoaded || Number.isNaN(t)) return "";
    return `${(t - this.begin).toFixed(3)} s${this.beat.number > 0 ? ` of beat ${this.beat.number}` : ""}`;
  }

  /** What was taken for granted of the anatomy. */
  get assumptions(): { part: string; text: string }[] {
    const frame = this.json.files["frame.json"];
    return this.summary?.assumptions ?? (frame ? JSON.parse(frame).assumed : undefined) ?? [];
  }

  /** The wall without load was found from one that bears a pressure; summary.json calls it early_diastole. */
  get isUnloaded(): boolean { return this.summary?.unloaded !== undefined; }

  /** Parameters were fitted to measured volumes. */
  get isFitted(): boolean { return Array.isArray(this.summary?.calibration) || Array.isArray(this.summary?.heartbeats_fitted); }

  /** A moment's name for readers. */
  momentTitle(name: string): string {
    if (name !== "early_diastole") return stateTitle(name);
    return this.isUnloaded ? "without load" : this.assumes("early diastole") ? `${stateTitle(name)}*` : stateTitle(name);
  }

  /** The state that a strain at a time is from: "from end-diastole", "from early diastole*, assumed"; empty of other quantities. */
  since(quantity: string, time: number): string {
    if (!quantity.endsWith("_strain") || Number.isNaN(time)) return "";
    if (time > (this.timeOf("end_diastole") ?? Infinity) + 1e-5) return `from ${stateTitle("end_diastole")}`;
    if (this.isUnloaded) return "from the wall without load";
    return `from ${this.momentTitle("early_diastole")}${this.assumes("early diastole") ? ", assumed" : ""}`;
  }

  /** The axes of the model in image space; undefined when it is not there, or nobody knows. */
  get axes(): { x: number[]; y: number[] } | undefined {
    const frame = this.json.files["frame.json"] ? JSON.parse(this.json.files["frame.json"]) : {};
    return frame.x_axis_in_image_space && { x: frame.x_axis_in_image_space, y: frame.y_axis_in_image_space };
  }

  assumes(part: string): boolean { return this.assumptions.some((a) => a.part === part); }

  /** Whether the infarct is where somebody said, and not where images show it. */
  get assumesInfarct(): boolean { return this.summary?.infarct !== undefined && this.mark("infarct") === "assumed"; }

  /** measured, fitted, assumed or computed: that of the longest path that a figure's path in summary.json begins with. */
  mark(path: string): string | undefined {
    const marks: Record<string, string> = this.summary?.marks ?? {};
    const found = Object.keys(marks).filter((key) => path === key || path.startsWith(`${key}.`));
    return marks[found.sort((a, b) => b.length - a.length)[0]];
  }

  /** A row of regions.csv. */
  row(state: string, scheme: string, region: string, quantity: string): Row | undefined {
    return this.regional.get([state, scheme, region, quantity].join("/"));
  }

  /** When the beat came to a moment; undefined when it did not. */
  timeOf(moment: string): number | undefined { return this.moments.find((m) => m.name === moment)?.time; }

  /** The moment that a time is, else the phase that it lies in. */
  words(t: number): string {
    const moment = this.moments.find((m) => Math.abs(m.time - t) < 1e-5);
    return moment ? stateTitle(moment.name) : (this.phases.find((p) => t <= p.end) ?? this.phases.at(-1))?.name ?? "";
  }

  /** Names of the moments that regions.csv has values at. */
  get states(): string[] { return [...new Set(this.regions.map((r) => r.state))]; }

  /** Names of a scheme's regions in their order. */
  regionNames(scheme: string): string[] {
    return [...new Set(this.regions.filter((r) => r.scheme === scheme).map((r) => r.region))];
  }

  /** The parameter's text as a case file would give it. */
  parameter(name: string): string | undefined {
    const value = this.summary?.parameters?.[name];
    return value === undefined ? undefined : String(value).replace(/^"|"$/g, "");
  }
}

function csv(text: string | undefined): Row[] {
  if (!text) return [];
  const [head, ...lines] = text.trim().split("\n").map((line) => line.split(","));
  return lines.map((fields) => Object.fromEntries(head.map((name, i) => [name, fields[i] ?? ""])));
}

/** NaN for an empty field: missing, never zero. */
export function value(field: string | undefined): number {
  return field === undefined || field === "" ? NaN : Number(field);
}

/** Number of the time that is nearest to a moment; 0 when there are none. */
export function nearest(times: number[], time: number): number {
  return times.reduce((best, t, i) => (Math.abs(t - time) < Math.abs(times[best] - time) ? i : best), 0);
}

const timesOf = new WeakMap<Row[], number[]>();  // tables are asked at every moment

/** On the straight line from a to b; a where one of them is no number. */
function between(a: string, b: string, share: number): string {
  const mixed = (1 - share) * value(a) + share * value(b);
  return Number.isNaN(mixed) ? a : String(mixed);
}

/** The row at a time: moments of heartbeats lie between two rows, and then so do its numbers. */
export function rowBetween(rows: Row[], times: number[], time: number): Row | undefined {
  const near = nearest(times, time);
  const next = time > times[near] ? near + 1 : near - 1;
  const share = (time - times[near]) / (times[next] - times[near]);
  if (!(share > 1e-4 && share < 1)) return rows[near];  // it is that row's, or lies beyond all rows
  return Object.fromEntries(Object.entries(rows[near]).map(([name, text]) => [name, between(text, rows[next][name], share)]));
}

/** The same of curves.csv. */
export function rowAt(rows: Row[], time: number): Row | undefined {
  if (!timesOf.has(rows)) timesOf.set(rows, rows.map((row) => value(row.time_s)));
  return rowBetween(rows, timesOf.get(rows)!, time);
}

export type { FlowJson };
