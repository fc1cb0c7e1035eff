// The wall in 3-D: surface, section, fibres; coloured by a quantity; regions can be picked.
import {
  BufferAttribute, BufferGeometry, DataTexture, DynamicDrawUsage, LinearFilter, LineBasicMaterial, LineSegments, Mesh,
  PerspectiveCamera, Raycaster, RGBAFormat, Scene, ShaderMaterial, Sphere, Vector2, Vector3, Vector4, WebGLRenderer, DoubleSide,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { colourTable, type Scale } from "./colours.ts";
import type { Scheme, Selection, Series, Wall } from "./data.ts";
import type { Fibres } from "./fibres.ts";
import { atPoints, cutWall, type Plane, type Section } from "./section.ts";
import type { Cut } from "./shared.ts";

const vertexShader = `
attribute float value;
attribute float chosen;
varying float v; varying float c; varying vec3 place; varying vec3 n; varying vec3 eye;
void main() {
  v = value; c = chosen; place = position; n = normalMatrix * normal;
  vec4 e = modelViewMatrix * vec4(position, 1.0);
  eye = e.xyz;
  gl_Position = projectionMatrix * e;
}`;
const fragmentShader = `
uniform sampler2D map; uniform vec2 range; uniform vec4 plane; uniform float choosing; uniform float plain; uniform float flatLight;
varying float v; varying float c; varying vec3 place; varying vec3 n; varying vec3 eye;
void main() {
  if (dot(plane.xyz, place) > plane.w) discard;
  vec3 colour = texture2D(map, vec2(clamp((v - range.x) / (range.y - range.x), 0.0, 1.0) * 0.99609375 + 0.001953125, 0.5)).rgb;
  colour = mix(colour, vec3(0.80, 0.62, 0.58), plain);
  if (flatLight < 0.5) colour *= 0.5 + 0.5 * abs(dot(normalize(n), normalize(eye)));
  colour = mix(colour, vec3(0.93), choosing * (1.0 - step(0.5, c)) * 0.72);
  gl_FragColor = vec4(colour, 1.0);
}`;

export interface Picked { cell: number; value: number; at: Vector3 }

function dynamic(size: number, width: number): BufferAttribute {
  return new BufferAttribute(new Float32Array(size * width), width).setUsage(DynamicDrawUsage);
}

export function planeOf(cut: Cut): Plane | undefined {
  if (cut.kind === "none") return undefined;
  if (cut.kind === "short") return { normal: [0, 0, 1], offset: cut.height };
  const a = (cut.angle * Math.PI) / 180;
  return { normal: [-Math.sin(a), Math.cos(a), 0], offset: 0 };
}

export class WallView {
  readonly canvas = document.createElement("canvas");
  readonly camera = new PerspectiveCamera(30, 1, 1, 2000);
  readonly controls: OrbitControls;
  private renderer: WebGLRenderer;
  private scene = new Scene();
  private skin: Mesh<BufferGeometry, ShaderMaterial>;
  private cap: Mesh<BufferGeometry, ShaderMaterial>;
  private sticks: LineSegments;
  private skinNodes: Int32Array;
  private section?: Section;
  private positions!: Float32Array;
  private values?: Float32Array;
  private plane?: Plane;
  private selection?: Selection;
  private waiting = false;
  private slow: boolean;  // no graphics processor
  private atRest = 0;  // timer of the full resolution
  onRender?: () => void;

  /** Throws when the browser has no WebGL. */
  constructor(readonly wall: Wall) {
    this.renderer = new WebGLRenderer({ canvas: this.canvas, preserveDrawingBuffer: true });
    const context = this.renderer.getContext();
    const facts = context.getExtension("WEBGL_debug_renderer_info");
    this.slow = /swiftshader|llvmpipe|software/i.test(facts ? String(context.getParameter(facts.UNMASKED_RENDERER_WEBGL)) : "");
    this.renderer.setClearColor(0xffffff);
    this.skinNodes = Int32Array.from(new Set(wall.skin)).sort();
    this.skin = this.makeSkin();
    this.cap = new Mesh(new BufferGeometry(), this.material(1));
    const stickMaterial = new LineBasicMaterial({ color: 0x101010 });
    this.sticks = new LineSegments(new BufferGeometry(), stickMaterial);
    for (const object of [this.skin, this.cap, this.sticks]) object.frustumCulled = false;
    this.scene.add(this.skin, this.cap, this.sticks);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enablePan = false;
    this.controls.addEventListener("change", () => this.render());
    this.canvas.tabIndex = 0;
    this.canvas.addEventListener("keydown", (event) => this.turnByKey(event));
    new ResizeObserver(() => this.resize()).observe(this.canvas);
    const z = this.wall.undeformed.subarray(2 * wall.nodes);
    this.controls.target.set(0, 0, 0.5 * z.reduce((a, b) => Math.min(a, b), 0));
    this.look(90, 12);
  }

  private material(flatLight: number): ShaderMaterial {
    return new ShaderMaterial({ vertexShader, fragmentShader, side: DoubleSide, uniforms: {
      map: { value: null }, range: { value: new Vector2(0, 1) }, plane: { value: new Vector4(0, 0, 0, 1) },
      choosing: { value: 0 }, plain: { value: 0 }, flatLight: { value: flatLight } } });
  }

  private makeSkin(): Mesh<BufferGeometry, ShaderMaterial> {
    const { wall, skinNodes } = this;
    const place = new Map<number, number>();
    skinNodes.forEach((node, i) => place.set(node, i));
    const corners = Int32Array.from(wall.skin, (node) => place.get(node)!);
    const index: number[] = [];
    const n = wall.nodesPerFace;
    for (let f = 0; f < corners.length; f += n) {
      index.push(corners[f], corners[f + 1], corners[f + 2]);
      if (n === 4) index.push(corners[f], corners[f + 2], corners[f + 3]);
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", dynamic(skinNodes.length, 3));
    geometry.setAttribute("normal", dynamic(skinNodes.length, 3));
    geometry.setAttribute("value", dynamic(skinNodes.length, 1));
    geometry.setAttribute("chosen", dynamic(skinNodes.length, 1));
    geometry.setIndex(index);
    geometry.boundingSphere = new Sphere(new Vector3(), 1e4);
    return new Mesh(geometry, this.material(0));
  }

  /** The camera at an azimuth from x towards y and an elevation [degrees]. */
  look(azimuth: number, elevation: number): void {
    const [a, e] = [azimuth, elevation].map((angle) => (angle * Math.PI) / 180);
    const distance = 225;
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e))
      .multiplyScalar(distance).add(this.controls.target);
    this.controls.update();
    this.render();
  }

  private turnByKey(event: KeyboardEvent): void {
    const turn: Record<string, [number, number]> = { ArrowLeft: [-10, 0], ArrowRight: [10, 0], ArrowUp: [0, 10], ArrowDown: [0, -10] };
    if (!turn[event.key]) return;
    event.preventDefault();
    const arm = this.camera.position.clone().sub(this.controls.target);
    const degrees = 180 / Math.PI;
    const elevation = Math.asin(arm.z / arm.length()) * degrees + turn[event.key][1];
    this.look(Math.atan2(arm.y, arm.x) * degrees + turn[event.key][0], Math.min(88, Math.max(-88, elevation)));
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.render();
  }

  /** The wall at a frame; `series` colours it, M if it is an array. */
  show(frame: number, field: Series | Float32Array | undefined, scale: Scale, cut: Cut, fibres: Fibres | undefined): void {
    this.positions = this.wall.positions(frame);
    this.values = field instanceof Float32Array ? field : field?.addTo(new Float32Array(this.wall.nodes), frame);
    this.plane = planeOf(cut);
    this.updateSkin();
    this.updateCap();
    this.updateSticks(fibres);
    const table = colourTable(scale);
    const map = new DataTexture(Uint8Array.from(table.flatMap((rgb) => [...rgb, 255])), 256, 1, RGBAFormat);
    map.magFilter = map.minFilter = LinearFilter;
    map.needsUpdate = true;
    for (const { material } of [this.skin, this.cap]) {
      material.uniforms.map.value?.dispose();
      material.uniforms.map.value = map;
      material.uniforms.range.value.set(scale.min, scale.max);
      material.uniforms.plain.value = this.values ? 0 : 1;
    }
    const plane = this.plane;
    this.skin.material.uniforms.plane.value.set(...(plane ? [...plane.normal, plane.offset] : [0, 0, 0, 1]) as [number, number, number, number]);
    this.choose(this.selection);
  }

  private updateSkin(): void {
    const { geometry } = this.skin;
    const position = geometry.getAttribute("position") as BufferAttribute;
    const value = geometry.getAttribute("value") as BufferAttribute;
    const n = this.wall.nodes;
    this.skinNodes.forEach((node, i) => {
      position.setXYZ(i, this.positions[node], this.positions[n + node], this.positions[2 * n + node]);
      value.setX(i, this.values ? this.values[node] : 0);
    });
    position.needsUpdate = value.needsUpdate = true;
    geometry.computeVertexNormals();
  }

  private updateCap(): void {
    this.cap.visible = this.plane !== undefined;
    this.section = this.plane && cutWall(this.wall, this.positions, this.plane);
    if (!this.section) return;
    const { geometry } = this.cap;
    const count = this.section.weight.length;
    geometry.dispose();
    geometry.setAttribute("position", new BufferAttribute(this.section.points, 3));
    geometry.setAttribute("value", new BufferAttribute(this.values ? atPoints(this.section, this.values) : new Float32Array(count), 1));
    geometry.setAttribute("normal", new BufferAttribute(new Float32Array(3 * count), 3));
    geometry.setAttribute("chosen", new BufferAttribute(new Float32Array(count), 1));
    geometry.setIndex(this.section.triangles);
    geometry.boundingSphere = new Sphere(new Vector3(), 1e4);
  }

  /** Fibres every few millimetres on the surfaces and on the section, a little before them: their part in the surface. */
  private updateSticks(fibres: Fibres | undefined): void {
    this.sticks.visible = fibres !== undefined;
    if (!fibres) return;
    const ends: number[] = [];
    const n = this.wall.nodes;
    const half = 1.6;
    const before = 0.35;
    const add = (x: number[], normal: number[], cell: number) => {
      const fibre = fibres.direction(this.positions, cell);
      const out = fibre[0] * normal[0] + fibre[1] * normal[1] + fibre[2] * normal[2];
      const f = fibre.map((v, d) => v - out * normal[d]);
      for (const side of [-half, half]) for (let d = 0; d < 3; ++d) ends.push(x[d] + before * normal[d] + side * f[d]);
    };
    const perFace = this.wall.nodesPerFace;
    const faces = this.wall.skinCells.length;
    const every = Math.max(1, Math.round(faces / 6000));
    for (let f = 0; f < faces; f += every) {
      const nodes = this.wall.skin.subarray(perFace * f, perFace * (f + 1));
      const corner = (i: number) => [0, 1, 2].map((d) => this.positions[d * n + nodes[i]]);
      const x = [0, 1, 2].map((d) => nodes.reduce((sum, node) => sum + this.positions[d * n + node], 0) / perFace);
      if (this.plane && x[0] * this.plane.normal[0] + x[1] * this.plane.normal[1] + x[2] * this.plane.normal[2] > this.plane.offset) continue;
      const [a, b, c] = [corner(0), corner(1), corner(2)];
      const u = a.map((v, d) => b[d] - v);
      const w = a.map((v, d) => c[d] - v);
      const normal = [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]];
      const length = Math.hypot(...normal) || 1;
      add(x, normal.map((v) => v / length), this.wall.skinCells[f]);
    }
    this.section?.polygons.forEach((corners, i) => {
      const x = [0, 1, 2].map((d) => corners.reduce((sum, p) => sum + this.section!.points[3 * p + d], 0) / corners.length);
      add(x, this.plane!.normal, this.section!.polygonCells[i]);
    });
    this.sticks.geometry.dispose();
    this.sticks.geometry.setAttribute("position", new BufferAttribute(Float32Array.from(ends), 3));
  }

  /** Fades all but one region. */
  choose(selection: Selection | undefined): void {
    this.selection = selection;
    const region = selection && this.wall.region(selection.scheme);
    for (const { material } of [this.skin, this.cap]) material.uniforms.choosing.value = region ? 1 : 0;
    if (region) {
      const index = selection!.index;
      this.mark(this.skin.geometry, this.wall.skinCells, this.wall.nodesPerFace === 4 ? 2 : 1, region, index);
      if (this.section) this.mark(this.cap.geometry, this.section.cells, 1, region, index);
    }
    this.render();
  }

  private mark(geometry: BufferGeometry, cells: ArrayLike<number>, trianglesPerCell: number, region: Int16Array, index: number): void {
    const chosen = geometry.getAttribute("chosen") as BufferAttribute;
    (chosen.array as Float32Array).fill(0);
    const corners = geometry.getIndex()!.array;
    for (let i = 0; i < cells.length; ++i)
      if (region[cells[i]] === index)
        for (let k = 3 * trianglesPerCell * i; k < 3 * trianglesPerCell * (i + 1); ++k) chosen.setX(corners[k], 1);
    chosen.needsUpdate = true;
  }

  /** What lies under a point of the canvas. */
  pick(event: PointerEvent): Picked | undefined {
    const bounds = this.canvas.getBoundingClientRect();
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2(((event.clientX - bounds.left) / bounds.width) * 2 - 1,
      1 - ((event.clientY - bounds.top) / bounds.height) * 2), this.camera);
    const cut = this.plane && new Vector3(...this.plane.normal);
    const hits = ray.intersectObjects(this.cap.visible ? [this.skin, this.cap] : [this.skin])
      .filter((hit) => hit.object === this.cap || !cut || cut.dot(hit.point) <= this.plane!.offset);
    const hit = hits[0];
    if (!hit) return undefined;
    const mesh = hit.object as Mesh<BufferGeometry>;
    const triangle = hit.faceIndex!;
    const cell = mesh === this.cap ? this.section!.cells[triangle]
      : this.wall.skinCells[this.wall.nodesPerFace === 4 ? triangle >> 1 : triangle];
    const value = mesh.geometry.getAttribute("value");
    const { a, b, c } = hit.face!;
    return { cell, at: hit.point, value: this.values ? (value.getX(a) + value.getX(b) + value.getX(c)) / 3 : NaN };
  }

  region(cell: number, scheme: Scheme): number | undefined { return this.wall.region(scheme)?.[cell]; }

  /** With a share of the screen's resolution. */
  private draw(share: number): void {
    const ratio = Math.min(share * devicePixelRatio, 3);
    if (this.renderer.getPixelRatio() !== ratio) this.renderer.setPixelRatio(ratio);
    this.renderer.render(this.scene, this.camera);
  }

  /** Draws at the next frame of the screen. */
  render(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      // finer at rest than in motion; edges are smoothed by drawing finer than the screen where that is cheap
      this.draw(this.slow ? 0.5 : 1);
      clearTimeout(this.atRest);
      this.atRest = window.setTimeout(() => this.draw(this.slow ? 1 : 2), 200);
      this.onRender?.();
    });
  }
}
