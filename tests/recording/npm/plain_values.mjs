// SPDX-License-Identifier: Apache-2.0
// Values as JSON can hold them: what both sides of a comparison are turned into.

/** 64-bit integers become text, typed arrays become arrays, maps become objects. */
export function plain(value) {
  if (typeof value === "bigint") return value.toString();
  if (ArrayBuffer.isView(value)) return Array.from(value, plain);
  if (Array.isArray(value)) return value.map(plain);
  if (value instanceof Map) return plain(Object.fromEntries(value));
  if (value !== null && typeof value === "object") {
    return Object.fromEntries(Object.entries(value).map(([key, item]) => [key, plain(item)]));
  }
  return value;
}

export function hex(bytes) {
  return Buffer.from(bytes).toString("hex");
}
