# SPDX-License-Identifier: Apache-2.0
"""Worlds: from files, or from polygons."""
import pathlib

from . import _clew


def _numbers(values):
    return "[" + ", ".join(repr(float(value)) for value in values) + "]"


def _lists(lists):
    return "[" + ", ".join(_numbers(values) for values in lists) + "]"


class World:
    """A world, checked: a name or a path, or with World.build from shapes."""

    def __init__(self, path=None, *, text=None):
        if text is None:
            file, text = _clew.find_file("worlds", str(path))
        else:
            file = "world"
        self.text = text
        facts = _clew.world(text, file)
        self.name = facts["name"]
        self.start = facts["start"]
        self.target = facts["target"]
        self.target_radius_m = facts["target_radius_m"]
        self.bounds = facts["bounds"]
        self.shortest_path_m = facts["shortest_path_m"]

    @classmethod
    def build(cls, name, *, bounds, start, target, target_radius_m=0.2, walls=(), polygons=(),
              circles=()):
        """Makes one.

        bounds     (x_min, y_min, x_max, y_max), a closed wall
        start      (x, y, heading)
        walls      [(x1, y1, x2, y2), ...]
        polygons   [[(x, y), ...], ...], filled
        circles    [(x, y, radius), ...], filled
        """
        lines = ["format: clew-world/1", f"name: {name}", f"bounds: {_numbers(bounds)}",
                 f"walls: {_lists(walls)}",
                 "polygons: [" + ", ".join(_lists(polygon) for polygon in polygons) + "]",
                 f"circles: {_lists(circles)}", f"start: {_numbers(start)}",
                 f"target: {_numbers(target)}", f"target_radius: {float(target_radius_m)!r}"]
        return cls(text="\n".join(lines) + "\n")

    def save(self, path):
        """Writes the world file."""
        pathlib.Path(path).write_text(self.text, encoding="utf-8")


def worlds():
    """The names of the worlds that there are."""
    return _clew.names("worlds")
