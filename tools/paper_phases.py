# SPDX-License-Identifier: Apache-2.0
"""The slow mover of Wang, Yang & Meng, wherever it is when the robot sets off: for paper-table.

With one start of the mover a robot may pass before or behind it and never meet it. So the mover
begins at eight places of its way, and a run counts as one that met it only if it differs from the
run in the room without it.
"""
import re

STATIC = "w-fig08-room-static"
WORLD = "w-fig09-slow-obstacle"
PHASES_S = range(0, 40, 5)
# The paper's robot has neither.
BARE = ["--set", "control.guard=false", "--set", "drive.safety=false"]
NUMBER = r"-?[\d.]+"
MOVER = re.compile(rf"circle: \[{NUMBER}, {NUMBER}, ({NUMBER})\], path: \[(.*?)\], loop: true", re.S)
WAYPOINT = re.compile(rf"\[({NUMBER}), ({NUMBER}), ({NUMBER})\]")


def place(path, time_s):
    """Where a mover is on its path of (time, x, y), which repeats."""
    time_s %= path[-1][0]
    for (t0, x0, y0), (t1, x1, y1) in zip(path, path[1:]):
        if time_s <= t1:
            share = (time_s - t0) / (t1 - t0)
            return x0 + share * (x1 - x0), y0 + share * (y1 - y0)
    raise ValueError("a path begins at 0")


def shifted(text, by_s):
    """A world whose one mover is by_s seconds further on its way."""
    found = MOVER.search(text)
    path = [tuple(map(float, numbers)) for numbers in WAYPOINT.findall(f"{found.group(2)}]")]
    period_s = path[-1][0]
    times = sorted({0.0, period_s} | {(t - by_s) % period_s for t, _, _ in path[1:]})
    points = [(t, *place(path, t + by_s)) for t in times]
    words = ", ".join(f"[{t:g}, {x:.6g}, {y:.6g}]" for t, x, y in points)
    circle = f"circle: [{points[0][1]:.6g}, {points[0][2]:.6g}, {found.group(1)}]"
    return text.replace(found.group(0), f"{circle}, path: [{words}], loop: true")


HEADER = (f"| {len(PHASES_S)} starts of the slow mover | met | reached | runs with contact | "
          "safety stops | in the room without it |\n" + "|---" * 6 + "|")


def row(variant, still, reports):
    """A row of the table: the run without the mover, and those with it."""
    met = [report for report in reports if report["hash"] != still["hash"]]
    contact = sum(report["collisions"] + report["hit_by"] > 0 for report in reports)
    reached = sum(report["outcome"] == "reached" for report in reports)
    stops = sum(report["safety_stops"] for report in reports)
    alone = f"{still['outcome']} {still['path_length_m']:.1f} m, {still['safety_stops']} stops"
    return f"| {variant} | {len(met)} | {reached} | {contact} | {stops} | {alone} |"
