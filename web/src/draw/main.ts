// The page of `ventricle draw`.
import "../style.css";
import "./draw.css";
import { el, titled } from "../dom.ts";
import { Drawing } from "./drawing.ts";
import { Editor } from "./editor.ts";
import { keyMeanings, listenToKeys, listenToScarKeys, scarKeyMeanings } from "./keys.ts";
import { keeper } from "./keeper.ts";
import { FirstList, StudyMap, VolumeCurve, doubtfulKeys, fullest } from "./overview.ts";
import { Player } from "./player.ts";
import { Saving } from "./saving.ts";
import { scarOf, type SaidScar } from "./scar.ts";
import { ScarEditor } from "./scar_editor.ts";
import { landmarksOf, linesOf, planesOf, programsOwn, sideNames, type SaidStudy } from "./study.ts";
import { brushBar, contrastBar, editBar, greyBar, placeBar, thresholdBar, toolBar, viewSwitch } from "./toolbars.ts";

const page = document.getElementById("page")!;
const source = keeper();

function statusWords(editor: Editor): string {
  const { slice, phase, side, line, study } = editor;
  const time = study.times[phase - 1];
  const when = `phase ${phase} of ${study.phases}${time === undefined ? "" : ` (${Math.round(1e3 * time)} ms)`}`;
  if (editor.isLongAxis) {
    const marks = [...editor.drawing.landmarks.values()].filter((mark) => mark.slice === slice);
    const here = marks.map((mark) => mark.name.replace("_", " ")).join(", ");
    const elsewhen = phase !== study.landmark_phase && marks.some((mark) => mark.by === programsOwn);
    return `${editor.called(slice)} of ${study.long_axis.length}, ${when}; cut by slice ${editor.crossing}; ${
      here ? `landmarks: ${here}${elsewhen ? ` (proposed at phase ${study.landmark_phase})` : ""}` : "no landmark here"}`;
  }
  const sure = editor.drawing.confidence.find((c) => c.slice === slice && c.phase === phase)?.[side];
  const how = !line ? "none here" : line.how === "proposed" ? `proposed${sure === undefined ? "" : `, confidence ${sure.toFixed(2)}`}` : `${line.how}${line.by ? ` by ${line.by}` : ""}`;
  const point = editor.selected === undefined ? "" : `; point ${editor.selected + 1} of ${line?.points.length ?? 0}`;
  return `slice ${slice} of ${study.slices.length}, ${when}; ${sideNames[side]}: ${how}${point}`;
}

const keyList = (meanings: [string[], string][]) =>
  el("ul", { class: "keys" }, ...meanings.map(([keys, meaning]) => el("li", {}, ...keys.map((key) => el("kbd", {}, key)), ` ${meaning}`)));

/** The enhanced slices with what belongs to them. */
interface ScarView { editor: ScarEditor; element: HTMLElement; show(): void }

function scarView(said: SaidScar, editor: Editor, saving: Saving, say: (words: string) => void): ScarView {
  const scar = new ScarEditor(said, editor.study, editor.drawing, source, say, () => editor.observer);
  const bars = [brushBar(scar, saving), thresholdBar(scar), greyBar(scar)];
  const where = el("p", { class: "status", id: "scar-where" });
  const { canvas } = scar.picture;
  canvas.setAttribute("role", "application");
  canvas.setAttribute("aria-label", "The enhanced slice with the wall and the scar. Keys: see the list below the picture");
  canvas.setAttribute("aria-describedby", "scar-where");
  const note = el("p", { class: "banner", id: "scar-note", hidden: true }, `Nothing is proposed yet: ${said.note}`);
  const look = () => {
    where.textContent = scar.words();
    note.hidden = said.note === "" || editor.drawing.keptScar !== undefined;
    for (const bar of bars) bar.show();
  };
  scar.onMove(look);
  listenToScarKeys(scar);
  const element = el("div", { class: "stage", hidden: true }, note, bars[0].element, canvas, where, ...bars.slice(1).map((bar) => bar.element),
    el("p", { class: "help legend" }, el("span", { class: "key" }, el("i", { style: "background:#ff3c28" }), "scar"), el("span", { class: "key" }, el("i", { style: "background:#3ce678" }), "remote muscle")),
    titled("scar-keys", "Keys", {}, keyList(scarKeyMeanings)));
  return { editor: scar, element, show: () => { scar.show(); look(); } };
}

function build(study: SaidStudy): { editor: Editor; scar: ScarEditor | undefined } {
  const drawing = new Drawing(linesOf(study.contours, study.slices), landmarksOf(study.landmarks, planesOf(study)), study.confidence, study.scar ? scarOf(study.scar) : undefined,
    study.scar?.saved);
  const said = el("p", { class: "status", role: "status", id: "said" });
  const say = (words: string) => { said.textContent = words; };
  const editor = new Editor(study, drawing, linesOf(study.proposal, study.slices), say);
  const curve = new VolumeCurve(study, editor.proposal);
  const map = new StudyMap(study, (slice, phase) => editor.go(slice, phase));
  const first = new FirstList(study, (slice, phase, side) => { editor.go(slice, phase, side); editor.picture.canvas.focus(); });
  const saving = new Saving(source, study, editor, say);
  const player = new Player(editor);
  const bars = [placeBar(editor, player), toolBar(editor, saving), editBar(editor, saving), contrastBar(editor)];
  const where = el("p", { class: "status", id: "where" });
  const { canvas } = editor.picture;
  canvas.setAttribute("role", "application");
  canvas.setAttribute("aria-label", "The slice with its borders. Keys: see the list below the picture");
  canvas.setAttribute("aria-describedby", "where");
  const look = () => {
    where.textContent = statusWords(editor);
    curve.show(drawing, editor.phase);
    map.point(editor.slice, editor.phase);
    for (const bar of bars) bar.show();
  };
  const changed = () => {
    editor.show();
    first.show(drawing, saving.doubts, fullest(curve.now.length > 0 ? curve.now : [1]));
    map.show(drawing);
    saving.show();
    scar?.show();
    look();
  };
  const scar = study.scar ? scarView(study.scar, editor, saving, say) : undefined;
  editor.onMove(look);
  drawing.onChange(changed);
  listenToKeys(editor, player, saving);
  const borders = [el("div", { class: "columns" },
    el("div", { class: "stage" }, bars[0].element, canvas, where, ...bars.slice(1).map((bar) => bar.element)),
    el("div", { class: "side" }, first.section, curve.section, map.section)),
  titled("keys", "Keys", {}, el("p", { class: "help" }, "They count while the picture has the focus (Tab leads to it); every one has its button."), keyList(keyMeanings))];
  const shows = (enhanced: boolean) => {
    for (const part of borders) part.hidden = enhanced;
    scar!.element.hidden = !enhanced;
    if (enhanced) { scar!.editor.fit(); scar!.show(); } else editor.show();
  };
  page.append(el("header", {}, el("h1", {}, `Borders of ${study.name}`), saving.bar, ...(scar ? [viewSwitch(shows)] : [])), saving.banners, said, ...borders, ...(scar ? [scar.element] : []));
  look();
  const [worst] = doubtfulKeys(drawing, study.doubtful);
  const [slice, phase] = worst ? worst.key.split("/").map(Number) : [Math.ceil(study.slices.length / 2), fullest(curve.now)];
  editor.go(slice, phase, worst?.key.endsWith("epi") ? "epi" : "endo");
  editor.fit();
  changed();
  return { editor, scar: scar?.editor };
}

async function start(): Promise<void> {
  const study = await source.study();
  document.title = `${study.name}: ventricle draw`;
  const { editor, scar } = build(study);
  const order = editor.planes.map((_, i) => i + 1).sort((a, b) => Math.abs(a - editor.slice) - Math.abs(b - editor.slice));
  for (const slice of order) editor.hold(slice, await source.slice(slice));
  for (const slice of scar?.planes.map((_, i) => i + 1) ?? []) scar!.hold(slice, await source.enhanced(slice));
  document.body.dataset.ready = "true";
}

start().catch((error: Error) => page.replaceChildren(el("p", { class: "banner", role: "alert" },
  `The study cannot be shown: ${error.message || "ventricle draw does not answer. Start it again and open the address that it prints."}`)));
