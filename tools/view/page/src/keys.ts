// SPDX-License-Identifier: Apache-2.0
// The keyboard: everything on the page is within its reach.

import { by_id, element } from "./elements";

export interface Key {
  keys: string[];
  shown: string;
  what: string;
  act: (event: KeyboardEvent) => void;
}

export function listen_to_keys(keys: Key[]): void {
  const dialog = by_id<HTMLDialogElement>("keys");
  const list = element("dl");
  for (const key of keys) list.append(element("dt", {}, element("kbd", {}, key.shown)), element("dd", {}, key.what));
  const close = element("button", { type: "button" }, "Close");
  close.addEventListener("click", () => dialog.close());
  dialog.append(element("h2", {}, "Keys"), list, close);
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || dialog.open) return;
    const target = event.target as HTMLElement;
    // In a field keys are letters, and a button or a list takes what it knows.
    if (target.matches("input:not([type=range]):not([type=checkbox]), select, textarea")) return;
    if (event.key === " " && target.matches("button, summary, input")) return;
    const key = keys.find((each) => each.keys.includes(event.key));
    if (!key) return;
    event.preventDefault();
    key.act(event);
  });
}
