// Measured volumes beside the model's, fitted parameters, and what errors of the measurements do to them.
import type { Case } from "./data.ts";
import { el, fileName, missing, table } from "./dom.ts";
import { shown, typeset } from "./quantities.ts";

/** What heartbeats were fitted to, as summary.json has it. */
const ofBeats = (c: Case): any[] => Array.isArray(c.summary?.heartbeats_fitted) ? c.summary.heartbeats_fitted : [];

/** What was measured of a heartbeat, in the unit of summary.json: "EDV", "ESV", "systolic" or "diastolic". */
export const measuredOfBeat = (c: Case, datum?: string): number | undefined => ofBeats(c).find((row) => row.datum === datum)?.measured;

/** The measured volume [ml] that summary.json names: "EDV" or "ESV". */
export function measuredVolume(c: Case, name: string): number | undefined {
  const rows: any[] = Array.isArray(c.summary?.calibration) ? c.summary.calibration : [];
  return rows.find((row) => row.volume === name)?.measured_ml ?? measuredOfBeat(c, name);
}

function volumes(c: Case): HTMLElement {
  return table(fileName(c.name, "calibration-volumes"),
    ["volume", "measured (ml)", "fit, quasi-static engine (ml)", "this beat (ml)", "within tolerance"],
    c.summary.calibration.map((v: any) => [v.volume, shown(v.measured_ml, 4), shown(v.quasi_static_ml, 4), shown(v.beat_ml, 4), v.within_tolerance ? "yes" : "NO"]));
}

function sensitivity(c: Case, fit: any): HTMLElement {
  const off: any[] = fit.uncertainty[0].when_off;
  return table(fileName(c.name, "fitted-parameters"),
    ["parameter", "fitted", ...off.map((w) => `if ${w.measurement} is ∓${w.by} off`)],
    fit.uncertainty.map((u: any) => [u.parameter, shown(u.value, 4), ...u.when_off.map((w: any) => `${shown(w.below)} / ${shown(w.above)}`)]));
}

/** Volumes that Klotz's curve gives the end-diastolic shape, beside the fitted model's, and the fit for other pressures. */
function klotz(c: Case, fit: any): (Node | undefined)[] {
  if (!Array.isArray(c.summary?.klotz)) return [];
  const others: any[] = fit?.other_pressures ?? [];
  const names: string[] = (fit?.uncertainty ?? []).map((u: any) => u.parameter);
  return [
    el("p", { class: "help" }, "The curve by Klotz et al. (2006) through the end-diastolic volume and pressure is a mean over hearts: assumed, not measured."),
    table(fileName(c.name, "klotz"), ["volume", "pressure (mmHg)", "curve, assumed (ml)", "fitted model (ml)"],
      c.summary.klotz.map((v: any) => [v.volume, shown(v.pressure_mmHg, 3), shown(v.target_ml, 4), shown(v.model_ml, 4)])),
    others.length ? table(fileName(c.name, "other-pressures"), ["had the end-diastolic pressure been (mmHg)", ...names, "unloaded (ml)"],
      others.map((o) => o.no_fit ? [shown(o.pressure_mmHg, 3), ...names.map(() => "no fit"), ""] :
        [shown(o.pressure_mmHg, 3), ...names.map((n) => shown(o[n], 4)), shown(o.unloaded_volume_ml, 4)])) : undefined];
}

/** How far end-systolic surfaces lie outside of the drawn ones that they were fitted to. */
function shape(c: Case): (Node | undefined)[] {
  const fitted = c.summary?.shape_fitted;
  if (!fitted) return [];
  return [
    el("p", { class: "help" }, "Fitted to the surfaces drawn at end-systole besides: distance by which the model's lie outside of them, by the means of every loop's sectors, " +
      "when all loops are moved along the long axis to where they fit best."),
    table(fileName(c.name, "shape-fitted"), ["end-systolic surfaces", "mean (mm)", "rms (mm)"],
      [["fitted to volumes alone", shown(fitted.bias_before_mm, 2), shown(fitted.rms_before_mm, 3)],
        ["fitted to the surfaces too", shown(fitted.bias_mm, 2), shown(fitted.rms_mm, 3)]])];
}

/** Empty for a case without calibration. */
export function calibration(c: Case): (Node | undefined)[] {
  return [...muscle(c), ...heartbeats(c)];
}

/** What the heartbeats were fitted to, the parameters that were, and how each datum follows each of them. */
function heartbeats(c: Case): (Node | undefined)[] {
  const rows = ofBeats(c);
  if (!rows.length) return [];
  const text = c.json.files["heartbeats.json"];
  const fit = text ? JSON.parse(text) : undefined;
  const parameters: any[] = fit?.parameters ?? [];
  const off: any[] = parameters[0]?.when_off ?? [];
  return [
    el("h3", {}, "Heartbeats fitted to what was measured"),
    el("p", { class: "help" }, "Each datum tells of one parameter; all are found together, from beats of the wall in its circulation up to their limit cycle. " +
      "A cuff's pressures are taken for the aorta's."),
    table(fileName(c.name, "heartbeats-fitted"), ["datum", "measured", "fit", "last beat", "within tolerance"],
      rows.map((v) => [`${v.datum} (${v.unit})`, shown(v.measured, 4), shown(v.fit, 4), shown(v.beat, 4), v.within_tolerance ? "yes" : "NO"])),
    parameters.length ? table(fileName(c.name, "heartbeats-parameters"),
      ["parameter", "before", "fitted", "fitted to", ...off.map((w) => `if ${w.measurement} is ∓${w.by} off`)],
      parameters.map((p) => [`${p.words}${p.unit ? ` (${p.unit})` : ""}`, shown(p.before, 4), shown(p.value, 4), p.fitted_to,
        ...p.when_off.map((w: any) => `${shown(w.below)} / ${shown(w.above)}`)]))
      : missing("heartbeats.json is missing: how sure the fitted parameters are is not known."),
    parameters.length ? table(fileName(c.name, "heartbeats-sensitivity"), ["relative change per relative change of", ...parameters.map((p) => p.words)],
      fit.data.map((d: any) => [d.name, ...parameters.map((p) => shown(d.d_ln_datum_by_d_ln[p.parameter]))])) : undefined,
    ...(fit?.left_alone ?? []).map((line: string) => el("p", { class: "help" }, typeset(`${line}.`)))];
}

/** The fit of the muscle at given pressures. */
function muscle(c: Case): (Node | undefined)[] {
  const volumesFitted = Array.isArray(c.summary?.calibration);
  if (!volumesFitted && !Array.isArray(c.summary?.klotz)) return [];
  const text = c.json.files["calibration.json"];
  const fit = text ? JSON.parse(text) : undefined;
  return [
    el("h3", {}, "Fitted to measured volumes"),
    el("p", { class: "help" }, "Parameters found with the quasi-static engine, and what they would be if a measured value were too low / too " +
      "high by its error (to first order of the logarithms, all else equal). A parameter that moves far is little known."),
    volumesFitted ? volumes(c) : undefined,
    ...klotz(c, fit),
    ...shape(c),
    fit?.uncertainty?.length ? sensitivity(c, fit) : missing("calibration.json is missing: how sure the fitted parameters are is not known."),
    ...(fit?.ambiguities ?? []).map((line: string) => el("p", { class: "help" }, typeset(line)))];
}
