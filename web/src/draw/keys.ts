// Everything by the keyboard alone.
import type { Editor } from "./editor.ts";
import type { Player } from "./player.ts";
import type { Saving } from "./saving.ts";
import { landmarkNames } from "./study.ts";

export const keyMeanings: [string[], string][] = [
  [["PageUp", "PageDown"], "the slice before, the next one"], [[",", "."], "the phase before, the next one"], [["Space"], "play and stop the cine"],
  [["D"], "the next doubtful border"], [["E", "P"], "endocardium, epicardium"], [["N", "B"], "the next point of the border, the one before"],
  [["←", "→", "↑", "↓"], "move the point by 0.5 mm, with Shift by 2 mm; what lies near comes along"], [["[", "]"], "the whole border smaller, larger by 0.5 mm"],
  [["{", "}"], "the same on all slices of the phase"],
  [["X", "Shift+X"], "set a point where the border should run, at the selected point or in the middle of the picture; drop these points"], [["R"], "redraw the border through the points that were set or pulled"],
  [["W", "Shift+W"], "a pull takes more, less of the border with it"], [["A"], "a new border: a circle, or beside the other one"], [["Delete"], "delete the border (Shift: both)"],
  [["C", "Shift+C"], "copy the border to the next slice, to the one before"], [["V"], "copy it to the next phase"], [["O"], "back to what the program proposed"],
  [["M"], "set the landmark that is chosen in the middle of the picture; the arrows then move it"], [["+", "−"], "zoom"], [["0"], "the surroundings of the borders"],
  [["I", "J", "K", "L"], "move the picture"], [["H"], "hide the borders, show them"], [["Ctrl+Z", "Ctrl+Y"], "undo, redo"], [["Ctrl+S"], "save"]];

const near = 0.5;  // mm
const far = 2;

function arrow(key: string): [number, number] | undefined {
  return ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] } as Record<string, [number, number]>)[key];
}

/** What the keys do while the picture has the focus. */
function commands(editor: Editor, player: Player, saving: Saving, shift: boolean): Record<string, () => void> {
  const { picture } = editor;
  return {
    PageUp: () => editor.go(editor.slice - 1, editor.phase), PageDown: () => editor.go(editor.slice + 1, editor.phase),
    ",": () => editor.go(editor.slice, editor.phase - 1), ".": () => editor.go(editor.slice, editor.phase + 1), " ": () => player.toggle(),
    d: () => editor.nextDoubtful(), e: () => editor.go(editor.slice, editor.phase, "endo"), p: () => editor.go(editor.slice, editor.phase, "epi"),
    n: () => editor.step(1), b: () => editor.step(-1), "[": () => editor.grow(-near), "]": () => editor.grow(near), "{": () => editor.growAll(-near), "}": () => editor.growAll(near),
    x: () => (shift ? editor.dropPoints() : editor.setPoint()), r: () => void saving.redraw(),
    w: () => { editor.width = Math.min(60, Math.max(4, editor.width + (shift ? -4 : 4))); editor.go(editor.slice, editor.phase); },
    a: () => editor.add(), Delete: () => (shift ? editor.removeBoth() : editor.remove()), c: () => editor.copy(shift ? -1 : 1, 0), v: () => editor.copy(0, 1),
    o: () => editor.backToProposal(), m: () => (editor.tool in landmarkNames ? editor.mark(editor.tool) : editor.say("choose a landmark first")),
    "+": () => picture.zoom(1.25), "=": () => picture.zoom(1.25), "-": () => picture.zoom(0.8), "0": () => editor.fit(),
    i: () => picture.pan(0, 30), k: () => picture.pan(0, -30), j: () => picture.pan(30, 0), l: () => picture.pan(-30, 0),
    h: () => { editor.showsLines = !editor.showsLines; editor.show(); },
  };
}

export function listenToKeys(editor: Editor, player: Player, saving: Saving): void {
  const { canvas } = editor.picture;
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const way = arrow(event.key);
    const step = event.shiftKey ? far : near;
    const command = way ? () => editor.nudge(step * way[0], step * way[1])
      : commands(editor, player, saving, event.shiftKey)[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!command) return;
    event.preventDefault();
    command();
  });
  document.addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey || event.target instanceof HTMLInputElement && event.target.type === "text") return;
    const key = event.key.toLowerCase();
    const command = key === "s" ? () => void saving.save() : key === "y" || (key === "z" && event.shiftKey) ? () => saving.redo() : key === "z" ? () => saving.undo() : undefined;
    if (!command) return;
    event.preventDefault();
    command();
  });
}
