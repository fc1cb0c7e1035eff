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

/** Empty for a case without calibration. */
export function calibration(c: Case): (Node | undefined)[] {
  if (!Array.isArray(c.summary?.calibration)) return [];
  const text = c.json.files["calibration.json"];
  const fit = text ? JSON.parse(text) : undefined;
  return [
    el("h3", {}, "Fitted to measured volumes"),
    el("p", { class: "help" }, "Parameters found with the quasi-static engine, and what they would be if a measured value were too low / too " +
      "high by its error (to first order of the logarithms, all else equal). A parameter that moves far is little known."),
    volumes(c),
    fit?.uncertainty?.length ? sensitivity(c, fit) : missing("calibration.json is missing: how sure the fitted parameters are is not known."),
    ...(fit?.ambiguities ?? []).map((line: string) => el("p", { class: "help" }, line))];
}
