// Summary, comparisons with print, infarct zones, quality of the input, parameters, files.
import { type Case, type Row, value } from "./data.ts";
import { el, fileName, folded, missing, paperSwitch, perCase, save, section, table } from "./dom.ts";
import { calibration, measuredVolume } from "./calibration_section.ts";
import { answerOf, judgements, rangeOf } from "./first_section.ts";
import { transmurality } from "./regions_section.ts";
import { heartOf, marked, starredTitle } from "./orientation.ts";
import type { Shared } from "./shared.ts";
import { healthyAdults, healthySubject, type MeanSd, paper, patient, volunteers } from "./published.ts";
import { label, nothingBelow, quantities, quantity, shown, stateTitle, typeset, volumeAt } from "./quantities.ts";

const pm = (x: MeanSd | undefined, least = 0) => (x ? `${shown(nothingBelow(least, x.mean))} ± ${shown(nothingBelow(least, x.sd), 2)}` : "–");
/** As it is printed. */
const printed = (x: MeanSd | undefined) => (x ? `${x.mean} ± ${x.sd}`.replace("-", "−") : "–");
const ofRow = (row: Row | undefined, least = 0): string => (row && row.mean !== "" ? pm({ mean: value(row.mean), sd: value(row.sd) }, least) : "–");
/** What of a quantity is below any meaning: a tenth of what has no colour. */
const leastOf = (name: string) => 0.1 * quantity(name).floor;

const known = ["case", "program", "resolution", "early_diastole", "edv_ml", "esv_ml", "stroke_volume_ml", "mass_g",
  "ejection_fraction_percent", "strain", "whole_wall", "fibre_shortening_percent",
  "rotation", "plausibility", "calibration", "heartbeats_fitted", "shape_fitted", "zones", "infarct", "infarct_segments", "assumptions", "warnings", "marks", "parameters", "set_in_case_file"];

/** After the name of a phase. */
const endedSteady = "_was_steady";
const steadyKeys = (c: Case) => Object.keys(c.summary).filter((key) => key.endsWith(endedSteady));

/** The moments that summary.json tells of. */
const momentsOf = (c: Case) => Object.keys(c.summary.whole_wall ?? {});

/** Entries of a JSON value as rows: "calibration.passive.value", 1.2. */
function flat(json: any, prefix: string): [string, string][] {
  if (json !== null && typeof json === "object")
    return Object.entries(json).flatMap(([key, inner]) => flat(inner, prefix ? `${prefix}.${key}` : key));
  return [[prefix, typeof json === "string" ? json : wordOrNumber(json === null ? "" : String(json))]];
}

/** "computed", or "fitted / computed" where the columns differ. */
const marks = (c: Case, ...paths: string[]) => [...new Set(paths.map((path) => c.mark(path)).filter(Boolean))].join(" / ") || "–";

function stateTable(c: Case): HTMLElement {
  const moments = momentsOf(c);
  const names = ["early_diastole", ...moments];
  const row = (title: string, key: string, digits = 4, nothing = 0) => [title, ...names.map((name) => shown(nothingBelow(nothing, c.summary[name]?.[key]), digits)),
    marks(c, ...names.map((name) => `${name}.${key}`))];
  const measured = moments.map((name) => shown(measuredVolume(c, volumeAt(name)), 4));
  return table(fileName(c.name, "states"), ["", ...names.map((name) => c.momentTitle(name)), "origin"], [
    ...(c.isLoaded ? [] : [row("time (s)", "time_s")]), row("endocardial pressure (mmHg)", "pressure_mmHg"), row("cavity volume (ml)", "cavity_volume_ml"),
    ["measured cavity volume (ml)", "–", ...measured, "measured"],
    row("wall volume (ml)", "wall_volume_ml"), row("endocardial apex z (mm)", "apex_endo_z_mm"),
    row("epicardial apex z (mm)", "apex_epi_z_mm"), row("radius of the endocardium at the base (mm)", "base_endo_radius_mm"),
    row("largest axial shift of the base (mm)", "base_axial_shift_mm", 2, 1e-3)]);
}

function plausibilityTable(c: Case): HTMLElement | undefined {
  const all = judgements(c);
  return all.length === 0 ? undefined : table(fileName(c.name, "plausibility"), ["figure", "value", "usual", "answer", "why, source"], all.map((j) =>
    [j.label, `${shown(nothingBelow(j.low === null || j.high === null ? 0 : 1e-3 * (j.high - j.low), j.value))}${j.unit === "1" ? "" : j.unit === "deg" ? "°" : ` ${j.unit}`}`, rangeOf(j), answerOf(j), typeset([j.reason, j.source].filter(Boolean).join("; "))]));
}

function runTable(c: Case): HTMLElement {
  const s = c.summary;
  const r = s.resolution ?? {};
  return table(fileName(c.name, "run"), ["", "value"], [
    ["program", `${s.program?.name} ${s.program?.version}`], ["engine", s.program?.engine ?? "–"],
    ["wall", `${r.elements ?? "–"}${r.order === 2 ? " quadratic" : ""} elements, ${r.nodes ?? "–"} nodes`],
    ...(r.grid ? [["grid of the box", r.grid], ["mesh width (mm)", shown(r.mesh_width_mm, 4)]] : []),  // the immersed engine's
    ["steps", `${r.steps ?? "–"} (${r.retries ?? "–"} taken back)`],
    ["time of the beat", r.wall_clock_s === undefined ? "–" : `${shown(r.wall_clock_s / 60)} min on ${r.ranks} rank${r.ranks === 1 ? "" : "s"}`],
    ...steadyKeys(c).map((key) => [`${key.slice(0, -endedSteady.length)} ended steady`, s[key] ? "yes" : "NO"])]);
}

function detailsOf(c: Case): (Node | undefined)[] {
  const s = c.summary;
  if (!s) return [missing("summary.json is missing: the results have not been computed.")];
  return [
    stateTable(c), ...calibration(c),
    el("h3", {}, "Does it look like a heart?"), plausibilityTable(c),
    el("h3", {}, "Whole wall, mean ± standard deviation"),
    table(fileName(c.name, "whole-wall"), ["quantity", ...momentsOf(c).map(stateTitle), "origin"], quantities
      .filter((q) => momentsOf(c).some((state) => s.whole_wall?.[state]?.[q.name])).map((q) => [label(q),
        ...momentsOf(c).map((state) => pm(s.whole_wall?.[state]?.[q.name], leastOf(q.name))), marks(c, "whole_wall")])),
    el("p", { class: "help" }, `Strain: ${s.strain ?? "not stated"}.`),
    el("h3", {}, "Run"), runTable(c),
    ...Object.keys(s).filter((key) => ![...known, ...momentsOf(c), ...steadyKeys(c)].includes(key)).map((key) =>
      el("div", {}, el("h3", {}, key.replaceAll("_", " ")), table(fileName(c.name, key), ["", "value"], flat(s[key], "")))),
  ];
}

export function detailsSection(cases: Case[]): HTMLElement {
  const title = "Volumes, shape, plausibility";
  if (cases.every((c) => !c.summary)) return folded("details", title, "summary.json is missing: the results have not been computed.");
  return section("details", title,
    "What the model comes to at the three moments that matter, and what each number is: measured, fitted so that another agrees with a measurement, " +
    "assumed, or computed from these. A number is within its usual range, outside of it, or the range does not apply; what no beating heart can have is " +
    "flagged. All numbers are summary.json's.", perCase(cases, detailsOf));
}

export function normalSection(cases: Case[]): HTMLElement {
  const strains = ["fibre_strain", "circumferential_strain", "longitudinal_strain", "radial_strain"];
  const thirds = ["basal", "middle", "apical"];
  const verdict = (row: Row | undefined, of: MeanSd | undefined) => {
    const away = of ? Math.abs(value(row?.mean) - of.mean) / of.sd : NaN;
    return Number.isNaN(away) ? "–" : `${away.toFixed(1)} sd`;
  };
  const title = "Strain beside published values";
  if (cases.every((c) => !c.regions.length)) return folded("normal", title, "regions.csv is missing: there are no results yet.");
  return section("normal", title,
    "Means ± standard deviations at end-systole, from end-diastole, per third of the wall (slices 1-2, 3-5, 6-7) and over all of it, " +
    "from regions.csv. Beside them, for the whole wall, " +
    `the mean and spread of 100 healthy adults from feature tracking of cine images (${volunteers}), whose changes of length are ` +
    "converted to Green-Lagrange strain, E = e + e²/2. Feature tracking follows the borders of the wall, mostly the inner one, so it sees " +
    "more shortening than a mean over the wall; a model whose base is held in its plane shortens little along its axis. “Away”: how many of those " +
    `standard deviations lie between. On request, the paper's healthy subject (${paper}): one heart, and its spread over the wall.`, paperSwitch(),
    perCase(cases, (c) => c.regions.length === 0 ? [missing("regions.csv is missing: there are no results yet.")] : [
      table(fileName(c.name, "strain-thirds"), ["strain", ...thirds, "whole wall", "100 healthy adults", "away", "paper's healthy subject", "away"],
        strains.map((name) => {
          const whole = c.row("end_systole", "whole", "wall", name);
          return [quantity(name).title, ...thirds.map((third) => ofRow(c.row("end_systole", "third", third, name))), ofRow(whole),
            pm(healthyAdults[name]), verdict(whole, healthyAdults[name]), printed(healthySubject[name]), verdict(whole, healthySubject[name])];
        }), [7, 8])]));
}

function scarTable(c: Case): Node | undefined {
  const rows: any[] = c.summary?.infarct_segments ?? [];
  const infarct = marked("infarct", c.assumesInfarct);
  return rows.length ? table(fileName(c.name, "infarct-segments"),
    [starredTitle("infarcted segment (AHA)", heartOf(c)), `${infarct} (ml)`, `${infarct} (g)`, "part of the segment (%)", "transmurality (%)"], rows.map((s) =>
      [s.segment, ...["infarct_ml", "infarct_g", "percent_of_segment", "transmurality_percent"].map((key) => shown(s[key]))])) : undefined;
}

export function zoneSection(cases: Case[], shared: Shared): HTMLElement {
  const title = "Infarct, border zone, remote muscle";
  if (cases.every((c) => !c.regionNames("zone").length))
    return folded("zones", title, cases.some((c) => c.regions.length) ? "There is no infarct." : "regions.csv is missing: there are no results yet.");
  const names = ["active_tension", "fibre_stress", "fibre_stress_passive", "fibre_strain", "circumferential_strain", "longitudinal_strain", "radial_strain"];
  const cells = (row: Row | undefined, least: number) => row ? [ofRow(row, least), ...["p1", "p50", "p99"].map((name) => shown(nothingBelow(least, value(row[name]))))] : ["–", "–", "–", "–"];
  return section("zones", title,
    "Per AHA segment the part of it that is infarcted, and the transmurality: the part of the wall's thickness that the infarct takes where it is, be that little of the segment. Distributions at end-systole over the infarct (M = 1), " +
    "its border zone (0 < M < 1) and remote muscle (M = 0), from regions.csv; on request with the means the paper gives for its patient.", paperSwitch(),
    perCase(cases, (c) => {
      const zones = c.regionNames("zone");
      if (!c.regions.length) return [missing("regions.csv is missing: there are no results yet.")];
      if (!zones.length) return [missing("This case has no infarct.")];
      return [transmurality(c, shared), table(fileName(c.name, "zones"), ["quantity, zone", "volume (ml)", "mean ± sd", "1%", "median", "99%", "paper's patient"],
        names.flatMap((name) => zones.map((zone) => {
          const row = c.row("end_systole", "zone", zone, name);
          return [marked(`${label(quantity(name))}, ${zone}`, c.assumesInfarct), shown(value(row?.volume_ml)), ...cells(row, leastOf(name)),
            printed(patient[zone as "remote"]?.[name])];
        })), [6]), scarTable(c)];
    }));
}

/** Units as they are set: "mm²" for "mm2" and "mm^2". */
const unitShown = (unit: string) => (unit === "" || unit === "1" || unit === "-" ? "–" : unit.replace(/\^?2$/, "²"));

/** A field of a table for reading: whole numbers as they are, others to four digits, words without underscores. */
function wordOrNumber(field: string): string {
  const x = value(field);
  if (!Number.isNaN(x)) return Number.isInteger(x) ? field.replace("-", "−") : shown(x, 4);
  return field === "" ? "–" : field.replaceAll("_", " ");
}

export function inputSection(cases: Case[]): HTMLElement {
  const rows = (c: Case, file: string, absent: string) => {
    const found = c.table(file);
    if (!found.length) return missing(absent);
    const head = Object.keys(found[0]);
    return table(fileName(c.name, file.replace(".csv", "")), head.map((name) => name.replaceAll("_", " ")),
      found.map((row) => head.map((name) => name === "unit" ? unitShown(row[name]) : wordOrNumber(row[name]))));
  };
  return section("input", "Input and mesh",
    "How far the fitted surfaces are from the contours (mm, per image and surface, with the shift that corrected the slice), the volumes " +
    "of the fit beside those of the contours or labels and what was found per slice, and the quality of the elements: a scaled Jacobian of 1 is a cube, 0 a flat element.",
    perCase(cases, (c) => [
      el("h3", {}, "Contours"), rows(c, "fit.csv", "No contours were fitted: the shape is an ellipsoid or a given mesh."),
      el("h3", {}, "Quality sheet"), rows(c, "anatomy_quality.csv", "No quality sheet: the shape was not drawn on images."),
      el("h3", {}, "Mesh"), rows(c, "quality.csv", "quality.csv is missing: the mesh has not been made.")]));
}

/** All parameters; the rows of those that no case file sets have the class by-default: print leaves them out. */
function parameterTable(cases: Case[], names: string[]): HTMLElement {
  const place = (c: Case, name: string) => c.summary?.set_in_case_file?.[name] ?? (c.summary ? "default" : "–");
  const all = table(fileName(...cases.map((c) => c.name), "parameters"), ["parameter", ...cases.flatMap((c) => [c.name, "set in"])],
    names.map((name) => [name, ...cases.flatMap((c) => [c.parameter(name) ?? "–", place(c, name)])]));
  all.querySelectorAll("tbody tr").forEach((row, i) => row.classList.toggle("by-default", cases.every((c) => !c.summary?.set_in_case_file?.[names[i]])));
  return all;
}

export function parameterSection(cases: Case[]): HTMLElement {
  const names = [...new Set(cases.flatMap((c) => Object.keys(c.summary?.parameters ?? {})))];
  const differ = (name: string) => cases.length > 1 && new Set(cases.map((c) => c.parameter(name))).size > 1;
  const isSet = (name: string) => cases.some((c) => c.summary?.set_in_case_file?.[name]);
  return section("parameters", "Parameters and files",
    "Every parameter of the run, with the line of the case file that sets it, or default. " +
    (cases.length > 1 ? "Those in which the cases differ come first." : ""),
    names.length ? el("details", { open: cases.length > 1 }, el("summary", {}, `${names.length} parameters`),
      parameterTable(cases, [...names.filter(differ), ...names.filter((name) => !differ(name))]),
      el("p", { class: "help in-print" }, `Printed are the ${names.filter(isSet).length} that were set or fitted. The other ${
        names.filter((name) => !isSet(name)).length} have their defaults, which summary.json holds and ventricle parameters lists.`))
      : missing("summary.json is missing, and with it the parameters."),
    perCase(cases, (c) => [el("p", {}, "Save the files that this page was made from: "),
      el("div", { class: "buttons" }, ...Object.entries(c.json.files).map(([name, text]) =>
        el("button", { type: "button", class: "save", click: () => save(fileName(c.name, name), new Blob([text], { type: "text/plain" })) }, name)))]));
}
