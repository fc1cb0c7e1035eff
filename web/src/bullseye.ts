// The wall seen from the apex, flattened: the base outside. The first sector of every ring is anterior (top), the others
// follow anticlockwise (septum on the left).
import { colourOf, inkOn, type Scale } from "./colours.ts";
import { sectorsPerRing, type Scheme } from "./data.ts";
import { svg } from "./dom.ts";
import { shown } from "./quantities.ts";

export interface BullsEye {
  scheme: Scheme;
  names: string[];
  values: number[];  // ring after ring; NaN: missing
  details: string[];
  scale: Scale;
  title: string;
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

export function drawBullsEye(plot: BullsEye): DrawnBullsEye {
  const rings = sectorsPerRing[plot.scheme];
  const root = svg("svg", { viewBox: `0 0 ${size} ${size}`, class: "bullseye", role: "group", "font-family": "sans-serif",
    "aria-label": plot.title });
  const id = `stripes-${Math.random().toString(36).slice(2)}`;
  root.append(svg("defs", {}, svg("pattern", { id, width: 6, height: 6, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" },
    svg("rect", { width: 6, height: 6, fill: "#d9d9d9" }), svg("rect", { width: 2, height: 6, fill: "#9a9a9a" }))));
  const inner = plot.scheme === "aha17" ? 0 : 0.06 * radius;
  const shapes: SVGPathElement[] = [];
  const texts = plot.values.map((x) => shown(x, 2));
  const longest = texts.reduce((most, text) => Math.max(most, text.length), 0);
  const fontSize = plot.scheme === "aha17" ? (longest > 5 ? 9 : 11) : longest > 5 ? 6 : 8;
  let first = 0;
  rings.forEach((count, ring) => {
    const outerR = radius - ((radius - inner) * ring) / rings.length;
    const innerR = radius - ((radius - inner) * (ring + 1)) / rings.length;
    for (let k = 0; k < count; ++k) {
      const index = first + k;
      const step = (2 * Math.PI) / count;
      const middle = Math.PI / 2 + k * step;
      const value = plot.values[index];
      const shape = svg("path", { d: ringShape(Math.max(innerR, 0), outerR, middle - step / 2, middle + step / 2),
        fill: Number.isNaN(value) ? `url(#${id})` : colourOf(plot.scale, value), stroke: "#fff", "stroke-width": 1.2,
        tabindex: 0, "data-index": index, role: "button", "aria-label": `${plot.names[index]}: ${plot.details[index]}`,
        pointerenter: () => plot.pick(index, false), pointerleave: () => plot.pick(undefined, false),
        focus: () => plot.pick(index, false), blur: () => plot.pick(undefined, false), click: () => plot.pick(index, true),
        keydown: (event: KeyboardEvent) => {
          if (event.key !== "Enter" && event.key !== " ") return;
          event.preventDefault();
          plot.pick(index, true);
        } }, svg("title", {}, `${plot.names[index]}: ${plot.details[index]}`));
      shapes.push(shape);
      root.append(shape);
      const r = count === 1 ? 0 : (innerR + outerR) / 2;
      // long numbers run along the ring
      const tilt = longest > 3 && count > 1 ? 90 - (middle * 180) / Math.PI : 0;
      const turn = Math.abs(((tilt % 360) + 540) % 360 - 180) > 91 ? tilt + 180 : tilt;
      root.append(svg("text", { transform: `translate(${centre + r * Math.cos(middle)} ${centre - r * Math.sin(middle)}) rotate(${turn})`,
        dy: "0.35em", "text-anchor": "middle", "font-size": fontSize, fill: inkOn(plot.scale, value), "pointer-events": "none" }, texts[index]));
    }
    first += count;
  });
  for (const [name, x, y, turn] of [["anterior", centre, 18, 0], ["inferior", centre, size - 10, 0],
    ["septal", 18, centre, -90], ["lateral", size - 12, centre, 90]] as const)
    root.append(svg("text", { transform: `translate(${x} ${y}) rotate(${turn})`, "text-anchor": "middle", "font-size": 11, fill: "#333" }, name));
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
