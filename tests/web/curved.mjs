// How the page draws quadratic elements: the drawn nodes lie where the elements' shape functions put them, neighbours share theirs,
// a section has the area that the curved wall has and the outline that its surface has. How it draws a surface roughly: with fewer corners
// of its own, edges and thin walls as they are.   exit code 77: skipped
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const web = fileURLToPath(new URL("../../web", import.meta.url));
if (!existsSync(join(web, "node_modules/esbuild"))) {
  console.log("skipped: the tools are not there (cd web && npm ci)");
  process.exit(77);
}
const { buildSync } = createRequire(join(web, "/"))("esbuild");
const { outputFiles } = buildSync({ stdin: { contents: `export * from "./src/curved.ts"; export * from "./src/section.ts"; export * from "./src/rougher.ts";`, resolveDir: web },
  bundle: true, format: "esm", write: false });
const { DrawnWall, cutWall, atPoints, outline, rougher, triangles } = await import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString("base64")}`);

let failed = 0;
function check(claim, holds, detail = "") {
  console.log(`${holds ? "pass" : "FAIL"}  ${claim}${!holds && detail !== "" ? `: ${detail}` : ""}`);
  if (!holds) ++failed;
}

const corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];

/** Quadratic hexahedra around a ring of radius 20 to 30 and height 10, in the page's form: each as its eight parts. */
function ring(around, order) {
  const nodes = [];
  const number = new Map();
  const node = (i, j, k) => {  // on a lattice of 2 x around, 3 across, 3 up
    const key = [i % (2 * around), j, k].join();
    if (!number.has(key)) {
      const [angle, r] = [(Math.PI * i) / around, 20 + 5 * j];
      number.set(key, nodes.push([r * Math.cos(angle), r * Math.sin(angle), 5 * k]) - 1);
    }
    return number.get(key);
  };
  const cells = [];
  const skin = [];
  const skinCells = [];
  for (let e = 0; e < around; ++e)
    for (let part = 0; part < 8; ++part) {
      const [i, j, k] = [2 * e + (part & 1), (part >> 1) & 1, part >> 2];
      const cell = corners.map(([x, y, z]) => node(i + x, j + y, k + z));
      if (j === 1) { skin.push(cell[2], cell[3], cell[7], cell[6]); skinCells.push(cells.length / 8); }
      cells.push(...cell);
    }
  return { order, nodes: nodes.length, nodesPerCell: 8, nodesPerFace: 4, cells: Int32Array.from(cells), skin: Int32Array.from(skin),
    skinCells: Int32Array.from(skinCells), positions: Float32Array.from([0, 1, 2].flatMap((d) => nodes.map((x) => x[d]))) };
}

/** Two quadratic tetrahedra that share a face, x = xi + (xi_1^2, 0, 0), each as its eight parts (as the program cuts them). */
function tetrahedra() {
  const vertices = [[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2], [2, 2, 2]];
  const nodes = [];
  const number = new Map();
  const node = (at) => {
    if (!number.has(at.join())) number.set(at.join(), nodes.push([at[0] + at[0] ** 2, at[1], at[2]]) - 1);
    return number.get(at.join());
  };
  const middle = (a, b) => a.map((x, d) => 0.5 * (x + b[d]));
  const cells = [];
  for (const [a, b, c, d] of [[0, 1, 2, 3], [1, 4, 2, 3]].map((cell) => cell.map((v) => vertices[v]))) {
    const [ab, ac, ad, bc, bd, cd] = [[a, b], [a, c], [a, d], [b, c], [b, d], [c, d]].map(([p, q]) => middle(p, q));
    for (const part of [[a, ab, ac, ad], [ab, b, bc, bd], [ac, bc, c, cd], [ad, bd, cd, d], [ab, ac, ad, cd], [ab, ad, bd, cd], [ab, bd, bc, cd], [ab, bc, ac, cd]])
      cells.push(...part.map(node));
  }
  return { order: 2, nodes: nodes.length, nodesPerCell: 4, nodesPerFace: 3, cells: Int32Array.from(cells), skin: Int32Array.from(cells.slice(0, 3)),
    skinCells: Int32Array.from([0]), positions: Float32Array.from([0, 1, 2].flatMap((d) => nodes.map((x) => x[d]))) };
}

function area({ points, triangles }) {
  let sum = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((i) => [...points.subarray(3 * triangles[t + i], 3 * triangles[t + i] + 3)]);
    const [u, v] = [b, c].map((p) => p.map((x, d) => x - a[d]));
    sum += 0.5 * Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
  }
  return sum;
}

const plane = { normal: [0, 0, 1], offset: 3.3 };
const exact = Math.PI * (30 ** 2 - 20 ** 2);
const errors = [2, 1].map((order) => {
  const wall = ring(6, order);
  const { section, positions } = cutWall(new DrawnWall(wall), wall.positions, plane);
  return { error: Math.abs(area(section) / exact - 1), section, positions, wall };
});
check("a section of six quadratic elements has a ring's area within 2%, their straight parts miss it by 4% and more",
  errors[0].error < 0.02 && errors[1].error > 0.04, errors.map((e) => e.error));
const heights = atPoints(errors[0].section, errors[0].positions.slice(2 * errors[0].positions.length / 3));
check("and its points lie in its plane", heights.every((z) => Math.abs(z - 3.3) < 1e-4));
check("cells behind it are the wall's", errors[0].section.cells.every((c) => c < errors[0].wall.cells.length / 8 && (c % 8) < 4));

const wall = ring(6, 2);
const drawn = new DrawnWall(wall);
const count = drawn.nodes;
const x = drawn.at(wall.positions, 3);
const radii = Array.from({ length: count }, (_, a) => a).filter((a) => drawn.skin.includes(a)).map((a) => Math.hypot(x[a], x[count + a]));
check("the skin's nodes are at least six times as near to the circle as the middles of straight sides would be",
  radii.every((r) => Math.abs(r - 30) < 0.15 && Math.abs(r - 30) < (30 - 30 * Math.cos(Math.PI / 12)) / 6), Math.max(...radii.map((r) => Math.abs(r - 30))));
check("every face of the skin in four, neighbours share their nodes", drawn.skin.length === 4 * wall.skin.length && new Set(drawn.skin).size === 5 * 24, new Set(drawn.skin).size);

const rough = new DrawnWall(wall, true);
check("roughly, its parts are straight", rough.skin === wall.skin && rough.nodes === wall.nodes && rough.near(plane, wall.positions).cells === wall.cells);

// a long-axis plane on whose nodes rounding decides, as in the page's steps of 0.01 mm
const noisy = { ...wall, positions: wall.positions.map((v, i) => (Math.abs(v) < 1e-3 ? (i % 2 ? 0.004 : -0.004) : v)) };
const cut = cutWall(rough, noisy.positions, { normal: [0, 1, 0], offset: 0 }).section;
const sides = outline(rough, cut);
const at = (p) => [...cut.points.subarray(3 * p, 3 * p + 3)];
const length = sides.reduce((sum, [p, q]) => sum + Math.hypot(...at(p).map((v, d) => v - at(q)[d])), 0);
check("a section through nodes has the outline of the surface and no other: two lines of the wall's height", Math.abs(length - 20) < 0.02 &&
  sides.flat().every((p) => Math.abs(Math.hypot(...at(p).slice(0, 2)) - 30) < 0.1), `${length} ${sides.length}`);

const tets = tetrahedra();
const both = new DrawnWall(tets);
both.near({ normal: [0, 0, 1], offset: 1 }, tets.positions);
const [n, m] = [both.nodes, tets.nodes];
const places = both.at(tets.positions, 3);
// x = a + a^2 of the place a, which the elements' polynomials repeat exactly: a is known from the straight field
const straight = both.at(Float32Array.from(tets.positions.slice(0, m), (v) => (Math.sqrt(1 + 4 * v) - 1) / 2));
check("quadratic tetrahedra: drawn nodes lie on x = a + a^2", n > m + 20 && straight.every((a, i) => Math.abs(places[i] - a - a * a) < 1e-4), n);
/** The surface of a tube of radius 20 and 22 and height 30, in faces of about 1 x 1. */
function tube() {
  const [around, up] = [130, 30];
  const nodes = [];
  const faces = [];
  const ring = (r, z) => nodes.push(...Array.from({ length: around }, (_, i) => [r * Math.cos((2 * Math.PI * i) / around), r * Math.sin((2 * Math.PI * i) / around), z])) - around;
  const band = (below, above) => { for (let i = 0; i < around; ++i) faces.push(below + i, below + ((i + 1) % around), above + ((i + 1) % around), above + i); };
  const [outer, inner] = [22, 20].map((r) => Array.from({ length: up + 1 }, (_, k) => ring(r, k)));
  for (let k = 0; k < up; ++k) { band(outer[k], outer[k + 1]); band(inner[k + 1], inner[k]); }
  band(outer[up], inner[up]);
  band(inner[0], outer[0]);
  return { faces: Int32Array.from(faces), at: (node) => nodes[node] };
}

/** Enclosed by triangles that face outwards. */
function volume({ nodes }, at) {
  let sum = 0;
  for (let t = 0; t < nodes.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((i) => at(nodes[t + i]));
    sum += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
  }
  return sum;
}

const { faces, at: place } = tube();
const smooth = triangles(faces, 4);
const coarse = rougher(smooth, place, 3.2);
check("a rough surface has less than a third of the triangles", coarse.faces.length < smooth.faces.length / 3 && coarse.nodes.length === 3 * coarse.faces.length,
  `${coarse.faces.length} ${smooth.faces.length}`);
check("its corners are the surface's own", [...coarse.nodes].every((node) => faces.includes(node)));
const radiiOf = [...new Set(coarse.nodes)].map((node) => Math.hypot(...place(node).slice(0, 2)));
check("both sides of a wall of 2 mm and its ends stay where they are", [20, 22].every((r) => radiiOf.some((one) => Math.abs(one - r) < 1e-9)) &&
  [0, 30].every((z) => [...coarse.nodes].some((node) => place(node)[2] === z)));
const [full, less] = [smooth, coarse].map((one) => volume(one, place));
check("what it encloses differs by less than 5% (chords of 4 mm lie 0.1 mm off a radius of 20 mm)", Math.abs(less / full - 1) < 0.05, `${less} ${full}`);
const sidesOf = new Map();
for (let t = 0; t < coarse.nodes.length; t += 3)
  for (const [i, j] of [[0, 1], [1, 2], [2, 0]]) {
    const key = [coarse.nodes[t + i], coarse.nodes[t + j]];
    const name = [...key].sort((p, q) => p - q).join();
    sidesOf.set(name, (sidesOf.get(name) ?? 0) + (key[0] < key[1] ? 1 : -1));
  }
check("and it has no hole", [...sidesOf.values()].every((count) => count === 0));
check("corners far apart stay as they are", rougher(smooth, place, 0.2).nodes.join() === smooth.nodes.join());

console.log(`${failed} failed`);
process.exit(failed ? 1 : 0);
