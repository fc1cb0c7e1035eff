// The cine, playing.
import type { Editor } from "./editor.ts";

export class Player {
  private since: number | undefined;
  private told: () => void = () => {};
  constructor(private readonly editor: Editor) {}

  get plays(): boolean { return this.since !== undefined; }
  onChange(tell: () => void): void { this.told = tell; }

  toggle(): void {
    this.since = this.plays ? undefined : performance.now();
    if (this.plays) requestAnimationFrame((now) => this.tick(now));
    this.told();
  }

  /** As fast as the heart beats, where the study says so; else a beat a second. */
  private get interval(): number {
    const { times, phases } = this.editor.study;
    return times.length > 1 ? 1e3 * (times.at(-1)! - times[0]) / (times.length - 1) : 1e3 / phases;
  }

  private tick(now: number): void {
    if (this.since === undefined) return;
    if (now - this.since >= this.interval) {
      this.since = now;
      this.editor.go(this.editor.slice, this.editor.phase + 1);
    }
    requestAnimationFrame((next) => this.tick(next));
  }
}
