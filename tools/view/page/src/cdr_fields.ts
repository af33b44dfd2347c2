// SPDX-License-Identifier: Apache-2.0
// Fields of serialised messages by their schema: all of them in the order of the IDL, named as
// `clew diff` and `clew echo` name them, and single ones straight from the bytes.

import { parseIDL } from "@foxglove/omgidl-parser";
import type { IDLMessageDefinition, IDLMessageDefinitionField as ParsedField } from "@foxglove/omgidl-parser";
import { MessageReader } from "@foxglove/omgidl-serialization";

/// The parser names an enumeration's type, which its own declarations leave out.
type IDLMessageDefinitionField = ParsedField & { enumType?: string };

export type Value = boolean | number | bigint | string;

/// A leaf of a message: `pose_world_robot.x_m`, `ranges_m[3]`, `entries.length`.
export interface Field {
  path: string;
  value: Value;
  /// The enumerator's name, where the value is one.
  word?: string;
}

const kSizes: Record<string, number> = {
  bool: 1, int8: 1, uint8: 1, int16: 2, uint16: 2, int32: 4, uint32: 4, float32: 4,
  int64: 8, uint64: 8, float64: 8,
};

/// Where a number lies in every sample of a topic.
interface Place {
  offset: number;
  type: string;
}

/// Reads one topic's samples with the schema that the recording carries.
export class Schema {
  private readonly definitions = new Map<string, IDLMessageDefinition>();
  private readonly enumerators = new Map<string, Map<number, string>>();
  private readonly reader: MessageReader;
  private readonly places = new Map<string, Place>();
  /// The first list of a sample, if it is one of doubles: where its length is.
  private first_list: { path: string; offset: number } | undefined;

  constructor(readonly type: string, readonly text: string) {
    const parsed = parseIDL(text);
    for (const definition of parsed) this.definitions.set(definition.name ?? "", definition);
    this.reader = new MessageReader(type, parsed);
    for (const [name, definition] of this.definitions) {
      if (definition.aggregatedKind !== "module") continue;
      const words = new Map<number, string>();
      for (const constant of definition.definitions) words.set(Number(constant.value), constant.name);
      this.enumerators.set(name, words);
    }
    this.find_places(type, "", 0);
  }

  /// Throws where the bytes are no message of the type.
  message(bytes: Uint8Array): Record<string, unknown> {
    return this.reader.readMessage<Record<string, unknown>>(bytes);
  }

  /// All leaves of a sample.
  fields(bytes: Uint8Array): Field[] {
    const found: Field[] = [];
    this.list_struct(this.type, this.message(bytes), "", found);
    return found;
  }

  /// The number at `path`, or NaN where this sample has none, or is no message of the type.
  number(bytes: Uint8Array, path: string): number {
    const place = this.places.get(path);
    if (place) return read_number(bytes, place);
    let value: unknown;
    try {
      value = this.message(bytes);
    } catch {
      return NaN;
    }
    for (const part of path.split(/[.[\]]+/).filter((word) => word !== "")) {
      if (value == null) return NaN;
      value = (value as Record<string, unknown>)[part];
    }
    return typeof value === "object" || value === undefined ? NaN : Number(value);
  }

  /// The doubles of a list, without those of the rest of the sample; nothing where they are not there.
  doubles(bytes: Uint8Array, path: string): Float64Array | undefined {
    const list = this.first_list;
    if (list?.path !== path) return undefined;
    const length = read_number(bytes, { offset: list.offset, type: "uint32" });
    const begin = 4 + Math.ceil(list.offset / 8) * 8;
    if (Number.isNaN(length) || begin + 8 * length > bytes.length) return undefined;
    return new Float64Array(bytes.slice(begin, begin + 8 * length).buffer);
  }

  // The leaves in front of the first string or list lie at the same place in every sample.
  private find_places(type: string, prefix: string, start: number): number {
    const definition = this.definitions.get(type);
    if (!definition || definition.aggregatedKind !== "struct") return NaN;
    let offset = start;
    for (const field of definition.definitions) {
      const path = prefix + field.name;
      if (field.isArray === true || field.arrayLengths) {
        // A head of four bytes lies before what is aligned.
        if (!field.arrayLengths && field.type === "float64") this.first_list = { path, offset: 4 + Math.ceil(offset / 4) * 4 };
        return NaN;
      }
      if (field.isComplex === true) {
        offset = this.find_places(field.type, `${path}.`, offset);
        if (Number.isNaN(offset)) return NaN;
        continue;
      }
      const size = kSizes[field.type];
      if (size === undefined) return NaN;
      offset = Math.ceil(offset / size) * size;
      this.places.set(path, { offset: offset + 4, type: field.type });
      offset += size;
    }
    return offset;
  }

  private list_struct(type: string, message: Record<string, unknown>, prefix: string, found: Field[]): void {
    const definition = this.definitions.get(type);
    if (!definition || definition.aggregatedKind !== "struct") return;
    for (const field of definition.definitions) {
      this.list_member(field, message[field.name], prefix + field.name, found);
    }
  }

  private list_member(field: IDLMessageDefinitionField, value: unknown, path: string, found: Field[]): void {
    if (field.isArray !== true && !field.arrayLengths) {
      this.list_value(field, value, path, found);
      return;
    }
    const items = value as ArrayLike<unknown>;
    if (!field.arrayLengths) found.push({ path: `${path}.length`, value: items.length });
    for (let i = 0; i < items.length; i++) this.list_value(field, items[i], `${path}[${i}]`, found);
  }

  private list_value(field: IDLMessageDefinitionField, value: unknown, path: string, found: Field[]): void {
    if (field.isComplex === true) {
      this.list_struct(field.type, value as Record<string, unknown>, `${path}.`, found);
      return;
    }
    const leaf: Field = { path, value: value as Value };
    const word = field.enumType == null ? undefined : this.enumerators.get(field.enumType)?.get(Number(value));
    if (word !== undefined) leaf.word = word;
    found.push(leaf);
  }
}

function read_number(bytes: Uint8Array, place: Place): number {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (place.offset + (kSizes[place.type] ?? 8) > bytes.byteLength) return NaN;
  switch (place.type) {
    case "float64": return view.getFloat64(place.offset, true);
    case "float32": return view.getFloat32(place.offset, true);
    case "uint64": return Number(view.getBigUint64(place.offset, true));
    case "int64": return Number(view.getBigInt64(place.offset, true));
    case "uint32": return view.getUint32(place.offset, true);
    case "int32": return view.getInt32(place.offset, true);
    case "uint16": return view.getUint16(place.offset, true);
    case "int16": return view.getInt16(place.offset, true);
    case "int8": return view.getInt8(place.offset);
    default: return view.getUint8(place.offset);
  }
}

/// As `clew diff` prints a value.
export function field_text(field: Field | undefined): string {
  if (!field) return "-";
  if (field.word !== undefined) return field.word;
  return typeof field.value === "string" ? JSON.stringify(field.value) : String(field.value);
}

/// The unit that a field's name ends with.
export function unit_of(path: string): string {
  const name = path.replace(/\[\d+\]$/, "").split(".").pop() ?? "";
  const units: [RegExp, string][] = [
    [/_radps$/, "rad/s"], [/_mps$/, "m/s"], [/_rad$/, "rad"], [/_ratio$/, ""], [/_hz$/, "Hz"],
    [/_s$/, "s"], [/_m$/, "m"],
  ];
  return units.find(([ending]) => ending.test(name))?.[1] ?? "";
}
