// Blood in a long-axis plane, that of the four-chamber view, seen so that its direction s, towards the middle of the septum, points
// to the left: speed or pressure as colours, velocity as arrows, the wall's section around it.
import { barParts } from "./bar.ts";
import { rgbOf, type Scale } from "./colours.ts";
import type { DrawnWall } from "./curved.ts";
import { nearest, shorts, type FlowJson } from "./data.ts";
import { ink, svg } from "./dom.ts";
import { type Heart, letterAt, unit } from "./orientation.ts";
import { shown } from "./quantities.ts";
import { cutWall, outline, type Section } from "./section.ts";

export type FlowQuantity = "speed" | "pressure";

export interface FlowFrame {
  velocity: Float32Array;  // m/s (along s, then across the plane, then z)
  pressure: Float32Array;  // mmHg
  section: Section;        // of the wall
  s: Float32Array;         // of the section's points
  sides: [number, number][];  // its outline
  cavity: ([number, number] | undefined)[];  // of each row of cells: from, to [mm]
}

const kPaPerMmHg = 0.133322387415;

export const flowTitle: Record<FlowQuantity, string> = { speed: "speed (m/s)", pressure: "pressure (mmHg)" };

async function velocityOf(flow: FlowJson, frame: number): Promise<Float32Array> {
  return Float32Array.from(await shorts(flow.velocity.frames[frame]), (n) => (n * flow.velocity.step) / 1000);
}

function speeds(velocity: Float32Array): Float32Array {
  const n = velocity.length / 3;
  return Float32Array.from({ length: n }, (_, i) => Math.hypot(velocity[i], velocity[n + i], velocity[2 * n + i]));
}

/** Height of the highest point. */
const topOf = (section: Section) => section.points.reduce((top, value, i) => (i % 3 === 2 ? Math.max(top, value) : top), -Infinity);

/** Where the plane meets blood within the wall, row after row from the base down; above the base, between its inner rims. */
function cavityOf(flow: FlowJson, section: Section, s: Float32Array, sides: [number, number][]): ([number, number] | undefined)[] {
  const x = (p: number) => s[p];
  const z = (p: number) => section.points[3 * p + 2];
  const base = topOf(section);
  const rows: ([number, number] | undefined)[] = Array.from({ length: flow.cells[1] });
  let middle = 0;
  for (let k = rows.length - 1; k >= 0; --k) {
    const height = Math.min(flow.lower[1] + (k + 0.5) * flow.spacing[1], base - 0.5);
    const crossings = sides.filter(([p, q]) => z(p) < height !== z(q) < height)
      .map(([p, q]) => x(p) + ((height - z(p)) / (z(q) - z(p))) * (x(q) - x(p)));
    const left = crossings.filter((at) => at < middle);
    const right = crossings.filter((at) => at >= middle);
    const inside = left.length > 1 && left.length % 2 === 0 && right.length > 1;  // a wall on both sides, and the middle in neither
    if (!inside) break;
    rows[k] = [Math.max(...left), Math.min(...right)];
    middle = 0.5 * (rows[k]![0] + rows[k]![1]);
  }
  return rows;
}

/** A frame of the blood with the wall at the nearest moment. */
export async function readFlow(flow: FlowJson, frame: number, drawn: DrawnWall): Promise<FlowFrame> {
  const { wall } = drawn;
  const [velocity, p] = await Promise.all([velocityOf(flow, frame), shorts(flow.pressure.frames[frame])]);
  const [c, d] = unit(flow.plane_deg ?? 0);
  const { section } = cutWall(drawn, wall.positions(nearest(wall.times, flow.times[frame])), { normal: [-d, c, 0], offset: 0 });
  const along = section.weight.map((_, i) => c * section.points[3 * i] + d * section.points[3 * i + 1]);
  const sides = outline(drawn, section);
  return { velocity, pressure: Float32Array.from(p, (n) => (n * flow.pressure.step) / kPaPerMmHg), section, s: along, sides,
    cavity: cavityOf(flow, section, along, sides) };
}

/** The frame after end-diastole with the fastest blood; of all when there is none. */
export async function fastestFrame(flow: FlowJson, endDiastole: number | undefined): Promise<number> {
  const all = flow.times.map((_, i) => i);
  const later = all.filter((i) => flow.times[i] > (endDiastole ?? Infinity));
  let best = { frame: 0, speed: -1 };
  for (const frame of later.length ? later : all) {
    const speed = speeds(await velocityOf(flow, frame)).reduce((a, b) => Math.max(a, b), 0);
    if (speed > best.speed) best = { frame, speed };
  }
  return best.frame;
}

const centreS = (flow: FlowJson, i: number) => flow.lower[0] + (i + 0.5) * flow.spacing[0];
const isBlood = (flow: FlowJson, frame: FlowFrame, i: number, k: number) => {
  const row = frame.cavity[k];
  return row !== undefined && centreS(flow, i) > row[0] && centreS(flow, i) < row[1];
};
const bloodCells = (flow: FlowJson, frame: FlowFrame) =>
  [...frame.pressure.keys()].filter((cell) => isBlood(flow, frame, cell % flow.cells[0], Math.floor(cell / flow.cells[0])));
const valuesOf = (frame: FlowFrame, what: FlowQuantity) => (what === "speed" ? speeds(frame.velocity) : frame.pressure);

export function flowScale(flows: { flow: FlowJson; frame: FlowFrame }[], what: FlowQuantity): Scale {
  const all = flows.flatMap(({ flow, frame }) => {
    const values = valuesOf(frame, what);
    return bloodCells(flow, frame).map((cell) => values[cell]);
  }).sort((a, b) => a - b);
  const at = (f: number) => all[Math.min(all.length - 1, Math.floor(f * all.length))] ?? 0;
  const bounds = what === "speed" ? { min: 0, max: Math.max(at(0.995), 1e-3) } : { min: Math.min(0, at(0.01)), max: Math.max(at(0.99), 0.01) };
  return { ...bounds, diverging: false, middle: 0, floor: 0 };
}

/** A drawing: its canvas, and what is written over it and saved with it. */
export class FlowView {
  readonly canvas = document.createElement("canvas");
  readonly overlay = svg("svg", { class: "overlay", "font-family": "sans-serif", "font-size": 26, "aria-hidden": "true" });
  private zoom: number;  // pixels a millimetre
  private head = 86;     // pixels for the captions
  private foot = 120;    // and for what explains arrows and colours
  private context: CanvasRenderingContext2D;
  constructor(private flow: FlowJson, private heart: Heart) {
    this.zoom = Math.max(2, Math.round(900 / (flow.cells[1] * flow.spacing[1])));
    this.canvas.width = Math.round(flow.cells[0] * flow.spacing[0] * this.zoom);
    this.canvas.height = Math.round(flow.cells[1] * flow.spacing[1] * this.zoom) + this.head + this.foot;
    this.context = this.canvas.getContext("2d")!;
    this.overlay.setAttribute("viewBox", `0 0 ${this.canvas.width} ${this.canvas.height}`);
    this.overlay.setAttribute("width", String(this.canvas.width));
    this.overlay.setAttribute("height", String(this.canvas.height));
  }

  private px(x: number): number { return this.canvas.width - (x - this.flow.lower[0]) * this.zoom; }
  private py(z: number): number { return this.canvas.height - this.foot - (z - this.flow.lower[1]) * this.zoom; }

  show(frame: FlowFrame, what: FlowQuantity, scale: Scale, captions: string[]): void {
    this.context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    const values = valuesOf(frame, what);
    this.colour(frame, values, scale);
    this.wall(frame);
    const fastest = this.fastest(frame);
    this.arrows(frame, values, what, scale, fastest);
    this.write(what, scale, captions, fastest);
  }

  /** Blood alone: the colours are cut by the cavity's outline. */
  private colour(frame: FlowFrame, values: Float32Array, scale: Scale): void {
    const { flow, context } = this;
    const [nx, nz] = flow.cells;
    const colours = document.createElement("canvas");
    [colours.width, colours.height] = [nx, nz];
    const pixels = new ImageData(nx, nz);
    for (let k = 0; k < nz; ++k)
      for (let i = 0; i < nx; ++i)
        pixels.data.set([...rgbOf(scale, values[i + nx * k]), 255], 4 * (nx - 1 - i + nx * (nz - 1 - k)));
    colours.getContext("2d")!.putImageData(pixels, 0, 0);
    const rows = frame.cavity.map((row, k) => ({ row, z: flow.lower[1] + (k + 0.5) * flow.spacing[1] })).filter(({ row }) => row !== undefined);
    if (!rows.length) return;
    // beyond the lowest row the wall, drawn later, is the border
    const path = (side: 0 | 1) => [{ ...rows[0], z: rows[0].z - 2 * flow.spacing[1] }, ...rows, { ...rows.at(-1)!, z: rows.at(-1)!.z + 0.5 * flow.spacing[1] }]
      .map(({ row, z }): [number, number] => [this.px(row![side]), this.py(z)]);
    context.save();
    context.beginPath();
    for (const at of [...path(0), ...path(1).reverse()]) context.lineTo(...at);
    context.clip();
    context.imageSmoothingQuality = "high";
    context.drawImage(colours, 0, this.head, this.canvas.width, this.canvas.height - this.head - this.foot);
    context.restore();
  }

  private wall({ section, s, sides }: FlowFrame): void {
    const { context } = this;
    const at = (p: number): [number, number] => [this.px(s[p]), this.py(section.points[3 * p + 2])];
    context.fillStyle = context.strokeStyle = "rgb(222, 205, 200)";
    context.lineWidth = 1;
    context.beginPath();
    for (const corners of section.polygons) {
      corners.forEach((p, i) => (i ? context.lineTo(...at(p)) : context.moveTo(...at(p))));
      context.closePath();
    }
    context.fill();
    context.stroke();
    // the two surfaces; the base is where the model ends, not a border of the wall
    const base = topOf(section);
    const isBase = (p: number) => section.points[3 * p + 2] > base - 0.7;
    context.strokeStyle = "#333";
    context.lineWidth = 2;
    context.beginPath();
    for (const [p, q] of sides) if (!(isBase(p) && isBase(q))) {
      context.moveTo(...at(p));
      context.lineTo(...at(q));
    }
    context.stroke();
  }

  private fastest(frame: FlowFrame): number {
    const n = frame.pressure.length;
    return bloodCells(this.flow, frame).reduce((most, i) => Math.max(most, Math.hypot(frame.velocity[i], frame.velocity[2 * n + i])), 1e-9);
  }

  /** Length of the arrow of the fastest blood. */
  private get longest(): number { return 3.2 * this.every * this.flow.spacing[0] * this.zoom; }
  private get every(): number { return Math.max(1, Math.round(4 / this.flow.spacing[0])); }

  private arrows(frame: FlowFrame, values: Float32Array, what: FlowQuantity, scale: Scale, fastest: number): void {
    const { flow, every } = this;
    const [nx, nz] = flow.cells;
    this.context.save();
    this.context.beginPath();
    this.context.rect(0, this.head, this.canvas.width, this.canvas.height - this.head - this.foot);
    this.context.clip();
    for (let k = every >> 1; k < nz; k += every)
      for (let i = every >> 1; i < nx; i += every) {
        if (!isBlood(flow, frame, i, k)) continue;
        const cell = i + nx * k;
        const [u, w] = [-frame.velocity[cell], frame.velocity[2 * nx * nz + cell]];
        const length = (this.longest * Math.hypot(u, w)) / fastest;
        if (length < 2) continue;
        const dark = what === "pressure" || (values[cell] - scale.min) / (scale.max - scale.min) > 0.55;
        this.arrow(this.px(centreS(flow, i)), this.py(flow.lower[1] + (k + 0.5) * flow.spacing[1]), length, Math.atan2(-w, u), dark ? "#111" : "#fff");
      }
    this.context.restore();
  }

  /** With a light or dark rim: its tip may lie on muscle or paper. */
  private arrow(x: number, y: number, length: number, angle: number, colour: string): void {
    const { context } = this;
    const tip: [number, number] = [x + length * Math.cos(angle), y + length * Math.sin(angle)];
    const head = Math.min(9, 0.5 * length);
    for (const [paint, width] of [[colour === "#111" ? "rgba(255,255,255,0.6)" : "rgba(0,0,0,0.45)", 3], [colour, 1.6]] as const) {
      context.strokeStyle = context.fillStyle = paint;
      context.lineWidth = width;
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(...tip);
      context.stroke();
      context.beginPath();
      context.moveTo(...tip);
      for (const side of [-0.45, 0.45]) context.lineTo(tip[0] - head * Math.cos(angle + side), tip[1] - head * Math.sin(angle + side));
      context.closePath();
      context.fill();
      if (width > 2) context.stroke();
    }
  }

  private write(what: FlowQuantity, scale: Scale, captions: string[], fastest: number): void {
    const { width, height } = this.canvas;
    const [bar, edge] = [20 * this.zoom, 20];
    const text = (x: number, y: number, anchor: string, words: string, more = {}) =>
      svg("text", { x, y, "text-anchor": anchor, fill: ink.text, ...more }, words);
    const letter = (x: number, anchor: string, degrees: number) =>
      text(x, this.py(0) - 30, anchor, letterAt(this.heart, (this.flow.plane_deg ?? 0) + degrees), { class: "letter", "font-size": 36, "font-weight": 700 });
    const length = Math.min(this.longest, 0.4 * width);
    const speed = (fastest * length) / this.longest;
    this.overlay.replaceChildren(...captions.map((line, i) => text(edge, 34 + 30 * i, "start", line, i === 0 ? { "font-weight": 600 } : {})),
      letter(edge, "start", 0), letter(width - edge, "end", 180),
      svg("g", { class: "legend", transform: `translate(${edge} ${height - 106}) scale(2)`, "font-size": 12 }, ...barParts(scale, flowTitle[what], 0.2 * width)),
      svg("path", { d: `M${width - edge - bar} ${height - 36}v12h${bar}v-12`, stroke: ink.text, "stroke-width": 3, fill: "none" }),
      text(width - edge - bar / 2, height - 40, "middle", "20 mm"),
      svg("path", { d: `M${width - edge - length} ${height - 168}h${length - 4}m-14 -7l14 7l-14 7`, stroke: ink.text, "stroke-width": 3, fill: "none" }),
      text(width - edge, height - 134, "end", `${shown(speed, 2)} m/s in the plane`));
  }
}
