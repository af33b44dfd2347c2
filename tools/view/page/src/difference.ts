// SPDX-License-Identifier: Apache-2.0
// The first field in which two recordings differ, as `clew diff` finds it: by tick, then topic, then
// the fields in the order of the IDL. Topics that only one recording has come last.

import type { Field, Value } from "./cdr_fields";
import type { Recording, Topic } from "./recording";

export interface Difference {
  topic: string;
  tick: number;
  field: string;
  a: Field | undefined;
  b: Field | undefined;
}

function same_bytes(a: Uint8Array, b: Uint8Array): boolean {
  if (a.length !== b.length) return false;
  for (let i = 0; i < a.length; i++) if (a[i] !== b[i]) return false;
  return true;
}

/// Numbers are the same if their bits are: 0 and -0 are not, one NaN and itself are.
function same_value(a: Value, b: Value): boolean {
  return typeof a === "number" && typeof b === "number" ? Object.is(a, b) : a === b;
}

function first_byte(a: Uint8Array, b: Uint8Array): [string, Field | undefined, Field | undefined] {
  let place = 0;
  while (place < a.length && place < b.length && a[place] === b[place]) place++;
  const path = `(byte ${place})`;
  const at = (bytes: Uint8Array): Field | undefined =>
    place < bytes.length ? { path, value: bytes[place] ?? 0 } : undefined;
  return [path, at(a), at(b)];
}

/// What of two samples with different bytes differs.
function explain(a: Topic, index_a: number, b: Topic, index_b: number): [string, Field | undefined, Field | undefined] {
  const bytes_a = a.sample(index_a);
  const bytes_b = b.sample(index_b);
  let fields_a: Field[];
  let fields_b: Map<string, Field>;
  try {
    fields_a = a.schema.fields(bytes_a);
    fields_b = new Map(b.schema.fields(bytes_b).map((field) => [field.path, field]));
  } catch {
    return first_byte(bytes_a, bytes_b);
  }
  for (const field of fields_a) {
    const other = fields_b.get(field.path);
    if (!other || !same_value(field.value, other.value)) return [field.path, field, other];
    fields_b.delete(field.path);
  }
  for (const field of fields_b.values()) return [field.path, undefined, field];
  return first_byte(bytes_a, bytes_b);
}

function missing(topic: string, tick: number, in_a: boolean): Difference {
  const present: Field = { path: "(sample)", value: "present", word: "present" };
  return { topic, tick, field: "(sample)", a: in_a ? present : undefined, b: in_a ? undefined : present };
}

/// The first sample of a topic that both have in which they part.
function first_of_topic(name: string, a: Topic, b: Topic, before: number): Difference | undefined {
  let i = 0;
  let j = 0;
  while (i < a.length || j < b.length) {
    const tick_a = a.ticks[i] ?? Infinity;
    const tick_b = b.ticks[j] ?? Infinity;
    const tick = Math.min(tick_a, tick_b);
    if (tick > before) return undefined;
    if (tick_a !== tick_b) return missing(name, tick, tick_a < tick_b);
    if (!same_bytes(a.sample(i), b.sample(j))) {
      const [field, in_a, in_b] = explain(a, i, b, j);
      return { topic: name, tick, field, a: in_a, b: in_b };
    }
    if (a.sequence(i) !== b.sequence(j)) {
      const of = (topic: Topic, at: number): Field => ({ path: "(sequence)", value: topic.sequence(at) });
      return { topic: name, tick, field: "(sequence)", a: of(a, i), b: of(b, j) };
    }
    i++;
    j++;
  }
  return undefined;
}

function sooner(found: Difference | undefined, other: Difference | undefined): Difference | undefined {
  if (!found || !other) return found ?? other;
  if (found.tick !== other.tick) return found.tick < other.tick ? found : other;
  return found.topic < other.topic ? found : other;
}

/// Nothing if all samples are the same.
export function first_difference(a: Recording, b: Recording): Difference | undefined {
  let found: Difference | undefined;
  let of_one: Difference | undefined;
  for (const name of [...new Set([...a.topics.keys(), ...b.topics.keys()])].sort()) {
    const in_a = a.topics.get(name);
    const in_b = b.topics.get(name);
    if (in_a && in_b) {
      found = sooner(found, first_of_topic(name, in_a, in_b, found?.tick ?? Infinity));
    } else {
      const first = (in_a ?? in_b)?.ticks[0];
      if (first !== undefined) of_one = sooner(of_one, missing(name, first, in_a !== undefined));
    }
  }
  return found ?? of_one;
}
