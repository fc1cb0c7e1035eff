// A surface with fewer corners, for motion where no graphics processor draws: nodes that lie close together become one of them, and faces
// without area go. What faces another way stays apart, so that neither sides of a thin wall grow together nor edges are rounded off.

/** Triangles of nodes, and the face that each is part of. */
export interface Triangles { nodes: Int32Array; faces: Int32Array }

/** Faces of three or four nodes as triangles. */
export function triangles(skin: Int32Array, perFace: number): Triangles {
  const nodes: number[] = [];
  const faces: number[] = [];
  for (let f = 0; f < skin.length / perFace; ++f)
    for (let i = 1; i + 1 < perFace; ++i) {
      nodes.push(skin[perFace * f], skin[perFace * f + i], skin[perFace * f + i + 1]);
      faces.push(f);
    }
  return { nodes: Int32Array.from(nodes), faces: Int32Array.from(faces) };
}

type Vector = [number, number, number];

/** The sum of the unit normals of the triangles around each node, and their number. */
function normalsOf(all: Triangles, at: (node: number) => Vector): Map<number, { sum: Vector; count: number }> {
  const normals = new Map<number, { sum: Vector; count: number }>();
  for (let t = 0; t < all.nodes.length; t += 3) {
    const corners = [...all.nodes.subarray(t, t + 3)];
    const [a, b, c] = corners.map(at);
    const [u, v] = [b, c].map((x) => x.map((value, d) => value - a[d]));
    const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const length = Math.hypot(...normal) || 1;
    for (const node of corners) {
      const own = normals.get(node) ?? { sum: [0, 0, 0], count: 0 };
      own.sum = own.sum.map((value, d) => value + normal[d] / length) as Vector;
      ++own.count;
      normals.set(node, own);
    }
  }
  return normals;
}

/** Which of six ways a normal points. */
function way(normal: Vector): number {
  const sizes = normal.map(Math.abs);
  const axis = sizes.indexOf(Math.max(...sizes));
  return 2 * axis + Number(normal[axis] < 0);
}

/** Nodes that lie in one cell of a grid, face the same way, and are all on an edge or none of them. */
function clusters(all: Triangles, at: (node: number) => Vector, size: number): number[][] {
  const edge = 0.9;  // length of the mean unit normal; below: the faces around the node make an edge
  const found = new Map<string, number[]>();
  for (const [node, { sum, count }] of normalsOf(all, at)) {
    const isOnEdge = Math.hypot(...sum) < edge * count;
    const key = [...at(node).map((x) => Math.floor(x / size)), isOnEdge ? "edge" : way(sum)].join();
    const members = found.get(key);
    if (members) members.push(node);
    else found.set(key, [node]);
  }
  return [...found.values()];
}

/** The member that is nearest to the middle of all. */
function middleOf(members: number[], at: (node: number) => Vector): number {
  const mean = [0, 1, 2].map((d) => members.reduce((sum, node) => sum + at(node)[d], 0) / members.length);
  const away = (node: number) => Math.hypot(...at(node).map((x, d) => x - mean[d]));
  return members.reduce((best, node) => (away(node) < away(best) ? node : best));
}

/** A surface with corners about `size` apart, where they are not farther apart already; they are nodes of its own. */
export function rougher(all: Triangles, at: (node: number) => Vector, size: number): Triangles {
  const taken = new Map<number, number>();
  for (const members of clusters(all, at, size)) {
    const one = middleOf(members, at);
    for (const node of members) taken.set(node, one);
  }
  const nodes: number[] = [];
  const faces: number[] = [];
  all.faces.forEach((face, t) => {
    const [a, b, c] = [...all.nodes.subarray(3 * t, 3 * t + 3)].map((node) => taken.get(node)!);
    if (a === b || b === c || c === a) return;
    nodes.push(a, b, c);
    faces.push(face);
  });
  return { nodes: Int32Array.from(nodes), faces: Int32Array.from(faces) };
}
