// What is written over a 3-D view, and saved and printed with it: case, moment, cut, letters, legend, scale bar.
import { barParts } from "./bar.ts";
import type { Scale } from "./colours.ts";
import { ink, inLines, svg } from "./dom.ts";
import type { WallView } from "./wall_view.ts";

const edge = 10;  // [pixels]

/** Sets what has changed: the browser draws again whatever is touched. */
function place(element: Element, attributes: Record<string, string | number>): void {
  for (const [name, value] of Object.entries(attributes))
    if (element.getAttribute(name) !== String(value)) element.setAttribute(name, String(value));
}

/** The line around an infarct, white with dark rims, and what it is; above a colour bar. */
const borderKey = (words: string) => [...[["#1a1a1a", 4.5], ["#fff", 1.8]].map(([stroke, width]) => svg("path", { d: "M1 -8h24", stroke, "stroke-width": width })),
  svg("text", { x: 32, y: -4, fill: ink.text }, words)];

export class Overlay {
  readonly element = svg("svg", { class: "overlay", "font-family": "sans-serif", "font-size": 13, "aria-hidden": "true" });
  private caption = svg("g", { fill: ink.text });
  private region = svg("text", { class: "region", "text-anchor": "end", y: 20, fill: ink.text, "font-weight": 600 });
  private legend = svg("g", { class: "legend", "font-size": 12 });
  private letters = new Map<string, SVGTextElement>();
  private bar = svg("path", { stroke: ink.text, "stroke-width": 2, fill: "none" });
  private length = svg("text", { "text-anchor": "middle", fill: ink.text, "font-size": 12 }, "20 mm");
  private stars = svg("g", { "text-anchor": "end", fill: ink.text, "font-size": 11, stroke: ink.paper, "stroke-width": 3, "paint-order": "stroke" });
  private legendParts: (width: number) => SVGElement[] = () => [];
  private explained = "";  // by the legend
  private legendWidth = 0;

  /** `star` says what the stars mean. */
  constructor(private view: WallView, private star: string) {
    this.element.append(this.caption, this.region, this.legend, this.bar, this.length, this.stars);
    for (const { name, label } of view.letters()) {
      const letter = svg("text", { class: "letter", "data-letter": name, "text-anchor": "middle", dy: "0.35em", "font-size": name.length > 1 ? 13 : 18,
        "font-weight": 700, fill: ink.text, stroke: ink.paper, "stroke-width": 4, "paint-order": "stroke" }, label);
      this.letters.set(name, letter);
      this.element.append(letter);
    }
  }

  /** `border`: what the line on the wall goes around, if there is one. */
  write(lines: string[], scale: Scale, title: string, border: string): void {
    this.caption.replaceChildren(...lines.map((line, i) =>
      svg("text", { x: edge, y: 20 + 17 * i, ...(i === 0 ? { "font-weight": 600 } : {}) }, line)));
    const explained = JSON.stringify([scale, title, border]);
    if (explained === this.explained) return;
    this.explained = explained;
    this.legendParts = (width) => [...barParts(scale, title, width), ...(border ? borderKey(border) : [])];
    this.legendWidth = 0;
    this.place();
  }

  /** Left of the middle, where an assumed apex has its name, and the stars' meaning on the right of it. */
  private placeLegend(width: number): void {
    const room = Math.max(60, Math.min(190, width / 2 - 32 - edge));
    if (room === this.legendWidth) return;
    this.legendWidth = room;
    const lines = inLines(this.star, width < 480 ? 24 : Infinity);
    this.stars.replaceChildren(...lines.map((line, i) => svg("text", { y: 13 * (i + 1 - lines.length) }, line)));
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
    place(this.stars, { transform: `translate(${width - edge} ${height - 44})` });
    for (const { name, x, y, seen } of letters)
      place(this.letters.get(name)!, { x: x.toFixed(1), y: y.toFixed(1), visibility: seen ? "visible" : "hidden" });
  }
}
