// Keeping the drawing, and what is told when it cannot be kept.
import { el } from "../dom.ts";
import type { Editor } from "./editor.ts";
import { Refused, Stopped, downloadDrawing, type Keeper } from "./keeper.ts";
import { toldScar } from "./scar.ts";
import { inSpace, keyOf, landmarksOf, linesOf, placeOn, programsOwn, said, sideNames, toldPoints, type Landmark, type SaidProposal, type SaidStudy, type Side } from "./study.ts";

const asking = 3000;  // ms between two questions whether the program still runs

export class Saving {
  doubts: string[];
  readonly banners = el("div", { id: "banners" });
  private readonly button = el("button", { type: "button", id: "save", click: () => void this.save() });
  private readonly state = el("span", { id: "state" });
  readonly bar = el("div", { class: "toolbar" }, this.button, this.state);
  private readonly shown = new Map<string, HTMLElement>();
  private revision: number;
  private keptAt = "";
  private readonly channel = "BroadcastChannel" in window ? new BroadcastChannel(`ventricle draw ${location.pathname}`) : undefined;

  constructor(private readonly source: Keeper, private readonly study: SaidStudy, private readonly editor: Editor, private readonly say: (words: string) => void) {
    this.doubts = study.doubts;
    this.revision = study.revision;
    this.button.textContent = source.save ? "Save" : "Download the result";
    if (source.save && study.hindrance) this.warn("hindrance", `Nothing can be saved: ${study.hindrance}. Allow it and save again, or download what you draw.`, this.downloadButton());
    this.tellFaults(study.faults);
    if (source.alive) setInterval(() => void this.lookAfter(), asking);
    if (source.save) this.meetOtherTabs();
    addEventListener("beforeunload", (event) => { if (this.editor.drawing.unsaved) event.preventDefault(); });
  }

  show(): void {
    const { drawing } = this.editor;
    const count = `${drawing.changes} change${drawing.changes === 1 ? "" : "s"}`;
    this.state.textContent = drawing.unsaved ? `${count}, not saved` : this.keptAt ? `${count}, saved at ${this.keptAt}` : this.study.saved ? `${count}; as saved in ${this.study.folder}` : `${count}; as the program proposed`;
  }

  undo(): void { const what = this.editor.drawing.undo(); this.say(what ? `undone: ${what}` : "nothing to undo"); }
  redo(): void { const what = this.editor.drawing.redo(); this.say(what ? `done again: ${what}` : "nothing to do again"); }

  private text(): string {
    const { lines, landmarks, confidence, keptScar } = this.editor.drawing;
    return JSON.stringify({ revision: this.revision, ...said(lines, landmarks, confidence, this.editor.planes),
      ...(keptScar ? { scar: toldScar(keptScar, this.study.scar!.slices) } : {}) });
  }

  private downloadButton(): HTMLElement {
    return el("button", { type: "button", click: () => downloadDrawing(this.study.name, this.text()) }, "Download the drawing");
  }

  private warn(about: string, words: string, ...more: HTMLElement[]): void {
    this.shown.get(about)?.remove();
    const banner = el("div", { class: "banner", role: "alert", "data-about": about }, el("span", {}, words), ...more);
    this.shown.set(about, banner);
    this.banners.append(banner);
  }

  private unwarn(about: string): void {
    this.shown.get(about)?.remove();
    this.shown.delete(about);
  }

  /** Borders that are kept as they are, of which no run can make a wall. */
  private tellFaults(faults: string[]): void {
    this.unwarn("faults");
    if (faults.length > 0) this.warn("faults", `These borders are saved, but no wall can be made of them: ${faults.join("; ")}.`);
  }

  async save(whateverStands = false): Promise<void> {
    if (!this.source.save) {
      downloadDrawing(this.study.name, this.text());
      this.kept();
      return this.say("Downloaded. ventricle draw CASE.toml --import FILE keeps it beside the case.");
    }
    try {
      const { revision, faults } = await this.source.save(this.text(), whateverStands);
      this.revision = revision;
      this.kept();
      for (const about of ["refused", "other", "hindrance"]) this.unwarn(about);
      this.channel?.postMessage({ saved: this.revision });
      this.say(`Saved in ${this.study.folder}/contours.`);
      this.tellFaults(faults);
    } catch (error) {
      this.explain(error);
    }
  }

  private kept(): void {
    this.keptAt = new Date().toLocaleTimeString();
    this.editor.drawing.nowKept();
  }

  private explain(error: unknown): void {
    if (error instanceof Stopped) return this.stopped();
    this.unwarn("other");
    if (error instanceof Refused && error.status === 409)
      return this.warn("refused", `Not saved: ${error.message}.`,
        el("button", { type: "button", click: () => location.reload() }, "Show what is saved (drops what was drawn here)"),
        el("button", { type: "button", click: () => void this.save(true) }, "Save this one over it"));
    this.warn("refused", `Not saved: ${(error as Error).message}`, this.downloadButton());
  }

  private stopped(): void {
    if (!this.shown.has("stopped"))
      this.warn("stopped", "ventricle draw has stopped, so nothing can be saved from here. What you drew is still in this tab: download it, give the file to ventricle draw CASE.toml --import FILE, and start ventricle draw again.",
        this.downloadButton());
  }

  private async lookAfter(): Promise<void> {
    try {
      const stands = await this.source.alive!();
      this.unwarn("stopped");
      if (stands !== this.revision) this.savedElsewhere();
    } catch (error) {
      if (error instanceof Stopped) this.stopped();
    }
  }

  private savedElsewhere(): void {
    if (!this.shown.has("refused") && !this.shown.has("other"))
      this.warn("other", "Another tab has saved this study. What is shown here is older.", el("button", { type: "button", click: () => location.reload() }, "Show what it saved"));
  }

  private meetOtherTabs(): void {
    if (!this.channel) return;
    const meet = () => this.warn("tabs", "This study is open in two tabs. Whoever saves second is asked first.");
    this.channel.addEventListener("message", ({ data }) => {
      if (data.saved) return this.savedElsewhere();
      if (data.opened) this.channel!.postMessage({ here: true });
      if (data.closed) return this.unwarn("tabs");
      meet();
    });
    this.channel.postMessage({ opened: true });
    addEventListener("pagehide", () => this.channel!.postMessage({ closed: true }));
  }

  /** Whether the program that redraws is there. */
  get redraws(): boolean { return this.source.redraw !== undefined; }

  /** Lets the program draw the border again through the points that were set. */
  async redraw(): Promise<void> {
    const { editor } = this;
    const { slice, phase, side, key, plane, wanted, line } = editor;
    if (!this.source.redraw) return this.say("This page is a file: only ventricle draw itself can redraw from points.");
    if (wanted.length === 0) return this.say(`Pull the ${sideNames[side]} to where it runs, or set points of it, first.`);
    const told = (of: Side) => toldPoints(plane, editor.drawing.lines.get(keyOf(slice, phase, of))?.points ?? []);
    const began = performance.now();
    try {
      const points = await this.source.redraw({ slice, phase, side, points: toldPoints(plane, wanted), endo: told("endo"), epi: told("epi") });
      if (editor.key !== key || editor.line !== line) return this.say("Not redrawn: the border was changed or left meanwhile.");
      editor.redrawn(points.map((x) => placeOn(plane, x)));
      this.say(`The ${sideNames[side]} was redrawn through ${wanted.length} point${wanted.length === 1 ? "" : "s"} in ${Math.round(performance.now() - began)} ms.`);
    } catch (error) {
      if (error instanceof Stopped) this.stopped();
      else this.say(`Not redrawn: ${(error as Error).message}`);
    }
  }

  /** Landmarks as the program proposes them now; those that a hand set stay. */
  private freshMarks(found: SaidProposal): [string, Landmark | undefined][] {
    const { landmarks } = this.editor.drawing;
    const fresh = landmarksOf(found.landmarks, this.editor.planes);
    const open = [...new Set([...landmarks.keys(), ...fresh.keys()])].filter((name) => (landmarks.get(name)?.by ?? programsOwn) === programsOwn);
    return open.map((name) => [name, fresh.get(name)]);
  }

  /** Lets the program segment again round the centre; what a hand drew stays. */
  async proposeAgain(): Promise<void> {
    const centre = this.editor.drawing.landmarks.get("centre");
    if (!this.source.propose) return this.say("This page is a file: only ventricle draw itself can propose again.");
    if (!centre) return this.say("Set the centre of the blood first.");
    this.say("The program looks for the borders round this centre.");
    try {
      const found = await this.source.propose(inSpace(this.editor.planes[centre.slice - 1], centre.at));
      const { drawing } = this.editor;
      const fresh = linesOf(found.contours, this.study.slices);
      const open = [...new Set([...drawing.lines.keys(), ...fresh.keys()])].filter((key) => (drawing.lines.get(key)?.how ?? "proposed") === "proposed");
      this.doubts = found.doubts;
      this.study.landmark_phase = found.landmark_phase;
      drawing.change({ what: "propose again", lines: open.map((key) => [key, fresh.get(key)]), marks: this.freshMarks(found), confidence: found.confidence });
      this.say(`Proposed again on ${new Set([...fresh.keys()].map((key) => key.split("/")[0])).size} slices; borders that a hand drew stay.`);
    } catch (error) {
      if (error instanceof Stopped) this.stopped();
      else this.say(`Not proposed: ${(error as Error).message}`);
    }
  }
}
