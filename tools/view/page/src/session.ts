// SPDX-License-Identifier: Apache-2.0
// What all parts of the page share: the runs, the tick that is looked at, and who wants to know.

import { Recording } from "./recording";
import { Run } from "./run";

export type Change = "tick" | "runs" | "data" | "theme" | "layers" | "playing";

export class Session {
  readonly runs: Run[] = [];
  /// The run whose messages are shown, and whose lanes are drawn.
  chosen = 0;
  readonly hidden = new Set<number>();
  tick = 0;
  playing = false;
  /// Simulated seconds a second.
  rate = 4;
  /// Whether somebody wants the insides of the chosen tick.
  wants_insides = false;
  private readonly listeners: ((change: Change) => void)[] = [];

  add(recording: Recording): Run {
    const run = new Run(recording, this.runs.length);
    this.runs.push(run);
    this.tell("runs");
    return run;
  }

  get run(): Run | undefined {
    return this.runs[this.chosen];
  }
  get shown(): Run[] {
    return this.runs.filter((run) => !this.hidden.has(run.index) && run.ticks.length > 0);
  }
  get first_tick(): number {
    return Math.min(...this.runs.filter((run) => run.ticks.length > 0).map((run) => run.first_tick), Infinity);
  }
  get last_tick(): number {
    return Math.max(0, ...this.runs.map((run) => run.last_tick));
  }

  listen(listener: (change: Change) => void): void {
    this.listeners.push(listener);
  }
  tell(change: Change): void {
    for (const listener of this.listeners) listener(change);
  }

  go_to(tick: number): void {
    const first = Number.isFinite(this.first_tick) ? this.first_tick : 0;
    const next = Math.max(first, Math.min(this.last_tick, Math.round(tick)));
    if (Number.isNaN(next)) return;
    if (next === this.tick) return;
    this.tick = next;
    this.tell("tick");
  }

  /// The next tick, or the one before, at which something happened in a shown run.
  event_tick(forward: boolean): number | undefined {
    let best: number | undefined;
    for (const run of this.shown) {
      for (const event of run.events) {
        const ahead = forward ? event.tick > this.tick : event.tick < this.tick;
        if (!ahead || event.kind === "landmark") continue;
        if (best === undefined || (forward ? event.tick < best : event.tick > best)) best = event.tick;
      }
    }
    return best;
  }

  set_playing(playing: boolean): void {
    if (playing === this.playing) return;
    if (playing && this.tick >= this.last_tick) this.go_to(this.first_tick);
    this.playing = playing;
    this.tell("playing");
    if (playing) this.play();
  }

  private play(): void {
    let before = performance.now();
    let at = this.tick;
    const step = (now: number): void => {
      if (!this.playing) return;
      const tick_s = this.run?.tick_s ?? 0.1;
      // Somebody may have gone elsewhere meanwhile.
      if (Math.round(at) !== this.tick) at = this.tick;
      at += (Math.min(now - before, 200) / 1000) * this.rate / tick_s;
      before = now;
      this.go_to(Math.min(at, this.last_tick));
      if (at >= this.last_tick) this.set_playing(false);
      else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }
}
