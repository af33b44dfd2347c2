# SPDX-License-Identifier: Apache-2.0
"""Behaviours written in Python, for trials. A class becomes a behaviour of a stage:

    @clew.detector("too_far", "the path is too long", limit_m=clew.number(30.0, "m", 0.1, 1000.0))
    class TooFar:
        def __init__(self, setup, limit_m):
            self.limit_m = limit_m

        def observe(self, situation):
            return "too far" if situation.odometry.travel_m > self.limit_m else None

    clew.run("krishna_kalra", parts={"recover.detector": "too_far"})

A run is as repeatable as its behaviours are. `self.__dict__` is the state that is saved; it must go
through pickle. They live in this process: `clew run` does not know them.
"""
from . import _clew


def number(default, unit, low, high, doc="a number"):
    """Declares a parameter."""
    return (float(default), unit, (float(low), float(high)), doc, [])


def whole_number(default, unit, low, high, doc="a whole number"):
    """Declares a parameter."""
    return (int(default), unit, (float(low), float(high)), doc, [])


def word(default, choices, doc="one of some words"):
    """Declares a parameter."""
    return (str(default), "", None, doc, list(choices))


def _decorator(kind, needed, adapt=None):
    def named(name, summary="", **parameters):
        def add(cls):
            missing = [method for method in needed if not callable(getattr(cls, method, None))]
            if missing:
                raise TypeError(f"a {kind} needs the method {missing[0]}()")
            if adapt is not None:
                adapt(cls)
            declared = [(key, *value) for key, value in parameters.items()]
            _clew.add_behaviour(kind, name, summary or (cls.__doc__ or name).splitlines()[0], cls,
                                declared)
            return cls
        return add
    named.__doc__ = (f"Makes a class a {kind} of that name. Its methods: {', '.join(needed)}. "
                     "It is made with (setup, **parameters).")
    return named


def _adapt_detector(cls):
    if not hasattr(cls, "start_afresh"):
        cls.start_afresh = lambda self: None


def _adapt_escape(cls):
    if not hasattr(cls, "begin"):
        cls.begin = lambda self, situation, text: None

    def step(self, situation):
        request = _clew.Request()
        return self.step(situation, request), request
    cls._step = step  # pylint: disable=protected-access


# observe(situation) returns None, or why this is a trap; start_afresh() is optional.
detector = _decorator("detector", ["observe"], _adapt_detector)
# step(situation, request) fills request (target, motion, obstacles, why) and returns "active",
# "ended", "failed", "unreachable" or "looks_again"; begin(situation, text) is optional.
escape = _decorator("escape", ["step"], _adapt_escape)
# step(odometry, scan, target) returns a clew.Motion.
controller = _decorator("controller", ["step"])
# step(odometry, scan) returns (spatial class 0..8, ticks that it has lasted).
classifier = _decorator("classifier", ["step"])
# step(odometry, target, target_radius_m, subgoals) returns (x_m, y_m, radius_m).
planner = _decorator("planner", ["step"])
# layout() returns (beams, first bearing, bearing step, beam width, range_max_m), in radians and
# metres; measure(world, pose, time_s, random) returns the ranges.
sensor = _decorator("sensor", ["layout", "measure"])
# tick_s(); limits() returns (speed, turn rate); legs(motion, speed, turn_rate) returns a list of
# (turn_rad, step_m, duration_s, bend_rad).
drive = _decorator("drive", ["tick_s", "limits", "legs"])
