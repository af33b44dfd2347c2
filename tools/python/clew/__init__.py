# SPDX-License-Identifier: Apache-2.0
"""Clew in Python: runs, recordings, and behaviours for trials.

    import clew
    run = clew.run("default", world="double-u", parameters={"sense.noise_stddev_m": 0.01}, seed=7)
    print(run.outcome, run.path_length_m, run.hash)

A run happens in this process and thread. It gives the same samples, and so the same hash, as
`clew run` does with any layout.
"""
import pathlib as _pathlib

from . import _clew
from ._behaviours import (classifier, controller, detector, drive, escape, number, planner, sensor,
                          whole_number, word)
from ._clew import (InputError, Motion, give_up, stop, turn_and_step, velocities, wheel_speeds)
from ._recordings import Fields, Recording, diff
from ._worlds import World, worlds

__all__ = ["Fields", "InputError", "Motion", "Recording", "Run", "Simulation", "World", "branch",
           "classifier", "controller", "detector", "diff", "drive", "escape", "give_up", "graphs",
           "load_plugin", "number", "planner", "replay", "run", "sensor", "stop", "turn_and_step",
           "velocities", "wheel_speeds", "whole_number", "word", "worlds"]


def _choices(parts):
    """{"recover.escape": ["a", "b"]} as the command line has it."""
    return [f"{part}={chosen if isinstance(chosen, str) else ','.join(chosen)}"
            for part, chosen in (parts or {}).items()]


def _settings(parameters):
    """{"sense.range_m": 2.0} as the command line has it."""
    def text(value):
        if isinstance(value, bool):
            return "true" if value else "false"
        if isinstance(value, (list, tuple)):
            return f"[{', '.join(map(str, value))}]"
        return str(value)
    return [f"{path}={text(value)}" for path, value in (parameters or {}).items()]


def _request(graph, world, robot, parts, parameters, seed, max_ticks):
    text = ""
    if isinstance(world, World):
        world, text = world.name, world.text
    return _clew.RunRequest(graph=str(graph), world=None if world is None else str(world),
                            world_text=text, robot=None if robot is None else str(robot),
                            with_=_choices(parts), set=_settings(parameters), seed=seed,
                            max_ticks=max_ticks)


class Run:
    """How a run ended.

    outcome        reached, collided, unreachable, timeout or aborted
    trajectory     an array N x 3: x and y in metres, heading in radians, a row a tick
    hash           of all that was published; None if it was not wanted
    """

    def __init__(self, result):
        self.outcome = result.outcome
        self.ticks = result.ticks
        self.sim_time_s = result.sim_time_s
        self.path_length_m = result.path_length_m
        self.shortest_path_m = result.shortest_path_m
        self.collisions = result.collisions
        self.ticks_per_s = result.ticks_per_s
        self.hash = result.hash
        self.trajectory = result.trajectory

    def __repr__(self):
        return f"<clew.Run {self.outcome}: {self.ticks} ticks, {self.path_length_m:.2f} m>"


def run(graph, *, world=None, robot=None, parts=None, parameters=None, seed=1, max_ticks=20000,
        record=None, force=False, hash=True):  # pylint: disable=redefined-builtin
    """Runs a graph to its end and returns a Run.

    graph       a name or a path
    world       a name, a path or a World; None: the graph's
    parts       other behaviours: {"control": "reactive", "recover.escape": ["a", "b"]}
    parameters  other values: {"sense.range_m": 2.0}
    record      a file for a recording; `force` overwrites it
    """
    request = _request(graph, world, robot, parts, parameters, seed, max_ticks)
    return Run(_clew.run(request, "" if record is None else str(record), force, hash))


class Simulation:
    """A run that is stepped.

        sim = clew.Simulation("default")
        while sim.step():
            print(sim["state"]["pose_world_robot.x_m"], sim["scan"]["ranges_m"].min())
    """

    def __init__(self, graph, *, world=None, robot=None, parts=None, parameters=None, seed=1,
                 max_ticks=20000):
        self._sim = _clew.Simulation(
            _request(graph, world, robot, parts, parameters, seed, max_ticks))

    def step(self, ticks=1):
        """Steps so many ticks, or to the end of the run; tells whether the run goes on."""
        return self._sim.step(ticks)

    @property
    def over(self):
        """Whether the run has an outcome."""
        return self._sim.over

    @property
    def ticks(self):
        """How many ticks were stepped."""
        return self._sim.ticks

    @property
    def topics(self):
        """The topics of this run."""
        return self._sim.topics()

    def __getitem__(self, topic):
        """The last sample of a topic."""
        return Fields.of_sample(self._sim.fields(topic))

    def save(self):
        """The state between two ticks, as bytes for load() of an equal simulation."""
        return self._sim.save()

    def load(self, state):
        """Goes on from a saved state."""
        self._sim.load(state)


def replay(recording, component=None, *, parts=None, parameters=None):
    """Feeds each component, or one, what was recorded, and compares what it writes.

    Returns a list of dicts: component, ticks, identical, first_difference, ticks_per_s.
    """
    return _clew.replay(Recording.of(recording).file, component or "", _choices(parts),
                        _settings(parameters))


def branch(recording, tick, *, parts=None, parameters=None, max_ticks=None):
    """Goes on from a tick of a recording, with changes: what would have been? Returns a Run."""
    return Run(_clew.branch(Recording.of(recording).file, tick, _choices(parts),
                            _settings(parameters), max_ticks))


def load_plugin(name):
    """Loads a plug-in: a path with a slash, or a name that is looked up along CLEW_PATH."""
    _clew.load_plugin(str(name) if not isinstance(name, _pathlib.Path) else str(name.resolve()))


def graphs():
    """The names of the graphs that there are."""
    return _clew.names("graphs")
