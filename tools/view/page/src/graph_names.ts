// SPDX-License-Identifier: Apache-2.0

/// The behaviours that a part of an expanded graph names: a word, a list, or a map from names to
/// parameters.
export function names_of(part: unknown): string {
  if (typeof part === "string") return part;
  if (Array.isArray(part)) return part.map(names_of).join(", ");
  return part && typeof part === "object" ? Object.keys(part).join(", ") : "";
}
