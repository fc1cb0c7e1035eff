// The scar on enhanced slices, pixel by pixel: where the wall is, what a threshold proposes, what the brush changes.
import { area, type How, type Place, type Plane } from "./study.ts";

/** Where the wall lies on a slice [mm along rows and columns]. */
export interface Wall { endo: Place[]; epi: Place[] }
/** Pixels first to last of a row, all from 0. */
export type Run = [number, number, number];

export interface SaidMap { threshold: number; phase: number; slices: { muscle: Run[]; remote: Run[]; scar: Run[]; how: How; by: string; when: string }[] }
export type Rule = "remote" | "brightest" | "level";
/** What the program hands over of late enhancement. */
export interface SaidScar {
  slices: Plane[]; low: number; high: number; rule: Rule; deviations: number; walls: (Wall | null)[]; proposed: SaidMap; drawn: SaidMap; saved: boolean; note: string;
}

export type Brush = "scar" | "muscle" | "remote";
const untouched = 0;
const added = 1;
const erased = 2;

/** A slice; a byte per pixel each. */
export interface ScarSlice {
  wall: Uint8Array; proposed: Uint8Array; brushed: Uint8Array; remote: Uint8Array; by: string; when: string;
}
/** Never changed, but replaced: so that every change of it can be undone. */
export interface Scar { threshold: number; phase: number; walls: (Wall | null)[]; slices: ScarSlice[] }

function pixelsOf(runs: Run[], plane: Plane): Uint8Array {
  const pixels = new Uint8Array(plane.columns * plane.rows);
  for (const [row, first, last] of runs) pixels.fill(1, row * plane.columns + first, row * plane.columns + last + 1);
  return pixels;
}

/** The runs of the pixels for which something holds. */
export function runsOf(plane: Plane, holds: (pixel: number) => boolean): Run[] {
  const runs: Run[] = [];
  for (let row = 0; row < plane.rows; ++row)
    for (let i = 0; i < plane.columns; ++i) {
      if (!holds(row * plane.columns + i)) continue;
      const first = i;
      while (i + 1 < plane.columns && holds(row * plane.columns + i + 1)) ++i;
      runs.push([row, first, i]);
    }
  return runs;
}

export const isScar = ({ wall, proposed, brushed }: ScarSlice, n: number) => wall[n] === 1 && (brushed[n] === added || (proposed[n] === 1 && brushed[n] !== erased));
export const isRemote = (slice: ScarSlice, n: number) => slice.wall[n] === 1 && slice.remote[n] === 1 && !isScar(slice, n);
export const isCorrected = (slice: ScarSlice) => slice.brushed.some((b) => b !== untouched);

const wallOf = (map: SaidMap["slices"][number], plane: Plane) => pixelsOf([...map.muscle, ...map.remote, ...map.scar], plane);

/** As the program hands it over: what differs from the proposal was the brush. */
export function scarOf(said: SaidScar): Scar {
  const slices = said.slices.map((plane, s): ScarSlice => {
    const [drawn, proposal] = [said.drawn.slices[s], said.proposed.slices[s]];
    const [scar, proposed] = [pixelsOf(drawn.scar, plane), pixelsOf(proposal.scar, plane)];
    return { wall: wallOf(drawn, plane), proposed, brushed: scar.map((is, n) => (is === proposed[n] ? untouched : is ? added : erased)), remote: pixelsOf(drawn.remote, plane),
      by: drawn.by, when: drawn.when };
  });
  return { threshold: said.drawn.threshold, phase: said.drawn.phase, walls: said.walls, slices };
}

/** With another wall and what a threshold proposes in it; what was brushed stays. */
export const proposedAgain = (scar: Scar, planes: Plane[], map: SaidMap, walls = scar.walls, phase = scar.phase): Scar => ({ threshold: map.threshold, phase, walls,
  slices: scar.slices.map((slice, s) => ({ ...slice, wall: wallOf(map.slices[s], planes[s]), proposed: pixelsOf(map.slices[s].scar, planes[s]) })) });

/** A slice with the pixels of its wall under a round brush made scar, muscle or remote muscle. */
export function brushed(slice: ScarSlice, plane: Plane, [u, v]: Place, radius: number, brush: Brush): ScarSlice {
  const [si, sj] = plane.spacing;
  const [marks, remote] = [slice.brushed.slice(), slice.remote.slice()];
  const within = (middle: number, size: number, most: number) => [Math.max(0, Math.ceil((middle - radius) / size)), Math.min(most - 1, Math.floor((middle + radius) / size))];
  const [[left, right], [top, bottom]] = [within(u, si, plane.columns), within(v, sj, plane.rows)];
  for (let j = top; j <= bottom; ++j)
    for (let i = left; i <= right; ++i) {
      const n = j * plane.columns + i;
      if (slice.wall[n] !== 1 || Math.hypot(i * si - u, j * sj - v) > radius) continue;
      marks[n] = brush === "scar" ? (slice.proposed[n] ? untouched : added) : slice.proposed[n] ? erased : untouched;
      remote[n] = Number(brush === "remote");
    }
  return { ...slice, brushed: marks, remote };
}

/** Volumes of scar and wall, pixels times the distance of slices [ml]. */
export function scarVolume(scar: Scar, planes: Plane[]): { scar: number; wall: number } {
  const sum = { scar: 0, wall: 0 };
  scar.slices.forEach((slice, s) => {
    const voxel = 1e-3 * planes[s].spacing[0] * planes[s].spacing[1] * apart(planes);
    for (let n = 0; n < slice.wall.length; ++n) {
      sum.wall += voxel * slice.wall[n];
      if (isScar(slice, n)) sum.scar += voxel;
    }
  });
  return sum;
}

/** The mean distance of neighbouring slices along their normal [mm]; of a single one 10. */
function apart(planes: Plane[]): number {
  if (planes.length < 2) return 10;
  const [{ origin: a, along_row: r, along_column: c }, b] = [planes[0], planes.at(-1)!.origin];
  const normal = [r[1] * c[2] - r[2] * c[1], r[2] * c[0] - r[0] * c[2], r[0] * c[1] - r[1] * c[0]];
  return Math.abs(normal.reduce((sum, n, d) => sum + n * (b[d] - a[d]), 0)) / (planes.length - 1);
}

const map = (scar: Scar, planes: Plane[], isScarAt: (slice: ScarSlice, n: number) => boolean, drawn: boolean) => ({ threshold: scar.threshold, phase: scar.phase,
  slices: scar.slices.map((slice, s) => ({ scar: runsOf(planes[s], (n) => isScarAt(slice, n)), remote: drawn ? runsOf(planes[s], (n) => isRemote(slice, n)) : [],
    muscle: runsOf(planes[s], (n) => slice.wall[n] === 1 && !isScarAt(slice, n) && !(drawn && isRemote(slice, n))),
    ...(drawn && isCorrected(slice) ? { how: "corrected", by: slice.by, when: slice.when } : { how: "proposed", by: "", when: "" }) })) });

/** As the program takes it. */
export const toldScar = (scar: Scar, planes: Plane[]) => ({ walls: scar.walls, proposed: map(scar, planes, (slice, n) => slice.wall[n] === 1 && slice.proposed[n] === 1, false),
  drawn: map(scar, planes, isScar, true) });

/** The slice with the largest wall, or the middle one. */
export const fullestSlice = (scar: Scar) => {
  const areas = scar.walls.map((wall) => (wall ? area(wall.epi) : 0));
  return areas.some((a) => a > 0) ? areas.indexOf(Math.max(...areas)) + 1 : Math.ceil(scar.slices.length / 2);
};
