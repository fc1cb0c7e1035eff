// The wall in 3-D: surface, section, fibres; coloured by a quantity; regions can be picked.
import {
  BufferAttribute, BufferGeometry, Color, DataTexture, DynamicDrawUsage, LinearFilter, LineBasicMaterial, LineSegments, Mesh,
  OrthographicCamera, Raycaster, RGBAFormat, Scene, ShaderMaterial, Sphere, Vector2, Vector3, Vector4, WebGLRenderer, DoubleSide,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { colourTable, type Rgb, type Scale, uncoloured } from "./colours.ts";
import type { Scheme, Selection, Series, Wall } from "./data.ts";
import { DrawnWall } from "./curved.ts";
import type { Fibres } from "./fibres.ts";
import { atPoints, cutWall, type Plane, type Section } from "./section.ts";
import { type Heart, marked, unit, walls } from "./orientation.ts";
import type { Cut } from "./shared.ts";

const vertexShader = `
attribute float value;
attribute float chosen;
varying float v; varying float c; varying vec3 place; varying vec3 n;
void main() {
  v = value; c = chosen; place = position; n = normalMatrix * normal;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;
// A chosen region has c = 1 at all its corners, so its border is where c falls below 1: a dark line there with a light one around it.
const fragmentShader = `
uniform sampler2D map; uniform vec2 range; uniform vec2 none; uniform vec3 uncoloured; uniform vec4 plane; uniform float choosing;
uniform float plain; uniform float flatLight; uniform float pixel;
varying float v; varying float c; varying vec3 place; varying vec3 n;
void main() {
  if (dot(plane.xyz, place) > plane.w) discard;
  vec3 colour = texture2D(map, vec2(clamp((v - range.x) / (range.y - range.x), 0.0, 1.0) * 0.99609375 + 0.001953125, 0.5)).rgb;
  if (abs(v - none.x) < none.y) colour = uncoloured;
  colour = mix(colour, vec3(0.80, 0.62, 0.58), plain);
  if (flatLight < 0.5) colour *= 0.55 + 0.45 * abs(normalize(n).z);
  float away = (1.0 - c) / max(fwidth(c), 1e-6) / pixel;
  if (choosing > 0.5 && c < 0.9999) {
    if (away < 2.5) colour = vec3(0.0);
    else if (away < 4.0) colour = vec3(1.0);
  }
  gl_FragColor = vec4(colour, 1.0);
}`;

export interface Picked { cell: number; value: number; at: Vector3 }

function dynamic(size: number, width: number): BufferAttribute {
  return new BufferAttribute(new Float32Array(size * width), width).setUsage(DynamicDrawUsage);
}

function planeOf(cut: Cut, heart: Heart): Plane | undefined {
  if (cut.kind === "none") return undefined;
  if (cut.kind === "short") return { normal: [0, 0, 1], offset: cut.height };
  const [x, y] = unit(heart.septum + cut.angle);
  return { normal: [-y, x, 0], offset: 0 };
}

const turned = ({ normal: [x, y, z], offset }: Plane): Plane => ({ normal: [-x, -y, -z], offset: -offset });

/** A letter of the picture, in pixels of the screen from its upper left corner. */
export interface Letter { name: string; label: string; x: number; y: number; seen: boolean }

export class WallView {
  readonly canvas = document.createElement("canvas");
  readonly camera = new OrthographicCamera(-1, 1, 1, -1, 1, 2000);
  readonly controls: OrbitControls;
  private renderer: WebGLRenderer;
  private scene = new Scene();
  private skin: Mesh<BufferGeometry, ShaderMaterial>;
  private cap: Mesh<BufferGeometry, ShaderMaterial>;
  private sticks: LineSegments;
  private drawn: DrawnWall;
  private skinNodes: Int32Array;
  private section?: Section;
  private undrawn!: Float32Array;    // positions of the wall's own nodes
  private positions!: Float32Array;  // and of all that are drawn
  private values?: Float32Array;
  private plane?: Plane;
  private cut: Cut = { kind: "none", angle: 0, height: 0 };
  private fibres?: Fibres;
  private reach: { radius: number; bottom: number; top: number };  // of the wall about the long axis, at all moments [mm]
  private lowest = 0;  // of the wall, at the moment that is shown [mm]
  private selection?: Selection;
  private waiting = false;
  private slow: boolean;  // no graphics processor
  private atRest = 0;  // timer of the full resolution
  private colours?: Rgb[];
  onRender?: () => void;

  /** Throws when the browser has no WebGL. */
  constructor(readonly wall: Wall, readonly heart: Heart) {
    this.renderer = new WebGLRenderer({ canvas: this.canvas, preserveDrawingBuffer: true });
    const context = this.renderer.getContext();
    const facts = context.getExtension("WEBGL_debug_renderer_info");
    this.slow = /swiftshader|llvmpipe|software/i.test(facts ? String(context.getParameter(facts.UNMASKED_RENDERER_WEBGL)) : "");
    this.drawn = new DrawnWall(wall);
    this.skinNodes = Int32Array.from(new Set(this.drawn.skin)).sort();
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
    this.reach = this.furthest();
    this.controls.target.set(0, 0, 0.5 * (this.reach.bottom + this.reach.top));
  }

  private furthest(): WallView["reach"] {
    const { nodes: n, times } = this.wall;
    const reach = { radius: 0, bottom: 0, top: 0 };
    for (const frame of new Set([0, times.length >> 1, times.length - 1])) {
      const x = this.wall.positions(frame);
      for (let a = 0; a < n; ++a) {
        reach.radius = Math.max(reach.radius, Math.hypot(x[a], x[n + a]));
        reach.bottom = Math.min(reach.bottom, x[2 * n + a]);
        reach.top = Math.max(reach.top, x[2 * n + a]);
      }
    }
    return reach;
  }

  private material(flatLight: number): ShaderMaterial {
    return new ShaderMaterial({ vertexShader, fragmentShader, side: DoubleSide, uniforms: {
      map: { value: null }, range: { value: new Vector2(0, 1) }, plane: { value: new Vector4(0, 0, 0, 1) },
      none: { value: new Vector2(0, 0) }, uncoloured: { value: new Vector3(...uncoloured).divideScalar(255) }, pixel: { value: 1 },
      choosing: { value: 0 }, plain: { value: 0 }, flatLight: { value: flatLight } } });
  }

  private makeSkin(): Mesh<BufferGeometry, ShaderMaterial> {
    const { drawn, skinNodes } = this;
    const place = new Map<number, number>();
    skinNodes.forEach((node, i) => place.set(node, i));
    const corners = Int32Array.from(drawn.skin, (node) => place.get(node)!);
    const index: number[] = [];
    const n = drawn.wall.nodesPerFace;
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

  /** The camera at an azimuth from the septum, anticlockwise seen from the base, and an elevation [degrees]. */
  look(azimuth: number, elevation: number): void {
    const [x, y] = unit(this.heart.septum + azimuth);
    const [across, up] = unit(elevation);
    const distance = 500;
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(across * x, across * y, up).multiplyScalar(distance).add(this.controls.target);
    this.controls.update();
    this.render();
  }

  private get azimuth(): number {
    return (Math.atan2(this.camera.position.y, this.camera.position.x) * 180) / Math.PI - this.heart.septum;
  }

  private get elevation(): number {
    const arm = this.camera.position.clone().sub(this.controls.target);
    return (Math.asin(arm.z / arm.length()) * 180) / Math.PI;
  }

  /** Takes the place of another view's camera about its own heart. */
  copy(other: WallView): void {
    const off = Math.abs(Math.sin(((other.azimuth - this.azimuth) * Math.PI) / 360)) + Math.abs(other.elevation - this.elevation);
    if (off < 1e-4 && this.camera.zoom === other.camera.zoom) return;
    this.camera.zoom = other.camera.zoom;
    this.camera.updateProjectionMatrix();
    this.look(other.azimuth, other.elevation);
  }

  private turnByKey(event: KeyboardEvent): void {
    const turn: Record<string, [number, number]> = { ArrowLeft: [-10, 0], ArrowRight: [10, 0], ArrowUp: [0, 10], ArrowDown: [0, -10] };
    if (!turn[event.key]) return;
    event.preventDefault();
    const [across, up] = turn[event.key];
    this.look(this.azimuth + across, Math.min(89.9, Math.max(-89.9, this.elevation + up)));
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    this.renderer.setSize(width, height, false);
    // room for letters around the wall, for the caption above and the apex below it
    const { radius, bottom, top } = this.reach;
    const [above, below] = [84, 22];  // [pixels]
    const across = 2 * (radius + 16);
    const mm = Math.max(Math.max(top - bottom + 8, across) / Math.max(height - above - below, 1), across / width);  // a pixel
    const [half, lower] = [0.5 * mm * height, 0.5 * mm * (above - below)];
    Object.assign(this.camera, { left: -0.5 * mm * width, right: 0.5 * mm * width, top: half + lower, bottom: lower - half });
    this.camera.updateProjectionMatrix();
    this.render();
  }

  /** Pixels of the screen a millimetre. */
  get scale(): number { return (this.camera.zoom * this.canvas.clientHeight) / (this.camera.top - this.camera.bottom); }

  /** The walls' letters around the base, or around the plane of a short axis, and an apex or a base that was assumed. One in line
   * with the eye is not seen. */
  letters(): Letter[] {
    const height = this.cut.kind === "short" ? this.cut.height : this.reach.top + 5;
    const { clientWidth: width, clientHeight } = this.canvas;
    this.camera.updateMatrixWorld();
    const eye = this.camera.getWorldDirection(new Vector3());
    const letter = (name: string, label: string, place: Vector3, direction: Vector3): Letter => {
      const at = place.project(this.camera);
      return { name, label, x: 0.5 * (1 + at.x) * width, y: 0.5 * (1 - at.y) * clientHeight, seen: Math.abs(eye.dot(direction)) < 0.8 };
    };
    const up = new Vector3(0, 0, 1);
    const ends: Record<string, number> = { apex: this.lowest - 5, base: this.reach.top + 4 };
    return [...walls.map(([name, angle]) => {
      const [x, y] = unit(this.heart.septum + angle);
      const direction = new Vector3(x, y, 0);
      return letter(name, marked(name, this.heart.assumed), direction.clone().multiplyScalar(this.reach.radius + 7).setZ(height), direction);
    }), ...this.heart.ends.map((end) => letter(end, `${end}*`, new Vector3(0, 0, ends[end]), up))];
  }

  /** Paper behind the wall. */
  background(colour: string): void {
    this.renderer.setClearColor(colour);
    this.render();
  }

  /** What is thrown away lies before the plane: its normal points to the eye. */
  private get facing(): Plane | undefined {
    const { plane } = this;
    if (!plane) return undefined;
    const arm = this.camera.position.clone().sub(this.controls.target);
    return arm.dot(new Vector3(...plane.normal)) < 0 ? turned(plane) : plane;
  }

  /** The wall at a frame; `series` colours it, M if it is an array. */
  show(frame: number, field: Series | Float32Array | undefined, scale: Scale, cut: Cut, fibres: Fibres | undefined): void {
    this.undrawn = this.wall.positions(frame);
    this.lowest = this.undrawn.subarray(2 * this.wall.nodes).reduce((a, b) => Math.min(a, b), 0);
    this.cut = cut;
    this.plane = planeOf(cut, this.heart);
    this.fibres = fibres;
    if (this.plane) ({ section: this.section, positions: this.positions } = cutWall(this.drawn, this.undrawn, this.plane));
    else [this.section, this.positions] = [undefined, this.drawn.at(this.undrawn, 3)];
    const values = field instanceof Float32Array ? field : field?.addTo(new Float32Array(this.wall.nodes), frame);
    this.values = values && this.drawn.at(values);
    this.updateSkin();
    this.updateCap();
    this.turnPlane();
    this.takeColours(colourTable(scale));
    for (const { material } of [this.skin, this.cap]) {
      material.uniforms.range.value.set(scale.min, scale.max);
      material.uniforms.none.value.set(scale.middle, scale.floor);
      material.uniforms.plain.value = this.values ? 0 : 1;
    }
    this.choose(this.selection);
  }

  private takeColours(table: Rgb[]): void {
    if (table === this.colours) return;
    this.colours = table;
    const map = new DataTexture(Uint8Array.from(table.flatMap((rgb) => [...rgb, 255])), 256, 1, RGBAFormat);
    map.magFilter = map.minFilter = LinearFilter;
    map.needsUpdate = true;
    for (const { material } of [this.skin, this.cap]) {
      material.uniforms.map.value?.dispose();
      material.uniforms.map.value = map;
    }
  }

  /** Follows the camera with the side of the plane that is seen. */
  private turnPlane(): void {
    this.plane = this.facing;
    const { plane } = this;
    this.skin.material.uniforms.plane.value.set(...(plane ? [...plane.normal, plane.offset] : [0, 0, 0, 1]) as [number, number, number, number]);
    this.updateSticks(this.fibres);
  }

  private updateSkin(): void {
    const { geometry } = this.skin;
    const position = geometry.getAttribute("position") as BufferAttribute;
    const value = geometry.getAttribute("value") as BufferAttribute;
    const n = this.drawn.nodes;
    this.skinNodes.forEach((node, i) => {
      position.setXYZ(i, this.positions[node], this.positions[n + node], this.positions[2 * n + node]);
      value.setX(i, this.values ? this.values[node] : 0);
    });
    position.needsUpdate = value.needsUpdate = true;
    geometry.computeVertexNormals();
  }

  private updateCap(): void {
    this.cap.visible = this.plane !== undefined;
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
    const n = this.drawn.nodes;
    const half = 1.6;
    const before = 0.35;
    const add = (x: number[], normal: number[], cell: number) => {
      const fibre = fibres.direction(this.undrawn, cell);
      const out = fibre[0] * normal[0] + fibre[1] * normal[1] + fibre[2] * normal[2];
      const f = fibre.map((v, d) => v - out * normal[d]);
      for (const side of [-half, half]) for (let d = 0; d < 3; ++d) ends.push(x[d] + before * normal[d] + side * f[d]);
    };
    const { skin, skinCells, facesPerFace } = this.drawn;
    const perFace = this.wall.nodesPerFace;
    const every = facesPerFace * Math.max(1, Math.round(skinCells.length / facesPerFace / 6000));
    for (let f = 0; f < skinCells.length; f += every) {
      const nodes = skin.subarray(perFace * f, perFace * (f + 1));
      const corner = (i: number) => [0, 1, 2].map((d) => this.positions[d * n + nodes[i]]);
      const x = [0, 1, 2].map((d) => nodes.reduce((sum, node) => sum + this.positions[d * n + node], 0) / perFace);
      if (this.plane && x[0] * this.plane.normal[0] + x[1] * this.plane.normal[1] + x[2] * this.plane.normal[2] > this.plane.offset) continue;
      const [a, b, c] = [corner(0), corner(1), corner(2)];
      const u = a.map((v, d) => b[d] - v);
      const w = a.map((v, d) => c[d] - v);
      const normal = [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]];
      const length = Math.hypot(...normal) || 1;
      add(x, normal.map((v) => v / length), skinCells[f]);
    }
    const seen = new Set<number>();  // cells, one stick each
    this.section?.polygons.forEach((corners, i) => {
      const cell = this.section!.polygonCells[i];
      if (seen.has(cell)) return;
      seen.add(cell);
      const x = [0, 1, 2].map((d) => corners.reduce((sum, p) => sum + this.section!.points[3 * p + d], 0) / corners.length);
      add(x, this.plane!.normal, cell);
    });
    this.sticks.geometry.dispose();
    this.sticks.geometry.setAttribute("position", new BufferAttribute(Float32Array.from(ends), 3));
  }

  /** Outlines one region. */
  choose(selection: Selection | undefined): void {
    this.selection = selection;
    const region = selection && this.wall.region(selection.scheme);
    for (const { material } of [this.skin, this.cap]) material.uniforms.choosing.value = region ? 1 : 0;
    if (region) {
      const index = selection!.index;
      this.mark(this.skin.geometry, this.drawn.skinCells, this.wall.nodesPerFace === 4 ? 2 : 1, region, index);
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
      : this.drawn.skinCells[this.wall.nodesPerFace === 4 ? triangle >> 1 : triangle];
    const value = mesh.geometry.getAttribute("value");
    const { a, b, c } = hit.face!;
    return { cell, at: hit.point, value: this.values ? (value.getX(a) + value.getX(b) + value.getX(c)) / 3 : NaN };
  }

  region(cell: number, scheme: Scheme): number | undefined { return this.wall.region(scheme)?.[cell]; }

  /** A copy of the picture on white paper, finer than the screen. */
  painted(): HTMLCanvasElement {
    const [colour, copy] = [this.renderer.getClearColor(new Color()), document.createElement("canvas")];
    this.renderer.setClearColor(0xffffff);
    this.draw(2);
    [copy.width, copy.height] = [this.canvas.width, this.canvas.height];
    copy.getContext("2d")!.drawImage(this.canvas, 0, 0);
    this.renderer.setClearColor(colour);
    this.render();
    return copy;
  }

  /** With a share of the screen's resolution. */
  private draw(share: number): void {
    const ratio = Math.min(share * devicePixelRatio, 3);
    if (this.renderer.getPixelRatio() !== ratio) this.renderer.setPixelRatio(ratio);
    for (const { material } of [this.skin, this.cap]) material.uniforms.pixel.value = ratio;
    this.renderer.render(this.scene, this.camera);
  }

  /** Draws at the next frame of the screen. */
  render(): void {
    if (this.waiting) return;
    this.waiting = true;
    this.canvas.dataset.at = "motion";
    requestAnimationFrame(() => {
      this.waiting = false;
      if (this.plane && this.facing !== this.plane) this.turnPlane();
      // finer at rest than in motion; edges are smoothed by drawing finer than the screen where that is cheap
      this.draw(this.slow ? 0.5 : 1);
      clearTimeout(this.atRest);
      this.atRest = window.setTimeout(() => {
        this.draw(this.slow ? 1 : 2);
        this.canvas.dataset.at = "rest";
      }, 200);
      this.onRender?.();
    });
  }
}
