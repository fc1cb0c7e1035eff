// A work folder with one frame of a wall that is thicker on one side, and of blood in it: a cup whose septum is 12 mm thick and
// whose lateral wall is 6 mm thick.
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { writeArchive } from "./archive.mjs";

const around = 48;
const depths = Array.from({ length: 11 }, (_, k) => -8 * k);

/** Nodes of the wall at an angle: cavity of 20 mm, closed below. */
function wallPoints(septum) {
  const points = [];
  for (const z of depths)
    for (let i = 0; i < around; ++i) {
      const angle = (2 * Math.PI * i) / around;
      const thick = 9 + 3 * Math.cos(angle - septum);
      for (const r of [20, 20 + thick]) points.push([r * Math.cos(angle), r * Math.sin(angle), z]);
    }
  return points;
}

function wallCells() {
  const node = (k, i, out) => 2 * (k * around + (i % around)) + out;
  const cells = [];
  for (let k = 0; k + 1 < depths.length; ++k)
    for (let i = 0; i < around; ++i)
      cells.push([[k + 1, i, 0], [k + 1, i, 1], [k + 1, i + 1, 1], [k + 1, i + 1, 0], [k, i, 0], [k, i, 1], [k, i + 1, 1], [k, i + 1, 0]].map((at) => node(...at)));
  return cells;
}

const array = (type, name, components, values) =>
  `<DataArray type="${type}" Name="${name}" NumberOfComponents="${components}" format="ascii">${values.join(" ")}</DataArray>`;

function unstructured(points, cells) {
  const zero = points.flatMap(() => [0, 0, 0]);
  return `<VTKFile type="UnstructuredGrid" version="0.1"><UnstructuredGrid><Piece NumberOfPoints="${points.length}" NumberOfCells="${cells.length}">` +
    `<PointData>${array("Float64", "displacement", 3, zero)}</PointData><CellData></CellData>` +
    `<Points>${array("Float64", "points", 3, points.flat())}</Points>` +
    `<Cells>${array("Int64", "connectivity", 1, cells.flat())}${array("Int64", "offsets", 1, cells.map((_, c) => 8 * (c + 1)))}` +
    `${array("UInt8", "types", 1, cells.map(() => 12))}</Cells></Piece></UnstructuredGrid></VTKFile>`;
}

/** Blood that flows up, faster in the middle. */
function image() {
  const [n, rows, h] = [20, 34, 4];
  const velocity = [];
  const pressure = [];
  for (let k = 0; k < rows; ++k)
    for (let j = 0; j < n; ++j)
      for (let i = 0; i < n; ++i) {
        const r = Math.hypot(i + 0.5 - n / 2, j + 0.5 - n / 2) * h;
        velocity.push(0, 0, Math.max(0, 500 - r * r));
        pressure.push(1);
      }
  return `<VTKFile type="ImageData" version="0.1"><ImageData WholeExtent="0 ${n} 0 ${n} 0 ${rows}" Origin="${[-n * h / 2, -n * h / 2, -100].join(" ")}" ` +
    `Spacing="${h} ${h} ${h}"><Piece Extent="0 ${n} 0 ${n} 0 ${rows}"><PointData></PointData><CellData>` +
    `${array("Float64", "velocity", 3, velocity)}${array("Float64", "pressure", 1, pressure)}</CellData></Piece></ImageData></VTKFile>`;
}

const series = (file) => `<VTKFile type="Collection"><Collection><DataSet timestep="0" file="${file}"/></Collection></VTKFile>`;

export function thickSeptum(work, degrees) {
  const beat = join(work, "03_beat");
  for (const folder of ["02_mesh", "03_beat"]) mkdirSync(join(work, folder), { recursive: true });
  writeFileSync(join(work, "02_mesh/stage.json"), JSON.stringify({ ingredients: { program: "of a test" } }));
  writeArchive(join(work, "02_mesh/facts.bin"), { septum_angle: [(degrees * Math.PI) / 180], order: [1], is_immersed: [1] });
  writeFileSync(join(beat, "wall.vtu"), unstructured(wallPoints((degrees * Math.PI) / 180), wallCells()));
  writeFileSync(join(beat, "blood.vti"), image());
  writeFileSync(join(beat, "wall.pvd"), series("wall.vtu"));
  writeFileSync(join(beat, "blood.pvd"), series("blood.vti"));
}
