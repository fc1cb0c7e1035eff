// The wall in 3-D: surface, section, fibres; coloured by a quantity; regions can be picked.
import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments, type Mesh, OrthographicCamera, Raycaster, Scene, type Texture, Vector2, Vector3,
  WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { colourTable, type Rgb, type Scale } from "./colours.ts";
import type { Scheme, Selection, Series, Wall } from "./data.ts";
import type { Fibres } from "./fibres.ts";
import type { Plane } from "./section.ts";
import { type Direction, type Heart, marked, unit, walls } from "./orientation.ts";
import type { Cut } from "./shared.ts";
import { type Shape, textureOf, WallBody } from "./wall_body.ts";

export interface Picked { cell: number; value: number; at: Vector3 }

function planeOf(cut: Cut, heart: Heart): Plane | undefined {
  if (cut.kind === "none") return undefined;
  if (cut.kind === "short") return { normal: [0, 0, 1], offset: cut.height };
  const [x, y] = unit(heart.septum + cut.angle);
  return { normal: [-y, x, 0], offset: 0 };
}

const turned = ({ normal: [x, y, z], offset }: Plane): Plane => ({ normal: [-x, -y, -z], offset: -offset });

/** What has to fit into a picture: about the long axis, and along it [mm]. */
export interface Room { radius: number; length: number }

/** What holds each of some walls at all their moments: they are seen at one scale. */
export const roomOf = (walls: Wall[]): Room => ({ radius: Math.max(...walls.map(({ reach }) => reach.radius)),
  length: Math.max(...walls.map(({ reach: { top, bottom } }) => top - bottom)) });

/** A letter of the picture, in pixels of the screen from its upper left corner. */
export interface Letter { name: string; label: string; x: number; y: number; seen: boolean }

export class WallView {
  readonly canvas = document.createElement("canvas");
  readonly camera = new OrthographicCamera(-1, 1, 1, -1, 1, 2000);
  readonly controls: OrbitControls;
  // what follows is there as soon as the wall's arrays are
  private renderer?: WebGLRenderer;
  private scene = new Scene();
  private fine!: WallBody;   // at rest
  private rough?: WallBody;  // in motion, made when it first moves: the same where a graphics processor draws
  private body!: WallBody;   // of these, what is drawn
  private sticks!: LineSegments;
  private shape?: Shape;
  private valueScale!: Scale;
  private plane?: Plane;
  private cut: Cut = { kind: "none", angle: 0, height: 0 };
  private fibres?: Fibres;
  private lowest: number;  // of the wall, at the moment that is shown [mm]
  private selection?: Selection;
  private waiting = false;
  private slow = false;  // no graphics processor
  private atRest = 0;  // timer of the full resolution
  private colours?: { table: Rgb[]; map: Texture };
  private paper = "#fff";
  onRender?: () => void;

  constructor(readonly wall: Wall, readonly heart: Heart, private room: Room) {
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enablePan = false;
    this.controls.addEventListener("change", () => this.render());
    this.canvas.tabIndex = 0;
    this.canvas.addEventListener("keydown", (event) => this.turnByKey(event));
    new ResizeObserver(() => this.resize()).observe(this.canvas);
    this.lowest = wall.reach.bottom;
    this.controls.target.set(0, 0, 0.5 * (wall.reach.bottom + wall.reach.top));
  }

  /** Makes ready to draw, when the wall's arrays are there; false where the browser has no WebGL. */
  begin(): boolean {
    if (this.renderer) return true;
    try {
      this.renderer = new WebGLRenderer({ canvas: this.canvas, preserveDrawingBuffer: true });
    } catch {
      return false;
    }
    this.prepare(this.renderer);
    return true;
  }

  private prepare(renderer: WebGLRenderer): void {
    const context = renderer.getContext();
    const facts = context.getExtension("WEBGL_debug_renderer_info");
    this.slow = /swiftshader|llvmpipe|software/i.test(facts ? String(context.getParameter(facts.UNMASKED_RENDERER_WEBGL)) : "");
    this.fine = new WallBody(this.wall, false);
    this.body = this.fine;
    this.sticks = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color: 0x101010 }));
    this.sticks.frustumCulled = false;
    this.scene.add(this.fine.group, this.sticks);
    renderer.setClearColor(this.paper);
    renderer.setSize(this.canvas.clientWidth, this.canvas.clientHeight, false);
  }

  private inMotion(): WallBody {
    if (!this.rough) {
      this.rough = this.slow ? new WallBody(this.wall, true) : this.fine;
      this.scene.add(this.rough.group);
    }
    return this.rough;
  }

  /** Puts the camera there. */
  look({ azimuth, elevation }: Direction): void {
    const [x, y] = unit(this.heart.septum + azimuth);
    const [across, up] = unit(elevation);
    const distance = 500;
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(across * x, across * y, up).multiplyScalar(distance).add(this.controls.target);
    this.controls.update();
    this.render();
  }

  /** Where the camera stands. */
  get direction(): Direction {
    const arm = this.camera.position.clone().sub(this.controls.target);
    return { azimuth: (Math.atan2(arm.y, arm.x) * 180) / Math.PI - this.heart.septum, elevation: (Math.asin(arm.z / arm.length()) * 180) / Math.PI };
  }

  /** Takes the place of another view's camera about its own heart. */
  copy(other: WallView): void {
    const [here, there] = [this.direction, other.direction];
    const off = Math.abs(Math.sin(((there.azimuth - here.azimuth) * Math.PI) / 360)) + Math.abs(there.elevation - here.elevation);
    if (off < 1e-4 && this.camera.zoom === other.camera.zoom) return;
    this.camera.zoom = other.camera.zoom;
    this.camera.updateProjectionMatrix();
    this.look(there);
  }

  private turnByKey(event: KeyboardEvent): void {
    const turn: Record<string, [number, number]> = { ArrowLeft: [-10, 0], ArrowRight: [10, 0], ArrowUp: [0, 10], ArrowDown: [0, -10] };
    if (!turn[event.key]) return;
    event.preventDefault();
    const [across, up] = turn[event.key];
    const { azimuth, elevation } = this.direction;
    this.look({ azimuth: azimuth + across, elevation: Math.min(89.9, Math.max(-89.9, elevation + up)) });
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    this.renderer?.setSize(width, height, false);
    // room for letters around the wall, for the caption above and the apex below it
    const [above, below] = [98, 22];  // [pixels]
    const across = 2 * (this.room.radius + 16);
    const mm = Math.max(Math.max(this.room.length + 8, across) / Math.max(height - above - below, 1), across / width);  // a pixel
    const [half, lower] = [0.5 * mm * height, 0.5 * mm * (above - below)];
    Object.assign(this.camera, { left: -0.5 * mm * width, right: 0.5 * mm * width, top: half + lower, bottom: lower - half });
    this.camera.updateProjectionMatrix();
    if (!this.shape) this.onRender?.();
    this.render();
  }

  /** Where the picture's middle is, between bottom and top of the reach, in pixels from the canvas's upper left corner. */
  get middle(): [number, number] {
    const { left, right, top, bottom } = this.camera;
    return [(-left / (right - left)) * this.canvas.clientWidth, (top / (top - bottom)) * this.canvas.clientHeight];
  }

  /** Pixels of the screen a millimetre. */
  get scale(): number { return (this.camera.zoom * this.canvas.clientHeight) / (this.camera.top - this.camera.bottom); }

  /** The walls' letters around the base, or around the plane of a short axis, and an apex or a base that was assumed. One in line
   * with the eye is not seen. */
  letters(): Letter[] {
    const height = this.cut.kind === "short" ? this.cut.height : this.wall.reach.top + 5;
    const { clientWidth: width, clientHeight } = this.canvas;
    this.camera.updateMatrixWorld();
    const eye = this.camera.getWorldDirection(new Vector3());
    const letter = (name: string, label: string, place: Vector3, direction: Vector3): Letter => {
      const at = place.project(this.camera);
      return { name, label, x: 0.5 * (1 + at.x) * width, y: 0.5 * (1 - at.y) * clientHeight, seen: Math.abs(eye.dot(direction)) < 0.8 };
    };
    const up = new Vector3(0, 0, 1);
    const ends: Record<string, number> = { apex: this.lowest - 5, base: this.wall.reach.top + 4 + 0.14 * this.wall.reach.radius /* the far rim, seen from a little above */ };
    return [...walls.map(([name, angle]) => {
      const [x, y] = unit(this.heart.septum + angle);
      const direction = new Vector3(x, y, 0);
      return letter(name, marked(name, this.heart.assumed), direction.clone().multiplyScalar(this.wall.reach.radius + 7).setZ(height), direction);
    }), ...this.heart.ends.map((end) => letter(end, `${end}*`, new Vector3(0, 0, ends[end]), up))];
  }

  /** Paper behind the wall. */
  background(colour: string): void {
    this.paper = colour;
    this.renderer?.setClearColor(colour);
    this.render();
  }

  /** What is thrown away lies before the plane: its normal points to the eye. */
  private get facing(): Plane | undefined {
    const { plane } = this;
    if (!plane) return undefined;
    const arm = this.camera.position.clone().sub(this.controls.target);
    return arm.dot(new Vector3(...plane.normal)) < 0 ? turned(plane) : plane;
  }

  /** The wall at a frame; `field` colours it; if it is an array, which is M, the infarct has no border. The first one finely. */
  show(frame: number, field: Series | Float32Array | undefined, scale: Scale, cut: Cut, fibres: Fibres | undefined): void {
    const isFirst = !this.shape;
    const positions = this.wall.positions(frame);
    this.lowest = positions.subarray(2 * this.wall.nodes).reduce((a, b) => Math.min(a, b), 0);
    this.cut = cut;
    this.fibres = fibres;
    const values = field instanceof Float32Array ? field : field?.addTo(new Float32Array(this.wall.nodes), frame);
    this.shape = { positions, values, plane: planeOf(cut, this.heart), isBordered: this.wall.infarct !== undefined && !(field instanceof Float32Array) };
    this.valueScale = scale;
    this.form(isFirst ? this.fine : this.inMotion());
    if (isFirst) this.rest();
    else this.render();
  }

  /** Gives a body the shape that is shown, and draws that body from now on. */
  private form(body: WallBody): void {
    this.body = body;
    for (const one of [this.fine, this.rough]) if (one) one.group.visible = one === body;
    body.show(this.shape!);
    this.takeColours(colourTable(this.valueScale));
    body.colour(this.valueScale, this.colours!.map);
    this.plane = this.shape!.plane;
    this.turnPlane();
    this.outline();
  }

  private takeColours(table: Rgb[]): void {
    if (table === this.colours?.table) return;
    this.colours?.map.dispose();
    this.colours = { table, map: textureOf(table) };
  }

  /** Follows the camera with the side of the plane that is seen. */
  private turnPlane(): void {
    this.plane = this.facing;
    this.body.open(this.plane);
    this.updateSticks(this.fibres);
  }

  /** Fibres every few millimetres on the surfaces and on the section, a little before them: their part in the surface. */
  private updateSticks(fibres: Fibres | undefined): void {
    this.sticks.visible = fibres !== undefined;
    if (!fibres) return;
    const ends: number[] = [];
    const { drawn, positions, section } = this.body;
    const n = drawn.nodes;
    const half = 1.6;
    const before = 0.35;
    const add = (x: number[], normal: number[], cell: number) => {
      const fibre = fibres.direction(this.shape!.positions, cell);
      const out = fibre[0] * normal[0] + fibre[1] * normal[1] + fibre[2] * normal[2];
      const f = fibre.map((v, d) => v - out * normal[d]);
      for (const side of [-half, half]) for (let d = 0; d < 3; ++d) ends.push(x[d] + before * normal[d] + side * f[d]);
    };
    const { skin, skinCells, facesPerFace } = drawn;
    const perFace = this.wall.nodesPerFace;
    const every = facesPerFace * Math.max(1, Math.round(skinCells.length / facesPerFace / 6000));
    for (let f = 0; f < skinCells.length; f += every) {
      const nodes = skin.subarray(perFace * f, perFace * (f + 1));
      const corner = (i: number) => [0, 1, 2].map((d) => positions[d * n + nodes[i]]);
      const x = [0, 1, 2].map((d) => nodes.reduce((sum, node) => sum + positions[d * n + node], 0) / perFace);
      if (this.plane && x[0] * this.plane.normal[0] + x[1] * this.plane.normal[1] + x[2] * this.plane.normal[2] > this.plane.offset) continue;
      const [a, b, c] = [corner(0), corner(1), corner(2)];
      const u = a.map((v, d) => b[d] - v);
      const w = a.map((v, d) => c[d] - v);
      const normal = [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]];
      const length = Math.hypot(...normal) || 1;
      add(x, normal.map((v) => v / length), skinCells[f]);
    }
    const seen = new Set<number>();  // cells, one stick each
    section?.polygons.forEach((corners, i) => {
      const cell = section!.polygonCells[i];
      if (seen.has(cell)) return;
      seen.add(cell);
      const x = [0, 1, 2].map((d) => corners.reduce((sum, p) => sum + section!.points[3 * p + d], 0) / corners.length);
      add(x, this.plane!.normal, cell);
    });
    this.sticks.geometry.dispose();
    this.sticks.geometry.setAttribute("position", new BufferAttribute(Float32Array.from(ends), 3));
  }

  /** Outlines one region. */
  choose(selection: Selection | undefined): void {
    this.selection = selection;
    if (!this.shape) return;
    this.outline();
    this.render(false);
  }

  private outline(): void {
    const region = this.selection && this.wall.region(this.selection.scheme);
    this.body.outline(region, this.selection?.index ?? 0);
  }

  /** What lies under a point of the canvas. */
  pick(event: PointerEvent): Picked | undefined {
    if (!this.shape) return undefined;
    const { body } = this;
    const bounds = this.canvas.getBoundingClientRect();
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2(((event.clientX - bounds.left) / bounds.width) * 2 - 1,
      1 - ((event.clientY - bounds.top) / bounds.height) * 2), this.camera);
    const cut = this.plane && new Vector3(...this.plane.normal);
    const hits = ray.intersectObjects(body.cap.visible ? [body.skin, body.cap] : [body.skin])
      .filter((hit) => hit.object === body.cap || !cut || cut.dot(hit.point) <= this.plane!.offset);
    const hit = hits[0];
    if (!hit) return undefined;
    const value = (hit.object as Mesh<BufferGeometry>).geometry.getAttribute("value");
    const { a, b, c } = hit.face!;
    return { cell: body.cellAt(hit.object, hit.faceIndex!), at: hit.point,
      value: this.shape.values ? (value.getX(a) + value.getX(b) + value.getX(c)) / 3 : NaN };
  }

  region(cell: number, scheme: Scheme): number | undefined { return this.wall.region(scheme)?.[cell]; }

  /** A copy of the picture on white paper, finer than the screen; nothing before there is one. */
  painted(): HTMLCanvasElement | undefined {
    const { renderer } = this;
    if (!renderer || !this.shape) return undefined;
    const copy = document.createElement("canvas");
    renderer.setClearColor(0xffffff);
    if (this.body !== this.fine) this.form(this.fine);
    this.draw(2);
    [copy.width, copy.height] = [this.canvas.width, this.canvas.height];
    copy.getContext("2d")!.drawImage(this.canvas, 0, 0);
    renderer.setClearColor(this.paper);
    this.render(false);
    return copy;
  }

  /** With a share of the screen's resolution. */
  private draw(share: number): void {
    const { renderer } = this;
    if (this.plane && this.facing !== this.plane) this.turnPlane();
    const ratio = Math.min(share * devicePixelRatio, 3);
    if (renderer!.getPixelRatio() !== ratio) renderer!.setPixelRatio(ratio);
    this.body.fineness = ratio;
    renderer!.render(this.scene, this.camera);
  }

  /** Finer than in motion; edges are smoothed by drawing finer than the screen where that is cheap. */
  private rest(): void {
    if (this.body !== this.fine) this.form(this.fine);
    this.draw(this.slow ? 1 : 2);
    this.canvas.dataset.at = "rest";
    this.onRender?.();
  }

  /** Draws at the next frame of the screen; in motion more coarsely until it rests. */
  render(moves = true): void {
    clearTimeout(this.atRest);
    if (this.waiting || !this.shape) return;
    this.waiting = true;
    const isRough = moves || this.canvas.dataset.at === "motion";
    this.canvas.dataset.at = "motion";
    requestAnimationFrame(() => {
      this.waiting = false;
      if (!isRough) { this.rest(); return; }
      if (this.body !== this.inMotion()) this.form(this.inMotion());
      this.draw(this.slow ? 0.5 : 1);
      this.onRender?.();
      this.atRest = window.setTimeout(() => this.rest(), 250);
    });
  }
}
