// Buttons and sliders: all that the keys do, for the pointer.
import { el } from "../dom.ts";
import type { Editor } from "./editor.ts";
import type { Player } from "./player.ts";
import type { Saving } from "./saving.ts";
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
  const slice = slider("slice", 1, study.slices.length, 1, 1, (value) => editor.go(value, editor.phase));
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
