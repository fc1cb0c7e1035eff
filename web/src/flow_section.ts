// The flow of all cases in their long-axis planes.
import { type Case } from "./data.ts";
import { el, fileName, missing, saveButtons, section } from "./dom.ts";
import { drawFlow, fastestFrame, type FlowFrame, flowScale, type FlowQuantity, readFlow } from "./flow_view.ts";
import { colourBar } from "./wall_section.ts";

interface Shown { c: Case; frame: number; data: FlowFrame; canvas: HTMLCanvasElement; caption: HTMLElement }

export function flowSection(cases: Case[]): HTMLElement {
  const place = el("div");
  const whole = section("flow", "Flow in a long-axis plane",
    "Blood and wall in the plane y = 0 through the long axis (the septum on the right where it is on the model's x axis). Colours: " +
    "speed with all three components, or pressure. Arrows: velocity in the plane; the longest arrow is the fastest blood of the " +
    "moment. It opens at the moment after end-diastole with the fastest blood among those the run wrote. There are no valves and no " +
    "atrium: blood passes freely through the open base, so the pattern there is not physiological.", place);
  // drawn when it comes near the screen: the first view does not wait for it
  const observer = new IntersectionObserver((entries) => {
    if (!entries.some((entry) => entry.isIntersecting)) return;
    observer.disconnect();
    void fill(cases, place);
  }, { rootMargin: "600px" });
  observer.observe(whole);
  addEventListener("beforeprint", () => { observer.disconnect(); if (!place.hasChildNodes()) void fill(cases, place); });
  return whole;
}

async function fill(cases: Case[], place: HTMLElement): Promise<void> {
  const found: Shown[] = [];
  for (const c of cases) {
    if (!c.flow) continue;
    const frame = await fastestFrame(c.flow, c.timeOf("end_diastole"));
    found.push({ c, frame, data: await readFlow(c.flow, frame), canvas: el("canvas", { class: "flow", role: "img" }), caption: el("p", { class: "time" }) });
  }
  const absent = cases.filter((c) => !c.flow).map((c) => missing(`${c.name}: no frames of the blood in the work folder ` +
    "(output.blood = false, or an engine without blood)."));
  if (!found.length) { place.replaceChildren(...absent); return; }
  let what: FlowQuantity = "speed";
  const bar = el("div", { class: "bar-place" });
  const draw = () => {
    const scale = flowScale(found.map((one) => one.data), what);
    bar.replaceChildren(colourBar(scale, what === "speed" ? "speed (m/s)" : "pressure (mmHg)"));
    for (const one of found) {
      const t = one.c.flow!.times[one.frame];
      const wallFrame = one.c.wall?.times.findIndex((time) => Math.abs(time - t) < 1e-6);
      drawFlow(one.canvas, one.c.flow!, one.data, what, scale, one.c.wall, wallFrame === -1 ? undefined : wallFrame);
      one.caption.textContent = `${one.c.name}: t = ${t.toFixed(3)} s, ${one.c.words(t)}`;
      one.canvas.setAttribute("aria-label", `${what} and velocity in the long-axis plane, ${one.caption.textContent}`);
    }
  };
  const choice = el("select", { change: () => { what = choice.value as FlowQuantity; draw(); } },
    el("option", { value: "speed" }, "speed (m/s)"), el("option", { value: "pressure" }, "pressure (mmHg)"));
  place.replaceChildren(el("div", { class: "controls" }, el("label", {}, "colours", choice)), bar,
    el("div", { class: "cases" }, ...found.map((one) => el("div", { class: "panel" }, one.caption, one.canvas,
      el("label", { class: "wide" }, "time", el("input", { type: "range", min: 0, max: one.c.flow!.times.length - 1, step: 1, value: one.frame,
        "aria-label": `time of the flow of ${one.c.name}`, input: async (event: Event) => {
          one.frame = (event.target as HTMLInputElement).valueAsNumber;
          one.data = await readFlow(one.c.flow!, one.frame);
          draw();
        } })), saveButtons(fileName(one.c.name, "flow"), () => one.canvas)))), ...absent);
  draw();
}
