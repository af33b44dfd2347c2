// SPDX-License-Identifier: Apache-2.0
// Making and finding elements. Texts are always texts: nothing here takes HTML.

type Children = (Node | string)[];

export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K, attributes: Record<string, string> = {}, ...children: Children): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

export function by_id<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no element ${id}`);
  return found as T;
}

export function button(text: string, title: string, on_click: () => void): HTMLButtonElement {
  const made = element("button", { type: "button", title }, text);
  made.addEventListener("click", on_click);
  return made;
}

/// Fits a canvas to its box at the screen's resolution; its size in CSS pixels.
export function fit_canvas(canvas: HTMLCanvasElement): { g: CanvasRenderingContext2D; width: number; height: number } {
  const scale = window.devicePixelRatio || 1;
  const width = canvas.clientWidth;
  const height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * scale)) canvas.width = Math.round(width * scale);
  if (canvas.height !== Math.round(height * scale)) canvas.height = Math.round(height * scale);
  const g = canvas.getContext("2d");
  if (!g) throw new Error("no 2D canvas");
  g.setTransform(scale, 0, 0, scale, 0, 0);
  return { g, width, height };
}

let on_trouble: (error: unknown) => void = console.error;

/// Who is told when something of a recording cannot be drawn.
export function tell_trouble_to(listener: (error: unknown) => void): void {
  on_trouble = listener;
}

/// Does it as far as it can be done: what a recording holds may be anything.
export function attempt(work: () => void): void {
  try {
    work();
  } catch (error) {
    on_trouble(error);
  }
}

/// At most once a frame.
export function once_a_frame(work: () => void): () => void {
  let waits = false;
  return () => {
    if (waits) return;
    waits = true;
    requestAnimationFrame(() => {
      waits = false;
      attempt(work);
    });
  };
}
