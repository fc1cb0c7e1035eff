// Blood in the long-axis plane y = 0: speed or pressure as colours, velocity as arrows, the wall's section above them.
import { rgbOf, type Scale } from "./colours.ts";
import { shorts, type FlowJson, type Wall } from "./data.ts";
import { cutWall } from "./section.ts";

export type FlowQuantity = "speed" | "pressure";
export interface FlowFrame { velocity: Float32Array; pressure: Float32Array }  // m/s (x, then y, then z), mmHg

const kPaPerMmHg = 0.133322387415;

export async function readFlow(flow: FlowJson, frame: number): Promise<FlowFrame> {
  const [u, p] = await Promise.all([shorts(flow.velocity.frames[frame]), shorts(flow.pressure.frames[frame])]);
  return { velocity: Float32Array.from(u, (n) => (n * flow.velocity.step) / 1000),
    pressure: Float32Array.from(p, (n) => (n * flow.pressure.step) / kPaPerMmHg) };
}

export function speeds(frame: FlowFrame): Float32Array {
  const n = frame.pressure.length;
  const { velocity: u } = frame;
  return frame.pressure.map((_, i) => Math.hypot(u[i], u[n + i], u[2 * n + i]));
}

/** The frame after end-diastole with the fastest blood; of all when there is none. */
export async function fastestFrame(flow: FlowJson, endDiastole: number | undefined): Promise<number> {
  const all = flow.times.map((_, i) => i);
  const later = all.filter((i) => flow.times[i] > (endDiastole ?? Infinity));
  let best = { frame: 0, speed: -1 };
  for (const frame of later.length ? later : all) {
    const speed = speeds(await readFlow(flow, frame)).reduce((a, b) => Math.max(a, b), 0);
    if (speed > best.speed) best = { frame, speed };
  }
  return best.frame;
}

export function flowScale(frames: FlowFrame[], what: FlowQuantity): Scale {
  const all = frames.flatMap((frame) => Array.from(what === "speed" ? speeds(frame) : frame.pressure)).sort((a, b) => a - b);
  const at = (f: number) => all[Math.min(all.length - 1, Math.floor(f * all.length))] ?? 0;
  if (what === "speed") return { min: 0, max: Math.max(at(0.995), 1e-3), diverging: false };
  return { min: Math.min(0, at(0.01)), max: Math.max(at(0.99), 0.01), diverging: false };
}

export function drawFlow(canvas: HTMLCanvasElement, flow: FlowJson, frame: FlowFrame, what: FlowQuantity, scale: Scale,
                         wall: Wall | undefined, wallFrame: number | undefined): void {
  const [nx, nz] = flow.cells;
  const zoom = Math.max(2, Math.round(900 / (nz * flow.spacing[1])));  // pixels per mm
  canvas.width = Math.round(nx * flow.spacing[0] * zoom);
  canvas.height = Math.round(nz * flow.spacing[1] * zoom);
  const context = canvas.getContext("2d")!;
  const colours = document.createElement("canvas");
  [colours.width, colours.height] = [nx, nz];
  const pixels = new ImageData(nx, nz);
  const values = what === "speed" ? speeds(frame) : frame.pressure;
  for (let k = 0; k < nz; ++k)
    for (let i = 0; i < nx; ++i)
      pixels.data.set([...rgbOf(scale, values[i + nx * k]), 255], 4 * (i + nx * (nz - 1 - k)));
  colours.getContext("2d")!.putImageData(pixels, 0, 0);
  context.imageSmoothingQuality = "high";
  context.drawImage(colours, 0, 0, canvas.width, canvas.height);
  const px = (x: number) => (x - flow.lower[0]) * zoom;
  const py = (z: number) => canvas.height - (z - flow.lower[1]) * zoom;
  if (wall && wallFrame !== undefined) drawWall(context, wall, wallFrame, px, py);
  drawArrows(context, flow, frame, values, what, scale, px, py);
  drawBar(context, canvas.height);
  function drawBar(c: CanvasRenderingContext2D, height: number) {
    c.fillStyle = "#fff";
    c.fillRect(12, height - 42, 20 * zoom + 20, 32);
    c.fillStyle = "#111";
    c.fillRect(22, height - 18, 20 * zoom, 3);
    c.font = "20px sans-serif";
    c.textAlign = "center";
    c.fillText("20 mm", 22 + 10 * zoom, height - 22);
  }
}

function drawWall(context: CanvasRenderingContext2D, wall: Wall, frame: number, px: (x: number) => number, py: (z: number) => number): void {
  const section = cutWall(wall, wall.positions(frame), { normal: [0, 1, 0], offset: 0 });
  context.fillStyle = "rgb(222, 205, 200)";
  context.beginPath();
  for (const corners of section.polygons) {
    // counter-clockwise all, so that the parts add up under the nonzero rule
    corners.forEach((p, i) => {
      const at: [number, number] = [px(section.points[3 * p]), py(section.points[3 * p + 2])];
      i ? context.lineTo(...at) : context.moveTo(...at);
    });
    context.closePath();
  }
  context.fill();
  context.strokeStyle = context.fillStyle;
  context.lineWidth = 1;
  context.stroke();
  // the outline: sides of one polygon only
  const sides = new Map<string, [number, number]>();
  for (const corners of section.polygons)
    corners.forEach((p, i) => {
      const q = corners[(i + 1) % corners.length];
      const key = p < q ? `${p} ${q}` : `${q} ${p}`;
      if (!sides.delete(key)) sides.set(key, [p, q]);
    });
  context.strokeStyle = "#333";
  context.lineWidth = 2;
  context.beginPath();
  for (const [p, q] of sides.values()) {
    context.moveTo(px(section.points[3 * p]), py(section.points[3 * p + 2]));
    context.lineTo(px(section.points[3 * q]), py(section.points[3 * q + 2]));
  }
  context.stroke();
}

function drawArrows(context: CanvasRenderingContext2D, flow: FlowJson, frame: FlowFrame, values: Float32Array, what: FlowQuantity,
                    scale: Scale, px: (x: number) => number, py: (z: number) => number): void {
  const [nx, nz] = flow.cells;
  const every = Math.max(1, Math.round(4 / flow.spacing[0]));
  const n = nx * nz;
  const fastest = speeds(frame).reduce((a, b) => Math.max(a, b), 1e-9);
  const longest = 3.2 * every * (px(flow.spacing[0]) - px(0));
  for (let k = every >> 1; k < nz; k += every)
    for (let i = every >> 1; i < nx; i += every) {
      const cell = i + nx * k;
      const u = frame.velocity[cell];
      const w = frame.velocity[2 * n + cell];
      const length = (longest * Math.hypot(u, w)) / fastest;
      if (length < 2) continue;
      const dark = what === "pressure" || (values[cell] - scale.min) / (scale.max - scale.min) > 0.55;
      context.strokeStyle = context.fillStyle = dark ? "#111" : "#fff";
      context.lineWidth = 1.6;
      const x = px(flow.lower[0] + (i + 0.5) * flow.spacing[0]);
      const y = py(flow.lower[1] + (k + 0.5) * flow.spacing[1]);
      const a = Math.atan2(-w, u);
      const tip: [number, number] = [x + length * Math.cos(a), y + length * Math.sin(a)];
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(...tip);
      context.stroke();
      const head = Math.min(9, 0.5 * length);
      context.beginPath();
      context.moveTo(...tip);
      for (const side of [-0.45, 0.45])
        context.lineTo(tip[0] - head * Math.cos(a + side), tip[1] - head * Math.sin(a + side));
      context.fill();
    }
}
