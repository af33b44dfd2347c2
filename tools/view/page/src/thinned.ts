// SPDX-License-Identifier: Apache-2.0
// What of a long run is to be drawn at a scale. A robot that goes round in a trap draws the same
// few pixels ten thousand times; here each is drawn once. All lists are in the order of ticks, so
// what belongs to the past of a tick is the beginning of a list.

import type { View } from "./map_layers";
import type { Pose, Run, RunEvent } from "./run";
import type { Point } from "./world";

/// Strokes and marks nearer to each other than this are one, in pixels.
const kCell = 2;
/// A pose that is so near to the last one of a path adds no stroke, in pixels.
const kLeastStroke = 0.5;

/// The cells of a few places as one number; NaN if they lie too far apart for that.
function key_of(x: number, y: number, to_x: number, to_y: number): number {
  const column = Math.round(x / kCell) + 0x20000;
  const row = Math.round(y / kCell) + 0x20000;
  const right = Math.round(to_x / kCell) + 0x20000 - column + 64;
  const up = Math.round(to_y / kCell) + 0x20000 - row + 64;
  const near = right >= 0 && right < 128 && up >= 0 && up < 128 && column >= 0 && column < 0x40000 && row >= 0 && row < 0x40000;
  // 18 + 18 + 7 + 7 bits: a whole number that a double holds.
  return near ? ((column * 0x40000 + row) * 128 + right) * 128 + up : NaN;
}

/// Strokes of a path, each with the place in the lists of its run at which it is drawn.
export class Strokes {
  private readonly at: number[] = [];
  private readonly ends: number[] = [];
  private readonly seen = new Set<number>();
  private last: Pose | undefined;

  /// `scale`: pixels a metre.
  constructor(private readonly scale: number) {}

  /// Goes on to a pose; without one, the path is interrupted.
  go_to(index: number, pose: Pose | undefined): void {
    const from = this.last;
    if (!pose || !from) {
      this.last = pose;
      return;
    }
    const { scale } = this;
    if (Math.max(Math.abs(pose.x - from.x), Math.abs(pose.y - from.y)) * scale < kLeastStroke) return;
    this.last = pose;
    const key = key_of(from.x * scale, from.y * scale, pose.x * scale, pose.y * scale);
    if (this.seen.has(key)) return;
    if (!Number.isNaN(key)) this.seen.add(key);
    this.at.push(index);
    this.ends.push(from.x, from.y, pose.x, pose.y);
  }

  /// Draws what is drawn up to a place in the lists; `falling`: down to it.
  draw(g: CanvasRenderingContext2D, view: View, index: number, falling = false): void {
    let low = 0;
    let high = this.at.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      const place = this.at[middle] ?? 0;
      if (falling ? place >= index : place <= index) low = middle + 1;
      else high = middle;
    }
    g.beginPath();
    let [x, y] = [NaN, NaN];
    for (let i = 0; i < 4 * low; i += 4) {
      const [from_x, from_y, to_x, to_y] = [this.ends[i] ?? 0, this.ends[i + 1] ?? 0, this.ends[i + 2] ?? 0, this.ends[i + 3] ?? 0];
      if (from_x !== x || from_y !== y) g.moveTo(...view.at(from_x, from_y));
      g.lineTo(...view.at(to_x, to_y));
      [x, y] = [to_x, to_y];
    }
    g.stroke();
  }
}

/// A virtual target, and where it was set.
export type VirtualTarget = Run["virtual_targets"][number];

/// All of a run at one scale. What arrives later is added by follow().
export class ThinnedRun {
  readonly truth: Strokes;
  readonly belief: Strokes;
  /// Where an escape was at work.
  readonly recovering: Strokes;
  readonly events: RunEvent[] = [];
  readonly virtual_targets: VirtualTarget[] = [];
  private readonly seen = new Set<string>();
  private ahead_strokes: Strokes | undefined;
  private poses = 0;
  private events_taken = 0;
  private targets_taken = 0;
  private readonly recording: unknown;

  constructor(private readonly run: Run, readonly scale: number) {
    this.recording = run.recording;
    this.truth = new Strokes(scale);
    this.belief = new Strokes(scale);
    this.recovering = new Strokes(scale);
  }

  /// Whether it is of this run still: one that began anew is another.
  fits(scale: number): boolean {
    return this.scale === scale && this.recording === this.run.recording && this.poses <= this.run.ticks.length;
  }

  follow(): void {
    const { run } = this;
    if (this.poses < run.ticks.length) this.ahead_strokes = undefined;
    for (; this.poses < run.ticks.length; this.poses++) {
      const i = this.poses;
      this.truth.go_to(i, run.truth[i]);
      this.belief.go_to(i, run.belief[i]);
      this.recovering.go_to(i, run.mode[i] === 1 ? run.truth[i] : undefined);
    }
    for (; this.events_taken < run.events.length; this.events_taken++) {
      const event = run.events[this.events_taken];
      if (event && this.is_new(`${event.kind} ${event.shadow}`, event.place, event.earlier?.place)) this.events.push(event);
    }
    for (; this.targets_taken < run.virtual_targets.length; this.targets_taken++) {
      const target = run.virtual_targets[this.targets_taken];
      if (target && this.is_new("target", target.place, target.from)) this.virtual_targets.push(target);
    }
  }

  /// The path from the end backward: what is still to come at a place in the lists is its beginning.
  get ahead(): Strokes {
    if (!this.ahead_strokes) {
      this.ahead_strokes = new Strokes(this.scale);
      for (let i = this.run.ticks.length - 1; i >= 0; i--) this.ahead_strokes.go_to(i, this.run.truth[i]);
    }
    return this.ahead_strokes;
  }

  private is_new(kind: string, ...places: (Point | undefined)[]): boolean {
    let key = kind;
    for (const place of places) {
      if (place) key += ` ${Math.round(place[0] * this.scale / kCell)} ${Math.round(place[1] * this.scale / kCell)}`;
    }
    if (this.seen.has(key)) return false;
    this.seen.add(key);
    return true;
  }
}

const thinned_runs = new WeakMap<Run, ThinnedRun>();

/// What is to be drawn of a run, all that has arrived of it.
export function thinned(run: Run, view: View): ThinnedRun {
  // Zooming makes all of it anew only where it doubles.
  const scale = 2 ** Math.ceil(Math.log2(view.scale));
  let found = thinned_runs.get(run);
  if (!found?.fits(scale)) {
    found = new ThinnedRun(run, scale);
    thinned_runs.set(run, found);
  }
  found.follow();
  return found;
}
