// Line charts as SVG.
import { ink, svg } from "./dom.ts";
import { shown } from "./quantities.ts";

export interface Line { label: string; colour: string; dashed?: boolean; x: number[]; y: number[]; dots?: boolean; bare?: boolean /* dots alone */; ofPaper?: boolean; behind?: boolean /* drawn before the others */; pick?: (isOver: boolean) => void /* it is pointed at, or no more */ }
export interface Mark { x: number; label: string }
export interface Chart {
  x: string;
  y: string;
  lines: Line[];
  marks?: Mark[];
  points?: { x: number; y: number; label: string }[];
  zero?: boolean;  // the y axis reaches 0
  also?: number[];  // values that the y axis reaches besides
  reach?: [number, number];  // of the x axis; without: that of the lines
  width?: number;
  height?: number;
}

/** Round steps: 1, 2 or 5 times a power of ten. */
export function ticks(min: number, max: number, count: number): number[] {
  const raw = (max - min) / count || 1;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = power * ([1, 2, 5, 10].find((f) => f * power >= raw) ?? 10);
  const first = Math.ceil(min / step - 1e-9);
  const last = Math.floor(max / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, i) => Number(((first + i) * step).toPrecision(12)));
}

const finite = (values: number[]) => values.filter(Number.isFinite);
/** A path with a gap where a number is missing; a point between two gaps is a dot. */
function pathOf(points: [number, number][]): { d: string; alone: [number, number][] } {
  const known = (p: [number, number] | undefined) => p !== undefined && p.every(Number.isFinite);
  let d = "";
  const alone: [number, number][] = [];
  points.forEach((p, k) => {
    if (!known(p)) return;
    const joins = known(points[k - 1]);
    if (!joins && !known(points[k + 1])) alone.push(p);
    d += `${joins ? "L" : "M"}${p[0].toFixed(1)} ${p[1].toFixed(1)}`;
  });
  return { d, alone };
}

const tickText = (x: number) => String(x).replace("-", "−");

export interface DrawnChart {
  figure: SVGSVGElement;
  /** Moves the vertical line of the time that is shown elsewhere. */
  cursor: (x: number) => void;
  /** Moves the dot of a line. */
  dot: (line: number, x: number, y: number) => void;
}

export function drawChart(chart: Chart): DrawnChart {
  const width = chart.width ?? 460;
  const height = chart.height ?? 300;
  const box = { left: 58, right: width - 14, top: 14 + 16 * Math.ceil(chart.lines.length / 2), bottom: height - (chart.x ? 44 : 22) };
  const xs = chart.reach ?? finite(chart.lines.flatMap((line) => line.x));
  const ys = finite(chart.lines.flatMap((line) => line.y)).concat(chart.zero ? [0] : [], chart.also ?? []);
  const reach = (values: number[]) => {
    const min = values.reduce((a, b) => Math.min(a, b), Infinity);
    const max = values.reduce((a, b) => Math.max(a, b), -Infinity);
    const room = 0.04 * (max - min || Math.abs(max) || 1);
    return [min - room, max + room];
  };
  const [x0, x1] = reach(xs);
  const [y0, y1] = reach(ys);
  const px = (x: number) => box.left + ((x - x0) / (x1 - x0)) * (box.right - box.left);
  const py = (y: number) => box.bottom - ((y - y0) / (y1 - y0)) * (box.bottom - box.top);

  const root = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "chart", role: "img", "font-family": "sans-serif",
    "font-size": 12, "aria-label": chart.x ? `${chart.y} against ${chart.x}` : chart.y });
  for (const x of ticks(x0, x1, 6))
    root.append(svg("line", { x1: px(x), x2: px(x), y1: box.top, y2: box.bottom, stroke: ink.grid }),
      svg("text", { x: px(x), y: box.bottom + 16, "text-anchor": "middle", fill: ink.text }, tickText(x)));
  for (const y of ticks(y0, y1, 5))
    root.append(svg("line", { x1: box.left, x2: box.right, y1: py(y), y2: py(y), stroke: ink.grid }),
      svg("text", { x: box.left - 6, y: py(y) + 4, "text-anchor": "end", fill: ink.text }, tickText(y)));
  root.append(svg("rect", { x: box.left, y: box.top, width: box.right - box.left, height: box.bottom - box.top,
    fill: "none", stroke: ink.frame }));
  root.append(svg("text", { x: (box.left + box.right) / 2, y: height - 8, "text-anchor": "middle", fill: ink.text }, chart.x));
  root.append(svg("text", { transform: `translate(14 ${(box.top + box.bottom) / 2}) rotate(-90)`, "text-anchor": "middle",
    fill: ink.text }, chart.y));
  let close = false;  // to the mark before, whose label this one must not cover
  for (const [k, mark] of (chart.marks ?? []).entries()) {
    const late = px(mark.x) > box.right - 70;
    close = k > 0 && !close && px(mark.x) - px(chart.marks![k - 1].x) < 80;
    root.append(svg("line", { x1: px(mark.x), x2: px(mark.x), y1: box.top, y2: box.bottom, stroke: ink.soft, "stroke-dasharray": "2 3" }),
      svg("text", { x: px(mark.x) + (late ? -4 : 4), y: box.bottom - (close ? 19 : 6), "text-anchor": late ? "end" : "start", fill: ink.soft, "font-size": 11 }, mark.label));
  }
  chart.lines.forEach((line, i) => {
    const group = svg("g", { class: line.ofPaper ? "of-paper" : "line",
      ...(line.pick && { pointerenter: () => line.pick!(true), pointerleave: () => line.pick!(false) }) }, line.pick && svg("title", {}, line.label));
    const points = line.x.map((x, k): [number, number] => [px(x), py(line.y[k])]);
    const { d, alone } = pathOf(points);
    if (!line.bare) group.append(svg("path", { d, fill: "none", stroke: line.colour, "stroke-width": 1.8,
      "stroke-dasharray": line.dashed ? "6 4" : "none", "stroke-linejoin": "round" }));
    for (const [cx, cy] of line.dots ? points.filter((p) => p.every(Number.isFinite)) : alone)
      group.append(svg("circle", { cx, cy, r: 3.2, fill: line.colour }));
    const [lx, ly] = [box.left + (i % 2) * ((box.right - box.left) / 2), 12 + 16 * Math.floor(i / 2)];
    group.append(line.bare ? svg("circle", { class: "key", cx: lx + 10, cy: ly, r: 3.2, fill: line.colour })
      : svg("line", { x1: lx, x2: lx + 20, y1: ly, y2: ly, stroke: line.colour, "stroke-width": 2, "stroke-dasharray": line.dashed ? "6 4" : "none" }),
      svg("text", { x: lx + 25, y: ly + 4, fill: ink.text }, line.label));
    if (line.behind) root.insertBefore(group, root.querySelector("g"));
    else root.append(group);
  });
  for (const { x, y, label } of chart.points ?? []) {
    const right = px(x) > (box.left + box.right) / 2;
    const high = py(y) < box.top + 22;
    root.append(svg("circle", { class: "key", cx: px(x), cy: py(y), r: 4.5, fill: ink.paper, stroke: ink.text, "stroke-width": 1.6 }),
      svg("text", { x: px(x) + (right ? -8 : 8), y: py(y) + (high ? 16 : -7), "text-anchor": right ? "end" : "start", fill: ink.text, "font-weight": 600 }, label));
  }

  const line = svg("line", { class: "live", y1: box.top, y2: box.bottom, stroke: ink.text, opacity: 0 });
  const dots = chart.lines.map((l) => svg("circle", { class: "live", r: 5, fill: l.colour, stroke: ink.paper, opacity: 0 }));
  const read = svg("text", { class: "live", x: box.right - 4, y: box.top + 14, "text-anchor": "end", fill: ink.text, "font-size": 11 });
  root.append(line, ...dots, read);
  root.addEventListener("pointermove", (event) => {
    const bounds = root.getBoundingClientRect();
    const x = x0 + (((event.clientX - bounds.left) * width) / bounds.width - box.left) / (box.right - box.left) * (x1 - x0);
    const y = y0 + (box.bottom - ((event.clientY - bounds.top) * height) / bounds.height) / (box.bottom - box.top) * (y1 - y0);
    const inside = x >= x0 && x <= x1 && y >= y0 && y <= y1;
    read.textContent = inside ? `${shown(x)}, ${shown(y)}` : "";
  });
  root.addEventListener("pointerleave", () => { read.textContent = ""; });
  return {
    figure: root,
    cursor: (x) => {
      line.setAttribute("opacity", Number.isFinite(x) ? "0.6" : "0");
      if (Number.isFinite(x)) for (const end of ["x1", "x2"]) line.setAttribute(end, String(px(x)));
    },
    dot: (i, x, y) => {
      const seen = Number.isFinite(x) && Number.isFinite(y);
      dots[i].setAttribute("opacity", seen ? "1" : "0");
      if (seen) { dots[i].setAttribute("cx", String(px(x))); dots[i].setAttribute("cy", String(py(y))); }
    },
  };
}

/** Charts over one axis, one above the other, as one figure; its cursor moves through all. */
export function drawStack(charts: Chart[], words: string): DrawnChart {
  const drawn = charts.map(drawChart);
  const width = Math.max(...drawn.map(({ figure }) => figure.viewBox.baseVal.width));
  let top = 0;
  for (const { figure } of drawn) {
    const { width: wide, height } = figure.viewBox.baseVal;
    for (const name of ["class", "role", "aria-label"]) figure.removeAttribute(name);
    for (const [name, value] of Object.entries({ x: 0, y: top, width: wide, height })) figure.setAttribute(name, String(value));
    top += height;
  }
  return {
    figure: svg("svg", { viewBox: `0 0 ${width} ${top}`, class: "chart", role: "img", "font-family": "sans-serif", "font-size": 12, "aria-label": words },
      ...drawn.map(({ figure }) => figure)),
    cursor: (x) => drawn.forEach((one) => one.cursor(x)),
    dot: () => {},
  };
}
