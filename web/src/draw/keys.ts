// Everything by the keyboard alone.
import type { Editor } from "./editor.ts";
import type { Player } from "./player.ts";
import type { Saving } from "./saving.ts";
import type { ScarEditor } from "./scar_editor.ts";
import { landmarkNames } from "./study.ts";

export const keyMeanings: [string[], string][] = [
  [["PageUp", "PageDown"], "the slice before, the next one; long-axis images follow the slices"], [[",", "."], "the phase before, the next one"], [["Space"], "play and stop the cine"],
  [["D"], "the next doubtful border"], [["E", "P"], "endocardium, epicardium"], [["N", "B"], "the next point of the border, the one before"],
  [["←", "→", "↑", "↓"], "move the point by 0.5 mm, with Shift by 2 mm; what lies near comes along"], [["[", "]"], "the whole border smaller, larger by 0.5 mm"],
  [["{", "}"], "the same on all slices of the phase"],
  [["X", "Shift+X"], "set a point where the border should run, at the selected point or in the middle of the picture; drop these points"], [["R"], "redraw the border through the points that were set or pulled"],
  [["W", "Shift+W"], "a pull takes more, less of the border with it"], [["A"], "a new border: a circle, or beside the other one"], [["Delete"], "delete the border (Shift: both)"],
  [["C", "Shift+C"], "copy the border to the next slice, to the one before"], [["V"], "copy it to the next phase"], [["O"], "back to what the program proposed"],
  [["M"], "set the landmark that is chosen in the middle of the picture; the arrows then move it"], [["+", "−"], "zoom"], [["0"], "the surroundings of the borders"],
  [["I", "J", "K", "L"], "move the picture"], [["H"], "hide the borders, show them"], [["Ctrl+Z", "Ctrl+Y"], "undo, redo"], [["Ctrl+S"], "save"]];

export const scarKeyMeanings: [string[], string][] = [
  [["PageUp", "PageDown"], "the enhanced slice before, the next one"], [["←", "→", "↑", "↓"], "move the brush by 0.5 mm, with Shift by 2 mm"], [["X"], "brush here"],
  [["S", "E", "R"], "the brush makes scar, erases it, shows remote muscle"], [["[", "]"], "a smaller, a larger brush"], [["T", "Shift+T"], "the threshold higher, lower"],
  [["+", "−"], "zoom"], [["0"], "the surroundings of the wall"], [["I", "J", "K", "L"], "move the picture"], [["H"], "hide the colours, show them"]];

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

/** What the keys do while the enhanced picture has the focus. */
function scarCommands(scar: ScarEditor, shift: boolean): Record<string, () => void> {
  const { picture, said: { low, high } } = scar;
  const size = (by: number) => { scar.radius = Math.min(12, Math.max(0.5, scar.radius + by)); scar.go(scar.slice); };
  const choose = (brush: typeof scar.brush) => { scar.brush = brush; scar.go(scar.slice); };
  return {
    PageUp: () => scar.go(scar.slice - 1), PageDown: () => scar.go(scar.slice + 1), x: () => scar.dab(), s: () => choose("scar"), e: () => choose("muscle"), r: () => choose("remote"),
    "[": () => size(-0.5), "]": () => size(0.5), t: () => scar.setLevel(scar.scar.threshold + (shift ? -1 : 1) * (high - low) / 100),
    "+": () => picture.zoom(1.25), "=": () => picture.zoom(1.25), "-": () => picture.zoom(0.8), "0": () => scar.fit(),
    i: () => picture.pan(0, 30), k: () => picture.pan(0, -30), j: () => picture.pan(30, 0), l: () => picture.pan(-30, 0),
    h: () => { scar.showsScar = !scar.showsScar; scar.go(scar.slice); },
  };
}

/** Arrows and other keys of a picture that has the focus. */
function listen(canvas: HTMLCanvasElement, nudge: (u: number, v: number) => void, others: (shift: boolean) => Record<string, () => void>): void {
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const way = arrow(event.key);
    const step = event.shiftKey ? far : near;
    const command = way ? () => nudge(step * way[0], step * way[1]) : others(event.shiftKey)[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!command) return;
    event.preventDefault();
    command();
  });
}

export const listenToScarKeys = (scar: ScarEditor) => listen(scar.picture.canvas, (u, v) => scar.moveBrush(u, v), (shift) => scarCommands(scar, shift));

export function listenToKeys(editor: Editor, player: Player, saving: Saving): void {
  listen(editor.picture.canvas, (u, v) => editor.nudge(u, v), (shift) => commands(editor, player, saving, shift));
  document.addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey || event.target instanceof HTMLInputElement && event.target.type === "text") return;
    const key = event.key.toLowerCase();
    const command = key === "s" ? () => void saving.save() : key === "y" || (key === "z" && event.shiftKey) ? () => saving.redo() : key === "z" ? () => saving.undo() : undefined;
    if (!command) return;
    event.preventDefault();
    command();
  });
}
