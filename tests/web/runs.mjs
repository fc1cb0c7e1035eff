// The runs and pages that the checks look at, each made once, two long runs at a time.
import { execFile } from "node:child_process";
import { cpSync, existsSync, mkdirSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { promisify } from "node:util";
import { root } from "./browser.mjs";
import { csv, folder, images, program, timed, work } from "./setting.mjs";
import { thickSeptum } from "./thick_septum.mjs";

const execute = promisify(execFile);
const ventricle = (...args) => execute(program, args, { cwd: folder, maxBuffer: 1 << 28 });

/** A phantom of few images and large elements through the quasi-static engine. */
async function runImages() {
  if (existsSync(images)) return;
  await ventricle("phantom", "study", "--phases", "6", "--field-of-view", "150", "--shortening", "0.12", "--nifti", "true", "--dicom", "false");
  const file = join(folder, "study/coarse.toml");
  writeFileSync(file, `engine = "quasi_static"\n${readFileSync(join(folder, "study/case.toml"), "utf8")}\n[quasi_static]\nedge_length = "18 mm"\n`);
  await ventricle("run", file, "--work", images, "--ranks", "1");
}

/** A mesh with an infarct about an angle from the septum, in a heart that is turned about its long axis. */
async function meshInfarct(name, angle) {
  writeFileSync(join(folder, `${name}.toml`), [`name = '${name}'`, "engine = 'quasi_static'", "[quasi_static]", "edge_length = '10 mm'", "[regions]",
    "septum_angle = '70 deg'", "[infarct]", "source = 'described'", "[infarct.described]", `angle = '${angle} deg'`, "width = '70 deg'", "top = 1.0", "apex = 0.0"].join("\n"));
  await ventricle("run", `${name}.toml`, "--until", "mesh", "--ranks", "1");
  await ventricle("report", `${name}.work`, "--output", `${name}.html`);
}

/** Infarcts of the anterior wall, a little towards the septum, and of the inferior one. */
async function meshInfarcts() {
  await meshInfarct("turned", 60);
  await meshInfarct("inferior", 270);
}

export const fit = { measured: [131.5, 61.25], C_a: 1.234, below: 1.111, above: 1.358 };

/** The run as if its parameters had been fitted, its septum assumed, more left in the cavity than was in it, and few rows of its curves written. */
async function pretendFit() {
  const to = join(folder, "fitted.work");
  cpSync(work, to, { recursive: true });
  const file = join(to, "04_results/summary.json");
  const summary = JSON.parse(readFileSync(file, "utf8"));
  summary.calibration = ["EDV", "ESV"].map((volume, i) => ({ volume, measured_ml: fit.measured[i], quasi_static_ml: 130, beat_ml: 129, within_tolerance: false }));
  const curves = join(to, "03_beat/curves.csv");
  writeFileSync(curves, readFileSync(curves, "utf8").split("\n").filter((line, i) => line === "" || i % 9 < 2).join("\n"));  // frames lie between rows
  summary.assumptions = [{ part: "septum", text: "the septum is assumed on the x axis" }, { part: "apex", text: "the apex is continued below the last contour" }];
  summary.unloaded = { pressure_mmHg: 8 };
  summary.infarct = { volume_ml: 14, mass_g: 14.7, percent_of_wall: 12.3 };
  summary.marks = { edv_ml: "fitted", end_diastole: "computed", "end_diastole.pressure_mmHg": "assumed" };
  const judged = { unit: "%", low: 48, high: 77, source: "a study" };
  summary.plausibility = [
    { quantity: "ejection_fraction_percent", label: "ejection fraction", value: -26, answer: "outside", reason: "it holds more", impossible: true, ...judged },
    { quantity: "apex_rotation_deg", label: "rotation of the apex", value: 30, answer: "outside", reason: "", impossible: false, ...judged },
    { quantity: "circumferential_strain", label: "circumferential strain", value: -0.1, answer: "not applicable", reason: "an infarct", impossible: false, ...judged },
    { quantity: "wall_volume_tails_percent", label: "change of an element's volume, 1st and 99th percentile", value: 6, answer: "outside", reason: "", impossible: false, of: "computation", ...judged },
    { quantity: "edv_ml", label: "end-diastolic volume", value: 131, answer: "within", reason: "", impossible: false, ...judged }];
  writeFileSync(file, JSON.stringify(summary));
  mkdirSync(join(to, "02b_calibrate"), { recursive: true });
  writeFileSync(join(to, "02b_calibrate/calibration.json"), JSON.stringify({ uncertainty: [{ parameter: "C_a", value: fit.C_a,
    when_off: [{ measurement: "EDV", by: "5%", below: fit.below, above: fit.above }] }], ambiguities: ["One volume determines one parameter."] }));
  await ventricle("report", to, "--output", "fitted.html");
}

/** The run with images as if its wall were in none of them. */
async function pretendElsewhere() {
  const to = join(folder, "elsewhere.work");
  cpSync(images, to, { recursive: true });
  const keep = (name, change) => writeFileSync(join(to, name), change(readFileSync(join(to, name), "utf8")));
  keep("01_anatomy/frame.json", (text) => JSON.stringify(Object.fromEntries(Object.entries(JSON.parse(text)).filter(([key]) => !/in_image_space/.test(key)))));
  keep("04_results/outlines.csv", (text) => text.split("\n").filter((line) => !/,model,/.test(line)).join("\n"));
  keep("04_results/outline_distances.csv", (text) => `${text.split("\n")[0]}\n`);
  await ventricle("report", to, "--output", "elsewhere.html");
}

export const ofBeats = (name) => csv(join(folder, name, "03_beat/beats.csv"));

/** The run as if its wall had beaten: with the beats of a circulation alone, for two resistances. */
async function pretendBeats() {
  for (const [name, R_p] of [["beats", 1.05], ["stiff", 1.6]]) {
    writeFileSync(join(folder, `${name}.toml`), ["[circulation]", "kind = 'windkessel'", "step = '2 ms'", "beats = 2", `windkessel.R_p = '${R_p} mmHg s/ml'`].join("\n"));
    await ventricle("circulation", `${name}.toml`, "--work", `${name}.circuit`);
    const to = join(folder, `${name}.work`);
    cpSync(work, to, { recursive: true });
    rmSync(join(to, "03_beat/curves.csv"));
    for (const table of ["cycle.csv", "beats.csv"]) cpSync(join(folder, `${name}.circuit/00_circulation`, table), join(to, "03_beat", table));
    const file = join(to, "04_results/summary.json");
    const last = ofBeats(`${name}.work`).at(-1);
    const summary = { ...JSON.parse(readFileSync(file, "utf8")), case: name, cycle: { last_beat: { peak_pressure_mmHg: Number(last.peak_pressure_mmHg) } } };
    if (name === "beats") {
      summary.heartbeats_fitted = [{ datum: "EDV", unit: "ml", measured: 141.25, fit: 141.1, beat: 140.9, within_tolerance: true },
        { datum: "systolic", unit: "mmHg", measured: 123.5, fit: 123.6, beat: 123.7, within_tolerance: true }];
      summary.cycle.last_beat.aortic_systolic_mmHg = 123.7;
    }
    writeFileSync(file, JSON.stringify(summary));
  }
  mkdirSync(join(folder, "beats.work/02b_calibrate"), { recursive: true });
  writeFileSync(join(folder, "beats.work/02b_calibrate/heartbeats.json"), JSON.stringify({ left_alone: ["The contractility keeps the case's value"],
    parameters: [{ parameter: "circulation.windkessel.p_ven", words: "filling pressure", unit: "mmHg", fitted_to: "EDV", before: 8, value: 9.876,
      when_off: [{ measurement: "EDV", by: "5%", below: 8.765, above: 11.25 }] }],
    data: [{ name: "EDV", d_ln_datum_by_d_ln: { "circulation.windkessel.p_ven": 0.4321 } }] }));
  await ventricle("report", "beats.work", "--output", "beats.html");
  await ventricle("compare", "beats.work", "stiff.work", "--output", "loops.html");
  await ventricle("compare", work, "beats.work", "--output", "unlike.html");
}

/** A run that is not complete, and one that has a mesh alone. */
async function makeHalf() {
  const half = join(folder, "half.work");
  cpSync(work, half, { recursive: true });
  for (const stage of ["04_results", "05_report"]) rmSync(join(half, stage), { recursive: true, force: true });
  if (existsSync(join(half, "03_beat"))) renameSync(join(half, "03_beat"), join(half, "03_beat.part"));
  await ventricle("report", half, "--output", "half.html");
  rmSync(join(half, "03_beat.part"), { recursive: true, force: true });
  await ventricle("report", half, "--output", "mesh.html");
}

/** Flow in a wall that is thicker on one side, and the same blood without its wall. */
async function makeThick() {
  thickSeptum(join(folder, "thick.work"), 70);
  await ventricle("report", "thick.work", "--output", "thick.html");
  rmSync(join(folder, "thick.work/03_beat/wall.pvd"));
  await ventricle("report", "thick.work", "--output", "blood.html");
}

/** The small beat with phases that end soon after their ramps: the page shows what there is, steady or not. */
async function makeSmall() {
  const soon = { filling_tolerance: "0.1", contraction_tolerance: "0.2", contraction_window: '"0.03 s"', frame_interval: '"0.1 s"' };
  const text = Object.entries(soon).reduce((all, [name, value]) => all.replace(new RegExp(`^${name} = .*`, "m"), `${name} = ${value}`),
    readFileSync(join(root, "tests/regress/small.toml"), "utf8"));
  writeFileSync(join(folder, "small.toml"), text);
  if (!existsSync(work)) await ventricle("run", "small.toml", "--work", work, "--ranks", "1");
  await ventricle("report", work, "--output", "page.html");
}

/** Where the data of a real ventricle are; undefined where they are not. */
export const realData = (() => {
  const data = join(process.env.VENTRICLE_DATA ?? join(root, "../shared/data"), "glasgow_HV01/text_export");
  if (existsSync(data)) return data;
  console.log(`info  no page of HV01: ${data} is not there (set VENTRICLE_DATA)`);
  return undefined;
})();

/** A real ventricle on large elements, fitted to its measured volume, its strains from a table. */
async function runReal() {
  if (!realData) return;
  const file = (name) => JSON.stringify(join(realData, name));
  writeFileSync(join(folder, "hv01.toml"), ["name = 'HV01'", "engine = 'quasi_static'", "[quasi_static]", "edge_length = '10 mm'", "[anatomy]", "source = 'contours'", "[anatomy.contours]",
    `short_axis = ${file("contours_sa_aligned_long_axis.csv")}`, `long_axis = ${file("contours_la.csv")}`, `apex_endo = ${file("apex_endo.csv")}`,
    `apex_epi = ${file("apex_epi.csv")}`, "septum_point = ['37.1 mm', '0.8 mm', '-4.5 mm']", "[calibrate]", "passive = 'scale'",
    "edv = '142.6 ml'", "[active]", "T_scale = 3.0", "[strain]", `measured = ${file("segmental_strain_from_cine.csv")}`, "measured_column = 'frame10'"].join("\n"));
  await ventricle("run", "hv01.toml", "--ranks", "1");
}

/** Promises by what is made; each waits for what it needs. The phantom is followed while the small beat runs, and then the real ventricle. */
export function makeRuns() {
  const made = {};
  const small = (made.page = timed("[run] small", makeSmall));
  const phantom = timed("[run] phantom", runImages);
  const after = (before, name, make) => before.then(() => timed(`[run] ${name}`, make));
  made.turned = after(small, "turned", meshInfarcts);
  made.thick = after(made.turned, "thick", makeThick);
  made.compare = after(made.thick, "compare", () => ventricle("compare", work, work, "--output", "compare.html"));
  made.fitted = after(made.compare, "fitted", pretendFit);
  made.half = after(made.fitted, "half", makeHalf);
  made.beats = after(made.half, "beats", pretendBeats);
  made.images = after(phantom, "images", () => ventricle("report", images, "--output", "images.html"));
  made.elsewhere = after(made.images, "elsewhere", pretendElsewhere);
  made.real = after(small, "HV01", runReal);
  made.mixed = after(Promise.all([made.images, small]), "mixed", () => ventricle("compare", images, work, "--output", "mixed.html"));
  // who waits for one hears of its failure; until then it is no unhandled one
  for (const one of Object.values(made)) one.catch(() => {});
  return made;
}
