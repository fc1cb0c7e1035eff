// The wall as it is drawn. Parts of quadratic elements are cut once more, with new nodes where the element's shape functions put
// them, x = sum_a phi_a(xi) x_a, so that its sides are seen curved as they are; linear elements are drawn as they are. Of the wall's
// inside only what a section needs is cut. The shape functions of quadratic elements stand here again: src/lv/mesh/shapes.hpp has them for
// the program; tests/web/curved.mjs tries these on a ring whose places and areas are known.
import type { Wall } from "./data.ts";
import type { Plane } from "./section.ts";

/** Cells that a section is made of: nodes of cell after cell, and the wall's cell that each is part of. */
export interface Parts { cells: ArrayLike<number>; of?: number[] /* nothing: itself */ }

/** A quadratic element: its nodes and their places, in quarters of the reference element (of a tetrahedron's four coordinates). */
interface Element { nodes: number[]; places: number[][]; index: Map<number, number>; known: Map<number, number>; cells?: number[] }

const partsPerElement = 8;
/** The corners of a hexahedron on the unit cube. */
const corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];
/** The three quadratic polynomials of a line at quarters of it. */
const line = [0, 1, 2, 3, 4].map((q) => q / 4).map((x) => [(1 - x) * (1 - 2 * x), 4 * x * (1 - x), x * (2 * x - 1)]);
/** Of each point of a 3 x 3 x 3 lattice in a hexahedron: the corners in whose middle it lies. */
const lattice = Array.from({ length: 27 }, (_, p) => [p % 3, Math.floor(p / 3) % 3, Math.floor(p / 9)]).map((at) =>
  corners.flatMap((corner, a) => (at.every((x, d) => x === 1 || x === 2 * corner[d]) ? [a] : [])));
const octants = [0, 1, 2, 3, 4, 5, 6, 7].map((part) => corners.map(([x, y, z]) => 9 * ((part >> 2) + z) + 3 * (((part >> 1) & 1) + y) + (part & 1) + x));

const byNumber = (a: number, b: number) => a - b;

export class DrawnWall {
  readonly skin: Int32Array;       // faces of drawn nodes
  readonly skinCells: Int32Array;  // the wall's cell behind each
  readonly facesPerFace: number;   // of the wall's skin
  private elements: Element[] = [];
  // the drawn nodes beyond the wall's own: where each one's terms begin, and its terms
  private start: number[] = [0];
  private from: number[] = [];
  private weight: number[] = [];
  private known = new Map<string, number>();

  private isCurved: boolean;

  /** Roughly: the parts of quadratic elements are straight. */
  constructor(readonly wall: Wall, isRough = false) {
    this.isCurved = wall.order === 2 && !isRough;
    this.facesPerFace = this.isCurved ? 4 : 1;
    [this.skin, this.skinCells] = this.isCurved ? this.cutSkin() : [wall.skin, wall.skinCells];
  }

  /** The wall's nodes come first. */
  get nodes(): number { return this.wall.nodes + this.start.length - 1; }

  private element(number: number): Element {
    return (this.elements[number] ??= this.readElement(number));
  }

  private readElement(number: number): Element {
    const { cells, nodesPerCell } = this.wall;
    const places = new Map<number, number[]>();
    for (let part = 0; part < partsPerElement; ++part)
      for (let a = 0; a < nodesPerCell; ++a) {
        const node = cells[(number * partsPerElement + part) * nodesPerCell + a];
        if (nodesPerCell === 8) places.set(node, corners[a].map((x, d) => 2 * (((part >> d) & 1) + x)));
        else if (part < 4) places.set(node, [0, 1, 2, 3].map((i) => 2 * (Number(i === part) + Number(i === a))));
      }
    const nodes = [...places.keys()];
    return { nodes, places: [...places.values()], index: new Map(nodes.map((node, i) => [node, i])), known: new Map() };
  }

  /** phi_a at a place. */
  private shape(element: Element, a: number, place: number[]): number {
    const own = element.places[a];
    if (own.length === 3) return line[place[0]][own[0] >> 1] * line[place[1]][own[1] >> 1] * line[place[2]][own[2] >> 1];
    const ends = own.flatMap((x, i) => (x > 0 ? [place[i] / 4] : []));
    return ends.length === 1 ? ends[0] * (2 * ends[0] - 1) : 4 * ends[0] * ends[1];
  }

  /** The drawn node in the middle of nodes of one element. */
  private middle(element: Element, of: number[]): number {
    if (of.length === 1) return of[0];
    const places = of.map((node) => element.places[element.index.get(node)!]);
    const place = places[0].map((_, d) => places.reduce((sum, p) => sum + p[d], 0) / places.length);
    const code = place.reduce((sum, x) => 5 * sum + x, 0);
    let node = element.known.get(code);
    if (node !== undefined) return node;
    const key = [...of].sort(byNumber).join();
    node = this.known.get(key) ?? this.add(element, place);
    this.known.set(key, node);
    element.known.set(code, node);
    return node;
  }

  private add(element: Element, place: number[]): number {
    element.nodes.forEach((node, a) => {
      const phi = this.shape(element, a, place);
      if (phi === 0) return;
      this.from.push(node);
      this.weight.push(phi);
    });
    this.start.push(this.from.length);
    return this.nodes - 1;
  }

  /** Every face in four. */
  private cutSkin(): [Int32Array, Int32Array] {
    const { skin, skinCells, nodesPerFace: n } = this.wall;
    const faces: number[] = [];
    skinCells.forEach((cell, f) => {
      const element = this.element(Math.floor(cell / partsPerElement));
      const face = [...skin.subarray(n * f, n * (f + 1))];
      const sides = face.map((node, i) => this.middle(element, [node, face[(i + 1) % n]]));
      if (n === 3) faces.push(...sides);
      const centre = n === 4 ? [this.middle(element, face)] : [];
      face.forEach((node, i) => faces.push(node, sides[i], ...centre, sides[(i + n - 1) % n]));
    });
    return [Int32Array.from(faces), Int32Array.from({ length: 4 * skinCells.length }, (_, f) => skinCells[f >> 2])];
  }

  /** The parts of an element, each in eight. */
  private cellsOf(number: number): number[] {
    const element = this.element(number);
    if (element.cells) return element.cells;
    const { cells, nodesPerCell: n } = this.wall;
    element.cells = [];
    for (let part = 0; part < partsPerElement; ++part) {
      const first = (number * partsPerElement + part) * n;
      const nodes = [...cells.subarray(first, first + n)];
      element.cells.push(...(n === 8 ? this.cutHexahedron(element, nodes) : this.cutTetrahedron(element, nodes)));
    }
    return element.cells;
  }

  private cutHexahedron(element: Element, nodes: number[]): number[] {
    const points = lattice.map((of) => this.middle(element, of.map((a) => nodes[a])));
    return octants.flatMap((octant) => octant.map((p) => points[p]));
  }

  private cutTetrahedron(element: Element, [a, b, c, d]: number[]): number[] {
    const [ab, ac, ad, bc, bd, cd] = [[a, b], [a, c], [a, d], [b, c], [b, d], [c, d]].map((of) => this.middle(element, of));
    const ring = [ac, ad, bd, bc];
    return [a, ab, ac, ad, ab, b, bc, bd, ac, bc, c, cd, ad, bd, cd, d, ...ring.flatMap((node, i) => [ab, node, ring[(i + 1) % 4], cd])];
  }

  /** The cells that a plane may cross; `positions` are those of the wall's nodes. */
  near({ normal: [nx, ny, nz], offset }: Plane, positions: Float32Array): Parts {
    const { cells, nodes: n, nodesPerCell } = this.wall;
    if (!this.isCurved) return { cells };
    const height = Float32Array.from({ length: n }, (_, a) => nx * positions[a] + ny * positions[n + a] + nz * positions[2 * n + a] - offset);
    const parts = { cells: [] as number[], of: [] as number[] };
    const size = partsPerElement * nodesPerCell;
    for (let e = 0; e < cells.length / size; ++e) {
      let [low, high] = [Infinity, -Infinity];
      for (let i = e * size; i < (e + 1) * size; ++i) {
        const h = height[cells[i]];
        if (h < low) low = h;
        if (h > high) high = h;
      }
      const bulge = 0.1 * (high - low);  // beyond its nodes
      if (low - bulge > 0 || high + bulge < 0) continue;
      for (const node of this.cellsOf(e)) parts.cells.push(node);
      for (let i = 0; i < partsPerElement * partsPerElement; ++i) parts.of.push(e * partsPerElement + (i >> 3));
    }
    return parts;
  }

  /** A field of the wall's nodes at the drawn ones, component after component. */
  at(field: Float32Array, components = 1): Float32Array {
    const { start, from, weight } = this;
    const [n, drawn] = [this.wall.nodes, this.nodes];
    if (drawn === n) return field;
    const out = new Float32Array(components * drawn);
    for (let d = 0; d < components; ++d) {
      out.set(field.subarray(d * n, (d + 1) * n), d * drawn);
      for (let k = 0; k + 1 < start.length; ++k) {
        let sum = 0;
        for (let i = start[k]; i < start[k + 1]; ++i) sum += weight[i] * field[d * n + from[i]];
        out[d * drawn + n + k] = sum;
      }
    }
    return out;
  }
}
