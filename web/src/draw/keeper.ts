// Where the study comes from and where the drawing goes: the program that serves the page, or the page itself.
import { save as download } from "../dom.ts";
import type { SaidMap, Wall } from "./scar.ts";
import type { Place, Point, SaidProposal, SaidStudy, Side } from "./study.ts";

/** One border and the points through which it is wanted; lines that do not stand are empty. */
export interface Wish { slice: number; phase: number; side: Side; points: Point[]; endo: Point[]; epi: Point[] }

/** The new revision, and what keeps borders of the kept drawing from being those of a wall, in sentences. */
export interface Kept { revision: number; faults: string[] }

export class Refused extends Error {
  status: number;
  constructor(status: number, words: string) { super(words); this.status = status; }
}

/** The program does not answer. */
export class Stopped extends Error {}

export interface Keeper {
  study(): Promise<SaidStudy>;
  /** Grey values of a slice, phase by phase. */
  slice(number: number): Promise<Uint8Array<ArrayBuffer>>;
  /** Those of an enhanced slice. */
  enhanced(number: number): Promise<Uint8Array<ArrayBuffer>>;
  /** Keeps a drawing; none where it is downloaded. */
  save?(drawing: string, whateverStands: boolean): Promise<Kept>;
  propose?(centre: Point): Promise<SaidProposal>;
  /** A border anew through points of it. */
  redraw?(wish: Wish): Promise<Point[]>;
  /** Where the wall within borders of the cine lies on the enhanced slices. */
  wall?(lines: string): Promise<(Wall | null)[]>;
  /** The scar that a threshold finds. */
  scar?(wish: string): Promise<SaidMap>;
  /** The revision that stands. */
  alive?(): Promise<number>;
}

async function ask(place: string, body?: string): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(place, body === undefined ? {} : { method: "POST", body });
  } catch {
    throw new Stopped();
  }
  if (response.ok) return response;
  const { error } = await response.json().catch(() => ({ error: `answer ${response.status}` }));
  throw new Refused(response.status, error);
}

const served: Keeper = {
  study: async () => (await ask("study")).json(),
  slice: async (number) => new Uint8Array(await (await ask(`slice/${number}`)).arrayBuffer()),
  enhanced: async (number) => new Uint8Array(await (await ask(`enhanced/${number}`)).arrayBuffer()),
  save: async (drawing, whateverStands) => (await ask(whateverStands ? "overwrite" : "save", drawing)).json(),
  propose: async (centre) => (await ask("segment", JSON.stringify({ centre }))).json(),
  redraw: async (wish) => (await (await ask("redraw", JSON.stringify(wish))).json()).points,
  wall: async (lines) => (await (await ask("wall", lines)).json()).walls,
  scar: async (wish) => (await ask("scar", wish)).json(),
  alive: async () => (await (await ask("alive")).json()).revision,
};

const inside = (id: string) => document.getElementById(id)?.textContent ?? "";

async function unpacked(id: string): Promise<Uint8Array<ArrayBuffer>> {
  const bytes = Uint8Array.from(atob(inside(id)), (letter) => letter.charCodeAt(0));
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer());
}

const alone: Keeper = {
  study: async () => JSON.parse(inside("study")),
  slice: (number) => unpacked(`slice-${number}`),
  enhanced: (number) => unpacked(`enhanced-${number}`),
};

export const keeper = (): Keeper => (document.getElementById("study") ? alone : served);

export const downloadDrawing = (name: string, drawing: string) =>
  download(`${name.replace(/[^\w.+-]+/g, "_")}.drawing.json`, new Blob([drawing], { type: "application/json" }));

export type { Place };
