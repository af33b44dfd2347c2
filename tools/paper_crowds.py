# SPDX-License-Identifier: Apache-2.0
"""Giving way to moving objects, in pairs: for paper-table.

Each run has its pair in the same world: `any_sensor`, which is the graph `give_way` without classifier
and reaction, and moves as `give_way` does without its reaction.
"""
import dataclasses

GRAPH = "give_way"
WITHOUT = "any_sensor"
SUITE = "crowds"
CONTROLLERS = {
    "fuzzy_behaviourist": [],
    "nearest_virtual_target": ["--with", "control=nearest_virtual_target"],
}
# With the world's start and moved ones.
SHIPPED = ["lm-text-walking-people", "moving-crossing"]


@dataclasses.dataclass
class Pair:
    """The reports of a world without giving way and with it."""
    without: dict
    giving: dict


def contacts(report):
    """Contacts of either kind with anything."""
    return report["hit_by"] + report["collisions"]


def both(pairs, value):
    """A sum over all pairs, without and with."""
    return (f"{sum(value(pair.without) for pair in pairs)}, "
            f"{sum(value(pair.giving) for pair in pairs)}")


def seconds(pairs):
    """The mean time of the pairs that both reached the target, without and with."""
    reached = [pair for pair in pairs
               if pair.without["outcome"] == pair.giving["outcome"] == "reached"]
    if not reached:
        return "-"
    return ", ".join(f"{sum(getattr(pair, side)['sim_time_s'] for pair in reached) / len(reached):.1f}"
                     for side in ("without", "giving"))


def row(where, controller, pairs):
    """A row of the table."""
    fewer = sum(contacts(pair.giving) < contacts(pair.without) for pair in pairs)
    more = sum(contacts(pair.giving) > contacts(pair.without) for pair in pairs)
    cells = [where, f"`{controller}`", str(len(pairs)),
             both(pairs, lambda report: report["outcome"] == "reached"),
             both(pairs, lambda report: contacts(report) > 0), both(pairs, contacts),
             f"{fewer}, {more}", both(pairs, lambda report: report["safety_stops"]), seconds(pairs)]
    return "| " + " | ".join(cells) + " |"


HEADER = ("| worlds | controller | pairs | reached | runs with contact | contacts | "
          "pairs with fewer, with more | safety stops | mean time in s |\n" + "|---" * 9 + "|")
