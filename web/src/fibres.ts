// Fibres in the deformed wall: F f0 of the element, with F from its nodes at its centre.
import type { Wall } from "./data.ts";

type Mat3 = number[];  // row by row

/** dX/dxi at the centre of a cell; its columns are edges of the mean cell. */
function jacobian(wall: Wall, x: Float32Array, cell: number): Mat3 {
  const n = wall.nodes;
  const node = (i: number) => wall.cells[cell * wall.nodesPerCell + i];
  const row = (d: number) => {
    const at = (i: number) => x[d * n + node(i)];
    if (wall.nodesPerCell === 4) return [at(1) - at(0), at(2) - at(0), at(3) - at(0)];
    return [at(1) + at(2) + at(5) + at(6) - at(0) - at(3) - at(4) - at(7),
      at(2) + at(3) + at(6) + at(7) - at(0) - at(1) - at(4) - at(5),
      at(4) + at(5) + at(6) + at(7) - at(0) - at(1) - at(2) - at(3)].map((sum) => sum / 4);
  };
  return [...row(0), ...row(1), ...row(2)];
}

function solve(m: Mat3, v: number[]): number[] {
  const minor = (a: number, b: number, c: number, d: number) => m[a] * m[d] - m[b] * m[c];
  const cofactors = [minor(4, 5, 7, 8), minor(5, 3, 8, 6), minor(3, 4, 6, 7)];
  const det = m[0] * cofactors[0] + m[1] * cofactors[1] + m[2] * cofactors[2];
  return [
    cofactors[0] * v[0] + (m[2] * m[7] - m[1] * m[8]) * v[1] + (m[1] * m[5] - m[2] * m[4]) * v[2],
    cofactors[1] * v[0] + (m[0] * m[8] - m[2] * m[6]) * v[1] + (m[2] * m[3] - m[0] * m[5]) * v[2],
    cofactors[2] * v[0] + (m[1] * m[6] - m[0] * m[7]) * v[1] + (m[0] * m[4] - m[1] * m[3]) * v[2],
  ].map((x) => x / det);
}

export class Fibres {
  private local = new Map<number, number[]>();  // f0 in the cell's own coordinates
  constructor(private wall: Wall, private f0: Float32Array) {}

  /** Unit vector along the deformed fibre of a cell. */
  direction(positions: Float32Array, cell: number): number[] {
    let xi = this.local.get(cell);
    if (!xi) {
      const count = this.wall.cells.length / this.wall.nodesPerCell;
      const f0 = [0, 1, 2].map((d) => this.f0[d * count + cell]);
      xi = solve(jacobian(this.wall, this.wall.undeformed, cell), f0);
      this.local.set(cell, xi);
    }
    const J = jacobian(this.wall, positions, cell);
    const f = [0, 3, 6].map((r) => J[r] * xi![0] + J[r + 1] * xi![1] + J[r + 2] * xi![2]);
    const length = Math.hypot(...f);
    return f.map((x) => x / length);
  }
}
