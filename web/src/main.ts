// The page: header, what is unfinished, and one section per subject.
import "./style.css";
import { curvesSection, muscleSection, rotationSection } from "./curves_section.ts";
import { about, Case } from "./data.ts";
import { el } from "./dom.ts";
import { flowSection } from "./flow_section.ts";
import { outlinesSection } from "./outlines_section.ts";
import { Shared, timeline } from "./shared.ts";
import { strainSection } from "./strain_section.ts";
import { inputSection, normalSection, parameterSection, summarySection, zoneSection } from "./tables_section.ts";
import { bullsEyeSection, wallSection } from "./wall_section.ts";

function header(cases: Case[], version: string): HTMLElement {
  const title = cases.map((c) => c.name).join(" beside ");
  document.title = `${title} – ventricle`;
  const unfinished = cases.filter((c) => !c.json.complete);
  const fidelity = cases.map((c) => c.json.wall?.displacement.largest_error ?? 0).reduce((a, b) => Math.max(a, b), 0);
  const relative = cases.flatMap((c) => Object.values(c.json.wall?.quantities ?? {}))
    .map((q) => q.largest_error / (q.max! - q.min!)).reduce((a, b) => Math.max(a, b), 0);
  return el("header", {}, el("h1", {}, title),
    el("p", {}, `A left ventricle modelled by ventricle; page written by version ${version} from the files in ` +
      `${cases.map((c) => c.json.folder).join(" and ")}. ` +
      "Research software: nothing here is a diagnosis or a recommendation for treatment."),
    ...unfinished.map((c) => el("div", { class: "state", role: "alert" }, el("strong", {}, `The run of ${c.name} is not complete. `),
      "What there is, is shown; what is not there, is said to be missing.", el("ul", {}, ...c.json.state.map((line) => el("li", {}, line))))),
    el("p", { class: "help" }, "Tables and charts repeat the files exactly. The 3-D view repeats positions within " +
      `${fidelity.toFixed(2)} mm and values within ${(100 * relative).toFixed(1)} % of their range.`));
}

const painted = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));

async function main(): Promise<void> {
  const { version, cases: count } = about();
  const cases = Array.from({ length: count }, (_, i) => Case.read(i));
  if (new Set(cases.map((c) => c.name)).size < cases.length) for (const c of cases) c.name += ` (${c.json.folder})`;
  const page = document.getElementById("page")!;
  page.className = cases.length > 1 ? "two" : "one";
  const nav = el("nav", { "aria-label": "sections" });
  const summary = summarySection(cases);
  page.append(header(cases, version), nav, summary);
  await painted();
  document.body.dataset.first = performance.now().toFixed(0);

  await Promise.all(cases.map((c) => c.loadWall()));
  const time = timeline(cases);
  const first = ["active_tension", "fibre_stress"].find((name) => cases.some((c) => c.wall?.quantities.includes(name))) ?? "infarct";
  const shared = new Shared({ quantity: first, step: time.start, cut: { kind: "long", angle: 0, height: -40 }, fibres: false, fixed: false });
  const wall = wallSection(cases, shared, time);
  const sections = [wall.element, bullsEyeSection(cases, shared),
    curvesSection(cases, shared, time), rotationSection(cases), flowSection(cases), muscleSection(cases), outlinesSection(cases), strainSection(cases),
    normalSection(cases),
    zoneSection(cases), inputSection(cases), parameterSection(cases)];
  nav.append(...[summary, ...sections].map((part) => el("a", { href: `#${part.id}` }, part.querySelector("h2")!.textContent!)));
  page.append(...sections, el("footer", {}, "Drawn with three.js (MIT licence). Colour maps are even in lightness and safe for " +
    "colour-blind eyes. ventricle is free software under the GPL, version 3 or later."));
  await wall.drawn;
  await painted();
  document.body.dataset.ready = performance.now().toFixed(0);
}

main().catch((error: unknown) => {
  document.getElementById("page")!.append(el("p", { class: "state", role: "alert" }, `This page cannot be drawn: ${error}`));
  throw error;
});
