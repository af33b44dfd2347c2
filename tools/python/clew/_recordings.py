# SPDX-License-Identifier: Apache-2.0
"""Recordings as arrays."""
import re

import numpy as np

from . import _clew


class Fields:
    """The fields of a topic: fields["pose_world_robot.x_m"], fields["ranges_m"], fields["stamp"].

    Of a recording, the first axis of an array is the tick's. A list is a further axis, as long as
    the longest list; what a shorter one lacks is NaN. A struct is Fields again.
    """

    def __init__(self, columns):
        self._columns = columns

    @classmethod
    def of_sample(cls, fields):
        """Those of one sample."""
        return cls(dict(fields))

    def keys(self):
        """The names of the fields: `ranges_m`, not `ranges_m[3]`."""
        return list(dict.fromkeys(re.match(r"[^.\[]+", path).group() for path in self._columns))

    def __iter__(self):
        return iter(self.keys())

    def __getitem__(self, path):
        if path in self._columns:
            return self._columns[path]
        inside = {name[len(path):]: column for name, column in self._columns.items()
                  if name.startswith((path + ".", path + "["))}
        length = inside.pop(".length", None)
        if not inside:
            if length is None:
                raise KeyError(f"there is no field '{path}'; there are: {', '.join(self.keys())}")
            return np.empty(np.shape(length) + (0,))
        if length is None and all(name.startswith(".") for name in inside):
            return Fields({name[1:]: column for name, column in inside.items()})
        if all(re.fullmatch(r"\[\d+\]", name) for name in inside):
            return np.stack([np.asarray(column) for column in inside.values()], axis=-1)
        items = {}
        for name, column in inside.items():
            index, rest = re.fullmatch(r"\[(\d+)\]\.?(.*)", name).groups()
            items.setdefault(int(index), {})[rest] = column
        return [Fields(columns) for columns in items.values()]

    def frame(self):
        """A pandas DataFrame: a row a tick, a column a number or text, named by its path."""
        import pandas  # pylint: disable=import-outside-toplevel
        columns = {path: column for path, column in self._columns.items()
                   if not path.startswith("stamp.") and not path.endswith(".length")}
        frame = pandas.DataFrame(columns)
        if "stamp.tick" in self._columns:
            frame.index = pandas.Index(self._columns["stamp.tick"], name="tick")
        return frame


class Recording:
    """A recording of a run.

        recording = clew.Recording("a.mcap")
        recording["state"]["pose_world_robot.x_m"]   # an array over ticks
        recording["scan"]["ranges_m"]                # ticks x beams
        recording["state"].frame()                   # pandas
    """

    def __init__(self, path):
        self.file = _clew.RunRecording.open(str(path))
        self._topics = {}

    @classmethod
    def of(cls, recording):
        """A recording, or the one in that file."""
        return recording if isinstance(recording, cls) else cls(recording)

    @property
    def topics(self):
        """The names of the topics."""
        return self.file.topics()

    @property
    def files(self):
        """The texts that the run was made of, by name: `graph.yaml`, `world.yaml`, ..."""
        return self.file.files

    @property
    def tick_s(self):
        """Simulated time of a tick."""
        return self.file.tick_s

    @property
    def complete(self):
        """Whether its recorder finished it."""
        return self.file.complete

    @property
    def hash(self):
        """The run's hash, computed anew from the samples."""
        return self.file.hash()

    def __getitem__(self, topic):
        if topic not in self._topics:
            self._topics[topic] = Fields(dict(self.file.columns(topic)))
        return self._topics[topic]


def diff(a, b, *, tolerance=0.0):
    """Compares the samples of two recordings: {identical, first_difference}."""
    return _clew.diff(Recording.of(a).file, Recording.of(b).file, tolerance)
