// SPDX-License-Identifier: Apache-2.0
// A run under way: samples as the server passes them on, until it ends; then all of it once more,
// since while it ran the page was shown sixty ticks a second.

import { Recording } from "./recording";
import type { Change, Incident, Topic } from "./recording";

interface Description {
  name: string;
  tick_s: number;
  seed: string;
  bundle: Record<string, string>;
  topics: { number: number; name: string; type: string; idl: string }[];
}

type Told = Partial<Description> & {
  ended?: string; missed?: number; changes?: Change[]; incidents?: Incident[];
};

export interface LiveListener {
  /// Something new is in the recording.
  grown(): void;
  /// All of the run, in place of what was shown of it.
  again(recording: Recording): void;
  ended(how: string, missed: number): void;
}

export class LiveRun {
  readonly recording = new Recording("live");
  /// Takes all of the run once more, when it has ended.
  private whole: Recording | undefined;
  private readonly socket: WebSocket;
  private readonly topics = new Map<number, Topic>();
  private description: Description | undefined;
  private outcome = "the connection was closed";
  private finished = false;
  private missed = 0;

  constructor(private readonly listener: LiveListener) {
    this.socket = new WebSocket(`ws://${location.host}/live`, ["clew.view.v1"]);
    this.socket.binaryType = "arraybuffer";
    this.socket.addEventListener("message", (event: MessageEvent<string | ArrayBuffer>) => {
      if (typeof event.data === "string") this.take_text(JSON.parse(event.data) as Told);
      else this.take_samples(event.data);
    });
    this.socket.addEventListener("close", () => {
      if (!this.finished) this.finish();
    });
  }

  private take_text(told: Told): void {
    if (told.changes || told.incidents) {
      // Those that came before the recording was read again are in it, too.
      for (const recording of this.whole ? [this.recording, this.whole] : [this.recording]) {
        for (const each of told.changes ?? []) recording.add_change(each.tick, each);
        for (const each of told.incidents ?? []) recording.add_incident(each.tick, each);
      }
    } else if (told.missed !== undefined) {
      this.missed = told.missed;
    } else if (told.ended !== undefined) {
      this.outcome = told.ended;
      if (this.missed > 0 && !this.whole) this.read_again();
      else this.finish();
    } else if (told.topics) {
      this.description = told as Description;
      this.describe();
    }
  }

  private describe(): void {
    const recording = this.whole ?? this.recording;
    const description = this.description;
    if (!description) return;
    recording.name = `${description.name} (live)`;
    recording.tick_s = description.tick_s;
    recording.seed = description.seed;
    for (const [file, text] of Object.entries(description.bundle)) recording.bundle.set(file, text);
    for (const { number, name, type, idl } of description.topics) this.topics.set(number, recording.add_topic(name, type, idl));
  }

  /// Records as a spool has them: tick, sequence, size, topic, bytes.
  private take_samples(data: ArrayBuffer): void {
    const view = new DataView(data);
    for (let at = 0; at + 24 <= data.byteLength;) {
      const size = view.getUint32(at + 16, true);
      const topic = this.topics.get(view.getUint32(at + 20, true));
      topic?.add(Number(view.getBigUint64(at, true)), Number(view.getBigUint64(at + 8, true)), new Uint8Array(data, at + 24, size));
      at += 24 + size;
    }
    if (!this.whole) this.listener.grown();
  }

  private read_again(): void {
    this.whole = new Recording("live");
    this.whole.changes.push(...this.recording.changes);
    this.whole.incidents.push(...this.recording.incidents);
    this.topics.clear();
    this.describe();
    this.socket.send(JSON.stringify({ all: true, from: 0 }));
  }

  private finish(): void {
    this.finished = true;
    // What did not come whole is no better than what is there.
    if (this.whole && this.whole.last_tick >= this.recording.last_tick) this.listener.again(this.whole);
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify({ has_all: true }));
    this.listener.ended(this.outcome, this.missed);
  }
}
