// Outlines of the model and contours drawn, over the cine images.
import { type Case, type Outlined, value } from "./data.ts";
import { el, figure, fileName, folded, missing, section, svg, table } from "./dom.ts";
import { heartOf, marked, starNote, unit, walls } from "./orientation.ts";
import { shown, stateTitle } from "./quantities.ts";

const modelColour = "#e69f00";
const contourColour = "#56b4e9";

/** Short axes are numbered; long axes have a name. */
const titleOf = (slice: string) => (/^\d+$/.test(slice) ? `slice ${slice}` : slice);

function pathOf(points: number[]): string {
  let path = "";
  for (let i = 0; i + 1 < points.length; i += 2) path += `${i ? "L" : "M"}${points[i]} ${points[i + 1]}`;
  return path;
}

const white = { "font-family": "sans-serif", fill: "#fff", stroke: "#000", "stroke-width": 0.9, "paint-order": "stroke" };

/** The walls' letters at the edges of an image to which their walls lie; one that points out of its plane is left out. */
function letters(c: Case, { along_row, along_column }: Outlined, width: number, height: number): SVGElement[] {
  const { axes } = c;
  if (!axes || !along_row || !along_column) return [];
  const [heart, inside] = [heartOf(c), 5];
  return walls.flatMap(([name, angle]) => {
    const [x, y] = unit(heart.septum + angle);
    const towards = (along: number[]) => along.reduce((sum, v, d) => sum + v * (x * axes.x[d] + y * axes.y[d]), 0);
    const [across, down] = [towards(along_row), towards(along_column)];
    if (Math.hypot(across, down) < 0.5) return [];
    const reach = Math.min((width / 2 - inside) / Math.max(Math.abs(across), 1e-9), (height / 2 - inside) / Math.max(Math.abs(down), 1e-9));
    return [svg("text", { class: "letter", x: width / 2 + reach * across, y: height / 2 + reach * down, "text-anchor": "middle", dy: "0.35em", "font-size": 7,
      "font-weight": 700, ...white }, marked(name, heart.assumed))];
  });
}

const scaleBar = (width: number, height: number) => [svg("rect", { x: width - 23, y: height - 5, width: 20, height: 1, fill: "#fff" }),
  svg("text", { x: width - 13, y: height - 6.5, "text-anchor": "middle", "font-size": 4.5, ...white }, "20 mm")];

/** Whether the model lies where the images show a heart, so that it was laid over them. */
const isLaid = (pictures: Outlined[]) => pictures.some((p) => p.lines.some((line) => line.source === "model"));

/** What agreement with the contours can mean in a case. */
function meaning(c: Case): string {
  const fitted = c.isFitted ? "; parameters were fitted to measured volumes, so what they enclose is no test of the model, where it lies is" : "";
  return c.isUnloaded ? `the wall without load was sought so that it fills to the shape that was seen: agreement at that moment is made, not found${fitted}.`
    : `the model was started from the shape at early diastole; at end-diastole and end-systole nothing else puts its outline onto the contours${fitted}.`;
}

/** An image with its lines; `scale` pixels of the screen a millimetre. */
function drawPicture(c: Case, picture: Outlined, scale: number, laid: boolean): SVGSVGElement {
  const { columns, rows, spacing_i_mm: across, spacing_j_mm: down } = picture;
  const [width, height] = [columns * across, rows * down];
  const title = `${titleOf(picture.slice)}, image ${picture.phase} (${stateTitle(picture.state)})`;
  const names = [...new Set(picture.lines.map((line) => line.source))];
  const root = svg("svg", { viewBox: `0 0 ${width} ${height}`, width: scale * width, height: scale * height, class: "outlined", role: "img",
    "data-slice": picture.slice, "aria-label": `${title}; ${names.includes("model") ? "with" : "without"} an outline of the model` },
    svg("image", { href: `data:image/png;base64,${picture.png}`, width, height, preserveAspectRatio: "none" }));
  const lines = svg("g", { transform: `scale(${across} ${down})` });
  for (const line of picture.lines)
    lines.append(svg("path", { d: pathOf(line.points), fill: "none", stroke: line.source === "model" ? modelColour : contourColour,
      "stroke-width": 1.6 / scale, "stroke-dasharray": line.source === "model" ? "none" : `${4.5 / scale} ${3 / scale}`, "data-source": line.source }));
  root.append(lines, ...(scale < 2 ? [svg("text", { x: 2, y: height - 2.5, "font-size": 4 + 6 / scale, ...white }, titleOf(picture.slice))]
    : [...(laid ? letters(c, picture, width, height) : []), ...scaleBar(width, height)]));
  return root;
}

/** One case's images: a grid of all slices, and one of them large. */
class Sheet {
  readonly element = el("div", { class: "panel" });
  private state: string;
  private slice: string;
  private grid = el("div", { class: "sheet" });
  private large = el("div");
  private slider: HTMLInputElement;
  private name = el("output");
  private laid: boolean;
  constructor(private c: Case, private pictures: Outlined[]) {
    this.laid = isLaid(pictures);
    const slices = this.slices();
    const states = [...new Set(pictures.map((p) => p.state))];
    this.state = states[0];
    this.slice = slices[Math.floor(slices.length / 2)];
    this.slider = el("input", { type: "range", min: 0, max: slices.length - 1, step: 1, value: slices.indexOf(this.slice),
      "aria-label": `slice of the images of ${c.name}`, input: () => { this.slice = slices[this.slider.valueAsNumber]; this.draw(); } });
    const choice = el("div", { class: "looks", role: "group", "aria-label": "moment of the images" },
      ...states.map((state) => el("button", { type: "button", "data-state": state,
        click: () => { this.state = state; this.draw(); } }, stateTitle(state))));
    this.element.append(el("div", { class: "controls" }, choice, el("label", {}, "slice", this.slider, this.name)),
      el("div", { class: "outlines" }, this.large, this.grid), this.laid ? el("p", { class: "help" }, `${c.name}: ${meaning(c)}`)
        : missing(`${c.name}: the model does not lie in the space of these images: it is not laid over them, and the images have no letters.`),
      ...(this.laid ? [this.distances()] : []));
    this.draw();
  }

  private slices(): string[] { return [...new Set(this.pictures.map((p) => p.slice))]; }

  private draw(): void {
    const slices = this.slices();
    for (const button of this.element.querySelectorAll<HTMLElement>("[data-state]"))
      button.setAttribute("aria-pressed", String(button.dataset.state === this.state));
    this.slider.value = String(slices.indexOf(this.slice));
    this.name.textContent = this.slice;
    const now = this.pictures.filter((p) => p.state === this.state);
    const chosen = now.find((p) => p.slice === this.slice);
    this.large.replaceChildren(chosen
      ? figure([`${this.c.name}: ${titleOf(this.slice)}, image ${chosen.phase}, at ${stateTitle(this.state)}, ${this.laid ? "model (solid, orange) and " : ""}contours (dashed, blue)`,
        this.laid ? starNote(heartOf(this.c)) : "the model does not lie in the space of these images"].filter(Boolean).join("; "),
        fileName(this.c.name, "outlines", this.state, titleOf(this.slice)), drawPicture(this.c, chosen, 4, this.laid))
      : missing(`No image of ${titleOf(this.slice)} at ${stateTitle(this.state)}.`));
    this.grid.replaceChildren(...now.map((p) => el("button", { type: "button", class: "thumb", "aria-label": `show ${titleOf(p.slice)}`,
      "aria-pressed": p.slice === this.slice, click: () => { this.slice = p.slice; this.draw(); } }, drawPicture(this.c, p, 1.3, this.laid))));
  }

  private distances(): HTMLElement {
    const rows = this.c.table("outline_distances.csv");
    if (!rows.length) return missing("outline_distances.csv is missing, or no contours were given to measure from.");
    return el("details", {}, el("summary", {}, "distance of the drawn contours from the model's outlines"), table(fileName(this.c.name, "outline-distances"),
      ["moment, slice, contour", "points", "mean (mm)", "rms (mm)", "largest (mm)"], rows.map((r) =>
        [`${stateTitle(r.state)}, ${r.slice}, ${r.contour}`, r.points,
          ...["mean_mm", "rms_mm", "largest_mm"].map((name) => shown(value(r[name])))])));
  }
}

export function outlinesSection(cases: Case[]): HTMLElement {
  const none = "There are no images in the results. A case whose [strain] names a cine and its contours has them.";
  if (cases.every((c) => !c.json.pictures)) return folded("outlines", "Outlines over the images", none);
  const place = el("div", { class: "cases" });
  const whole = section("outlines", "Outlines over the images",
    "Where the model's two surfaces cut the planes of the cine, short and long axes (solid, orange), over the images at end-diastole and " +
    "end-systole, with the contours that were drawn on them (dashed, blue). Where both lie on each other the model has the shape of the " +
    "heart; what that says of it stands below the images. A slice without " +
    "orange lies above the model's base or below its apex. The table has the distance of the drawn points from the model's outline; " +
    "a dash where the plane does not cut the model. Curves on long axes are drawn at end-diastole alone. From pictures/, outlines.csv and outline_distances.csv.", place);
  const absent = (c: Case) => el("div", { class: "panel" }, missing(`${c.name}: ${none}`));
  const fill = async () => place.replaceChildren(...await Promise.all(cases.map(async (c) => {
    const pictures = await c.pictures();
    return pictures.length ? new Sheet(c, pictures).element : absent(c);
  })));
  void fill();
  return whole;
}
