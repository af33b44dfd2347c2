#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A control component in Python, without DDS: turn toward the target, step as far as is free.

For every tick Clew writes one line of JSON with the inputs to its standard input, and reads one
line with the outputs from its standard output.
"""
import json
import math
import sys

STEP_M = 0.1
MAX_TURN_RAD = 0.16
MARGIN_M = 0.02


def clamp(value, low, high):
    return max(low, min(high, value))


def decide(odometry, scan, guidance):
    """What the robot shall do in this tick; a motion that recover asks for goes before our own."""
    if guidance["has_override"]:
        return guidance["override_motion"]
    pose = odometry["pose_odom_robot"]
    bearing = math.atan2(guidance["target_y_m"] - pose["y_m"], guidance["target_x_m"] - pose["x_m"])
    turn = clamp(math.remainder(bearing - pose["heading_rad"], math.tau), -MAX_TURN_RAD,
                 MAX_TURN_RAD)
    beams = [scan["bearing_first_rad"] + i * scan["bearing_step_rad"]
             for i in range(len(scan["ranges_m"]))]
    clear = min([scan["range_max_m"]] +
                [range_m for beam, range_m in zip(beams, scan["ranges_m"])
                 if abs(beam - turn) <= scan["beam_width_rad"] * 1.5])
    return {"kind": "COMMAND_TURN_AND_STEP", "turn_rad": turn,
            "step_m": clamp(clear - MARGIN_M, 0.0, STEP_M)}


for line in sys.stdin:
    tick = json.loads(line)
    motion = decide(tick["odometry"], tick["scan"], tick["guidance"])
    print(json.dumps({"tick": tick["tick"], "command": {"motion": motion}}), flush=True)
