# SPDX-License-Identifier: Apache-2.0
"""In a debugger a function of a Debug build has its arguments and members with their values."""
import json
import pathlib
import subprocess
import tempfile
import unittest

from clew_command import SOURCE

PROGRAM = """
#include "drive/referee.hpp"
int main() {
  clew::drive::Referee referee({{{{3.0, 4.0}, 0.25}}, 100});
  return referee.judge(7, {}, 0, {}) == clew::domain::Outcome::kRunning ? 0 : 1;
}
"""
SOURCES = ["drive/referee.cpp", "world/route.cpp", "core/hash128.cpp", "core/check.cpp",
           "core/math.cpp", "core/process_end.cpp"]


def debug_flags():
    """What the preset for a debugger compiles with."""
    presets = json.loads((SOURCE / "CMakePresets.json").read_text(encoding="utf-8"))
    [preset] = [one for one in presets["configurePresets"] if one["name"] == "debug"]
    assert preset["cacheVariables"]["CMAKE_BUILD_TYPE"] == "Debug"
    return preset["cacheVariables"]["CLEW_DEBUG_FLAGS"].split()


class Debugger(unittest.TestCase):
    def test_shows_arguments_and_members(self):
        with tempfile.TemporaryDirectory() as directory:
            main = pathlib.Path(directory) / "main.cpp"
            main.write_text(PROGRAM)
            components = SOURCE / "components"
            subprocess.run(["g++", "-std=c++17", *debug_flags(), f"-I{components}",
                            "-isystem/usr/include/eigen3", main,
                            *(components / source for source in SOURCES), "-lxxhash",
                            "-o", f"{directory}/program"], check=True, timeout=300)

            told = subprocess.run(["gdb", "-q", "-nx", "-batch", "-ex", "break Referee::judge",
                                   "-ex", "run", "-ex", "info args", "-ex",
                                   "print max_ticks_", f"{directory}/program"],
                                  capture_output=True, text=True, timeout=120, check=False,
                                  stdin=subprocess.DEVNULL)

        self.assertIn("tick = 7\n", told.stdout, told.stderr)
        self.assertIn("collisions = 0\n", told.stdout)
        self.assertIn("$1 = 100\n", told.stdout)


if __name__ == "__main__":
    unittest.main()
