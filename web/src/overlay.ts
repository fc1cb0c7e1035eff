// What is written over a 3-D view, and saved and printed with it: case, moment, cut, letters, legend, scale bar.
import { barParts } from "./bar.ts";
import type { Scale } from "./colours.ts";
import { ink, svg } from "./dom.ts";
import { starNote } from "./orientation.ts";
import type { WallView } from "./wall_view.ts";

const edge = 10;  // [pixels]

/** Sets what has changed: the browser draws again whatever is touched. */
function place(element: Element, attributes: Record<string, string | number>): void {
  for (const [name, value] of Object.entries(attributes))
    if (element.getAttribute(name) !== String(value)) element.setAttribute(name, String(value));
}

export class Overlay {
  readonly element = svg("svg", { class: "overlay", "font-family": "sans-serif", "font-size": 13, "aria-hidden": "true" });
  private caption = svg("g", { fill: ink.text });
  private region = svg("text", { class: "region", "text-anchor": "end", y: 20, fill: ink.text, "font-weight": 600 });
  private legend = svg("g", { class: "legend", "font-size": 12 });
  private letters = new Map<string, SVGTextElement>();
  private bar = svg("path", { stroke: ink.text, "stroke-width": 2, fill: "none" });
  private length = svg("text", { "text-anchor": "middle", fill: ink.text, "font-size": 12 }, "20 mm");
  private star = svg("text", { "text-anchor": "end", fill: ink.text, "font-size": 11, stroke: ink.paper, "stroke-width": 3, "paint-order": "stroke" });
  private legendParts: (width: number) => SVGElement[] = () => [];
  private explained = "";  // by the legend
  private legendWidth = 0;

  constructor(private view: WallView) {
    this.element.append(this.caption, this.region, this.legend, this.bar, this.length, this.star);
    for (const { name, label } of view.letters()) {
      const letter = svg("text", { class: "letter", "data-letter": name, "text-anchor": "middle", dy: "0.35em", "font-size": name.length > 1 ? 13 : 18,
        "font-weight": 700, fill: ink.text, stroke: ink.paper, "stroke-width": 4, "paint-order": "stroke" }, label);
      this.letters.set(name, letter);
      this.element.append(letter);
    }
    this.star.textContent = starNote(view.heart);
  }

  write(lines: string[], scale: Scale, title: string): void {
    this.caption.replaceChildren(...lines.map((line, i) =>
      svg("text", { x: edge, y: 20 + 17 * i, ...(i === 0 ? { "font-weight": 600 } : {}) }, line)));
    const explained = JSON.stringify([scale, title]);
    if (explained === this.explained) return;
    this.explained = explained;
    this.legendParts = (width) => barParts(scale, title, width);
    this.legendWidth = 0;
    this.place();
  }

  /** Left of the middle, where an assumed apex has its name. */
  private placeLegend(width: number): void {
    const room = Math.max(60, Math.min(190, width / 2 - 32 - edge));
    if (room === this.legendWidth) return;
    this.legendWidth = room;
    this.legend.replaceChildren(...this.legendParts(room));
  }

  /** The region that is marked. */
  name(region: string): void { this.region.textContent = region; }

  /** Follows the camera. */
  place(): void {
    // all is read before anything is written: the browser lays out once
    const { clientWidth: width, clientHeight: height } = this.view.canvas;
    if (!width) return;  // in print a copy stands for the canvas, and what was written over that holds
    const [length, letters] = [20 * this.view.scale, this.view.letters()];
    this.placeLegend(width);
    place(this.element, { viewBox: `0 0 ${width} ${height}`, width, height });
    place(this.legend, { transform: `translate(${edge} ${height - 52})` });
    place(this.region, { x: width - edge });
    place(this.bar, { d: `M${width - edge - length} ${height - 22}v6h${length}v-6` });
    place(this.length, { x: width - edge - length / 2, y: height - 24 });
    place(this.star, { x: width - edge, y: height - 44 });
    for (const { name, x, y, seen } of letters)
      place(this.letters.get(name)!, { x: x.toFixed(1), y: y.toFixed(1), visibility: seen ? "visible" : "hidden" });
  }
}
