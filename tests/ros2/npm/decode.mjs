// SPDX-License-Identifier: Apache-2.0
// Decodes lines `TYPE HEXADECIMAL` of standard input with the official definitions, to a line of
// JSON each. Infinite numbers are texts.
import { createInterface } from "node:readline";

import { readerOf } from "./official_types.mjs";

const readers = new Map();
function plain(key, value) {
  if (typeof value === "number" && !Number.isFinite(value)) return String(value);
  if (typeof value === "bigint") return Number(value);
  if (ArrayBuffer.isView(value)) {
    return Array.from(value, (item) => plain("", typeof item === "bigint" ? Number(item) : item));
  }
  return value;
}
for await (const line of createInterface({ input: process.stdin })) {
  const [type, bytes] = line.split(" ");
  if (!readers.has(type)) readers.set(type, readerOf(type));
  console.log(JSON.stringify(readers.get(type).readMessage(Buffer.from(bytes, "hex")), plain));
}
