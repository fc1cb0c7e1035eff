// The wall seen from the apex, flattened: the base outside. The first sector of every ring is anterior (top), the others
// follow anticlockwise (septum on the left).
import { about } from "./about.ts";
import { colourOf, inkOn, type Scale } from "./colours.ts";
import { sectorsPerRing, type Scheme } from "./data.ts";
import { ink, svg, uniqueId } from "./dom.ts";
import { marked } from "./orientation.ts";
import { nothingBelow, shown } from "./quantities.ts";

export interface BullsEye {
  scheme: Scheme;
  names: string[];
  values: number[];  // ring after ring; NaN: missing
  details: string[];
  scale: Scale;
  title: string;
  assumed: boolean;  // the septum
  outlined?: boolean[];  // regions that a line goes around
  pick: (index: number | undefined, fixed: boolean) => void;
}

export interface DrawnBullsEye { figure: SVGSVGElement; highlight: (index: number | undefined) => void }

const size = 300;
const centre = size / 2;
const radius = 122;

function ringShape(inner: number, outer: number, from: number, to: number): string {
  const at = (r: number, a: number) => `${(centre + r * Math.cos(a)).toFixed(2)} ${(centre - r * Math.sin(a)).toFixed(2)}`;
  if (to - from > 6.28)
    return `M${at(outer, 0)}A${outer} ${outer} 0 1 0 ${at(outer, Math.PI)}A${outer} ${outer} 0 1 0 ${at(outer, 0)}Z`;
  const wide = to - from > Math.PI ? 1 : 0;
  return `M${at(outer, from)}A${outer} ${outer} 0 ${wide} 0 ${at(outer, to)}L${at(inner, to)}` +
    `A${inner} ${inner} 0 ${wide} 1 ${at(inner, from)}Z`;
}

/** How far the outer side of each ring is from the middle, and the inner side of the last. */
function sides(scheme: Scheme): number[] {
  const rings = sectorsPerRing[scheme].length;
  const inner = scheme === "aha17" ? 0 : 0.06 * radius;
  return Array.from({ length: rings + 1 }, (_, ring) => radius - ((radius - inner) * ring) / rings);
}

/** The line between regions that are outlined and others, in pieces of 15 degrees: where sides of sectors lie. */
function outlineOf(scheme: Scheme, outlined: boolean[]): string {
  const piece = 15;
  const rings = sectorsPerRing[scheme];
  const r = sides(scheme);
  const first = rings.map((_, ring) => rings.slice(0, ring).reduce((sum, count) => sum + count, 0));
  const isIn = (ring: number, degrees: number) => {
    if (ring < 0) return false;
    const count = rings[ring];
    const sector = Math.round((degrees + 0.5 * piece - 90) / (360 / count));
    return outlined[first[ring] + (((sector % count) + count) % count)];
  };
  const at = (distance: number, degrees: number) => {
    const a = (degrees * Math.PI) / 180;
    return `${(centre + distance * Math.cos(a)).toFixed(2)} ${(centre - distance * Math.sin(a)).toFixed(2)}`;
  };
  let line = "";
  for (let ring = 0; ring < rings.length; ++ring)
    for (let d = 0; d < 360; d += piece) {
      if (isIn(ring, d) !== isIn(ring - 1, d)) line += `M${at(r[ring], d)}A${r[ring]} ${r[ring]} 0 0 0 ${at(r[ring], d + piece)}`;
      if (isIn(ring, d) !== isIn(ring, d - piece)) line += `M${at(r[ring], d)}L${at(r[ring + 1], d)}`;
    }
  return line;
}

interface Place { d: string; ring: number; middle: number; r: number; whole: boolean }

function places(scheme: Scheme): Place[] {
  const rings = sectorsPerRing[scheme];
  const r = sides(scheme);
  return rings.flatMap((count, ring) => Array.from({ length: count }, (_, k) => {
    const step = (2 * Math.PI) / count;
    const middle = Math.PI / 2 + k * step;
    return { d: ringShape(r[ring + 1], r[ring], middle - step / 2, middle + step / 2), ring, middle,
      r: count === 1 ? 0 : (r[ring] + r[ring + 1]) / 2, whole: count === 1 };
  }));
}

/** The neighbour that an arrow key leads to: around the ring, or the nearest of the next ring. */
function neighbour(all: Place[], index: number, key: string): number | undefined {
  const { ring, middle } = all[index];
  const of = (wanted: number) => all.map((p, i) => ({ p, i })).filter(({ p }) => p.ring === wanted);
  const own = of(ring);
  const k = own.findIndex(({ i }) => i === index);
  if (key === "ArrowLeft") return own[(k + 1) % own.length].i;
  if (key === "ArrowRight") return own[(k + own.length - 1) % own.length].i;
  if (key !== "ArrowUp" && key !== "ArrowDown") return undefined;
  const next = of(ring + (key === "ArrowUp" ? -1 : 1));
  const away = (p: Place) => Math.abs(Math.sin((p.middle - middle) / 2));
  return next.reduce<{ p: Place; i: number } | undefined>((best, one) => (!best || away(one.p) < away(best.p) ? one : best), undefined)?.i;
}

/** On light paper and dark alike: lines between segments, and those around the territories. */
const [parting, rimmed] = ["#fff", "#1a1a1a"];

/** The segments of one artery after the other, each group in front of a dark rim: what is left of it parts the territories. */
function territoryGroups(all: Place[], shapes: SVGPathElement[]): SVGElement[] {
  const rim = (index: number) => svg("path", { d: all[index].d, fill: "none", stroke: rimmed, "stroke-width": 5, "pointer-events": "none" });
  return about.territories.flatMap(({ segments }) => [...segments.map(rim), ...segments.map((i) => shapes[i])]);
}

function words(assumed: boolean): SVGElement[] {
  return ([["anterior", centre, 18, 0], ["inferior", centre, size - 10, 0], ["septal", 18, centre, -90], ["lateral", size - 12, centre, 90]] as const)
    .map(([name, x, y, turn]) => svg("text", { transform: `translate(${x} ${y}) rotate(${turn})`, "text-anchor": "middle", "font-size": 11, fill: ink.text },
      marked(name, assumed)));
}

function territoryNames(assumed: boolean): SVGElement[] {
  return about.territories.map(({ name, angle }) => svg("text", { x: centre + 137 * Math.cos((angle * Math.PI) / 180),
    y: centre - 137 * Math.sin((angle * Math.PI) / 180) + 4, "text-anchor": "middle", "font-size": 10, "font-weight": 600, fill: ink.soft }, marked(name, assumed)));
}

/** Value, and with it the number of an AHA segment. */
function texts(plot: BullsEye, place: Place, index: number, text: string, longest: number): SVGElement {
  const aha = plot.scheme === "aha17";
  const fontSize = aha ? (longest > 5 ? 9 : 11) : longest > 5 ? 6 : 8;
  // long numbers run along the ring
  const tilt = longest > 3 && !place.whole ? 90 - (place.middle * 180) / Math.PI : 0;
  const turn = Math.abs(((tilt % 360) + 540) % 360 - 180) > 91 ? tilt + 180 : tilt;
  const fill = inkOn(plot.scale, plot.values[index]);
  const at = `translate(${centre + place.r * Math.cos(place.middle)} ${centre - place.r * Math.sin(place.middle)}) rotate(${turn})`;
  return svg("g", { transform: at, "text-anchor": "middle", fill, "pointer-events": "none" },
    svg("text", { dy: aha ? "0.7em" : "0.35em", "font-size": fontSize }, text),
    aha && svg("text", { dy: "-0.55em", "font-size": 6.5 }, String(index + 1)));
}

export function drawBullsEye(plot: BullsEye): DrawnBullsEye {
  const root = svg("svg", { viewBox: `0 0 ${size} ${size}`, class: "bullseye", role: "group", "font-family": "sans-serif",
    "aria-label": `${plot.title}; arrow keys go from region to region` });
  const id = uniqueId("stripes");
  root.append(svg("defs", {}, svg("pattern", { id, width: 6, height: 6, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" },
    svg("rect", { width: 6, height: 6, fill: "#d9d9d9" }), svg("rect", { width: 2, height: 6, fill: "#9a9a9a" }))));
  const all = places(plot.scheme);
  const shownValues = plot.values.map((x) => shown(nothingBelow(0.1 * plot.scale.floor, x), 2));
  const longest = shownValues.reduce((most, text) => Math.max(most, text.length), 0);
  const focus = (index: number) => {
    shapes.forEach((shape, i) => shape.setAttribute("tabindex", i === index ? "0" : "-1"));
    shapes[index].focus();
  };
  const keydown = (event: KeyboardEvent, index: number) => {
    const next = neighbour(all, index, event.key);
    if (next === undefined && event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    if (next === undefined) plot.pick(index, true);
    else focus(next);
  };
  const shapes = all.map(({ d }, index) => {
    const value = plot.values[index];
    const name = `${plot.names[index]}: ${plot.details[index]}${plot.outlined?.[index] ? ", infarcted" : ""}`;
    return svg("path", { d, fill: Number.isNaN(value) ? `url(#${id})` : colourOf(plot.scale, value), stroke: parting, "stroke-width": 1.2,
      tabindex: index === 0 ? 0 : -1, "data-index": index, role: "button", "aria-label": name,
      pointerenter: () => plot.pick(index, false), pointerleave: () => plot.pick(undefined, false),
      focus: () => plot.pick(index, false), blur: () => plot.pick(undefined, false), click: () => plot.pick(index, true),
      keydown: (event: KeyboardEvent) => keydown(event, index) }, svg("title", {}, name));
  });
  root.append(...(plot.scheme === "aha17" ? territoryGroups(all, shapes) : shapes));
  if (plot.outlined) {
    const d = outlineOf(plot.scheme, plot.outlined);
    root.append(...[["#1a1a1a", 4.5], ["#fff", 2]].map(([stroke, width]) => svg("path", { class: "infarct", d, fill: "none", stroke, "stroke-width": width,
      "stroke-linecap": "round", "pointer-events": "none" })));
  }
  root.append(...all.map((place, i) => texts(plot, place, i, shownValues[i], longest)), ...words(plot.assumed),
    ...(plot.scheme === "aha17" ? territoryNames(plot.assumed) : []));
  const ring = svg("path", { class: "live", fill: "none", stroke: "#000", "stroke-width": 3, "pointer-events": "none" });
  const halo = svg("path", { class: "live", fill: "none", stroke: "#fff", "stroke-width": 6, "pointer-events": "none" });
  root.append(halo, ring);
  return {
    figure: root,
    highlight: (index) => {
      const d = index === undefined ? "" : shapes[index].getAttribute("d")!;
      for (const path of [halo, ring]) path.setAttribute("d", d);
    },
  };
}
