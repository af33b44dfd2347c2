// SPDX-License-Identifier: Apache-2.0
// A recorded run in memory: samples by topic, as bytes, and what the run was made of. It may grow,
// while a file is read or a run goes on.

import { McapStreamReader } from "@mcap/core";
import type { McapTypes } from "@mcap/core";
import { decompress as decompress_zstd } from "fzstd";
import { decompress as decompress_lz4 } from "lz4js";

import { Schema } from "./cdr_fields";

/// One topic's samples, in one growing buffer.
export class Topic {
  readonly ticks: number[] = [];
  private readonly sequences: number[] = [];
  private readonly starts: number[] = [0];
  private bytes = new Uint8Array(1 << 16);

  /// `complain` hears of samples that are no message of the topic's type.
  constructor(readonly name: string, readonly schema: Schema, private readonly complain: (text: string) => void = () => undefined) {}

  get length(): number {
    return this.ticks.length;
  }

  add(tick: number, sequence: number, cdr: Uint8Array): void {
    const start = this.starts[this.ticks.length] ?? 0;
    if (start + cdr.length > this.bytes.length) {
      const larger = new Uint8Array(Math.max(2 * this.bytes.length, start + cdr.length));
      larger.set(this.bytes);
      this.bytes = larger;
    }
    this.bytes.set(cdr, start);
    this.ticks.push(tick);
    this.sequences.push(sequence);
    this.starts.push(start + cdr.length);
  }

  sample(index: number): Uint8Array {
    return this.bytes.subarray(this.starts[index], this.starts[index + 1]);
  }

  sequence(index: number): number {
    return this.sequences[index] ?? -1;
  }

  /// The index of the sample of `tick`; -1 if there is none.
  index_at(tick: number): number {
    // Ticks without a gap, which is the rule, need no search.
    const guess = tick - (this.ticks[0] ?? 0);
    if (this.ticks[guess] === tick) return guess;
    let low = 0;
    let high = this.ticks.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((this.ticks[middle] ?? 0) < tick) low = middle + 1;
      else high = middle;
    }
    return this.ticks[low] === tick ? low : -1;
  }

  message_at(tick: number): Record<string, unknown> | undefined {
    const index = this.index_at(tick);
    return index < 0 ? undefined : this.message(index);
  }

  /// Nothing where the bytes are no message of the topic's type.
  message(index: number): Record<string, unknown> | undefined {
    try {
      return this.schema.message(this.sample(index));
    } catch {
      this.complain(`topic '${this.name}' at tick ${this.ticks[index] ?? 0} is no message of its type: it is left out`);
      return undefined;
    }
  }

  number_at(tick: number, path: string): number {
    const index = this.index_at(tick);
    return index < 0 ? NaN : this.schema.number(this.sample(index), path);
  }
}

/// What somebody changed in the run while it went on, or ordered: `pause`, `pace`.
export interface Change {
  tick: number;
  changes: string[];
  order: string;
}
/// What befell the run.
export interface Incident {
  tick: number;
  kind: string;
  stage: string;
  text: string;
}

/// More kinds of complaints than these nobody reads.
const kMostComplaints = 12;
let on_complaint: () => void = () => undefined;

/// Who is told when a recording has something more to complain of.
export function tell_complaints_to(listener: () => void): void {
  on_complaint = listener;
}

export class Recording {
  readonly topics = new Map<string, Topic>();
  readonly bundle = new Map<string, string>();
  readonly changes: Change[] = [];
  readonly incidents: Incident[] = [];
  tick_s = 0.1;
  seed = "";
  /// What its recorder wrote at the end; nothing of one that was cut off or is not read yet.
  end: { hash: string; ticks: number; lost: number; aborted: string } | undefined;
  /// What of it cannot be read, and is left out: the first of each kind.
  private readonly first_complaints = new Map<string, string>();

  constructor(public name: string) {}

  add_topic(name: string, type: string, text: string): Topic {
    const known = this.topics.get(name);
    if (known) return known;
    const topic = new Topic(name, new Schema(type, text), (what) => this.complain(`topic ${name}`, what));
    this.topics.set(name, topic);
    return topic;
  }

  topic(name: string): Topic | undefined {
    return this.topics.get(name);
  }

  /// Of a kind the first complaint stays: what follows may come of it.
  complain(kind: string, text: string): void {
    if (this.first_complaints.has(kind) || this.first_complaints.size >= kMostComplaints) return;
    this.first_complaints.set(kind, text);
    on_complaint();
  }
  /// By order of time; none if all of it can be read.
  get complaints(): string[] {
    return [...this.first_complaints.values()];
  }

  /// Takes what a file says, as far as it is what we know.
  add_change(tick: number, said: unknown): void {
    const { changes, order } = (said ?? {}) as Partial<Record<keyof Change, unknown>>;
    this.changes.push({
      tick, changes: Array.isArray(changes) ? changes.map(String) : [], order: typeof order === "string" ? order : "",
    });
  }
  add_incident(tick: number, said: unknown): void {
    const { kind, stage, text } = (said ?? {}) as Partial<Incident>;
    this.incidents.push({ tick, kind: String(kind), stage: String(stage), text: String(text) });
  }

  get first_tick(): number {
    const firsts = [...this.topics.values()].filter((topic) => topic.length > 0).map((topic) => topic.ticks[0] ?? 0);
    return firsts.length === 0 ? 0 : Math.min(...firsts);
  }

  get last_tick(): number {
    let last = 0;
    for (const topic of this.topics.values()) last = Math.max(last, topic.ticks[topic.length - 1] ?? 0);
    return last;
  }
}

const kText = new TextDecoder();
const kChanges = "clew/interventions";
const kIncidents = "clew/incidents";

/// Takes the bytes of an MCAP file, in pieces of any size, into a recording.
export class McapFeed {
  private readonly reader = new McapStreamReader({
    validateCrcs: true,
    decompressHandlers: {
      zstd: (data) => decompress_zstd(data),
      lz4: (data, size) => Uint8Array.from(decompress_lz4(data, Number(size))),
    },
  });
  private readonly schemas = new Map<number, McapTypes.Schema>();
  private readonly channels = new Map<number, Topic>();
  /// Channels of what is no sample.
  private readonly sides = new Map<number, string>();

  constructor(private readonly recording: Recording) {}

  /// Throws where a changed byte or a foreign file is found; what came before it stays.
  append(bytes: Uint8Array): void {
    this.reader.append(bytes);
    for (let record = this.reader.nextRecord(); record; record = this.reader.nextRecord()) this.take(record);
  }

  private take(record: McapTypes.TypedMcapRecord): void {
    switch (record.type) {
      case "Message": {
        const tick = Math.round(Number(record.logTime) / 1e9 / this.recording.tick_s);
        this.channels.get(record.channelId)?.add(tick, record.sequence, record.data);
        this.take_side(record.channelId, tick, record.data);
        break;
      }
      case "Schema":
        this.schemas.set(record.id, { ...record, data: record.data.slice() });
        break;
      case "Channel":
        this.take_channel(record);
        break;
      case "Metadata":
        this.take_metadata(record);
        break;
      case "Attachment":
        if (record.mediaType === "application/yaml") this.recording.bundle.set(record.name, kText.decode(record.data));
        break;
    }
  }

  private take_side(channel: number, tick: number, data: Uint8Array): void {
    const side = this.sides.get(channel);
    if (side === undefined) return;
    const said = this.read_json(side, tick, data);
    if (said === undefined) return;
    if (side === kChanges) this.recording.add_change(tick, said);
    else this.recording.add_incident(tick, said);
  }

  private read_json(side: string, tick: number, data: Uint8Array): unknown {
    try {
      return JSON.parse(kText.decode(data));
    } catch {
      this.recording.complain(side, `${side} at tick ${tick} is no JSON: what it says is left out`);
      return undefined;
    }
  }

  private take_channel(channel: McapTypes.Channel): void {
    if (channel.topic === kChanges || channel.topic === kIncidents) this.sides.set(channel.id, channel.topic);
    const schema = this.schemas.get(channel.schemaId);
    if (this.channels.has(channel.id) || schema?.encoding !== "omgidl") return;
    const name = channel.topic.replace(/^\//, "");
    try {
      this.channels.set(channel.id, this.recording.add_topic(name, schema.name, kText.decode(schema.data)));
    } catch (error) {
      const why = String(error instanceof Error ? error.message : error).split("\n")[0] ?? "";
      this.recording.complain(`schema ${name}`, `the schema of topic '${name}' cannot be read (${why}): the topic is left out`);
    }
  }

  private take_metadata(record: McapTypes.Metadata): void {
    const value = (key: string): string => record.metadata.get(key) ?? "";
    if (record.name === "clew") {
      this.recording.tick_s = Number(value("tick_s")) || this.recording.tick_s;
      this.recording.seed = value("seed");
    } else if (record.name === "clew_end" && value("continues") !== "true") {
      this.recording.end = {
        hash: value("hash"), ticks: Number(value("ticks")), lost: Number(value("lost_samples")),
        aborted: value("aborted"),
      };
    }
  }
}
