// A cine with its borders, as the program hands it over, and what can be measured on it.

import type { SaidScar } from "./scar.ts";

export type Side = "endo" | "epi";
export type How = "proposed" | "corrected" | "drawn";
/** A place in a slice: millimetres along its rows and its columns from the middle of the first pixel. */
export type Place = readonly [number, number];
export type Point = [number, number, number];

export interface Line { points: Place[]; how: How; by: string; when: string }
export interface Landmark { name: string; slice: number; at: Place; by: string; when: string }
export interface Confidence { slice: number; phase: number; endo: number; epi: number }
export interface Plane { columns: number; rows: number; origin: Point; along_row: Point; along_column: Point; spacing: [number, number] }
/** A long-axis image; it may have another number of pictures over the cycle than the slices. */
export interface LongAxis extends Plane { phases: number }

interface SaidLine { slice: number; phase: number; side: Side; points: Point[]; how: How; by: string; when: string }
interface SaidLandmark { name: string; slice: number; at: Point; by: string; when: string }
export interface SaidProposal { contours: SaidLine[]; landmarks: SaidLandmark[]; landmark_phase: number; confidence: Confidence[]; doubts: string[] }
/** By whom a landmark is set that the program proposes. */
export const programsOwn = "proposed";

/** What the program hands over; slices and phases count from 1. Landmarks count the long-axis images on, after the slices. */
export interface SaidStudy extends SaidProposal {
  name: string; folder: string; phases: number; times: number[]; spacing: number; slices: Plane[]; long_axis: LongAxis[]; doubtful: number;
  proposal: SaidLine[]; saved: boolean; faults: string[]; hindrance: string; revision: number; scar: SaidScar | null;
}

export const sides: Side[] = ["endo", "epi"];
export const sideNames: Record<Side, string> = { endo: "endocardium", epi: "epicardium" };
export const landmarkNames: Record<string, string> = { centre: "centre of the blood", septum_anterior: "anterior insertion of the septum",
  septum_inferior: "inferior insertion of the septum", apex_endo: "tip of the endocardium", apex_epi: "tip of the epicardium",
  annulus_1: "mitral annulus, a point", annulus_2: "mitral annulus, second point", annulus_3: "mitral annulus, third point", annulus_4: "mitral annulus, fourth point",
  annulus_5: "mitral annulus, fifth point", annulus_6: "mitral annulus, sixth point", annulus_7: "mitral annulus, seventh point", annulus_8: "mitral annulus, eighth point" };

/** The name of a border among all: slice, phase and side. */
export const keyOf = (slice: number, phase: number, side: Side) => `${slice}/${phase}/${side}`;
export function ofKey(key: string): { slice: number; phase: number; side: Side } {
  const [slice, phase, side] = key.split("/");
  return { slice: Number(slice), phase: Number(phase), side: side as Side };
}

export const dot = (a: Point, b: Point) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

export function placeOn(plane: Plane, x: Point): Place {
  const d: Point = [x[0] - plane.origin[0], x[1] - plane.origin[1], x[2] - plane.origin[2]];
  return [dot(d, plane.along_row), dot(d, plane.along_column)];
}

export const inSpace = (plane: Plane, [u, v]: Place): Point =>
  [0, 1, 2].map((i) => plane.origin[i] + u * plane.along_row[i] + v * plane.along_column[i]) as Point;

/** In space, as the program is told it. */
export const toldPoints = (plane: Plane, places: readonly Place[]): Point[] => places.map((p) => rounded(inSpace(plane, p)));

const rounded = (x: Point): Point => x.map((c) => Math.round(1e3 * c) / 1e3) as Point;

export function linesOf(said: SaidLine[], slices: Plane[]): Map<string, Line> {
  return new Map(said.map(({ slice, phase, side, points, how, by, when }) =>
    [keyOf(slice, phase, side), { points: points.map((x) => placeOn(slices[slice - 1], x)), how, by, when }]));
}

/** Every plane that has a number: the slices, then the long-axis images. */
export const planesOf = (study: SaidStudy): Plane[] => [...study.slices, ...study.long_axis];

export const landmarksOf = (said: SaidLandmark[], planes: Plane[]): Map<string, Landmark> =>
  new Map(said.map((mark) => [mark.name, { ...mark, at: placeOn(planes[mark.slice - 1], mark.at) }]));

/** The drawing as the program takes it. */
export function said(lines: Map<string, Line>, landmarks: Map<string, Landmark>, confidence: Confidence[], planes: Plane[]) {
  const contours = [...lines].map(([key, line]) =>
    ({ ...ofKey(key), ...line, points: toldPoints(planes[ofKey(key).slice - 1], line.points) }));
  const marks = [...landmarks.values()].map((mark) => ({ ...mark, at: rounded(inSpace(planes[mark.slice - 1], mark.at)) }));
  return { contours, landmarks: marks, confidence };
}

/** Where a direction of image space (x to the patient's left, y to the back, z to the head) points, as viewers write it: the letters of
 * its parts by their size, without those of less than a quarter (15 degrees beside the plane of the others). */
export function directionLetters(d: Point): string {
  const ends: [string, string][] = [["L", "R"], ["P", "A"], ["H", "F"]];
  return [0, 1, 2].filter((i) => Math.abs(d[i]) >= 0.25).sort((i, j) => Math.abs(d[j]) - Math.abs(d[i])).map((i) => ends[i][d[i] > 0 ? 0 : 1]).join("");
}

/** The letters at the edges of a picture. */
export function edgeLetters({ along_row, along_column }: Plane): Record<"left" | "right" | "top" | "bottom", string> {
  const back = (d: Point): Point => [-d[0], -d[1], -d[2]];
  return { left: directionLetters(back(along_row)), right: directionLetters(along_row), top: directionLetters(back(along_column)), bottom: directionLetters(along_column) };
}

/** The area that a closed line encloses [mm²]. */
export function area(points: Place[]): number {
  let sum = 0;
  points.forEach(([u, v], i) => {
    const [s, t] = points[(i + 1) % points.length];
    sum += u * t - s * v;
  });
  return Math.abs(sum) / 2;
}

export function centroid(points: Place[]): Place {
  let [a, x, y] = [0, 0, 0];
  points.forEach(([u, v], i) => {
    const [s, t] = points[(i + 1) % points.length];
    const cross = u * t - s * v;
    a += cross;
    x += (u + s) * cross;
    y += (v + t) * cross;
  });
  return [x / (3 * a), y / (3 * a)];
}

/** The cavity's volume at each phase, areas times the spacing of slices [ml]. */
export function volumes(lines: Map<string, Line>, phases: number, spacing: number): number[] {
  const sums = Array<number>(phases).fill(0);
  for (const [key, line] of lines) {
    const { phase, side } = ofKey(key);
    if (side === "endo") sums[phase - 1] += 1e-3 * spacing * area(line.points);
  }
  return sums;
}
