// Strain of the model beside strain from images: per region, and how far they agree.
import { drawChart, type Line } from "./chart.ts";
import { lineColours } from "./colours.ts";
import { type Case, type Row, value } from "./data.ts";
import { el, figure, fileName, folded, missing, perCase, section, table } from "./dom.ts";
import { heartOf, starNote, starredTitle } from "./orientation.ts";
import { shown } from "./quantities.ts";

const components = ["circumferential", "radial"];
const schemes: [string, string][] = [["sector", "sectors of slices"], ["aha17", "AHA segments"]];
/** A caption, with what was assumed of the anatomy that the regions hang on. */
const withStars = (c: Case, caption: string) => {
  const note = starNote(heartOf(c));
  return `${c.name}: ${caption}${note && `, regions* (${note})`}`;
};

interface Agreement { count: number; bias: number; standard_deviation: number; lower_limit: number; upper_limit: number; correlation: number }

const words: Record<string, string> = { ant: "anterior", antsept: "anteroseptal", infsept: "inferoseptal", inf: "inferior",
  inflat: "inferolateral", antlat: "anterolateral", all: "whole slice" };
const region = (r: Row) => (r.scheme === "aha17" ? r.segment : `slice ${r.slice}, ${words[r.segment] ?? r.segment}`);

const across = (values: number[]) => [Math.min(...values), Math.max(...values)];

/** Model against images, with the line on which they are the same. */
function scatter(c: Case, component: string, rows: Row[]): HTMLElement {
  const [x, y] = [rows.map((r) => value(r.measured)), rows.map((r) => value(r.model))];
  const ends = across([...x, ...y]);
  const lines: Line[] = [{ label: "a region", colour: lineColours[0], x, y, dots: true, bare: true },
    { label: "the same", colour: "#777", dashed: true, x: ends, y: ends }];
  const chart = drawChart({ x: `${component} strain, images`, y: `${component} strain, model`, lines });
  return figure(withStars(c, `${component} strain of the model against that of the images`), fileName(c.name, component, "scatter"), chart.figure);
}

/** Difference against mean, with bias and 95% limits. */
function blandAltman(c: Case, component: string, rows: Row[], a: Agreement): HTMLElement {
  const x = rows.map((r) => (value(r.measured) + value(r.model)) / 2);
  const y = rows.map((r) => value(r.difference));
  const ends = across(x);
  const level = (label: string, at: number, dashed: boolean): Line => ({ label, colour: dashed ? lineColours[1] : "#333", dashed, x: ends, y: [at, at] });
  const chart = drawChart({ x: `mean of both, ${component} strain`, y: "model − images", lines: [
    { label: "a region", colour: lineColours[0], x, y, dots: true, bare: true }, level(`bias ${shown(a.bias)}`, a.bias, false),
    level(`upper limit ${shown(a.upper_limit)}`, a.upper_limit, true), level(`lower limit ${shown(a.lower_limit)}`, a.lower_limit, true)] });
  return figure(withStars(c, `Bland and Altman, ${component} strain`), fileName(c.name, component, "bland-altman"), chart.figure);
}

function agreementTable(c: Case, all: any): HTMLElement {
  const rows = components.flatMap((component) => schemes.flatMap(([scheme, title]) => {
    const a: Agreement | undefined = all[component]?.[scheme];
    return a ? [[`${component}, ${title}`, String(a.count), shown(a.bias), shown(a.standard_deviation),
      `${shown(a.lower_limit)} to ${shown(a.upper_limit)}`, shown(a.correlation)]] : [];
  }));
  return table(fileName(c.name, "strain-agreement"),
    ["strain", "regions", "bias", "sd of differences", "95% limits of agreement", "correlation"], rows);
}

/** Both components side by side, region after region. */
function regionTable(c: Case, scheme: string, title: string): HTMLElement | undefined {
  const [cir, rad] = components.map((k) => c.table(`strain_comparison_${k}.csv`).filter((r) => r.scheme === scheme));
  const names = [...new Set([...cir, ...rad].map(region))];
  if (!names.length) return undefined;
  const cells = (rows: Row[], name: string) => {
    const r = rows.find((row) => region(row) === name);
    return ["measured", "model", "difference"].map((column) => shown(value(r?.[column])));
  };
  return el("details", { open: scheme === "aha17" || !c.table("strain_comparison_circumferential.csv").some((r) => r.scheme === "aha17") },
    el("summary", {}, `${names.length} ${title}`), table(fileName(c.name, "strain", scheme),
      [starredTitle("region", heartOf(c)), "circumferential, images", "model", "difference", "radial, images", "model", "difference"],
      names.map((name) => [name, ...cells(cir, name), ...cells(rad, name)])));
}

const none = "There is no strain from images. A case with [strain] measures it from its cine, or takes it from a table.";
const hasStrain = (c: Case) => c.json.files["strain_agreement.json"] !== undefined && components.some((k) => c.table(`strain_comparison_${k}.csv`).length);

function ofCase(c: Case): (Node | undefined)[] {
  const rows = components.map((k) => c.table(`strain_comparison_${k}.csv`));
  if (!hasStrain(c)) return [missing(`${c.name}: ${none}`)];
  const all = JSON.parse(c.json.files["strain_agreement.json"]);
  const scheme = all.circumferential?.sector || all.radial?.sector ? "sector" : "aha17";
  const figures = components.flatMap((component, k) => {
    const chosen = rows[k].filter((r) => r.scheme === scheme);
    const a: Agreement | undefined = all[component]?.[scheme];
    return a && chosen.length ? [scatter(c, component, chosen), blandAltman(c, component, chosen, a)] : [];
  });
  const unfollowed = c.table("strain_slices.csv").filter((r) => r.followed === "no").map((r) => r.slice);
  return [
    unfollowed.length ? el("p", { class: "warning" }, `Not followed everywhere: slice ${unfollowed.join(", ")}. ` +
      "Strains of sectors there are not to be trusted; AHA segments leave them out.") : undefined,
    el("p", { class: "help" }, `Measure: ${all.measure === "green_lagrange" ? "Green-Lagrange" : all.measure} strain. Charts: ${scheme === "sector" ? "sectors of slices" : "AHA segments"}.`),
    agreementTable(c, all), el("div", { class: "figures" }, ...figures),
    ...schemes.map(([name, title]) => regionTable(c, name, title))];
}

export function strainSection(cases: Case[]): HTMLElement {
  if (!cases.some(hasStrain)) return folded("strain", "Strain: model and images", none);
  return section("strain", "Strain: model and images",
    "Systolic strain from end-diastole of the model and of the images, region by region (the paper's Table 1), and how far they agree: " +
    "the bias is the mean of model − images, and 95% of the differences of such regions lie within the limits (Bland & Altman, Lancet " +
    "327:307, 1986). Points on the dashed line agree. Tracking in short-axis planes cannot see tissue that moves through them, and radial " +
    "strain from images is far less certain than circumferential: a difference is not the model's error alone. " +
    "From strain_comparison_*.csv and strain_agreement.json.",
    perCase(cases, ofCase));
}
