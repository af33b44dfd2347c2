# SPDX-License-Identifier: Apache-2.0
"""Clew in Python, step by step. The tests run this file as it is:

    PYTHONPATH=build/python /usr/bin/python3 tools/python/tutorial/tutorial.py
"""
import numpy as np

import clew

# 1. Run a graph. It takes place in this process and gives the hash that `clew run` gives.
run = clew.run("default")
print(run, run.hash)

# 2. Change a world, a behaviour, a value.
run = clew.run("krishna_kalra", world="double-u", parts={"recover.detector": "position_revisit"},
               parameters={"sense.noise_stddev_m": 0.01}, seed=7)
print(run)

# 3. A world of your own: a wall of boxes with a gap.
world = clew.World.build(
    "gap", bounds=(0, 0, 8, 6), start=(1, 3, 0), target=(7, 3),
    polygons=[[(3.9, 0.1), (4.1, 0.1), (4.1, 3.5), (3.9, 3.5)],
              [(3.9, 4.7), (4.1, 4.7), (4.1, 5.9), (3.9, 5.9)]])
run = clew.run("default", world=world, record="tutorial.mcap", force=True)
print(run, "at most", run.trajectory[:, 1].max().round(2), "m up")

# 4. A recording is arrays: topic, then field.
recording = clew.Recording("tutorial.mcap")
nearest_m = recording["scan"]["ranges_m"].min(axis=1)
print("nearest return", nearest_m.min().round(3), "m, at tick", int(nearest_m.argmin()))
print(recording["state"].frame()[["pose_world_robot.x_m", "path_length_m"]].tail(2))

# 5. What would have been? Feed a component its recorded inputs, or go on from a tick.
for report in clew.replay(recording, parameters={"control.guard_margin_m": 0.05}):
    print(report["component"], "does the same" if report["identical"] else
          f"first differs at tick {report['first_difference']['tick']}")
print(clew.branch(recording, 10, parameters={"control.guard_margin_m": 0.05}))


# 6. A behaviour of your own. It lives in this process; `clew new` makes one for the command.
@clew.controller("swerve", "straight for the target, away from what is near",
                 near_m=clew.number(0.4, "m", 0.0, 5.0, "what is nearer pushes"))
class Swerve:
    """A first trial."""

    def __init__(self, setup, near_m):
        self.near_m = near_m

    def step(self, odometry, scan, target):
        """Turns away from what is near, else toward the target."""
        bearing_rad = odometry.pose.bearing_rad(*target)
        nearest = int(np.argmin(scan.ranges_m))
        if scan.ranges_m[nearest] < self.near_m:
            bearing_rad -= np.copysign(0.7, scan.bearings_rad[nearest])
        return clew.turn_and_step(float(bearing_rad), 0.08)


# 7. Step by step, to look at anything in between.
sim = clew.Simulation("reactive", world="open-field", parts={"control": "swerve"})
while sim.step(20):
    print("tick", sim.ticks, "x", round(sim["state"]["pose_world_robot.x_m"], 2))
