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

export function section(id: string, title: string, help: string, ...children: Child[]): HTMLElement {
  return el("section", { id, "aria-labelledby": `${id}-title` }, el("h2", { id: `${id}-title` }, title),
    el("p", { class: "help" }, help), ...children);
}

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
  copy.querySelectorAll(".live").forEach((mark) => mark.remove());
  return new XMLSerializer().serializeToString(copy);
};

async function svgToPng(figure: SVGSVGElement): Promise<Blob> {
  const { width, height } = figure.viewBox.baseVal;
  const image = new Image();
  image.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(svgText(figure));
  await image.decode();
  const canvas = el("canvas", { width: 3 * width, height: 3 * height });
  const context = canvas.getContext("2d")!;
  context.fillStyle = "#fff";
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(image, 0, 0, canvas.width, canvas.height);
  return canvasPng(canvas);
}

export const canvasPng = (canvas: HTMLCanvasElement) =>
  new Promise<Blob>((done) => canvas.toBlob((blob) => done(blob!), "image/png"));

/** Buttons that save a figure: `name` without extension. */
export function saveButtons(name: string, source: () => SVGSVGElement | HTMLCanvasElement): HTMLElement {
  const button = (format: string, make: () => Promise<Blob>) =>
    el("button", { type: "button", class: "save", title: `Save as ${name}.${format}`,
      click: async () => save(`${name}.${format}`, await make()) }, format.toUpperCase());
  const now = source();
  const bar = el("div", { class: "buttons" });
  if (now instanceof SVGSVGElement) {
    bar.append(button("svg", async () => new Blob([svgText(source() as SVGSVGElement)], { type: "image/svg+xml" })));
    bar.append(button("png", () => svgToPng(source() as SVGSVGElement)));
  } else bar.append(button("png", () => canvasPng(source() as HTMLCanvasElement)));
  return bar;
}

/** A figure with its caption and its buttons. */
export function figure(caption: string, name: string, content: SVGSVGElement): HTMLElement {
  return el("figure", {}, content, el("figcaption", {}, caption, saveButtons(name, () => content)));
}

/** A table with a button that saves it as CSV. Numbers are right-aligned. */
export function table(name: string, head: string[], rows: (string | number)[][]): HTMLElement {
  const quoted = (cell: string | number) => {
    const text = typeof cell === "number" ? (Number.isNaN(cell) ? "" : String(cell)) : cell === "–" ? "" : cell;
    return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  const text = [head, ...rows].map((row) => row.map(quoted).join(",")).join("\n").replaceAll("−", "-") + "\n";
  const cell = (content: string | number, i: number) =>
    i === 0 ? el("th", { scope: "row" }, String(content)) : el("td", {}, String(content));
  return el("div", { class: "table" },
    el("table", {}, el("thead", {}, el("tr", {}, ...head.map((title) => el("th", { scope: "col" }, title)))),
      el("tbody", {}, ...rows.map((row) => el("tr", {}, ...row.map(cell))))),
    el("div", { class: "buttons" }, el("button", { type: "button", class: "save", title: `Save as ${name}.csv`,
      click: () => save(`${name}.csv`, new Blob([text], { type: "text/csv" })) }, "CSV")));
}
