// A colour bar: what the colours of a picture mean.
import { colourTable, cssOf, type Scale, uncoloured } from "./colours.ts";
import { ink, svg, uniqueId } from "./dom.ts";
import { shown } from "./quantities.ts";

/** `title` says quantity and unit; the bar is `width` wide and 46 high. */
export function barParts(scale: Scale, title: string, width: number): SVGElement[] {
  const id = uniqueId("bar");
  const table = colourTable(scale);
  const stops = Array.from({ length: 33 }, (_, i) =>
    svg("stop", { offset: i / 32, "stop-color": cssOf(table[Math.round((255 * i) / 32)]) }));
  const text = (x: number, y: number, anchor: string, words: string) => svg("text", { x, y, "text-anchor": anchor, fill: ink.text }, words);
  const place = (x: number) => Math.min(width, Math.max(0, ((x - scale.min) / (scale.max - scale.min)) * width));
  const [from, to] = [scale.middle - scale.floor, scale.middle + scale.floor].map(place);
  const number = (t: number) => shown(scale.min + t * (scale.max - scale.min));
  const letter = 8;  // width of a letter
  const ends = letter * [0, 0.5, 1].reduce((sum, t) => sum + number(t).length + 1, 0) < width ? [0, 0.5, 1] : [0, 1];
  const words = ends.map(number);
  return [svg("defs", {}, svg("linearGradient", { id }, ...stops)), text(0, 12, "start", title),
    svg("rect", { x: 0, y: 18, width, height: 12, fill: `url(#${id})` }),
    ...(to > from ? [svg("rect", { x: from, y: 18, width: to - from, height: 12, fill: cssOf(uncoloured) })] : []),
    ...ends.map((t, i) => text(width * t, 43, t === 0 ? "start" : t === 1 ? "end" : "middle", words[i]))];
}

export function colourBar(scale: Scale, title: string): SVGSVGElement {
  return svg("svg", { viewBox: "-10 0 320 46", class: "bar", role: "img", "font-family": "sans-serif", "font-size": 12,
    "aria-label": `${title}, from ${shown(scale.min)} to ${shown(scale.max)}` }, ...barParts(scale, title, 300));
}
