// Measured volumes beside the model's, fitted parameters, and what errors of the measurements do to them.
import type { Case } from "./data.ts";
import { el, fileName, missing, table } from "./dom.ts";
import { shown } from "./quantities.ts";

/** The measured volume [ml] that summary.json names: "EDV" or "ESV". */
export function measuredVolume(c: Case, name: string): number | undefined {
  const rows: any[] = Array.isArray(c.summary?.calibration) ? c.summary.calibration : [];
  return rows.find((row) => row.volume === name)?.measured_ml;
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

/** Empty for a case without calibration. */
export function calibration(c: Case): (Node | undefined)[] {
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
    fit?.uncertainty?.length ? sensitivity(c, fit) : missing("calibration.json is missing: how sure the fitted parameters are is not known."),
    ...(fit?.ambiguities ?? []).map((line: string) => el("p", { class: "help" }, line))];
}
