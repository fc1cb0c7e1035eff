// The 3-D views of all cases with one set of controls.
import type { Scale } from "./colours.ts";
import { type Case, rowAt, type Scheme, type Series, value } from "./data.ts";
import { el, fileName, missing, overlaidPng, savePng, titled } from "./dom.ts";
import { Fibres } from "./fibres.ts";
import { cutName, heartOf, isAt, looks, marked, openingLook, openingReason, sideName, starNote } from "./orientation.ts";
import { Overlay } from "./overlay.ts";
import { infarct, label, quantities, quantity, shown } from "./quantities.ts";
import { type Cut, scaleOf, Shared, type Timeline } from "./shared.ts";
import { type Room, roomOf, WallView } from "./wall_view.ts";

function select(title: string, options: [string, string][], chosen: string, change: (value: string) => void): HTMLElement {
  return el("label", {}, title, el("select", { change: (event: Event) => change((event.target as HTMLSelectElement).value) },
    ...options.map(([value, text]) => el("option", { value, selected: value === chosen }, text))));
}

/** A slider that also shows a number that others set. */
function slider(title: string, min: number, max: number, step: number, unit: string, change: (value: number) => void) {
  const output = el("output");
  const input = el("input", { type: "range", min, max, step, input: () => change(input.valueAsNumber) });
  const show = (x: number) => { input.value = String(x); output.textContent = `${x} ${unit}`; };
  return { element: el("label", {}, title, input, output), show };
}

/** "strain from end-diastole"; empty of other quantities. */
const strainSince = (c: Case, name: string, time: number) => c.since(name, time) && `strain ${c.since(name, time)}`;

export const regionName = (c: Case, scheme: Scheme, index: number) => c.regionNames(scheme)[index] ?? `${index + 1}`;

/** One case's 3-D view. */
class Panel {
  private view?: WallView;
  private overlay?: Overlay;
  private series = new Map<string, Series | Float32Array | undefined>();
  readonly element: HTMLElement;
  private fibres?: Fibres;
  private side = "";  // that is seen
  private opening?: HTMLImageElement;  // what the program has drawn, until the wall is
  private read = el("p", { class: "read", "aria-live": "polite" });
  constructor(private c: Case, private number: number, private shared: Shared, private time: Timeline, private scale: () => Scale, room: Room) {
    this.element = el("div", { class: "panel" });
    if (!c.wall) {
      this.element.append(missing("No wall is shown: the work folder holds neither frames of a beat nor a mesh."));
      return;
    }
    this.view = new WallView(c.wall, heartOf(c), room);
    this.overlay = new Overlay(this.view, starNote(this.view.heart, c.assumesInfarct ? ["infarct"] : []));
    const { opening } = c.wall;
    if (opening && opening.frame === time.frame(number, time.start)) {
      this.opening = el("img", { class: "opening", alt: "", src: `data:image/png;base64,${opening.png}` });
      this.opening.decoding = "sync";  // it is part of the first picture of the page
    }
    const { canvas } = this.view;
    canvas.className = "wall";
    canvas.setAttribute("role", "img");
    this.listen(canvas);
    this.element.append(el("div", { class: "view" }, this.opening, canvas, this.overlay.element), el("div", { class: "below" },
      savePng(fileName(c.name, "wall"), () => overlaidPng(this.view!.painted()!, this.overlay!.element)), this.read));
  }

  get camera() { return this.view; }

  /** Letters, scale bar and the name of the side that is seen follow the camera. */
  follow(): void {
    this.overlay?.place();
    if (this.view && this.side !== this.sideNow) this.write();
    if (this.opening) this.placeOpening(this.opening);
  }

  /** The picture of the opening lies where the wall will be. */
  private placeOpening(picture: HTMLImageElement): void {
    const [x, y] = this.view!.middle;
    picture.style.cssText = `left: ${x}px; top: ${y}px; width: ${this.view!.scale * this.c.wall!.opening!.width_mm}px`;
  }

  /** When the picture of the opening can be shown; at once where there is none. */
  get opened(): Promise<void> { return this.opening?.decode().catch(() => {}) ?? Promise.resolve(); }

  private listen(canvas: HTMLCanvasElement): void {
    let latest: PointerEvent | undefined;
    canvas.addEventListener("pointermove", (event) => {
      if (event.buttons) return;
      if (!latest) requestAnimationFrame(() => { this.hover(latest!, false); latest = undefined; });
      latest = event;
    });
    canvas.addEventListener("pointerleave", () => this.shared.pick(undefined, false));
    let down: [number, number] = [0, 0];
    canvas.addEventListener("pointerdown", (event) => { down = [event.clientX, event.clientY]; });
    canvas.addEventListener("click", (event) => {
      if (Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 4) this.hover(event as PointerEvent, true);
    });
  }

  private hover(event: PointerEvent, fixed: boolean): void {
    const hit = this.view!.pick(event);
    const scheme = this.shared.state.selection?.scheme ?? "aha17";
    const region = hit && this.view!.region(hit.cell, scheme);
    this.shared.pick(region === undefined ? undefined : { scheme, index: region }, fixed);
    const q = quantity(this.shared.state.quantity);
    const place = (words: string, of: Scheme) => {
      const index = this.view!.region(hit!.cell, of);
      return index === undefined ? [] : [`${words} ${regionName(this.c, of, index)}`];
    };
    this.read.textContent = hit === undefined ? "" : [`${label(q)} here: ${shown(hit.value)}`,
      [...place("segment", "aha17"), ...place("slice and sector", "sector")].join(", ")].filter(Boolean).join("; ");
  }

  private async field(name: string): Promise<Series | Float32Array | undefined> {
    const wall = this.c.wall!;
    if (!this.series.has(name))
      this.series.set(name, name === "infarct" ? wall.infarct ?? new Float32Array(wall.nodes)
        : wall.quantities.includes(name) ? await wall.series(name) : undefined);
    return this.series.get(name);
  }

  /** What the step shows: "end-systole, 150 mmHg, 59.5 ml". */
  moment(step: number): string {
    const t = this.time.time(this.number, step);
    const row = rowAt(this.c.table("curves.csv"), t);
    return [this.c.words(t), this.c.clock(t), row && `${shown(value(row.pressure_mmHg))} mmHg`,
      row && `${shown(value(row.cavity_volume_ml))} ml`].filter(Boolean).join(", ");
  }

  /** From where the whole wall is seen; empty of one that is cut. */
  private get sideNow(): string {
    return this.shared.state.cut.kind === "none" ? `, ${sideName(this.view!.heart, this.view!.direction)}` : "";
  }

  /** What stands over the picture. */
  write(): void {
    if (!this.view) return;
    const { state } = this.shared;
    this.side = this.sideNow;
    const [q, scale] = [quantity(state.quantity), this.scale()];
    const has = q === infarct || this.c.wall!.quantities.includes(q.name);
    const lines = [this.c.name, this.moment(state.step), cutName(state.cut) + this.side, ...(has ? [] : [`${q.title} is not in this case's frames`]),
      strainSince(this.c, q.name, this.time.time(this.number, state.step))].filter(Boolean);
    const hasBorder = this.c.json.wall!.infarct && q !== infarct;
    this.overlay!.write(lines, scale, marked(label(q), q === infarct && this.c.assumesInfarct), hasBorder ? marked("border of the infarct", this.c.assumesInfarct) : "");
    this.view.canvas.setAttribute("aria-label", `The wall in 3-D, ${label(q)}: ${lines.join("; ")}. Arrow keys turn it.`);
  }

  async update(): Promise<void> {
    if (!this.view) return;
    const { state } = this.shared;
    const wall = this.c.wall!;
    await wall.load();
    const frame = this.time.frame(this.number, state.step)!;
    const field = await this.field(state.quantity);
    if (state.fibres && !this.fibres) {
      const f0 = await wall.fibres();
      this.fibres = f0 && new Fibres(wall, f0);
    }
    if (!this.begin()) return;
    this.write();
    this.view.show(frame, field, this.scale(), state.cut, state.fibres ? this.fibres : undefined);
    this.opening?.remove();
    this.opening = undefined;
  }

  private begin(): boolean {
    const can = this.view?.begin() ?? false;
    if (!can) {
      this.view = undefined;
      this.element.replaceChildren(missing("The 3-D view needs WebGL, which this browser does not offer."));
    }
    return can;
  }

  choose(): void {
    const { selection } = this.shared.state;
    this.view?.choose(selection);
    this.overlay?.name(selection ? regionName(this.c, selection.scheme, selection.index) : "");
  }

  /** A copy on white paper stands for the view in print. */
  print(): void {
    this.element.querySelector("canvas.printed")?.remove();
    const copy = this.view?.painted();
    if (!copy) return;
    copy.className = "printed";
    this.overlay!.element.before(copy);
  }

  /** On the page's paper, light or dark. */
  colour(): void { this.view?.background(getComputedStyle(document.body).getPropertyValue("--paper").trim()); }
}

/** Play, the slider, and end-diastole and end-systole below it. */
function timeBar(shared: Shared, time: Timeline, words: (step: number) => string) {
  const input = el("input", { type: "range", id: "time", min: 0, max: time.count - 1, step: 1, value: shared.state.step,
    "aria-label": "moment", input: () => shared.set({ step: input.valueAsNumber }) });
  let playing: number | undefined;
  const play = el("button", { type: "button", id: "play", click: () => {
    if (playing !== undefined) { clearInterval(playing); playing = undefined; play.textContent = "Play"; return; }
    play.textContent = "Stop";
    playing = window.setInterval(() => shared.set({ step: (shared.state.step + 1) % time.count }), 120);
  } }, "Play");
  const ticks = time.marks.map(({ step, label, title }) => el("button", { type: "button", class: "tick", title: `go to ${title}`,
    style: `--at: ${time.count > 1 ? step / (time.count - 1) : 0}`, click: () => shared.set({ step }) }, label));
  const show = () => {
    input.value = String(shared.state.step);
    input.setAttribute("aria-valuetext", words(shared.state.step));
  };
  return { element: el("div", { class: "time-bar" }, play, el("div", { class: "ticked" }, input, el("div", { class: "ticks" }, ...ticks))), show };
}

function rangeFields(shared: Shared) {
  const field = (name: string) => el("input", { type: "number", step: "any", change: () => take(), "aria-label": name });
  const [lowest, highest] = [field("lowest colour"), field("highest colour")];
  const take = () => {
    const [min, max] = [lowest.valueAsNumber, highest.valueAsNumber];
    if (max > min) shared.set({ range: [min, max] });
  };
  return { element: el("div", { class: "looks" }, "colours from", lowest, " to ", highest,
    el("button", { type: "button", click: () => shared.set({ range: undefined }) }, "usual")),
  show: ({ min, max }: Scale) => { [lowest.value, highest.value] = [min, max].map((x) => String(Number(x.toPrecision(3)))); } };
}

const help = "Drag to turn, wheel or pinch to zoom, arrow keys to turn when the picture has the focus. Letters stand at the anterior (A), septal (S), " +
  "inferior (I) and lateral (L) wall; a short axis is seen from the apex, anterior up, septum left. What lies before a cut is taken away, " +
  "from whichever side it is seen. The white line with dark rims is the infarct's border, where M = 0.5: half-way through its border zone. Point at the wall to read a value and to outline its segment here and in the bull's-eyes; click to keep " +
  "it. The section is cut anew at every moment by a plane fixed in space. Only moments that the run wrote are shown, none is made up in " +
  "between. Values of elements are averaged to the nodes; what is nearly nothing has no colour. Fibres are drawn by their part in the surface " +
  "or section: short where they run through it.";

/** `opened`: its first picture can be shown, which the program has drawn; `draw`: it reads the wall and draws it. */
export interface WallSection { element: HTMLElement; opened: Promise<unknown>; draw: () => Promise<unknown>; scale: () => Scale }

export function wallSection(cases: Case[], shared: Shared, time: Timeline): WallSection {
  const scale = () => {
    const { quantity: name, range } = shared.state;
    const usual = scaleOf(cases, name);
    return range ? { ...usual, min: range[0], max: range[1] } : usual;
  };
  const room = roomOf(cases.flatMap((c) => c.wall ?? []));
  const panels = cases.map((c, i) => new Panel(c, i, shared, time, scale, room));
  const views = panels.map((panel) => panel.camera).filter((view) => view !== undefined);
  panels.forEach((panel) => {
    const { camera: view } = panel;
    if (view) view.onRender = () => {
      panel.follow();
      for (const other of views) if (other !== view) other.copy(view);  // one camera for all
      press();
    };
  });
  const has = (name: string) => cases.some((c) => c.wall?.quantities.includes(name));
  const offered = [...quantities.filter((q) => has(q.name)), ...(cases.some((c) => c.wall) ? [infarct] : [])];
  const what = el("p", { class: "help" });
  const bar = timeBar(shared, time, (step) => panels.map((panel, i) => (panels.length > 1 ? `${cases[i].name}: ` : "") + panel.moment(step)).join("; "));
  const cut = (change: Partial<Cut>) => shared.set({ cut: { ...shared.state.cut, ...change } });
  const angle = slider("plane from the septum", -180, 180, 5, "°", (x) => cut({ angle: x }));
  const height = slider("height of the plane", -110, 0, 1, "mm", (x) => cut({ height: x }));
  const kinds = el("select", { change: () => cut({ kind: kinds.value as Cut["kind"] }) },
    ...([["long", "long axis"], ["short", "short axis"], ["none", "none"]] as const).map(([value, text]) => el("option", { value }, text)));
  const range = rangeFields(shared);
  const named = looks.map((look) => el("button", { type: "button", class: "look", click: () => {
    cut(look.cut);
    views.forEach((view) => view.look(look));
  } }, look.name));
  const press = () => named.forEach((button, i) => {
    const isHere = views.length > 0 && isAt(looks[i], views[0].direction, shared.state.cut);
    if (button.getAttribute("aria-pressed") !== String(isHere)) button.setAttribute("aria-pressed", String(isHere));
  });
  const more = el("details", { class: "more" }, el("summary", {}, "cut, fibres, colours, help"),
    el("div", { class: "controls" }, el("label", {}, "cut", kinds), angle.element, height.element,
      el("label", { class: "check" }, el("input", { type: "checkbox", id: "fibres", change: (event: Event) =>
        shared.set({ fibres: (event.target as HTMLInputElement).checked }) }), "fibres"), range.element),
    what, el("p", { class: "help" }, help));
  let turns = 0;
  const refresh = () => {
    const { quantity: name, cut: now } = shared.state;
    what.textContent = quantity(name).help;
    range.show(scale());
    kinds.value = now.kind;
    angle.show(now.angle);
    height.show(now.height);
    angle.element.hidden = now.kind !== "long";
    height.element.hidden = now.kind !== "short";
    bar.show();
    element.setAttribute("aria-busy", "true");
    const turn = ++turns;
    return Promise.all(panels.map((panel) => panel.update())).then(() => turn === turns && element.removeAttribute("aria-busy"));
  };
  shared.onChange((_, changed) => {
    if (["quantity", "step", "cut", "fibres", "range"].some((name) => changed.has(name as never))) void refresh();
    if (changed.has("selection")) panels.forEach((panel) => panel.choose());
  });
  const colour = () => panels.forEach((panel) => panel.colour());
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", colour);
  addEventListener("beforeprint", () => panels.forEach((panel) => panel.print()));
  const element = titled("wall", "The wall in 3-D", {},
    el("div", { class: "controls" }, select("quantity", offered.map((q) => [q.name, label(q)]), shared.state.quantity,
      (name) => shared.set({ quantity: name, range: undefined })),
    el("div", { class: "looks", role: "group", "aria-label": "views" }, ...named)),
    cases.some((c) => c.json.wall?.infarct) && el("p", { class: "help opened" }, openingReason(openingLook)),
    el("div", { class: "cases" }, ...panels.map((panel) => panel.element)), bar.element, more);
  views.forEach((view) => view.look(openingLook));
  press();
  colour();
  panels.forEach((panel) => panel.write());
  return { opened: Promise.all(panels.map((panel) => panel.opened)), draw: refresh, element, scale };
}
