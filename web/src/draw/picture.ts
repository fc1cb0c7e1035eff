// One slice at one phase with its borders, on a canvas that can be moved and magnified.
import { el } from "../dom.ts";
import { edgeLetters, sides, type Landmark, type Line, type Place, type Plane, type Side } from "./study.ts";

export const colours: Record<Side, string> = { endo: "#ffd23f", epi: "#5ad1ff" };
const doubtColour = "#ff7b1a";
const wantedColour = "#7dff5a";
const cutColour = "#c9a0ff";
const letterColour = "#ffe9b0";

/** What is shown. */
export interface Scene {
  plane: Plane;
  greys: Uint8Array | undefined;  ///< of this phase
  lines: Partial<Record<Side, Line>>;
  doubtful: Partial<Record<Side, boolean>>;
  original: Partial<Record<Side, Line>>;  ///< dashed
  marks: Landmark[];
  side: Side | undefined;  ///< whose points are marked
  point: number | undefined;  ///< of that side that is selected
  wanted: Place[];  ///< points of that side that the hand set
  stroke: Place[];
  cut?: { ends: [Place, Place]; name: string };  ///< by a slice of the other orientation
  passages?: { at: Place; side: Side; here: boolean }[];  ///< of borders through the plane; `here`: of that slice
  brush?: { at: Place; radius: number };  ///< in mm
  tint?: (pixel: number) => readonly [number, number, number, number] | undefined;  ///< over the grey of a pixel
}

export class Picture {
  readonly canvas: HTMLCanvasElement;
  level = 0.5;
  width = 1;
  private middle: Place = [0, 0];
  private scale = 3;  // CSS pixels per mm
  private scene: Scene | undefined;
  private readonly pixels = el("canvas");

  constructor(name = "slice") { this.canvas = el("canvas", { class: name, tabindex: 0, width: 800, height: 800 }); }

  get size(): [number, number] { return [this.canvas.clientWidth || 1, this.canvas.clientHeight || 1]; }

  /** Shows the box between two places as large as it fits. */
  fit([a, b]: Place, [c, d]: Place): void {
    const [w, h] = this.size;
    this.middle = [(a + c) / 2, (b + d) / 2];
    this.scale = Math.min(w / (c - a), h / (d - b));
    this.draw();
  }

  zoom(factor: number, at: [number, number] = [this.size[0] / 2, this.size[1] / 2]): void {
    const before = this.placeAt(at);
    this.scale = Math.min(60, Math.max(0.5, this.scale * factor));
    const after = this.placeAt(at);
    this.middle = [this.middle[0] + before[0] - after[0], this.middle[1] + before[1] - after[1]];
    this.draw();
  }

  pan(dx: number, dy: number): void {
    this.middle = [this.middle[0] - dx / this.scale, this.middle[1] - dy / this.scale];
    this.draw();
  }

  /** Follows the hand: what it presses, what it moves to, when it lets go; the wheel magnifies. */
  listen(press: (event: PointerEvent) => void, follow: (at: Place) => void, release: () => void): void {
    const { canvas } = this;
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button > 1) return;
      canvas.setPointerCapture(event.pointerId);
      press(event);
    });
    canvas.addEventListener("pointermove", (event) => follow(this.placeOf(event)));
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => release());
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-event.deltaY / 500), this.spot(event));
    }, { passive: false });
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  /** Moves with the hand until the function that it returns is called. */
  panWith(event: PointerEvent): () => void {
    let last = this.spot(event);
    const follow = (next: PointerEvent) => {
      const now = this.spot(next);
      this.pan(now[0] - last[0], now[1] - last[1]);
      last = now;
    };
    this.canvas.addEventListener("pointermove", follow);
    return () => this.canvas.removeEventListener("pointermove", follow);
  }

  private spot(event: MouseEvent): [number, number] {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }
  placeOf(event: MouseEvent): Place { return this.placeAt(this.spot(event)); }

  get centre(): Place { return this.middle; }
  mm(pixels: number): number { return pixels / this.scale; }

  placeAt([x, y]: [number, number]): Place {
    const [w, h] = this.size;
    return [this.middle[0] + (x - w / 2) / this.scale, this.middle[1] + (y - h / 2) / this.scale];
  }

  /** Where a place is on the canvas, in CSS pixels from its corner. */
  at([u, v]: Place): [number, number] {
    const [w, h] = this.size;
    return [w / 2 + (u - this.middle[0]) * this.scale, h / 2 + (v - this.middle[1]) * this.scale];
  }

  show(scene: Scene): void {
    this.scene = scene;
    this.draw();
  }

  draw(): void {
    if (!this.scene) return;
    const [w, h] = this.size;
    const fine = window.devicePixelRatio || 1;
    if (this.canvas.width !== Math.round(w * fine) || this.canvas.height !== Math.round(h * fine))
      [this.canvas.width, this.canvas.height] = [Math.round(w * fine), Math.round(h * fine)];
    const context = this.canvas.getContext("2d")!;
    context.setTransform(fine, 0, 0, fine, 0, 0);
    context.fillStyle = "#000";
    context.fillRect(0, 0, w, h);
    this.drawGreys(context);
    for (const side of sides) {
      const original = this.scene.original[side];
      if (original) this.drawLine(context, original.points, colours[side], 1, [4, 5]);
      const line = this.scene.lines[side];
      if (line) this.drawLine(context, line.points, colours[side], side === this.scene.side ? 2.5 : 1.5, []);
      if (line && this.scene.doubtful[side]) this.drawLine(context, line.points, doubtColour, 2.5, [7, 7]);
    }
    this.drawCut(context);
    for (const passage of this.scene.passages ?? []) this.drawPassage(context, passage);
    this.drawPoints(context);
    for (const place of this.scene.wanted) this.drawWanted(context, place);
    if (this.scene.stroke.length > 1) this.drawLine(context, this.scene.stroke, "#fff", 2, [], false);
    for (const mark of this.scene.marks) this.drawMark(context, mark);
    this.drawBrush(context);
    this.drawLetters(context);
  }

  /** Which way the patient lies, at the edges of what is seen. */
  private drawLetters(context: CanvasRenderingContext2D): void {
    const [w, h] = this.size;
    const letters = edgeLetters(this.scene!.plane);
    context.font = "bold 16px system-ui, sans-serif";
    context.textBaseline = "middle";
    context.lineWidth = 3;
    context.strokeStyle = "#000";
    context.fillStyle = letterColour;
    const write = (words: string, x: number, y: number, align: CanvasTextAlign) => {
      context.textAlign = align;
      context.strokeText(words, x, y);
      context.fillText(words, x, y);
    };
    write(letters.left, 8, h / 2, "left");
    write(letters.right, w - 8, h / 2, "right");
    write(letters.top, w / 2, 14, "center");
    write(letters.bottom, w / 2, h - 14, "center");
    context.textAlign = "start";
    context.textBaseline = "alphabetic";
    this.canvas.dataset.edges = Object.values(letters).join(" ");
  }

  private drawGreys(context: CanvasRenderingContext2D): void {
    const { plane, greys } = this.scene!;
    if (!greys) return;
    if (this.pixels.width !== plane.columns || this.pixels.height !== plane.rows)
      [this.pixels.width, this.pixels.height] = [plane.columns, plane.rows];
    const shades = Uint8ClampedArray.from({ length: 256 }, (_, v) => 255 * ((v / 255 - this.level) / this.width + 0.5));
    const image = new ImageData(plane.columns, plane.rows);
    for (let i = 0; i < greys.length; ++i) {
      image.data[4 * i] = image.data[4 * i + 1] = image.data[4 * i + 2] = shades[greys[i]];
      image.data[4 * i + 3] = 255;
    }
    this.pixels.getContext("2d")!.putImageData(image, 0, 0);
    this.lay(context, true);
    this.drawTint(context, image);
  }

  /** The pixels on the canvas, smoothed or as squares. */
  private lay(context: CanvasRenderingContext2D, smooth: boolean): void {
    const { columns, rows, spacing: [si, sj] } = this.scene!.plane;
    const [x, y] = this.at([-si / 2, -sj / 2]);
    context.imageSmoothingEnabled = smooth;
    context.drawImage(this.pixels, x, y, columns * si * this.scale, rows * sj * this.scale);
  }

  private drawTint(context: CanvasRenderingContext2D, image: ImageData): void {
    const { tint } = this.scene!;
    if (!tint) return;
    for (let n = 0; 4 * n < image.data.length; ++n) image.data.set(tint(n) ?? [0, 0, 0, 0], 4 * n);
    this.pixels.getContext("2d")!.putImageData(image, 0, 0);
    this.lay(context, false);
  }

  private drawBrush(context: CanvasRenderingContext2D): void {
    const { brush } = this.scene!;
    if (!brush) return;
    const [x, y] = this.at(brush.at);
    context.beginPath();
    context.arc(x, y, brush.radius * this.scale, 0, 2 * Math.PI);
    context.lineWidth = 1.5;
    context.strokeStyle = "#fff";
    context.stroke();
  }

  private drawLine(context: CanvasRenderingContext2D, points: Place[], colour: string, width: number, dash: number[], closed = true): void {
    context.beginPath();
    points.forEach((p, i) => {
      const [x, y] = this.at(p);
      i === 0 ? context.moveTo(x, y) : context.lineTo(x, y);
    });
    if (closed) context.closePath();
    context.setLineDash(dash);
    context.lineWidth = width;
    context.strokeStyle = colour;
    context.stroke();
    context.setLineDash([]);
  }

  private drawPoints(context: CanvasRenderingContext2D): void {
    const { lines, side, point } = this.scene!;
    if (!side) return;
    lines[side]?.points.forEach((p, i) => {
      if (i !== point && i % handleStep !== 0) return;
      const [x, y] = this.at(p);
      context.beginPath();
      context.arc(x, y, i === point ? 6 : 3, 0, 2 * Math.PI);
      context.fillStyle = i === point ? "#fff" : colours[side];
      context.fill();
      context.lineWidth = i === point ? 2.5 : 1;
      context.strokeStyle = i === point ? "#d00080" : "#000";
      context.stroke();
    });
  }

  private drawCut(context: CanvasRenderingContext2D): void {
    const { cut } = this.scene!;
    if (!cut) return;
    this.drawLine(context, cut.ends, cutColour, 1.2, [9, 5], false);
    // the name beside the end that is nearer to the picture's left, where that is seen
    const ends = cut.ends.map((end) => this.at(end)).sort((a, b) => a[0] - b[0]);
    const [w] = this.size;
    const t = ends[1][0] > ends[0][0] ? Math.min(1, Math.max(0, (0.04 * w - ends[0][0]) / (ends[1][0] - ends[0][0]))) : 0;
    context.font = "12px system-ui, sans-serif";
    context.fillStyle = cutColour;
    context.fillText(cut.name, ends[0][0] + t * (ends[1][0] - ends[0][0]), ends[0][1] + t * (ends[1][1] - ends[0][1]) - 5);
  }

  private drawPassage(context: CanvasRenderingContext2D, { at, side, here }: { at: Place; side: Side; here: boolean }): void {
    const [x, y] = this.at(at);
    context.beginPath();
    context.arc(x, y, here ? 5 : 3, 0, 2 * Math.PI);
    context.fillStyle = colours[side];
    context.fill();
    context.lineWidth = 1;
    context.strokeStyle = "#000";
    context.stroke();
  }

  private drawWanted(context: CanvasRenderingContext2D, place: Place): void {
    const [x, y] = this.at(place);
    context.lineWidth = 2;
    context.fillStyle = wantedColour;
    context.strokeStyle = "#000";
    context.fillRect(x - 4.5, y - 4.5, 9, 9);
    context.strokeRect(x - 4.5, y - 4.5, 9, 9);
  }

  private drawMark(context: CanvasRenderingContext2D, mark: Landmark): void {
    const [x, y] = this.at(mark.at);
    context.lineWidth = 2;
    context.strokeStyle = "#ff5ad1";
    context.beginPath();
    context.moveTo(x - 8, y);
    context.lineTo(x + 8, y);
    context.moveTo(x, y - 8);
    context.lineTo(x, y + 8);
    context.stroke();
    context.font = "12px system-ui, sans-serif";
    context.fillStyle = "#ffb3ec";
    context.fillText(mark.name.replace("_", " "), x + 10, y - 4);
  }
}

/** Every so many points of a line are marked, and stepped through by the keys. */
export const handleStep = 3;
