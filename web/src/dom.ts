// Elements of the page, and figures that can be saved.

type Child = Node | string | undefined | false;
type Attributes = Record<string, string | number | boolean | ((event: any) => void)>;

function fill<E extends Element>(element: E, attributes: Attributes, children: Child[]): E {
  for (const [name, value] of Object.entries(attributes))
    if (typeof value === "function") element.addEventListener(name, value);
    else if (value !== false) element.setAttribute(name, value === true ? "" : String(value));
  element.append(...children.filter((child): child is Node | string => child !== undefined && child !== false));
  return element;
}

export function el<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]) {
  return fill(document.createElement(tag), attributes, children);
}

export function svg<K extends keyof SVGElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]) {
  return fill(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);
}

/** An id that does not clash when drawings of two pages are put into one document. */
export const uniqueId = (name: string) => `${name}-${Math.random().toString(36).slice(2)}`;

/** Colours of drawings: the page's, or those of paper in a file that is saved. */
export const ink = { text: "var(--ink, #1a1a1a)", soft: "var(--soft, #505050)", grid: "var(--grid, #e6e6e6)",
  frame: "var(--frame, #888)", paper: "var(--paper, #fff)" };

/** Shows what stands in the paper of its two subjects (class of-paper), or hides it; all such switches go together. */
export function paperSwitch(): HTMLElement {
  return el("label", { class: "paper-switch" }, el("input", { type: "checkbox", change: (event: Event) => {
    const on = (event.target as HTMLInputElement).checked;
    document.body.classList.toggle("paper", on);
    for (const other of document.querySelectorAll<HTMLInputElement>(".paper-switch input")) other.checked = on;
  } }), "beside the paper's two subjects");
}

/** A section that begins with its title. */
export const titled = (id: string, title: string, attributes: Attributes, ...children: Child[]): HTMLElement =>
  el("section", { id, ...attributes, "aria-labelledby": `${id}-title` }, el("h2", { id: `${id}-title` }, title), ...children);

export const section = (id: string, title: string, help: string, ...children: Child[]) =>
  titled(id, title, {}, el("p", { class: "help" }, help), ...children);

/** A section without data: one line. */
export const folded = (id: string, title: string, why: string) =>
  titled(id, title, { class: "folded" }, missing(why));

/** What a section says of each case, side by side, with their names where there are two. */
export const perCase = <C extends { name: string }>(cases: C[], content: (c: C) => Child[]) =>
  el("div", { class: "cases" }, ...cases.map((c) => el("div", { class: "panel" }, cases.length > 1 && el("h3", {}, c.name), ...content(c))));

export const missing = (what: string) => el("p", { class: "missing" }, what);

export function save(name: string, blob: Blob): void {
  const link = el("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** The file name of a figure: case, what, format. */
export const fileName = (...parts: string[]) =>
  parts.map((part) => part.replace(/[^\w.+-]+/g, "_")).join("-");

const svgText = (figure: SVGSVGElement) => {
  const copy = figure.cloneNode(true) as SVGSVGElement;
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.querySelectorAll(`.live${document.body.classList.contains("paper") ? "" : ", .of-paper"}`).forEach((mark) => mark.remove());
  return new XMLSerializer().serializeToString(copy).replaceAll(/var\(--[\w-]+, ([^)]+)\)/g, "$1");
};

/** Pictures on white paper, one above the other, as a PNG. */
async function paintedPng(width: number, height: number, layers: (HTMLCanvasElement | SVGSVGElement)[]): Promise<Blob> {
  const canvas = el("canvas", { width, height });
  const context = canvas.getContext("2d")!;
  context.fillStyle = "#fff";
  context.fillRect(0, 0, width, height);
  for (const layer of layers) {
    if (layer instanceof HTMLCanvasElement) context.drawImage(layer, 0, 0, width, height);
    else {
      const image = new Image();
      image.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(svgText(layer));
      await image.decode();
      context.drawImage(image, 0, 0, width, height);
    }
  }
  return new Promise((done) => canvas.toBlob((blob) => done(blob!), "image/png"));
}

function svgToPng(figure: SVGSVGElement): Promise<Blob> {
  const { width, height } = figure.viewBox.baseVal;
  return paintedPng(3 * width, 3 * height, [figure]);
}

/** A canvas with what is written over it, at the canvas's resolution. */
export const overlaidPng = (canvas: HTMLCanvasElement, overlay: SVGSVGElement) =>
  paintedPng(canvas.width, canvas.height, [canvas, overlay]);

const saveButton = (name: string, format: string, make: () => Promise<Blob>) =>
  el("button", { type: "button", class: "save", title: `Save as ${name}.${format}`, "aria-label": `Save as ${name}.${format}`,
    click: async () => save(`${name}.${format}`, await make()) }, format.toUpperCase());

/** A button that saves what is drawn on a canvas; `name` without extension. */
export const savePng = (name: string, make: () => Promise<Blob>) => el("div", { class: "buttons" }, saveButton(name, "png", make));

/** Words in lines of at most so many letters. */
export function inLines(words: string, most: number): string[] {
  return words.split(" ").reduce<string[]>((lines, word) => (lines.length && lines.at(-1)!.length + word.length < most
    ? [...lines.slice(0, -1), `${lines.at(-1)} ${word}`] : [...lines, word]), []);
}

/** A colour bar for a file: its parts for a width, of a height of 46. */
export type Legend = (width: number) => SVGElement[];

/** What is saved of a figure: its caption above it, its colour bar below it. */
function framed(content: SVGSVGElement, caption: string, legend: Legend | undefined): SVGSVGElement {
  const { width, height } = content.viewBox.baseVal;
  const [font, edge] = [12, 10];
  const lines = inLines(caption, width / (0.56 * font));
  const top = 6 + 1.3 * font * lines.length;
  const copy = content.cloneNode(true) as SVGSVGElement;
  for (const [name, value] of Object.entries({ x: 0, y: top, width, height })) copy.setAttribute(name, String(value));
  return svg("svg", { viewBox: `0 0 ${width} ${top + height + (legend ? 56 : 0)}`, "font-family": "sans-serif", "font-size": font },
    ...lines.map((line, i) => svg("text", { class: "caption", x: edge, y: 4 + 1.3 * font * (i + 0.8), fill: ink.text }, line)), copy,
    legend && svg("g", { class: "legend", transform: `translate(${edge} ${top + height + 2})` }, ...legend(width - 2 * edge)));
}

const saveSvg = (name: string, drawing: () => SVGSVGElement) => el("div", { class: "buttons" },
  saveButton(name, "svg", async () => new Blob([svgText(drawing())], { type: "image/svg+xml" })),
  saveButton(name, "png", () => svgToPng(drawing())));

/** A figure with its caption and its buttons. */
export function figure(caption: string, name: string, content: SVGSVGElement, legend?: Legend): HTMLElement {
  return el("figure", {}, content, el("figcaption", {}, caption, saveSvg(name, () => framed(content, caption, legend))));
}

/** A table with a button that saves it as CSV. Numbers are right-aligned; columns `ofPaper` are shown on request. */
export function table(name: string, head: string[], rows: (string | number)[][], ofPaper: number[] = []): HTMLElement {
  const quoted = (cell: string | number) => {
    const text = typeof cell === "number" ? (Number.isNaN(cell) ? "" : String(cell)) : cell === "–" ? "" : cell;
    return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  const text = () => [head, ...rows].map((row) => row.map(quoted).join(",")).join("\n").replaceAll("−", "-") + "\n";
  const kinds = head.map((_, i) => ({ class: `${ofPaper.includes(i) ? "of-paper" : ""} ${
    i > 0 && rows.some((row) => String(row[i]).length > 60) ? "long" : ""}`.trim() || false }));
  const cell = (content: string | number, i: number) =>
    i === 0 ? el("th", { scope: "row" }, String(content)) : el("td", kinds[i], String(content));
  return el("div", { class: "table" },
    el("table", {}, el("thead", {}, el("tr", {}, ...head.map((title, i) => title === "" ? el("td") : el("th", { scope: "col", ...kinds[i] }, title)))),
      el("tbody", {}, ...rows.map((row) => el("tr", {}, ...row.map(cell))))),
    el("div", { class: "buttons" }, saveButton(name, "csv", async () => new Blob([text()], { type: "text/csv" }))));
}
