// Buttons and sliders: all that the keys do, for the pointer.
import { el } from "../dom.ts";
import type { Editor } from "./editor.ts";
import type { Player } from "./player.ts";
import type { Saving } from "./saving.ts";
import type { Brush, Rule } from "./scar.ts";
import type { ScarEditor } from "./scar_editor.ts";
import { landmarkNames, sideNames, sides, type Side } from "./study.ts";

export interface Bar { element: HTMLElement; show(): void }

const button = (text: string, click: () => void, id?: string) => el("button", { type: "button", click, ...(id ? { id } : {}) }, text);
const group = (legend: string, ...children: (Node | string)[]) => el("fieldset", {}, el("legend", {}, legend), ...children);

function slider(label: string, min: number, max: number, step: number, value: number, input: (value: number) => void) {
  const range = el("input", { type: "range", min, max, step, value, input: () => input(Number(range.value)) });
  return { element: el("label", {}, label, range), range };
}

function radios<T extends string>(name: string, choices: [T, string][], chosen: T, choose: (value: T) => void) {
  const inputs = choices.map(([value, text]) => {
    const input = el("input", { type: "radio", name, value, checked: value === chosen, change: () => choose(value) });
    return { value, input, label: el("label", {}, input, text) };
  });
  return { labels: inputs.map(({ label }) => label), set: (now: T) => inputs.forEach(({ value, input }) => { input.checked = value === now; }) };
}

export function placeBar(editor: Editor, player: Player): Bar {
  const { study } = editor;
  const slice = slider("slice", 1, editor.planes.length, 1, 1, (value) => editor.go(value, editor.phase));
  const phase = slider("phase", 1, study.phases, 1, 1, (value) => editor.go(editor.slice, value));
  const play = button("Play", () => player.toggle(), "play");
  player.onChange(() => { play.textContent = player.plays ? "Stop" : "Play"; });
  const element = el("div", { class: "toolbar" }, slice.element, phase.element, play, button("Next doubtful", () => editor.nextDoubtful()));
  return { element, show: () => { [slice.range.value, phase.range.value] = [String(editor.slice), String(editor.phase)]; } };
}

export function toolBar(editor: Editor, saving: Saving): Bar {
  const side = radios<Side>("side", sides.map((s) => [s, sideNames[s]]), editor.side, (s) => editor.go(editor.slice, editor.phase, s));
  const tool = radios<string>("tool", [["pull", "pull a part"], ["size", "resize"], ["redraw", "redraw"], ["points", "set points"]], "pull", (t) => { editor.tool = t; mark.value = ""; });
  const mark = el("select", { id: "landmark", change: () => { editor.tool = mark.value || "pull"; tool.set(editor.tool); } },
    el("option", { value: "" }, "none"), ...Object.entries(landmarkNames).map(([name, words]) => el("option", { value: name }, words)));
  const width = slider("a pull takes along", 4, 60, 1, editor.width, (value) => { editor.width = value; shown.textContent = `${value} mm`; });
  const shown = el("span", {}, `${editor.width} mm`);
  const redraw = button(saving.redraws ? "Redraw from my points" : "Redraw from my points (needs ventricle draw itself)", () => void saving.redraw(), "from-points");
  redraw.disabled = !saving.redraws;
  const element = el("div", { class: "toolbar" }, group("Border", ...side.labels), group("Pointer", ...tool.labels), el("label", {}, "or sets", mark),
    redraw, button("Drop points", () => editor.dropPoints(), "drop-points"), button("Propose again from the centre", () => void saving.proposeAgain(), "propose"), width.element, shown);
  return { element, show: () => { side.set(editor.side); width.range.value = String(editor.width); shown.textContent = `${editor.width} mm`; } };
}

export function editBar(editor: Editor, saving: Saving): Bar {
  const undo = button("Undo", () => saving.undo(), "undo");
  const redo = button("Redo", () => saving.redo(), "redo");
  const observer = el("input", { type: "text", id: "observer", maxlength: 40, autocomplete: "off", input: () => { editor.observer = observer.value; } });
  const element = el("div", { class: "toolbar" }, undo, redo, button("Delete", () => editor.remove(), "delete"), button("Delete both", () => editor.removeBoth(), "delete-both"),
    button("New border", () => editor.add(), "add"), button("Copy to next slice", () => editor.copy(1, 0), "copy"), button("to slice before", () => editor.copy(-1, 0)),
    button("to next phase", () => editor.copy(0, 1)), button("Smaller", () => editor.grow(-0.5), "smaller"), button("Larger", () => editor.grow(0.5), "larger"),
    button("All slices smaller", () => editor.growAll(-0.5), "all-smaller"), button("All slices larger", () => editor.growAll(0.5), "all-larger"),
    button("Back to the proposal", () => editor.backToProposal(), "back"), el("label", {}, "drawn by (initials)", observer));
  return { element, show: () => { [undo.disabled, redo.disabled] = [!editor.drawing.canUndo, !editor.drawing.canRedo]; } };
}

export function contrastBar(editor: Editor): Bar {
  const { picture } = editor;
  const redraw = () => picture.draw();
  const level = slider("brightness", 0, 1, 0.01, 0.5, (value) => { picture.level = 1 - value; redraw(); });
  const width = slider("contrast", 0, 0.95, 0.01, 0, (value) => { picture.width = 1 - value; redraw(); });
  const original = el("input", { type: "checkbox", change: () => { editor.showsOriginal = original.checked; editor.show(); } });
  const lines = el("input", { type: "checkbox", checked: true, change: () => { editor.showsLines = lines.checked; editor.show(); } });
  const element = el("div", { class: "toolbar" }, level.element, width.element, button("+", () => picture.zoom(1.25)), button("−", () => picture.zoom(0.8)), button("Fit", () => editor.fit()),
    el("label", {}, lines, "borders"), el("label", {}, original, "what was proposed, dashed"));
  return { element, show: () => { lines.checked = editor.showsLines; } };
}

/** Slices and brush of the enhanced picture. */
export function brushBar(scar: ScarEditor, saving: Saving): Bar {
  const slice = slider("enhanced slice", 1, scar.planes.length, 1, scar.slice, (value) => scar.go(value));
  const brush = radios<Brush>("brush", [["scar", "scar"], ["muscle", "muscle (erases)"], ["remote", "remote muscle"]], scar.brush, (value) => { scar.brush = value; });
  const size = slider("brush", 0.5, 12, 0.5, scar.radius, (value) => { scar.radius = value; scar.show(); shown.textContent = `${value} mm`; });
  const shown = el("span", {}, `${scar.radius} mm`);
  const undo = button("Undo", () => saving.undo(), "scar-undo");
  const redo = button("Redo", () => saving.redo(), "scar-redo");
  const tint = el("input", { type: "checkbox", checked: true, change: () => { scar.showsScar = tint.checked; scar.show(); } });
  const element = el("div", { class: "toolbar" }, slice.element, group("Brush", ...brush.labels), size.element, shown, undo, redo, el("label", {}, tint, "colours"),
    button("+", () => scar.picture.zoom(1.25)), button("−", () => scar.picture.zoom(0.8)), button("Fit", () => scar.fit(), "scar-fit"));
  return { element, show: () => {
    [slice.range.value, size.range.value, shown.textContent] = [String(scar.slice), String(scar.radius), `${scar.radius} mm`];
    brush.set(scar.brush);
    tint.checked = scar.showsScar;
    [undo.disabled, redo.disabled] = [!scar.drawing.canUndo, !scar.drawing.canRedo];
  } };
}

/** What the threshold is taken from, and whose borders are the wall. */
export function thresholdBar(scar: ScarEditor): Bar {
  const { low, high } = scar.said;
  const rule = radios<Rule>("rule", [["brightest", "half of the brightest"], ["remote", "above remote muscle"], ["level", "chosen"]], scar.rule, (value) => scar.setRule(value));
  const deviations = slider("deviations above it", 1, 10, 0.5, scar.deviations, (value) => { scar.setDeviations(value); many.textContent = String(value); });
  const many = el("span", {}, String(scar.deviations));
  const level = slider("threshold", low, high, (high - low) / 400, scar.scar.threshold, (value) => scar.setLevel(value));
  const phase = slider("wall of phase", 1, scar.study.phases, 1, scar.scar.phase, (value) => { chosen.textContent = String(value); });
  const chosen = el("span", {}, String(scar.scar.phase));
  const take = button(scar.asks ? "Take its borders as they are drawn now" : "Take its borders (needs ventricle draw itself)", () => scar.takeWall(Number(phase.range.value)), "take-wall");
  const element = el("div", { class: "toolbar" }, group("Scar is brighter than", ...rule.labels), deviations.element, many, level.element, phase.element, chosen, take,
    ...(scar.asks ? [] : [el("span", { class: "help" }, "The threshold needs ventricle draw itself; the brush works.")]));
  for (const input of element.querySelectorAll("input")) input.disabled = !scar.asks;
  take.disabled = !scar.asks;
  return { element, show: () => {
    rule.set(scar.rule);
    level.range.value = String(scar.scar.threshold);
    deviations.range.disabled = !scar.asks || scar.rule !== "remote";
  } };
}

export function greyBar(scar: ScarEditor): Bar {
  const { picture } = scar;
  const level = slider("brightness", 0, 1, 0.01, 0.5, (value) => { picture.level = 1 - value; picture.draw(); });
  const width = slider("contrast", 0, 0.95, 0.01, 0, (value) => { picture.width = 1 - value; picture.draw(); });
  return { element: el("div", { class: "toolbar" }, level.element, width.element), show: () => {} };
}

/** Borders or scar. */
export function viewSwitch(show: (scar: boolean) => void): HTMLElement {
  const { labels } = radios<string>("view", [["borders", "borders"], ["scar", "scar"]], "borders", (value) => show(value === "scar"));
  return el("div", { class: "toolbar" }, group("Show", ...labels));
}
