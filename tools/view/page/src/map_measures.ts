// SPDX-License-Identifier: Apache-2.0
// The scale of the map, and what somebody measures on it.

import { round_up } from "./map_layers";
import type { Scene } from "./map_layers";
import type { Point } from "./world";

/// How long a round number of metres is, in the corner below.
export function draw_scale({ g, view, theme: colours }: Scene, height: number): void {
  const length = round_up(60 / view.scale);
  const pixels = length * view.scale;
  g.strokeStyle = g.fillStyle = colours.text;
  g.lineWidth = 1.5;
  g.beginPath();
  g.moveTo(16, height - 22);
  g.lineTo(16, height - 16);
  g.lineTo(16 + pixels, height - 16);
  g.lineTo(16 + pixels, height - 22);
  g.stroke();
  g.font = "11px system-ui, sans-serif";
  g.textAlign = "left";
  g.textBaseline = "middle";
  g.fillText(`${length} m`, 22 + pixels, height - 18);
}

/// What was measured: the way, its length and its direction.
export function draw_ruler({ g, view, theme: colours }: Scene, from: Point, to: Point): void {
  const [x1, y1] = view.at(...from);
  const [x2, y2] = view.at(...to);
  g.strokeStyle = colours.text;
  g.lineWidth = 1.5;
  g.beginPath();
  g.moveTo(x1, y1);
  g.lineTo(x2, y2);
  g.stroke();
  const dx = to[0] - from[0];
  const dy = to[1] - from[1];
  const text = `${Math.hypot(dx, dy).toFixed(3)} m, ${(Math.atan2(dy, dx) * 180 / Math.PI).toFixed(1)}°`;
  g.font = "600 12px system-ui, sans-serif";
  const width = g.measureText(text).width;
  g.fillStyle = colours.ground;
  // Beside the line, so that neither it nor the cross at its end lies on the text.
  const [x, y] = [(x1 + x2) / 2 + (Math.abs(y2 - y1) > Math.abs(x2 - x1) ? 12 : -width / 2), (y1 + y2) / 2 - 24];
  g.fillRect(x - 4, y - 9, width + 8, 18);
  g.fillStyle = colours.text;
  g.textAlign = "left";
  g.textBaseline = "middle";
  g.fillText(text, x, y);
}
