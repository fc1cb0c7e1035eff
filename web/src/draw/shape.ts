// How a closed line changes under the hand.
import { centroid, type Place } from "./study.ts";

export const distance = (a: Place, b: Place) => Math.hypot(a[0] - b[0], a[1] - b[1]);

/** The number of the point that is nearest to a place, and how far it is [mm]. */
export function nearest(points: Place[], at: Place): { point: number; away: number } {
  let [point, away] = [0, Infinity];
  points.forEach((p, i) => {
    const d = distance(p, at);
    if (d < away) [point, away] = [i, d];
  });
  return { point, away };
}

/** Distance of every point from one of them along the line, the shorter way round [mm]. */
function along(points: Place[], from: number): number[] {
  const n = points.length;
  const ahead = Array<number>(n).fill(0);
  for (let k = 1; k < n; ++k) {
    const i = (from + k) % n;
    ahead[i] = ahead[(i + n - 1) % n] + distance(points[i], points[(i + n - 1) % n]);
  }
  const whole = ahead[(from + n - 1) % n] + distance(points[from], points[(from + n - 1) % n]);
  return ahead.map((s) => Math.min(s, whole - s));
}

/** A point moved by (u, v), and what lies within `width` mm of it along the line with it, less and less (half a cosine). */
export function pulled(points: Place[], point: number, [u, v]: Place, width: number): Place[] {
  const away = along(points, point);
  return points.map((p, i): Place => {
    const w = i === point ? 1 : away[i] < width ? 0.5 + 0.5 * Math.cos(Math.PI * away[i] / width) : 0;
    return [p[0] + w * u, p[1] + w * v];
  });
}

/** The whole line larger or smaller by so many mm of its mean radius, round its centroid. */
export function resized(points: Place[], by: number): Place[] {
  const [x, y] = centroid(points);
  const radius = points.reduce((sum, p) => sum + distance(p, [x, y]), 0) / points.length;
  const factor = Math.max(0.1, 1 + by / radius);
  return points.map(([u, v]): Place => [x + factor * (u - x), y + factor * (v - y)]);
}

const pointsOfLine = 72;

/** So many points at equal distances along a closed line. */
export function even(points: Place[], count = pointsOfLine): Place[] {
  const closed = [...points, points[0]];
  const steps = closed.slice(1).map((p, i) => distance(p, closed[i]));
  const whole = steps.reduce((a, b) => a + b, 0);
  const result: Place[] = [];
  let [i, before] = [0, 0];
  for (let k = 0; k < count; ++k) {
    const s = k * whole / count;
    while (i < steps.length - 1 && before + steps[i] < s) before += steps[i++];
    const t = steps[i] > 0 ? (s - before) / steps[i] : 0;
    result.push([closed[i][0] + t * (closed[i + 1][0] - closed[i][0]), closed[i][1] + t * (closed[i + 1][1] - closed[i][1])]);
  }
  return result;
}

/** Without the tremor of a hand: each point the mean of its neighbours, twice. */
const steadied = (points: Place[]): Place[] => [1, 2].reduce((line) => line.map((p, i): Place => {
  const [a, b] = [line[(i + line.length - 1) % line.length], line[(i + 1) % line.length]];
  return [(a[0] + 2 * p[0] + b[0]) / 4, (a[1] + 2 * p[1] + b[1]) / 4];
}), points);

export const circle = ([x, y]: Place, radius: number): Place[] => Array.from({ length: pointsOfLine }, (_, i): Place =>
  [x + radius * Math.cos(2 * Math.PI * i / pointsOfLine), y + radius * Math.sin(2 * Math.PI * i / pointsOfLine)]);

const meanAway = (part: Place[], stroke: Place[]) => part.reduce((sum, p) => sum + nearest(stroke, p).away, 0) / Math.max(part.length, 1);

/** A stroke of the hand: a closed one is the new line; an open one takes the place of the part of the old line that it runs along. */
export function redrawn(old: Place[] | undefined, stroke: Place[]): { points: Place[]; whole: boolean } | undefined {
  const length = stroke.slice(1).reduce((sum, p, i) => sum + distance(p, stroke[i]), 0);
  if (stroke.length < 3 || length < 5) return undefined;
  if (!old || distance(stroke[0], stroke.at(-1)!) < 0.2 * length) return { points: steadied(even(stroke)), whole: true };
  const n = old.length;
  const from = nearest(old, stroke[0]).point;
  const to = nearest(old, stroke.at(-1)!).point;
  const walk = (a: number, b: number) => Array.from({ length: (b - a + n) % n + 1 }, (_, k) => old[(a + k) % n]);
  const [forth, back] = [walk(from, to), walk(to, from)];
  const runsForth = meanAway(forth, stroke) < meanAway(back, stroke);
  const kept = runsForth ? back.slice(1, -1) : forth.slice(1, -1).reverse();
  return { points: even([...stroke, ...kept]), whole: false };
}
