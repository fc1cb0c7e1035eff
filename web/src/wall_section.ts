// The 3-D views of all cases with one set of controls, and the bull's-eyes that point at the same regions.
import { drawBullsEye, type DrawnBullsEye } from "./bullseye.ts";
import { colourTable, type Scale } from "./colours.ts";
import { Case, type Scheme, type Series, value } from "./data.ts";
import { el, figure, missing, saveButtons, section, svg, fileName } from "./dom.ts";
import { Fibres } from "./fibres.ts";
import { infarct, label, quantities, quantity, shown, stateTitle } from "./quantities.ts";
import { regionScale, Shared, statesOf, type Timeline, wallScale } from "./shared.ts";
import { WallView } from "./wall_view.ts";

let numbers = 0;

export function colourBar(scale: Scale, title: string): SVGSVGElement {
  const id = `bar-${++numbers}`;
  const table = colourTable(scale);
  const stops = Array.from({ length: 33 }, (_, i) =>
    svg("stop", { offset: i / 32, "stop-color": `rgb(${table[Math.round((255 * i) / 32)].join(",")})` }));
  const root = svg("svg", { viewBox: "0 0 300 46", class: "bar", role: "img", "font-family": "sans-serif", "font-size": 12,
    "aria-label": `${title}, from ${shown(scale.min)} to ${shown(scale.max)}` },
    svg("defs", {}, svg("linearGradient", { id }, ...stops)),
    svg("text", { x: 150, y: 12, "text-anchor": "middle" }, title),
    svg("rect", { x: 10, y: 17, width: 280, height: 12, fill: `url(#${id})` }));
  for (const t of [0, 0.5, 1])
    root.append(svg("text", { x: 10 + 280 * t, y: 43, "text-anchor": t === 0 ? "start" : t === 1 ? "end" : "middle" },
      shown(scale.min + t * (scale.max - scale.min))));
  return root;
}

const option = (value: string, title: string, chosen: boolean) => el("option", { value, selected: chosen }, title);

function select(title: string, options: [string, string][], chosen: string, change: (value: string) => void): HTMLElement {
  return el("label", {}, title, el("select", { change: (event: Event) => change((event.target as HTMLSelectElement).value) },
    ...options.map(([name, text]) => option(name, text, name === chosen))));
}

function slider(title: string, min: number, max: number, step: number, start: number, unit: string, change: (value: number) => void): HTMLElement {
  const output = el("output", {}, `${start} ${unit}`);
  return el("label", {}, title, el("input", { type: "range", min, max, step, value: start, input: (event: Event) => {
    const x = Number((event.target as HTMLInputElement).value);
    output.textContent = `${x} ${unit}`;
    change(x);
  } }), output);
}

export const regionName = (c: Case, scheme: Scheme, index: number) => c.regionNames(scheme)[index] ?? `${index + 1}`;

/** One case's 3-D view. */
class Panel {
  private view?: WallView;
  private series = new Map<string, Series | Float32Array | undefined>();
  readonly element: HTMLElement;
  private fibres?: Fibres;
  private read = el("p", { class: "read", "aria-live": "polite" });
  private caption = el("p", { class: "time" });
  constructor(private c: Case, private number: number, private shared: Shared, private time: Timeline, private scale: () => Scale) {
    this.element = el("div", { class: "panel" });
    if (!c.wall) {
      this.element.append(missing("No wall is shown: the work folder holds neither frames of a beat nor a mesh."));
      return;
    }
    try {
      this.view = new WallView(c.wall);
    } catch {
      this.element.append(missing("The 3-D view needs WebGL, which this browser does not offer."));
      return;
    }
    const { canvas } = this.view;
    canvas.className = "wall";
    canvas.setAttribute("aria-label", `The wall of ${c.name} in 3-D; arrow keys turn it`);
    canvas.setAttribute("role", "img");
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
    this.element.append(this.caption, canvas, this.read,
      saveButtons(fileName(c.name, "wall"), () => canvas));
  }

  get camera() { return this.view; }

  private hover(event: PointerEvent, fixed: boolean): void {
    const hit = this.view!.pick(event);
    const scheme = this.shared.state.selection?.scheme ?? "aha17";
    const region = hit && this.view!.region(hit.cell, scheme);
    this.shared.pick(region === undefined ? undefined : { scheme, index: region }, fixed);
    const q = quantity(this.shared.state.quantity);
    this.read.textContent = hit === undefined ? "" :
      `${label(q)} here: ${shown(hit.value)}; segment ${regionName(this.c, "aha17", this.view!.region(hit.cell, "aha17") ?? 0)}, ` +
      `slice and sector ${regionName(this.c, "sector", this.view!.region(hit.cell, "sector") ?? 0)}`;
  }

  private async field(name: string): Promise<Series | Float32Array | undefined> {
    const wall = this.c.wall!;
    if (!this.series.has(name))
      this.series.set(name, name === "infarct" ? wall.infarct ?? new Float32Array(wall.nodes)
        : wall.quantities.includes(name) ? await wall.series(name) : undefined);
    return this.series.get(name);
  }

  async update(): Promise<void> {
    if (!this.view) return;
    const { state } = this.shared;
    const frame = this.time.frame(this.number, state.step)!;
    const field = await this.field(state.quantity);
    const t = this.time.time(this.number, state.step);
    this.caption.textContent = `${this.c.name}: t = ${t.toFixed(3)} s, ${this.c.words(t)}` +
      (field ? "" : `; ${quantity(state.quantity).title} is not in this case's frames`);
    if (state.fibres && !this.fibres) {
      const f0 = await this.c.wall!.fibres();
      this.fibres = f0 && new Fibres(this.c.wall!, f0);
    }
    this.view.show(frame, field, this.scale(), state.cut, state.fibres ? this.fibres : undefined);
  }

  choose(): void { this.view?.choose(this.shared.state.selection); }
}

export function wallSection(cases: Case[], shared: Shared, time: Timeline): { element: HTMLElement; drawn: Promise<unknown> } {
  const scale = () => {
    const { quantity: name, range } = shared.state;
    const usual = wallScale(cases, name);
    return range ? { ...usual, min: range[0], max: range[1] } : usual;
  };
  const panels = cases.map((c, i) => new Panel(c, i, shared, time, scale));
  const views = panels.map((panel) => panel.camera).filter((view) => view !== undefined);
  // one camera for all
  for (const view of views) view.onRender = () => {
    for (const other of views) if (other !== view && !other.camera.position.equals(view.camera.position)) {
      other.camera.position.copy(view.camera.position);
      other.controls.update();
    }
  };
  const has = (name: string) => cases.some((c) => c.wall?.quantities.includes(name));
  const offered = [...quantities.filter((q) => has(q.name)), ...(cases.some((c) => c.wall) ? [infarct] : [])];
  const bar = el("div", { class: "bar-place" });
  const help = el("p", { class: "help" });
  const lowest = el("input", { type: "number", step: "any", change: () => takeRange(), "aria-label": "lowest colour" });
  const highest = el("input", { type: "number", step: "any", change: () => takeRange(), "aria-label": "highest colour" });
  const takeRange = () => {
    const [min, max] = [lowest.valueAsNumber, highest.valueAsNumber];
    if (max > min) shared.set({ range: [min, max] });
  };
  const timeSlider = el("input", { type: "range", id: "time", min: 0, max: time.count - 1, step: 1, value: shared.state.step,
    "aria-label": "time", input: () => shared.set({ step: timeSlider.valueAsNumber }) });
  let playing: number | undefined;
  const play = el("button", { type: "button", id: "play", click: () => {
    if (playing !== undefined) { clearInterval(playing); playing = undefined; play.textContent = "Play"; return; }
    play.textContent = "Stop";
    playing = window.setInterval(() => shared.set({ step: (shared.state.step + 1) % time.count }), 120);
  } }, "Play");
  const angle = slider("plane about the long axis", 0, 355, 5, shared.state.cut.angle, "°",
    (x) => shared.set({ cut: { ...shared.state.cut, angle: x } }));
  const height = slider("height of the plane", -110, 0, 1, shared.state.cut.height, "mm",
    (x) => shared.set({ cut: { ...shared.state.cut, height: x } }));
  const looks: [string, number, number][] = [["anterior", 90, 12], ["septum", 0, 12], ["inferior", 270, 12], ["lateral", 180, 12],
    ["from the base", 90, 88], ["from the apex", 90, -88]];
  const controls = el("div", { class: "controls" },
    select("quantity", offered.map((q) => [q.name, label(q)]), shared.state.quantity, (name) => shared.set({ quantity: name, range: undefined })),
    select("cut", [["long", "long axis"], ["short", "short axis"], ["none", "none"]], shared.state.cut.kind,
      (kind) => shared.set({ cut: { ...shared.state.cut, kind: kind as "long" } })),
    angle, height,
    el("label", { class: "check" }, el("input", { type: "checkbox", id: "fibres", change: (event: Event) =>
      shared.set({ fibres: (event.target as HTMLInputElement).checked }) }), "fibres"),
    el("label", {}, "colours from", lowest, " to ", highest,
      el("button", { type: "button", click: () => shared.set({ range: undefined }) }, "usual")),
    el("div", { class: "looks" }, "look at ", ...looks.map(([name, azimuth, elevation]) =>
      el("button", { type: "button", click: () => views.forEach((view) => view.look(azimuth, elevation)) }, name))));
  const refresh = () => {
    const { quantity: name, cut } = shared.state;
    const q = quantity(name);
    const now = scale();
    bar.replaceChildren(colourBar(now, label(q)));
    help.textContent = q.help;
    [lowest.value, highest.value] = [now.min, now.max].map((x) => String(Number(x.toPrecision(3))));
    angle.hidden = cut.kind !== "long";
    height.hidden = cut.kind !== "short";
    timeSlider.value = String(shared.state.step);
    timeSlider.setAttribute("aria-valuetext", cases.map((_, i) => `${time.time(i, shared.state.step).toFixed(3)} s`).join(", "));
    return Promise.all(panels.map((panel) => panel.update()));
  };
  shared.onChange((_, changed) => {
    if (["quantity", "step", "cut", "fibres", "range"].some((name) => changed.has(name as never))) void refresh();
    if (changed.has("selection")) panels.forEach((panel) => panel.choose());
  });
  const drawn = refresh();
  return { drawn, element: section("wall", "The wall in 3-D",
    "Drag to turn, wheel or pinch to zoom, arrow keys to turn when the picture has the focus. Point at the wall to read a value and " +
    "to mark its segment here and in the bull's-eyes; click to keep it marked. The section is cut anew at every moment by a plane " +
    "fixed in space. Only moments that the run wrote are shown, none is made up in between. Values of elements are averaged to the nodes. " +
    "Fibres are drawn by their part in the surface or section: short where they run through it.",
    controls, help, bar, el("div", { class: "time-bar" }, play, timeSlider),
    el("div", { class: "cases" }, ...panels.map((panel) => panel.element))) };
}

export function bullsEyeSection(cases: Case[], shared: Shared): HTMLElement {
  const plots: { drawn: DrawnBullsEye; scheme: Scheme }[] = [];
  const place = el("div");
  const read = el("p", { class: "read", "aria-live": "polite" });
  const one = (c: Case, state: string, scheme: Scheme) => {
    const q = quantity(shared.state.quantity);
    const names = c.regionNames(scheme);
    const rows = names.map((name) => c.row(state, scheme, name, q.name));
    const title = `${c.name}: ${q.title} at ${stateTitle(state)}, ${scheme === "aha17" ? "17 segments (AHA)" : "seven slices"}`;
    const drawn = drawBullsEye({ scheme, names, values: rows.map((row) => value(row?.mean)), title,
      details: rows.map((row) => `${shown(value(row?.mean))} ± ${shown(value(row?.sd))}`),
      scale: regionScale(cases, q.name, state), pick: (index, fixed) =>
        shared.pick(index === undefined ? undefined : { scheme, index }, fixed) });
    plots.push({ drawn, scheme });
    return figure(title, fileName(c.name, q.name, state, scheme), drawn.figure);
  };
  const absent = (c: Case) => missing(`${c.name}: regions.csv is missing, so there are no regional means.`);
  const refresh = () => {
    plots.length = 0;
    const q = quantity(shared.state.quantity);
    if (q.name === "infarct") {
      place.replaceChildren(missing("The infarct M does not change with time; choose another quantity above for its regional means."));
      return;
    }
    place.replaceChildren(...statesOf(cases).map((state) => el("div", {},
      el("h3", {}, `${label(q)} at ${stateTitle(state)}`), colourBar(regionScale(cases, q.name, state), `${label(q)}, mean of the region`),
      el("div", { class: "cases" }, ...cases.map((c) => c.regions.length
        ? el("div", { class: "pair" }, one(c, state, "sector"), one(c, state, "aha17"))
        : absent(c))))), ...(statesOf(cases).length ? [] : cases.map(absent)));
    mark();
  };
  const mark = () => {
    const { selection } = shared.state;
    for (const { drawn, scheme } of plots)
      drawn.highlight(selection?.scheme === scheme ? selection.index : undefined);
    read.textContent = selection === undefined ? "" : cases.map((c) => {
      const name = regionName(c, selection.scheme, selection.index);
      const q = quantity(shared.state.quantity);
      return `${c.name}, ${name}: ` + c.states.map((state) => {
        const row = c.row(state, selection.scheme, name, q.name);
        return `${stateTitle(state)} ${shown(value(row?.mean))} ± ${shown(value(row?.sd))} ` +
          `(1% ${shown(value(row?.p1))}, median ${shown(value(row?.p50))}, 99% ${shown(value(row?.p99))})`;
      }).join("; ");
    }).join(" | ");
  };
  shared.onChange((_, changed) => {
    if (changed.has("quantity")) refresh();
    if (changed.has("selection")) mark();
  });
  refresh();
  return section("regions", "Bull's-eyes",
    "The wall seen from the apex and laid flat: the base outside, the apex in the middle. Left the scheme of the paper (seven " +
    "short-axis slices, the basal five with six sectors, the other two with four), right the 17 segments of the American Heart " +
    "Association. Means over the undeformed volume, from regions.csv; stripes where a region has no value. The quantity is chosen " +
    "at the 3-D view. Point at a region to mark it there; click to keep it.",
    read, place);
}
