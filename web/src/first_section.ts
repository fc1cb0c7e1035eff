// The numbers that are read first, beside measured ones and usual ranges.
import { measuredOfBeat, measuredVolume } from "./calibration_section.ts";
import { type Case, type Row, value } from "./data.ts";
import { el, fileName, missing, table, titled } from "./dom.ts";
import { quantity, shown } from "./quantities.ts";

interface Figure {
  title: string;
  unit: string;
  path: string;  // in summary.json: whose mark holds
  range?: string;  // its name in summary.json's plausibility
  of: (c: Case) => number | undefined;
  measured?: (c: Case) => number | undefined;
}

const both = (c: Case, f: (edv: number, esv: number) => number) => {
  const [edv, esv] = ["EDV", "ESV"].map((name) => measuredVolume(c, name));
  return edv === undefined || esv === undefined ? undefined : f(edv, esv);
};

/** Mean over the regions that images gave, in per cent; Green-Lagrange, as the model's own. */
function seen(c: Case, component: string): number | undefined {
  const agreement = c.json.files["strain_agreement.json"];
  const isLength = agreement !== undefined && JSON.parse(agreement).measure === "engineering";
  const rows: Row[] = c.table(`strain_comparison_${component}.csv`);
  const scheme = rows.some((r) => r.scheme === "sector") ? "sector" : "aha17";
  const found = rows.filter((r) => r.scheme === scheme).map((r) => value(r.measured)).filter(Number.isFinite)
    .map((e) => (isLength ? e + (e * e) / 2 : e));
  return found.length ? (100 * found.reduce((sum, x) => sum + x, 0)) / found.length : undefined;
}

const strain = (name: string) => (c: Case) => {
  const mean = c.summary?.whole_wall?.end_systole?.[`${name}_strain`]?.mean;
  return typeof mean === "number" ? 100 * mean : undefined;
};

const figures: Figure[] = [
  { title: "end-diastolic volume", unit: "ml", path: "edv_ml", range: "edv_ml", of: (c) => c.summary?.edv_ml, measured: (c) => measuredVolume(c, "EDV") },
  { title: "end-systolic volume", unit: "ml", path: "esv_ml", range: "esv_ml", of: (c) => c.summary?.esv_ml, measured: (c) => measuredVolume(c, "ESV") },
  { title: "stroke volume", unit: "ml", path: "stroke_volume_ml", of: (c) => c.summary?.stroke_volume_ml, measured: (c) => both(c, (edv, esv) => edv - esv) },
  { title: "ejection fraction", unit: "%", path: "ejection_fraction_percent", range: "ejection_fraction_percent",
    of: (c) => c.summary?.ejection_fraction_percent, measured: (c) => both(c, (edv, esv) => (100 * (edv - esv)) / edv) },
  ...[["peak pressure", "peak_pressure_mmHg", "mmHg"], ["aortic pressure, systolic", "aortic_systolic_mmHg", "mmHg", "systolic"],
    ["aortic pressure, diastolic", "aortic_diastolic_mmHg", "mmHg", "diastolic"], ["stroke work", "stroke_work_mmHg_ml", "mmHg ml"]].map(([title, name, unit, datum]): Figure =>
    ({ title, unit, path: `cycle.last_beat.${name}`, of: (c) => c.summary?.cycle?.last_beat?.[name], measured: (c) => measuredOfBeat(c, datum) })),
  { title: "mass of the wall", unit: "g", path: "mass_g", range: "mass_g", of: (c) => c.summary?.mass_g },
  { title: quantity("circumferential_strain").title, unit: "%", path: "whole_wall.end_systole", range: "circumferential_strain", of: strain("circumferential"),
    measured: (c) => seen(c, "circumferential") },
  { title: quantity("longitudinal_strain").title, unit: "%", path: "whole_wall.end_systole", range: "longitudinal_strain", of: strain("longitudinal") },
  { title: quantity("radial_strain").title, unit: "%", path: "whole_wall.end_systole", of: strain("radial"), measured: (c) => seen(c, "radial") },
  { title: "scar, part of the wall", unit: "%", path: "infarct", of: (c) => c.summary?.infarct?.percent_of_wall },
];

interface Judgement { quantity: string; label: string; value: number; unit: string; low: number | null; high: number | null; source: string; answer: string;
  reason: string; impossible: boolean; of?: "heart" | "computation" }

export const judgements = (c: Case): Judgement[] => c.summary?.plausibility ?? [];

export const answerOf = (j: Judgement) => (j.impossible ? "IMPOSSIBLE" : j.answer);

export function rangeOf(j: Judgement, factor = 1): string {
  const end = (x: number | null) => (x === null ? "…" : String(Number((x * factor).toPrecision(3))).replace("-", "−"));
  return `${end(j.low)} to ${end(j.high)}`;
}

/** Model, measured where anything was, usual range, answer, origin. */
function ofOne(c: Case, measured: boolean): (string | number)[][] {
  const judged = (name: string | undefined) => judgements(c).find((j) => j.quantity === name);
  return figures.filter((f) => f.of(c) !== undefined).map((f) => {
    const j = judged(f.range);
    return [`${f.title} (${f.unit})`, shown(f.of(c)), ...(measured ? [shown(f.measured?.(c))] : []), j ? rangeOf(j, j.unit === "1" ? 100 : 1) : "–", j ? answerOf(j) : "–",
      c.mark(f.path) ?? "–"];
  });
}

const anyMeasured = (c: Case) => figures.some((f) => f.measured?.(c) !== undefined);

/** The second less the first; what is less than half of the last of three digits is nothing. */
function difference(x: number | undefined, y: number | undefined): string {
  if (x === undefined || y === undefined) return "–";
  return shown(Math.abs(y - x) < 5e-4 * Math.max(Math.abs(x), Math.abs(y)) ? 0 : y - x);
}

function ofTwo(cases: Case[]): (string | number)[][] {
  return figures.filter((f) => cases.some((c) => f.of(c) !== undefined)).map((f) => {
    const [x, y] = cases.map((c) => f.of(c));
    return [`${f.title} (${f.unit})`, ...cases.flatMap((c) => [shown(f.of(c)), ...(anyMeasured(c) ? [shown(f.measured?.(c))] : [])]), difference(x, y)];
  });
}

/** "HV01 ejects 92.5 of 143 ml: an ejection fraction of 65%; ..." */
export function sentence(c: Case): string {
  const s = c.summary;
  if (!s) return `${c.name}: the run has no results yet.`;
  const names = (all: Judgement[]) => all.map((j) => j.label.split(",")[0]).join(", ");
  const [unsound, outside] = [true, false].map((numbers) => judgements(c).filter((j) => j.answer === "outside" && !j.impossible &&
    (j.of === "computation") === numbers));
  const impossible = judgements(c).filter((j) => j.impossible);
  const flags = [impossible.length ? `IMPOSSIBLE: ${names(impossible)}` : "",
    outside.length ? `outside the usual range: ${names(outside)}` : "",
    unsound.length ? `the computation is less exact than it should be: ${names(unsound)}` : ""].filter(Boolean);
  const ejects = s.esv_ml <= s.edv_ml ? `ejects ${shown(s.edv_ml - s.esv_ml)} of ${shown(s.edv_ml)} ml: an ejection fraction of ${shown(s.ejection_fraction_percent, 2)}%`
    : `does not eject: it holds ${shown(s.edv_ml)} ml at end-diastole and ${shown(s.esv_ml)} ml at end-systole`;
  const scar = s.infarct?.percent_of_wall;
  return `${c.name}${scar ? `, with an infarct${c.assumesInfarct ? "*" : ""} of ${shown(scar, 2)}% of the wall,` : ""} ${ejects}${flags.length ? `; ${flags.join("; ")}` : judgements(c).length ? "; all that is judged is within usual ranges" : ""}.`;
}

export function firstSection(cases: Case[]): HTMLElement {
  const found = cases.some((c) => c.summary);
  const several = cases.length > 1;
  const name = fileName(...cases.map((c) => c.name), "figures");
  const none = found && !cases.some(anyMeasured);
  const content = !found ? missing("summary.json is missing: the results have not been computed.")
    : several ? table(name, ["", ...cases.flatMap((c) => [c.name, ...(anyMeasured(c) ? [`${c.name}, measured`] : [])]), "difference"], ofTwo(cases))
    : table(name, ["", "model", ...(none ? [] : ["measured"]), "usual", "answer", "origin"], ofOne(cases[0], !none));
  return titled("summary", "Summary", {}, content,
    none ? el("p", { class: "help" }, `No measured volumes: ${several ? "neither case" : "the case"} is ${several ? "" : "not "}fitted to any.`) : undefined,
    found && el("p", { class: "help" }, `Strain at end-systole is Green-Lagrange, from end-diastole, the mean over the wall${none ? "" : "; measured, the mean over the regions of the images"}. ${cases.some((c) => c.summary && !c.summary.cycle) ? "Without heartbeats end-systole is where contraction ends, which need not be the least volume of the curve. " : ""}` +
      "Origin: measured, fitted to a measurement, assumed, or computed from these. Sources of the usual ranges are below."));
}

/** What was assumed and what the run warns of, in full: beside or below the numbers and the picture, which mark it. */
export function remarks(cases: Case[]): HTMLElement {
  const several = cases.length > 1;
  return el("div", { class: "remarks" },
    ...cases.flatMap((c) => c.assumptions.map((a) => el("p", { class: "warning" }, el("strong", {}, `${several ? `${c.name}: ` : ""}assumed, ${a.part}: `), a.text))),
    ...cases.flatMap((c) => (c.summary?.warnings ?? []).filter((text: string) => !c.assumptions.some((a) => a.text === text))
      .map((text: string) => el("p", { class: "warning" }, several && `${c.name}: `, text))));
}

/** "Assumed: septum, apex." */
export function assumedSentence(c: Case): string {
  const parts = [...new Set([...(c.mark("mass_g") === "assumed" ? ["shape"] : []), ...c.assumptions.map((a) => a.part), ...(c.assumesInfarct ? ["infarct"] : [])])];
  return parts.length ? ` Assumed: ${parts.join(", ")}.` : "";
}
