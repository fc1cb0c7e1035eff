// The wall's section by a plane, one convex polygon per cell that the plane crosses. Neighbouring polygons share their
// corners, which lie on edges of the mesh, so the section has no gaps.
import type { DrawnWall } from "./curved.ts";

export interface Plane { normal: [number, number, number]; offset: number }  // n.x = offset

export interface Section {
  points: Float32Array;    // three numbers each
  from: Int32Array;        // the two nodes of the edge that each point lies on
  weight: Float32Array;    // of the second node
  triangles: number[];
  cells: number[];         // of the wall, behind each triangle
  polygons: number[][];    // corners of each cut cell
  polygonCells: number[];
}

const hexEdges = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]];
const tetEdges = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];

/** `undrawn`: x, then y, then z of the wall's nodes. The section, and the positions of all nodes that are drawn. */
export function cutWall(drawn: DrawnWall, undrawn: Float32Array, plane: Plane): { section: Section; positions: Float32Array } {
  const { nodesPerCell } = drawn.wall;
  const { cells, of } = drawn.near(plane, undrawn);
  const positions = drawn.at(undrawn, 3);
  const n = drawn.nodes;
  const [nx, ny, nz] = plane.normal;
  const height = new Float32Array(n);
  for (let a = 0; a < n; ++a)
    height[a] = nx * positions[a] + ny * positions[n + a] + nz * positions[2 * n + a] - plane.offset;
  const edges = nodesPerCell === 8 ? hexEdges : tetEdges;
  const known = new Map<number, number>();
  const points: number[] = [];
  const from: number[] = [];
  const weight: number[] = [];
  const crossing = (a: number, b: number): number => {
    if (a > b) [a, b] = [b, a];
    const key = a * n + b;
    const old = known.get(key);
    if (old !== undefined) return old;
    const w = height[a] / (height[a] - height[b]);
    for (let d = 0; d < 3; ++d) points.push((1 - w) * positions[d * n + a] + w * positions[d * n + b]);
    from.push(a, b);
    weight.push(w);
    known.set(key, weight.length - 1);
    return weight.length - 1;
  };
  // two directions in the plane
  const along = Math.abs(nz) < 0.9 ? unit([ny, -nx, 0]) : [1, 0, 0];
  const across = [ny * along[2] - nz * along[1], nz * along[0] - nx * along[2], nx * along[1] - ny * along[0]];
  const flat = (p: number, axis: number[]) =>
    points[3 * p] * axis[0] + points[3 * p + 1] * axis[1] + points[3 * p + 2] * axis[2];
  const section = { triangles: [] as number[], cells: [] as number[], polygons: [] as number[][], polygonCells: [] as number[] };
  for (let c = 0; c < cells.length / nodesPerCell; ++c) {
    const first = c * nodesPerCell;
    let above = 0;
    for (let i = 0; i < nodesPerCell; ++i) above += height[cells[first + i]] >= 0 ? 1 : 0;
    if (above === 0 || above === nodesPerCell) continue;
    const corners: number[] = [];
    for (const [i, j] of edges) {
      const a = cells[first + i];
      const b = cells[first + j];
      if (height[a] < 0 !== height[b] < 0) corners.push(crossing(a, b));
    }
    const mean = (axis: number[]) => corners.reduce((sum, p) => sum + flat(p, axis), 0) / corners.length;
    const [u, v] = [mean(along), mean(across)];
    const angle = new Map(corners.map((p) => [p, Math.atan2(flat(p, across) - v, flat(p, along) - u)]));
    corners.sort((p, q) => angle.get(p)! - angle.get(q)!);
    for (let i = 1; i + 1 < corners.length; ++i) {
      section.triangles.push(corners[0], corners[i], corners[i + 1]);
      section.cells.push(of ? of[c] : c);
    }
    section.polygons.push(corners);
    section.polygonCells.push(of ? of[c] : c);
  }
  return { positions, section: { ...section, points: Float32Array.from(points), from: Int32Array.from(from), weight: Float32Array.from(weight) } };
}

/** Where the plane cuts the wall's surface: pairs of the section's points. (Sides of one polygon alone are no border where nodes lie in
 * the plane: the polygons on both sides of a face in it do not meet side by side.) */
export function outline(drawn: DrawnWall, section: Section): [number, number][] {
  const { from } = section;
  const [n, perFace] = [drawn.nodes, drawn.wall.nodesPerFace];
  const pointOn = new Map<number, number>();  // an edge
  for (let p = 0; p < from.length / 2; ++p) pointOn.set(from[2 * p] * n + from[2 * p + 1], p);
  const sides: [number, number][] = [];
  for (let f = 0; f < drawn.skin.length; f += perFace) {
    const found: number[] = [];
    for (let i = 0; i < perFace; ++i) {
      const [a, b] = [drawn.skin[f + i], drawn.skin[f + ((i + 1) % perFace)]];
      const point = pointOn.get(Math.min(a, b) * n + Math.max(a, b));
      if (point !== undefined) found.push(point);
    }
    if (found.length === 2) sides.push([found[0], found[1]]);
  }
  return sides;
}

const unit = (v: number[]) => v.map((x) => x / Math.hypot(...v));

/** A nodal field at a section's points. */
export function atPoints(section: Section, nodal: Float32Array): Float32Array {
  return section.weight.map((w, p) => (1 - w) * nodal[section.from[2 * p]] + w * nodal[section.from[2 * p + 1]]);
}
