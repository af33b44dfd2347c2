// SPDX-License-Identifier: Apache-2.0
// Recordings inside a page that needs no server.

import { decompress } from "fzstd";

const kFiles = "script[type='text/plain']";
const bytes_of = (base64: string): Uint8Array => Uint8Array.from(atob(base64.trim()), (letter) => letter.charCodeAt(0));

export function has_embedded(): boolean {
  return document.querySelector(kFiles) !== null;
}

/// Their files stand in it in order, in zstd in base64; those of one that is split follow its first.
export function embedded(): { name: string; files: Uint8Array[] }[] {
  const found: { name: string; files: Uint8Array[] }[] = [];
  for (const script of document.querySelectorAll<HTMLElement>(kFiles)) {
    const name = script.dataset["name"];
    if (name !== undefined) found.push({ name: new TextDecoder().decode(bytes_of(name)), files: [] });
    found[found.length - 1]?.files.push(decompress(bytes_of(script.textContent ?? "")));
  }
  return found;
}
