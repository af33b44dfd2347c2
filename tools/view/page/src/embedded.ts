// SPDX-License-Identifier: Apache-2.0
// Files inside a page that needs no server.

import { decompress } from "fzstd";

/// They stand in it in zstd in base64.
export function embedded(): { name: string; bytes: Uint8Array }[] {
  return [...document.querySelectorAll<HTMLElement>("script[type='text/plain'][data-name]")].map((script) => {
    const text = (script.textContent ?? "").trim();
    const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const name = new TextDecoder().decode(Uint8Array.from(atob(script.dataset["name"] ?? ""), (c) => c.charCodeAt(0)));
    return { name, bytes: decompress(packed) };
  });
}
