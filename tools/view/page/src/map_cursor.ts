// SPDX-License-Identifier: Apache-2.0
// A cross on the map in place of the mouse: arrow keys move it, Enter presses and lets go.

import type { Theme } from "./theme";

/// Pixels a key press; with shift.
const kStep = 8;
const kLongStep = 40;
const kArm = 9;
const kWays: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/// What is done where the cross is, in pixels of the canvas.
export interface Pointing {
  /// Whether a place is wanted at all.
  wanted(): boolean;
  /// Whether what is pressed is moved until it is let go.
  drags(): boolean;
  down(x: number, y: number): void;
  move(x: number, y: number): void;
  up(): void;
}

export class MapCursor {
  private at: { x: number; y: number } | undefined;
  private pressed = false;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly pointing: Pointing, private readonly redraw: () => void) {
    canvas.addEventListener("keydown", (event) => this.key(event));
    canvas.addEventListener("pointermove", () => this.leave());
    canvas.addEventListener("blur", () => this.leave());
  }

  /// Somebody is to choose a place: the keys go to the map.
  begin(): void {
    this.canvas.focus({ preventScroll: true });
  }

  draw(g: CanvasRenderingContext2D, colours: Theme): void {
    if (!this.at || !this.pointing.wanted()) return;
    const { x, y } = this.at;
    for (const [width, colour] of [[4, colours.ground], [1.6, colours.text]] as const) {
      g.lineWidth = width;
      g.strokeStyle = colour;
      g.setLineDash([]);
      g.beginPath();
      g.moveTo(x - kArm, y);
      g.lineTo(x + kArm, y);
      g.moveTo(x, y - kArm);
      g.lineTo(x, y + kArm);
      if (this.pressed) g.rect(x - 4, y - 4, 8, 8);
      g.stroke();
    }
  }

  private key(event: KeyboardEvent): void {
    if (!this.pointing.wanted() || event.ctrlKey || event.metaKey || event.altKey) return;
    const way = kWays[event.key];
    if (!way && event.key !== "Enter") return;
    event.preventDefault();
    event.stopPropagation();
    const at = this.at ?? { x: this.canvas.clientWidth / 2, y: this.canvas.clientHeight / 2 };
    this.at = at;
    if (way) this.step(at, way, event.shiftKey ? kLongStep : kStep);
    else this.press(at);
    this.redraw();
  }

  private step(at: { x: number; y: number }, [right, down]: [number, number], length: number): void {
    at.x = Math.max(0, Math.min(this.canvas.clientWidth, at.x + right * length));
    at.y = Math.max(0, Math.min(this.canvas.clientHeight, at.y + down * length));
    this.pointing.move(at.x, at.y);
  }

  private press(at: { x: number; y: number }): void {
    if (this.pressed) {
      this.pressed = false;
      this.pointing.up();
      return;
    }
    // What is pressed may end what was wanted.
    this.pressed = this.pointing.drags();
    this.pointing.down(at.x, at.y);
    if (!this.pressed) this.pointing.up();
  }

  private leave(): void {
    if (!this.at) return;
    if (this.pressed) this.pointing.up();
    this.at = undefined;
    this.pressed = false;
    this.redraw();
  }
}
