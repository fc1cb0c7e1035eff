// Summary, comparisons with print, infarct zones, quality of the input, parameters, files.
import { type Case, type Row, value } from "./data.ts";
import { el, fileName, missing, save, section, table } from "./dom.ts";
import { calibration, measuredVolume } from "./calibration_section.ts";
import { healthyAdults, healthySubject, type MeanSd, paper, patient, volunteers } from "./published.ts";
import { label, quantities, quantity, shown, stateTitle } from "./quantities.ts";

const perCase = (cases: Case[], content: (c: Case) => (Node | undefined)[]) =>
  el("div", { class: "cases" }, ...cases.map((c) => el("div", { class: "panel" },
    cases.length > 1 && el("h3", {}, c.name), ...content(c))));
const pm = (x: MeanSd | undefined) => (x ? `${shown(x.mean)} ± ${shown(x.sd, 2)}` : "–");
/** As it is printed. */
const printed = (x: MeanSd | undefined) => (x ? `${x.mean} ± ${x.sd}`.replace("-", "−") : "–");
const ofRow = (row: Row | undefined): string => (row && row.mean !== "" ? pm({ mean: value(row.mean), sd: value(row.sd) }) : "–");

const known = ["case", "program", "resolution", "early_diastole", "edv_ml", "esv_ml", "ejection_fraction_percent", "strain",
  "whole_wall", "fibre_shortening_percent", "rotation", "observations", "calibration", "zones", "infarct_segments", "warnings",
  "parameters", "set_in_case_file"];

/** After the name of a phase. */
const endedSteady = "_was_steady";

/** Entries of a JSON value as rows: "calibration.passive.value", 1.2. */
function flat(json: any, prefix: string): [string, string][] {
  if (json !== null && typeof json === "object")
    return Object.entries(json).flatMap(([key, inner]) => flat(inner, prefix ? `${prefix}.${key}` : key));
  return [[prefix, json === null ? "–" : String(json)]];
}

function summaryOf(c: Case): (Node | undefined)[] {
  const s = c.summary;
  if (!s) return [missing("summary.json is missing: the results have not been computed.")];
  const moments = Object.keys(s.whole_wall ?? {});
  const states = ["early_diastole", ...moments].map((name) => s[name] ?? {});
  const steady = Object.keys(s).filter((key) => key.endsWith(endedSteady));
  const row = (title: string, key: string, digits = 4) => [title, ...states.map((state) => shown(state[key], digits))];
  const r = s.resolution ?? {};
  const measured = moments.map((name) => measuredVolume(c, ({ end_diastole: "EDV", end_systole: "ESV" } as Record<string, string>)[name]));
  return [
    el("dl", { class: "key" },
      ...[["end-diastolic volume", `${shown(s.edv_ml, 4)} ml`, "edv_ml"], ["end-systolic volume", `${shown(s.esv_ml, 4)} ml`, "esv_ml"],
        ["ejection fraction", `${shown(s.ejection_fraction_percent, 3)} %`, "ejection_fraction_percent"],
        ["mean fibre stress, end-systole", `${shown(s.whole_wall?.end_systole?.fibre_stress?.mean)} kPa`, "fibre_stress"],
        ["mean active tension, end-systole", `${shown(s.whole_wall?.end_systole?.active_tension?.mean)} kPa`, "active_tension"]]
        .map(([title, text, id]) => el("div", {}, el("dt", {}, title), el("dd", { "data-key": id }, text)))),
    table(fileName(c.name, "states"), ["", "early diastole", ...moments.map(stateTitle)], [
      row("time (s)", "time_s"), row("endocardial pressure (mmHg)", "pressure_mmHg"), row("cavity volume (ml)", "cavity_volume_ml"),
      ["measured cavity volume (ml)", "–", ...measured.map((ml) => shown(ml, 4))],
      row("wall volume (ml)", "wall_volume_ml"), row("endocardial apex z (mm)", "apex_endo_z_mm"),
      row("epicardial apex z (mm)", "apex_epi_z_mm"), row("radius of the endocardium at the base (mm)", "base_endo_radius_mm"),
      row("largest axial shift of the base (mm)", "base_axial_shift_mm", 2)]),
    measured.every((ml) => ml === undefined) ? missing("No measured volumes: the case is not fitted to any.") : undefined,
    ...calibration(c),
    el("h3", {}, "Whole wall, mean ± standard deviation"),
    table(fileName(c.name, "whole-wall"), ["quantity", ...moments.map(stateTitle)], quantities.map((q) => [label(q),
      ...moments.map((state) => pm(s.whole_wall?.[state]?.[q.name]))])),
    el("p", { class: "help" }, `Strain: ${s.strain ?? "not stated"}.`),
    el("h3", {}, "Does it look like a heart?"),
    table(fileName(c.name, "observations"), ["observation", "value", "rule", "holds"], (s.observations ?? []).map((o: any) =>
      [o.name.replaceAll("_", " "), `${shown(o.value)} ${o.unit}`, o.rule, o.holds ? "yes" : "NO"])),
    el("h3", {}, "Run"),
    table(fileName(c.name, "run"), ["", "value"], [
      ["program", `${s.program?.name} ${s.program?.version}`], ["engine", s.program?.engine ?? "–"],
      ["wall", `${r.elements ?? "–"} elements, ${r.nodes ?? "–"} nodes`], ["grid of the box", r.grid ?? "–"],
      ["mesh width (mm)", shown(r.mesh_width_mm, 4)], ["steps", `${r.steps ?? "–"} (${r.retries ?? "–"} taken back)`],
      ["time of the beat", r.wall_clock_s === undefined ? "–" : `${shown(r.wall_clock_s / 60)} min on ${r.ranks} rank${r.ranks === 1 ? "" : "s"}`],
      ...steady.map((key) => [`${key.slice(0, -endedSteady.length)} ended steady`, s[key] ? "yes" : "NO"])]),
    ...Object.keys(s).filter((key) => ![...known, ...moments, ...steady].includes(key)).map((key) =>
      el("div", {}, el("h3", {}, key.replaceAll("_", " ")), table(fileName(c.name, key), ["", "value"], flat(s[key], "")))),
  ];
}

export function summarySection(cases: Case[]): HTMLElement {
  return section("summary", "Summary",
    "What the model comes to at the three moments that matter. Read the volumes first, against the measured ones if there are any; " +
    "then whether each observation holds that a healthy ventricle fulfils; then the warnings. All numbers are summary.json's.",
    perCase(cases, (c) => [
      ...(c.summary?.warnings ?? []).map((text: string) => el("p", { class: "warning" }, text)), ...summaryOf(c)]));
}

export function normalSection(cases: Case[]): HTMLElement {
  const strains = ["fibre_strain", "circumferential_strain", "longitudinal_strain", "radial_strain"];
  const thirds = ["basal", "middle", "apical"];
  const verdict = (row: Row | undefined, of: MeanSd | undefined) => {
    const away = of ? Math.abs(value(row?.mean) - of.mean) / of.sd : NaN;
    return Number.isNaN(away) ? "–" : `${away.toFixed(1)} sd`;
  };
  return section("normal", "Strain beside published values",
    "Means ± standard deviations at end-systole, from end-diastole, per third of the wall (slices 1-2, 3-5, 6-7) and over all of it, " +
    `from regions.csv. Beside them, for the whole wall: the paper's healthy subject (${paper}), one heart and its spread over the wall; ` +
    `and the mean and spread of 100 healthy adults from feature tracking of cine images (${volunteers}), whose changes of length are ` +
    "converted to Green-Lagrange strain, E = e + e²/2. Feature tracking follows the borders of the wall, mostly the inner one, so it sees " +
    "more shortening than a mean over the wall; the model's base cannot move, so its longitudinal strain is small. “Away”: how many of those " +
    "standard deviations lie between. For thirds of the wall nothing stands beside the model: the paper's Table 2 compares them with " +
    "tagged images of 31 volunteers (Moore et al., Radiology 214:453, 2000), but neither's numbers are in the paper's text.",
    perCase(cases, (c) => c.regions.length === 0 ? [missing("regions.csv is missing: there are no results yet.")] : [
      table(fileName(c.name, "strain-thirds"), ["strain", ...thirds, "whole wall", "paper's healthy subject", "away", "100 healthy adults", "away"],
        strains.map((name) => {
          const whole = c.row("end_systole", "whole", "wall", name);
          return [quantity(name).title, ...thirds.map((third) => ofRow(c.row("end_systole", "third", third, name))), ofRow(whole),
            printed(healthySubject[name]), verdict(whole, healthySubject[name]), pm(healthyAdults[name]), verdict(whole, healthyAdults[name])];
        }))]));
}

function scarTable(c: Case): Node | undefined {
  const rows: any[] = c.summary?.infarct_segments ?? [];
  return rows.length ? table(fileName(c.name, "infarct-segments"),
    ["infarcted segment (AHA)", "infarct (ml)", "infarct (g)", "part of the segment (%)", "transmurality (%)"], rows.map((s) =>
      [s.segment, ...["infarct_ml", "infarct_g", "percent_of_segment", "transmurality_percent"].map((key) => shown(s[key]))])) : undefined;
}

export function zoneSection(cases: Case[]): HTMLElement {
  const names = ["active_tension", "fibre_stress", "fibre_stress_passive", "fibre_strain", "circumferential_strain", "longitudinal_strain", "radial_strain"];
  const cells = (row: Row | undefined) => row ? [ofRow(row), shown(value(row.p1)), shown(value(row.p50)), shown(value(row.p99))] : ["–", "–", "–", "–"];
  return section("zones", "Infarct, border zone, remote muscle",
    "Distributions at end-systole over the infarct (M = 1), its border zone (0 < M < 1) and remote muscle (M = 0), from regions.csv; " +
    "beside them the means the paper gives for its patient.",
    perCase(cases, (c) => {
      const zones = c.regionNames("zone");
      if (!c.regions.length) return [missing("regions.csv is missing: there are no results yet.")];
      if (!zones.length) return [missing("This case has no infarct.")];
      return [table(fileName(c.name, "zones"), ["quantity, zone", "volume (ml)", "mean ± sd", "1%", "median", "99%", "paper's patient"],
        names.flatMap((name) => zones.map((zone) => {
          const row = c.row("end_systole", "zone", zone, name);
          return [`${label(quantity(name))}, ${zone}`, shown(value(row?.volume_ml)), ...cells(row),
            printed(patient[zone as "remote"]?.[name])];
        }))), scarTable(c)];
    }));
}

export function inputSection(cases: Case[]): HTMLElement {
  const rows = (c: Case, file: string, absent: string) => {
    const found = c.table(file);
    if (!found.length) return missing(absent);
    const head = Object.keys(found[0]);
    return table(fileName(c.name, file.replace(".csv", "")), head.map((name) => name.replaceAll("_", " ")),
      found.map((row) => head.map((name) => row[name] === "" ? "–" : row[name].replace("-", "−"))));
  };
  return section("input", "Input and mesh",
    "How far the fitted surfaces are from the contours (mm, per image and surface, with the shift that corrected the slice), the volumes " +
    "of the fit beside those of the contours or labels and what was found per slice, and the quality of the elements: a scaled Jacobian of 1 is a cube, 0 a flat element.",
    perCase(cases, (c) => [
      el("h3", {}, "Contours"), rows(c, "fit.csv", "No contours were fitted: the shape is an ellipsoid or a given mesh."),
      el("h3", {}, "Quality sheet"), rows(c, "anatomy_quality.csv", "No quality sheet: the shape was not drawn on images."),
      el("h3", {}, "Mesh"), rows(c, "quality.csv", "quality.csv is missing: the mesh has not been made.")]));
}

export function parameterSection(cases: Case[]): HTMLElement {
  const names = [...new Set(cases.flatMap((c) => Object.keys(c.summary?.parameters ?? {})))];
  const differ = (name: string) => cases.length > 1 && new Set(cases.map((c) => c.parameter(name))).size > 1;
  const place = (c: Case, name: string) => c.summary?.set_in_case_file?.[name] ?? (c.summary ? "default" : "–");
  return section("parameters", "Parameters and files",
    "Every parameter of the run, with the line of the case file that sets it, or default. " +
    (cases.length > 1 ? "Those in which the cases differ come first." : ""),
    names.length ? el("details", { open: cases.length > 1 }, el("summary", {}, `${names.length} parameters`),
      table(fileName(...cases.map((c) => c.name), "parameters"), ["parameter", ...cases.flatMap((c) => [c.name, "set in"])],
        [...names.filter(differ), ...names.filter((name) => !differ(name))].map((name) =>
          [name, ...cases.flatMap((c) => [c.parameter(name) ?? "–", place(c, name)])])))
      : missing("summary.json is missing, and with it the parameters."),
    perCase(cases, (c) => [el("p", {}, "Save the files that this page was made from: "),
      el("div", { class: "buttons" }, ...Object.entries(c.json.files).map(([name, text]) =>
        el("button", { type: "button", class: "save", click: () => save(fileName(c.name, name), new Blob([text], { type: "text/plain" })) }, name)))]));
}
