// The wall's surface and section as they are drawn, and the regions that are outlined on them.
import {
  BufferAttribute, BufferGeometry, DataTexture, DynamicDrawUsage, Group, LinearFilter, Mesh, RGBAFormat, ShaderMaterial, Sphere, type Texture, Vector2, Vector3, Vector4, DoubleSide,
} from "three";
import { type Scale, uncoloured, uncolouredRange } from "./colours.ts";
import { DrawnWall } from "./curved.ts";
import type { Wall } from "./data.ts";
import { rougher, type Triangles, triangles } from "./rougher.ts";
import { atPoints, cutWall, type Plane, type Section } from "./section.ts";

const vertexShader = `
attribute float value;
attribute float chosen;
attribute float infarct;
varying float v; varying float c; varying float m; varying vec3 place; varying vec3 n;
void main() {
  v = value; c = chosen; m = infarct; place = position; n = normalMatrix * normal;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;
// A chosen region has c = 1 at all its corners, so its border is where c falls below 1: a dark line there with a light one around it.
// The infarct's border is where M = 0.5: a white line with dark rims.
const fragmentShader = `
uniform sampler2D map; uniform vec2 range; uniform vec2 none; uniform vec3 uncoloured; uniform vec4 plane; uniform float choosing;
uniform float plain; uniform float flatLight; uniform float pixel; uniform float bordered;
varying float v; varying float c; varying float m; varying vec3 place; varying vec3 n;
void main() {
  if (dot(plane.xyz, place) > plane.w) discard;
  vec3 colour = texture2D(map, vec2(clamp((v - range.x) / (range.y - range.x), 0.0, 1.0) * 0.99609375 + 0.001953125, 0.5)).rgb;
  if (v > none.x && v < none.y) colour = uncoloured;
  colour = mix(colour, vec3(0.80, 0.62, 0.58), plain);
  if (flatLight < 0.5) colour *= 0.55 + 0.45 * abs(normalize(n).z);
  float off = abs(m - 0.5) / max(length(vec2(dFdx(m), dFdy(m))), 1e-6) / max(pixel, 1.0);
  if (bordered > 0.5 && off < 1.8) colour = vec3(off < 0.8 ? 1.0 : 0.1);
  float away = (1.0 - c) / max(fwidth(c), 1e-6) / pixel;
  if (choosing > 0.5 && c < 0.9999) {
    if (away < 2.5) colour = vec3(0.0);
    else if (away < 4.0) colour = vec3(1.0);
  }
  gl_FragColor = vec4(colour, 1.0);
}`;

type Surface = Mesh<BufferGeometry, ShaderMaterial>;

function dynamic(size: number, width: number): BufferAttribute {
  return new BufferAttribute(new Float32Array(size * width), width).setUsage(DynamicDrawUsage);
}

/** Twice the areas of the triangles around each corner, as vectors: the shader makes unit vectors of them. */
function addNormals(x: Float32Array, index: ArrayLike<number>, normals: Float32Array): void {
  for (let t = 0; t < index.length; t += 3) {
    const [a, b, c] = [3 * index[t], 3 * index[t + 1], 3 * index[t + 2]];
    const [ux, uy, uz] = [x[b] - x[a], x[b + 1] - x[a + 1], x[b + 2] - x[a + 2]];
    const [vx, vy, vz] = [x[c] - x[a], x[c + 1] - x[a + 1], x[c + 2] - x[a + 2]];
    const [nx, ny, nz] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const corner of [a, b, c]) {
      normals[corner] += nx;
      normals[corner + 1] += ny;
      normals[corner + 2] += nz;
    }
  }
}

function material(flatLight: number): ShaderMaterial {
  return new ShaderMaterial({ vertexShader, fragmentShader, side: DoubleSide, uniforms: {
    map: { value: null }, range: { value: new Vector2(0, 1) }, plane: { value: new Vector4(0, 0, 0, 1) },
    none: { value: new Vector2(0, 0) }, uncoloured: { value: new Vector3(...uncoloured).divideScalar(255) }, pixel: { value: 1 },
    choosing: { value: 0 }, bordered: { value: 0 }, plain: { value: 0 }, flatLight: { value: flatLight } } });
}

const roughSize = 3.2;  // between corners of a rough surface [mm]

/** What is shown: positions and values of the wall's own nodes (no values: no colours), the plane that cuts them, and whether the infarct's
 * border is drawn. */
export interface Shape { positions: Float32Array; values?: Float32Array; plane?: Plane; isBordered: boolean }

export class WallBody {
  readonly drawn: DrawnWall;
  readonly skin: Surface;
  readonly cap: Surface;
  readonly group = new Group();
  section?: Section;
  positions!: Float32Array;   // of all nodes that are drawn
  private values?: Float32Array;
  private infarct?: Float32Array;  // M of all nodes that are drawn
  private triangles: Triangles;  // of the skin
  private cells: number[];       // behind each
  private skinNodes: Int32Array;

  /** Quadratic elements are drawn curved, or roughly, with their parts straight; of linear ones a rough surface has fewer corners. */
  constructor(wall: Wall, isRough: boolean) {
    this.drawn = new DrawnWall(wall, isRough);
    this.triangles = triangles(this.drawn.skin, wall.nodesPerFace);
    if (isRough && wall.order === 1) {
      const { nodes, undeformed: x } = wall;
      this.triangles = rougher(this.triangles, (node) => [x[node], x[nodes + node], x[2 * nodes + node]], roughSize);
    }
    this.cells = Array.from(this.triangles.faces, (face) => this.drawn.skinCells[face]);
    this.skinNodes = Int32Array.from(new Set(this.triangles.nodes)).sort();
    this.infarct = wall.infarct && this.drawn.at(wall.infarct);
    this.skin = this.makeSkin();
    this.cap = new Mesh(new BufferGeometry(), material(1));
    for (const object of [this.skin, this.cap]) object.frustumCulled = false;
    this.group.add(this.skin, this.cap);
  }

  private get surfaces(): Surface[] { return [this.skin, this.cap]; }

  private makeSkin(): Surface {
    const { skinNodes } = this;
    const place = new Map<number, number>();
    skinNodes.forEach((node, i) => place.set(node, i));
    const index = Array.from(this.triangles.nodes, (node) => place.get(node)!);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", dynamic(skinNodes.length, 3));
    geometry.setAttribute("normal", dynamic(skinNodes.length, 3));
    geometry.setAttribute("value", dynamic(skinNodes.length, 1));
    geometry.setAttribute("chosen", dynamic(skinNodes.length, 1));
    geometry.setAttribute("infarct", new BufferAttribute(Float32Array.from(skinNodes, (node) => this.infarct?.[node] ?? 0), 1));
    geometry.setIndex(index);
    geometry.boundingSphere = new Sphere(new Vector3(), 1e4);
    return new Mesh(geometry, material(0));
  }

  show({ positions, values, plane, isBordered }: Shape): void {
    if (plane) ({ section: this.section, positions: this.positions } = cutWall(this.drawn, positions, plane));
    else [this.section, this.positions] = [undefined, this.drawn.at(positions, 3)];
    this.values = values && this.drawn.at(values);
    const { wall, nodes } = this.drawn;
    if (wall.infarct && this.infarct!.length < nodes) this.infarct = this.drawn.at(wall.infarct);  // a section adds nodes
    for (const { material: { uniforms } } of this.surfaces) uniforms.bordered.value = isBordered ? 1 : 0;
    this.updateSkin();
    this.updateCap();
  }

  colour(scale: Scale, map: Texture): void {
    for (const { material: { uniforms } } of this.surfaces) {
      uniforms.map.value = map;
      uniforms.range.value.set(scale.min, scale.max);
      uniforms.none.value.set(...uncolouredRange(scale));
      uniforms.plain.value = this.values ? 0 : 1;
    }
  }

  /** Nothing is drawn on the side that the plane's normal points to. */
  open(plane: Plane | undefined): void {
    this.cap.visible = plane !== undefined;
    const [x, y, z, w] = plane ? [...plane.normal, plane.offset] : [0, 0, 0, 1];
    this.skin.material.uniforms.plane.value.set(x, y, z, w);
  }

  /** Pixels of the picture a pixel of the screen. */
  set fineness(ratio: number) { for (const { material: { uniforms } } of this.surfaces) uniforms.pixel.value = ratio; }

  private updateSkin(): void {
    const { skinNodes, positions, values } = this;
    const { geometry } = this.skin;
    const [position, normal, value] = ["position", "normal", "value"].map((name) => geometry.getAttribute(name) as BufferAttribute);
    const [x, v] = [position.array as Float32Array, value.array as Float32Array];
    const n = this.drawn.nodes;
    for (let i = 0; i < skinNodes.length; ++i) {
      for (let d = 0; d < 3; ++d) x[3 * i + d] = positions[d * n + skinNodes[i]];
      v[i] = values ? values[skinNodes[i]] : 0;
    }
    addNormals(x, geometry.getIndex()!.array, (normal.array as Float32Array).fill(0));
    position.needsUpdate = normal.needsUpdate = value.needsUpdate = true;
  }

  private updateCap(): void {
    if (!this.section) return;
    const { geometry } = this.cap;
    const count = this.section.weight.length;
    geometry.dispose();
    geometry.setAttribute("position", new BufferAttribute(this.section.points, 3));
    for (const [name, nodal] of [["value", this.values], ["infarct", this.infarct]] as const)
      geometry.setAttribute(name, new BufferAttribute(nodal ? atPoints(this.section, nodal) : new Float32Array(count), 1));
    geometry.setAttribute("normal", new BufferAttribute(new Float32Array(3 * count), 3));
    geometry.setAttribute("chosen", new BufferAttribute(new Float32Array(count), 1));
    geometry.setIndex(this.section.triangles);
    geometry.boundingSphere = new Sphere(new Vector3(), 1e4);
  }

  /** Outlines the region of that number; without `region` none. */
  outline(region: Int16Array | undefined, index: number): void {
    for (const { material: { uniforms } } of this.surfaces) uniforms.choosing.value = region ? 1 : 0;
    if (!region) return;
    this.mark(this.skin.geometry, this.cells, region, index);
    if (this.section) this.mark(this.cap.geometry, this.section.cells, region, index);
  }

  /** `cells`: behind each triangle. */
  private mark(geometry: BufferGeometry, cells: number[], region: Int16Array, index: number): void {
    const chosen = geometry.getAttribute("chosen") as BufferAttribute;
    (chosen.array as Float32Array).fill(0);
    const corners = geometry.getIndex()!.array;
    cells.forEach((cell, t) => {
      if (region[cell] === index) for (let k = 3 * t; k < 3 * t + 3; ++k) chosen.setX(corners[k], 1);
    });
    chosen.needsUpdate = true;
  }

  /** The wall's cell behind a triangle of one of the surfaces. */
  cellAt(surface: object, triangle: number): number {
    return surface === this.cap ? this.section!.cells[triangle] : this.cells[triangle];
  }
}

/** 256 colours as a texture. */
export function textureOf(table: number[][]): Texture {
  const map = new DataTexture(Uint8Array.from(table.flatMap((rgb) => [...rgb, 255])), 256, 1, RGBAFormat);
  map.magFilter = map.minFilter = LinearFilter;
  map.needsUpdate = true;
  return map;
}
