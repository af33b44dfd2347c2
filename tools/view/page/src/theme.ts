// SPDX-License-Identifier: Apache-2.0
// Colours and marks. Runs differ by colour and by dashes, events by shape, so that a grey picture
// tells the same. Colours: Okabe & Ito 2008, lighter where the ground is dark.

import type { EventKind } from "./run";

export interface Theme {
  dark: boolean;
  ground: string;
  field: string;
  grid: string;
  wall: string;
  solid: string;
  moving: string;
  text: string;
  faint: string;
  accent: string;
  target: string;
  scan: string;
  trap: string;
  runs: string[];
  /// Of layers of one kind.
  layers: string[];
}

const kLight: Theme = {
  dark: false, ground: "#f4f5f7", field: "#ffffff", grid: "#e6e8ec", wall: "#23272f", solid: "#c9cdd4",
  moving: "#8a9099", text: "#1c2026", faint: "#6b7280", accent: "#0072b2", target: "#007f5c",
  scan: "#e69f00", trap: "#c8102e",
  runs: ["#0072b2", "#d55e00", "#007f5c", "#a2497f", "#b07a00", "#444444"],
  layers: ["#d55e00", "#6a3d9a", "#007f5c", "#0072b2", "#a2497f"],
};
const kDark: Theme = {
  dark: true, ground: "#14171c", field: "#1b1f26", grid: "#2a2f38", wall: "#e3e6eb", solid: "#4a515d",
  moving: "#7e8794", text: "#e7eaf0", faint: "#98a1af", accent: "#56b4e9", target: "#2fbf95",
  scan: "#f0c04a", trap: "#ff6b6b",
  runs: ["#56b4e9", "#ff8a3c", "#2fbf95", "#e39ac4", "#e6b422", "#cccccc"],
  layers: ["#ff8a3c", "#b79bff", "#2fbf95", "#56b4e9", "#e39ac4"],
};
export const kDashes: number[][] = [[], [8, 4], [2, 3], [10, 3, 2, 3], [5, 2], [1, 5]];

export function run_colour(theme: Theme, index: number): string {
  return theme.runs[index % theme.runs.length] ?? theme.accent;
}
export function run_dash(index: number): number[] {
  return kDashes[index % kDashes.length] ?? [];
}

let chosen: "light" | "dark" | undefined;

export function theme(): Theme {
  const dark = chosen ? chosen === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  return dark ? kDark : kLight;
}
export function toggle_theme(): void {
  chosen = theme().dark ? "light" : "dark";
  document.documentElement.dataset["theme"] = chosen;
}

export const kKindNames: Record<EventKind, string> = {
  landmark: "landmark recognised", reflex: "reflex of immediate memory", trap: "trap",
  escape_begun: "escape begun", escape_ended: "escape ended", escape_failed: "escape failed",
  virtual_target: "virtual target set", unreachable: "unreachable", collision: "collision",
  hit: "hit by an obstacle", safety_stop: "safety stop", late: "late command", end: "end of the run",
  waypoint: "way-point reached", change: "changed", incident: "incident", restart: "restarted",
};

/// A mark of about `size` pixels in radius; hollow for a detector that only watches.
export function draw_mark(g: CanvasRenderingContext2D, kind: EventKind, x: number, y: number, size: number,
  colour: string, ground: string, hollow = false): void {
  const s = size;
  g.save();
  g.translate(x, y);
  g.lineWidth = 1.6;
  g.strokeStyle = colour;
  g.fillStyle = hollow ? ground : colour;
  g.setLineDash([]);
  g.beginPath();
  switch (kind) {
    case "trap":  // a warning triangle
      polygon(g, [[0, -s * 1.25], [s * 1.15, s * 0.85], [-s * 1.15, s * 0.85]]);
      break;
    case "escape_begun":
      polygon(g, [[-s * 0.7, -s], [s, 0], [-s * 0.7, s]]);
      break;
    case "escape_ended":
      polygon(g, [[-s, -s], [s, -s], [s, s], [-s, s]].map(([a, b]) => [0.8 * (a ?? 0), 0.8 * (b ?? 0)]));
      break;
    case "virtual_target":
      star(g, s * 1.2);
      break;
    case "reflex":
      polygon(g, [[0, -s], [s, 0], [0, s], [-s, 0]]);
      break;
    case "landmark":
      g.arc(0, 0, s * 0.62, 0, 2 * Math.PI);
      g.fillStyle = ground;
      break;
    case "end":
      polygon(g, [[-s * 0.7, s * 1.2], [-s * 0.7, -s * 1.2], [s, -s * 0.5], [-s * 0.7, 0.1 * s]]);
      break;
    case "late":
      g.arc(0, 0, s * 0.9, 0, 2 * Math.PI);
      g.moveTo(0, -s * 0.6);
      g.lineTo(0, 0);
      g.lineTo(s * 0.5, 0);
      g.fillStyle = ground;
      break;
    case "waypoint":  // a ring with its centre
      g.arc(0, 0, s * 0.95, 0, 2 * Math.PI);
      g.moveTo(s * 0.3, 0);
      g.arc(0, 0, s * 0.3, 0, 2 * Math.PI);
      g.fillStyle = ground;
      break;
    case "change":  // put in from above
      polygon(g, [[0, s], [s * 0.9, -s * 0.2], [s * 0.35, -s * 0.2], [s * 0.35, -s], [-s * 0.35, -s], [-s * 0.35, -s * 0.2],
        [-s * 0.9, -s * 0.2]]);
      break;
    case "incident":  // an exclamation mark
      g.rect(-s * 0.2, -s, s * 0.4, s * 1.1);
      g.rect(-s * 0.2, s * 0.6, s * 0.4, s * 0.4);
      break;
    case "restart":  // an arrow that goes round
      g.arc(0, 0, s * 0.75, -0.3, 1.45 * Math.PI);
      g.moveTo(s * 0.1, -s * 1.2);
      g.lineTo(s * 0.1, -s * 0.3);
      g.moveTo(s * 0.1, -s * 1.2);
      g.lineTo(s * 0.75, -s * 0.8);
      g.lineTo(s * 0.1, -s * 0.3);
      g.fillStyle = "transparent";
      break;
    case "safety_stop":
      polygon(g, Array.from({ length: 8 }, (_, i) => {
        const angle = (i + 0.5) * Math.PI / 4;
        return [s * Math.cos(angle), s * Math.sin(angle)];
      }));
      break;
    default:  // a cross
      g.moveTo(-s * 0.8, -s * 0.8);
      g.lineTo(s * 0.8, s * 0.8);
      g.moveTo(s * 0.8, -s * 0.8);
      g.lineTo(-s * 0.8, s * 0.8);
  }
  g.fill();
  g.stroke();
  if (kind === "trap") draw_exclamation(g, s, hollow ? colour : ground);
  g.restore();
}

/// Without colour, too, a trap differs from what lies at the same tick.
function draw_exclamation(g: CanvasRenderingContext2D, s: number, colour: string): void {
  g.fillStyle = colour;
  g.fillRect(-s * 0.14, -s * 0.5, s * 0.28, s * 0.7);
  g.fillRect(-s * 0.14, s * 0.35, s * 0.28, s * 0.28);
}

function polygon(g: CanvasRenderingContext2D, points: (number[] | undefined)[]): void {
  points.forEach((point, i) => {
    const [x, y] = point ?? [0, 0];
    if (i === 0) g.moveTo(x ?? 0, y ?? 0);
    else g.lineTo(x ?? 0, y ?? 0);
  });
  g.closePath();
}

function star(g: CanvasRenderingContext2D, size: number): void {
  polygon(g, Array.from({ length: 10 }, (_, i) => {
    const radius = i % 2 === 0 ? size : 0.45 * size;
    const angle = -Math.PI / 2 + i * Math.PI / 5;
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  }));
}
