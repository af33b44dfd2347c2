# SPDX-License-Identifier: Apache-2.0
"""What the papers say of their figures, and what of it can be measured: the rows of
`tools/paper-table trap_scenes`. A row holds if it does so from where the world starts, and from at
least 14 of 16 starts and targets that were moved a little."""
import math
import random
import re
import typing

MOVED_STARTS = 16
LEAST_SHARE = 14
MOVE_M = 0.1
TURN_RAD = 0.2
NUMBER = r"-?[\d.]+"
START = re.compile(rf"^start: \[({NUMBER}), ({NUMBER}), ({NUMBER})\]$", re.M)
TARGET = re.compile(rf"^target: \[({NUMBER}), ({NUMBER})\]$", re.M)
WALL = re.compile(rf"\[({NUMBER}), ({NUMBER}), ({NUMBER}), ({NUMBER})\]")


def moved_starts(text):
    """The world and, after it, the same with start and target moved by up to 0.1 m in both axes,
    and the heading by 0.2 rad; always the same ones."""
    draw = random.Random(1)
    yield text
    for _ in range(MOVED_STARTS):
        def shifted(match):
            place = [float(number) for number in match.groups()]
            limits = [MOVE_M, MOVE_M, TURN_RAD][:len(place)]
            return [round(number + draw.uniform(-limit, limit), 4)
                    for number, limit in zip(place, limits)]
        moved, starts = START.subn(lambda match: f"start: {shifted(match)}", text)
        moved, targets = TARGET.subn(lambda match: f"target: {shifted(match)}", moved)
        assert starts == targets == 1, text
        yield moved


def mirrored(text):
    """The mirror image of a world of walls, left and right."""
    left, _, right, _ = map(float, WALL.search(text).groups())
    assert "circles:" not in text and "polygons:" not in text, text
    bounds, rest = text.split("\n", 4)[:4], text.split("\n", 4)[4]

    def across(x_m):
        return round(left + right - float(x_m), 4)
    rest = WALL.sub(lambda wall: str([across(wall[1]), float(wall[2]), across(wall[3]),
                                      float(wall[4])]), rest)
    rest = START.sub(lambda start: f"start: {[across(start[1]), float(start[2])]}"[:-1]
                     + f", {round(math.pi - float(start[3]), 4)}]", rest)
    rest = TARGET.sub(lambda target: f"target: {[across(target[1]), float(target[2])]}", rest)
    return "\n".join([*bounds, rest])


def without_mover(text):
    """A world in which nothing moves."""
    still, count = re.subn(r"^moving: .*\n", "", text, flags=re.M)
    assert count == 1, text
    return still


class Still(list):
    """Arguments of a run in the scene's world without what moves there."""


class Alarmed(list):
    """Arguments of a run whose report tells the tick of the first trap that was noticed."""


def nothing_beyond(text):
    """The concave obstacle of Krishna & Kalra's figure 16 without its last two walls."""
    bounds_and_walls = list(WALL.finditer(text))
    assert len(bounds_and_walls) == 1 + 5, text
    return text[:bounds_and_walls[3].end()] + text[bounds_and_walls[5].end():]


class Scene(typing.NamedTuple):
    """A figure, what its text claims, and whether the reports of some runs bear that out."""
    figure: str
    claim: str
    measured: str
    world: str
    runs: dict
    holds: typing.Callable
    change: typing.Callable = str  # of the world's text


NO_DETECTOR = ["--with", "recover.detector=none"]
KK = ["krishna_kalra_2000"]
KK_REACTIVE = [*KK, *NO_DETECTOR, "--set", "recover.immediate_memory=false", "--set",
               "classify.networks=[art]"]
NO_IMAS = [*KK, "--set", "recover.immediate_memory=false"]
# Huang & Lee's robot has the same controller, and no landmarks.
HUANG_LEE = [*NO_IMAS, "--with", "recover.detector=heading_reversal", "--with",
             "recover.escape=track_mode"]
SWAPPED = [*HUANG_LEE, "--set", "recover.escape.leave=swapped"]
NVT = {"NVT alone": ["nakhaeinia", *NO_DETECTOR], "with LMP": ["nakhaeinia"]}
BOXES = ["--with", "recover.detector=position_revisit", "--with", "recover.escape=virtual_obstacle"]
LONG = ["--max-ticks", "20000"]


def reached(report, least=0, most=math.inf):
    """Whether a run reached its target, by that many virtual targets."""
    return report["outcome"] == "reached" and least <= report["virtual_targets"] <= most


def trapped(report):
    """Whether a run went on to its end."""
    return report["outcome"] == "timeout"


def quiet(report):
    """Whether a run reached its target and no trap was noticed."""
    return reached(report) and report["traps_detected"] == 0


def led_out(report):
    """Whether a run noticed a trap and reached its target."""
    return reached(report) and report["traps_detected"] > 0


def shorter(report, other, by_m=0.0):
    """Whether both runs reached their target, and the first on a path that much shorter."""
    return (reached(report) and reached(other)
            and report["path_length_m"] + by_m < other["path_length_m"])


def earlier(report, other):
    """Whether both runs noticed a trap and reached their target, and the first one noticed it first."""
    return led_out(report) and led_out(other) and report["alarm_tick"] < other["alarm_tick"]


def networks(figure, world):
    """Two rows: the alarm of either network alone, and the path that follows."""
    runs = {name: Alarmed([*KK, "--set", f"classify.networks=[{name.lower()}]"])
            for name in ("SOM", "ART")}
    return (Scene(f"Krishna & Kalra {figure}", "ART detects the trap earlier than the SOM",
                  "both: a trap noticed, reached; by ART at an earlier tick", world, runs,
                  lambda som, art: earlier(art, som)),
            Scene(f"Krishna & Kalra {figure}, path", "a shorter path results",
                  "both: a trap noticed, reached; by ART shorter", world, runs,
                  lambda som, art: led_out(som) and led_out(art) and shorter(art, som)))


def leaving(figure, claim, measured, world, change=str):
    """The criterion of leaving alone: Huang & Lee's, and that of Krishna & Kalra in its place."""
    return Scene(f"Krishna & Kalra {figure}", claim, measured, world,
                 {"theirs": HUANG_LEE, "ours in its place": SWAPPED},
                 lambda theirs, ours: shorter(ours, theirs), change)


def complicated(letter):
    """One of the three environments of Nakhaeinia's figure 13."""
    return Scene(f"Nakhaeinia 13{letter}", "complicated: the LMP leads out",
                 "alone: no end; with LMP: a trap noticed, reached",
                 f"n-fig13{letter}-complicated", NVT,
                 lambda alone, both: trapped(alone) and led_out(both))


def trap_of(figure, world):
    """A trap of Krishna & Kalra: without memory the robot goes round in it, with it it gets out."""
    return Scene(f"Krishna & Kalra {figure}", "an infinite loop, out of which the DMAS leads",
                 "reactive: no end; whole: a trap noticed, reached", world,
                 {"reactive": KK_REACTIVE, "whole": KK},
                 lambda reactive, whole: trapped(reactive) and led_out(whole))


def touches_nothing(report):
    """Whether a run reached its target without a contact of either kind."""
    return reached(report) and report["collisions"] == report["hit_by"] == 0


def within(report, ratio):
    """Whether a run reached its target on a path of at most that many times the shortest."""
    return reached(report) and report["path_length_m"] <= ratio * report["shortest_path_m"]


def room(figure, claim, world, runs):
    """A room of Wang, Yang & Meng, in which each run must touch nothing."""
    return Scene(f"Wang, Yang & Meng {figure}", claim, "reached, no contact", world, runs,
                 lambda *reports: all(map(touches_nothing, reports)))


def polar(figure, claim, world, ratio, *choice):
    """A figure of Lagoudakis & Maida: the way there is not much longer than the shortest."""
    return Scene(f"Lagoudakis & Maida {figure}", claim,
                 f"reached on at most {ratio:g} times the shortest path, no contact", world,
                 {"as the paper": ["lagoudakis_maida", *choice]},
                 lambda report: within(report, ratio) and touches_nothing(report))


WYM = ["wang_yang_meng"]
# The paper's robot has neither.
BARE = ["--set", "control.guard=false", "--set", "drive.safety=false"]
SLOW = "w-fig09-slow-obstacle"
MET = ("the slowly moving obstacle is avoided",
       "reached, no contact; and met: the run is another one than without the obstacle", SLOW)


def met(report, still):
    """Whether a run met what moves and touched nothing."""
    return report["hash"] != still["hash"] and touches_nothing(report)


CORNER = ("the corner draws the robot in without IMAS; with it the path is shorter",
          "both reached, with IMAS by 0.5 m shorter: a robot's diameter is 0.3 m",
          "kk-fig08-right-angle-corner", {"no IMAS": NO_IMAS, "IMAS": KK},
          lambda without, with_imas: shorter(with_imas, without, 0.5))

SCENES = [
    Scene("Krishna & Kalra 7", "fuzzy control alone passes clutter", "reached", "kk-fig07-clutter",
          {"reactive": KK_REACTIVE}, reached),
    Scene("Krishna & Kalra 8, 9", *CORNER),
    Scene("Krishna & Kalra 8, 9, mirrored", *CORNER, mirrored),
    trap_of("10", "kk-fig10-bends-and-kinks"),
    *networks("10c", "kk-fig10-bends-and-kinks"),
    trap_of("11a", "kk-fig11a-oscillation"),
    trap_of("11c", "kk-fig11c-double-wall"),
    trap_of("12", "kk-fig12-hooks"),
    *networks("12c", "kk-fig12-hooks"),
    Scene("Krishna & Kalra 13b", "IMAS leads out of the maze, without DMAS",
          "reached without recovery", "kk-fig13-maze-four-loops", {"IMAS": [*KK, *NO_DETECTOR]},
          reached),
    Scene("Krishna & Kalra 13c", "ART alone leads out of the maze",
          "reactive: no end; ART: a trap noticed, reached", "kk-fig13-maze-four-loops",
          {"reactive": KK_REACTIVE, "ART": [*KK, "--set", "classify.networks=[art]"]},
          lambda reactive, art: trapped(reactive) and led_out(art)),
    Scene("Krishna & Kalra 14", "the SOM does not detect the trap, ART does",
          "SOM alone: no end, no trap noticed; ART: a trap noticed, reached",
          "kk-fig14-som-cannot-detect",
          {"SOM": [*KK, "--set", "classify.networks=[som]"],
           "ART": [*KK, "--set", "classify.networks=[art]"]},
          lambda som, art: trapped(som) and som["traps_detected"] == 0 and led_out(art)),
    Scene("Krishna & Kalra 15", "the 160-degree rule misfires, and its path is the longer one",
          "theirs: an alarm, reached; ours: none, reached, shorter", "kk-fig15-not-trapped",
          {"theirs": HUANG_LEE, "ours": KK},
          lambda theirs, ours: led_out(theirs) and quiet(ours) and shorter(ours, theirs)),
    trap_of("16a", "kk-fig16a-concave-obstacle"),
    trap_of("16c", "kk-fig16c-concave-obstacle-mirrored"),
    leaving("16a, b", "T mode that ends by their criterion gives the shorter path",
            "after the same alarm: both reached, shorter", "kk-fig16a-concave-obstacle"),
    leaving("16c, d", "the same, mirrored", "the same", "kk-fig16c-concave-obstacle-mirrored"),
    leaving("16a, b, nothing beyond", "the same, if nothing lies beyond the concave obstacle",
            "the same, without the last two walls", "kk-fig16a-concave-obstacle", nothing_beyond),
    leaving("16c, d, nothing beyond", "the same, mirrored", "the same",
            "kk-fig16c-concave-obstacle-mirrored", nothing_beyond),
    Scene("Krishna & Kalra 4.6", "similar scenes at other places are not confused",
          "reached, no trap noticed", "kk-text-similar-scenes", {"whole": KK}, quiet),
    Scene("Pin & Bender 4", "a limit cycle without memory", "no end", "pb-fig04-dead-end-chamber",
          {"no memory": ["pin_bender", *NO_DETECTOR]}, trapped),
    Scene("Pin & Bender 5", "virtual obstacles fill the chamber, then the goal is reached",
          "reached by two of them or more, with either controller", "pb-fig04-dead-end-chamber",
          {"pin_bender": ["pin_bender"], "krishna_kalra": ["krishna_kalra", *BOXES]},
          lambda theirs, other: reached(theirs, 2) and reached(other, 2)),
    Scene("Pin & Bender, off the axis", "the same in a variant of ours, in 20000 ticks",
          "the same", "pb-fig04-chamber-off-axis",
          {"pin_bender": ["pin_bender", *LONG], "krishna_kalra": ["krishna_kalra", *BOXES]},
          lambda theirs, other: reached(theirs, 2) and reached(other, 2)),
    Scene("Nakhaeinia 1", "NVT takes the safe region with the shorter path",
          "alone: reached; with LMP: reached, no trap noticed", "n-fig01-safe-regions", NVT,
          lambda alone, both: reached(alone) and quiet(both)),
    Scene("Nakhaeinia 2", "NVT alone finds its way through clutter",
          "alone: reached; with LMP: reached, no trap noticed", "n-fig02-nvt-cluttered", NVT,
          lambda alone, both: reached(alone) and quiet(both)),
    Scene("Nakhaeinia 3", "NVT alone leaves a visible minimum",
          "alone: reached; with LMP: reached, no trap noticed", "n-fig03-visible-minimum", NVT,
          lambda alone, both: reached(alone) and quiet(both)),
    Scene("Nakhaeinia 4", "an invisible minimum traps NVT; one virtual target leads out",
          "alone: no end; with LMP: reached by one", "n-fig04-invisible-minimum", NVT,
          lambda alone, both: trapped(alone) and reached(both, 1, 1)),
    Scene("Nakhaeinia 9", "one virtual target leads out",
          "alone: no end; with LMP: reached by one", "n-fig09-local-minimum", NVT,
          lambda alone, both: trapped(alone) and reached(both, 1, 1)),
    # Both are set at a trap, and the first one comes in force again: three changes.
    Scene("Nakhaeinia 10", "two virtual targets lead out, the second popped before the first",
          "alone: no end; with LMP: reached by two traps and three changes of the target",
          "n-fig10-recursive-u", NVT,
          lambda alone, both: (trapped(alone) and reached(both, 3, 3)
                               and both["traps_detected"] == 2)),
    Scene("Nakhaeinia 11", "one virtual target leads along the discontinued wall",
          "alone: no end; with LMP: reached by one or two", "n-fig11-discontinued-wall", NVT,
          lambda alone, both: trapped(alone) and reached(both, 1, 2)),
    Scene("Nakhaeinia 12", "surrounded: one virtual target leads out",
          "alone: no end; with LMP: reached by one", "n-fig12-surrounded", NVT,
          lambda alone, both: trapped(alone) and reached(both, 1, 1)),
    *(complicated(letter) for letter in "abc"),
    room("8", "no static obstacle is hit", "w-fig08-room-static", {"trained": WYM}),
    room("8, the controller alone", "no static obstacle is hit", "w-fig08-room-static",
         {"neither guard nor safety layer": [*WYM, *BARE]}),
    room("8, both discs", "no static obstacle is hit, by a body of 20 x 25 cm",
         "w-fig08-room-static", {"the disc within": [*WYM, "--robot", "disc-010"],
                                 "the disc around": [*WYM, "--robot", "disc-016"]}),
    Scene("Wang, Yang & Meng 9, slow", *MET,
          {"trained": WYM, "without the obstacle": Still(WYM)}, met),
    Scene("Wang, Yang & Meng 9, slow, the controller alone", *MET,
          {"neither guard nor safety layer": [*WYM, *BARE],
           "without the obstacle": Still([*WYM, *BARE])}, met),
    room("9, sudden", "the obstacle that appears suddenly is avoided", "w-fig09-sudden-obstacle",
         {"trained": WYM}),
    room("9, sudden, the controller alone", "the obstacle that appears suddenly is avoided",
         "w-fig09-sudden-obstacle", {"neither guard nor safety layer": [*WYM, *BARE]}),
    polar("2", "the global map leads round three walls", "lm-fig02-three-walls", 1.2, "--with",
          "plan=neural_map"),
    polar("4", "the polar map leads round an L", "lm-fig04-l-obstacle", 1.2),
    polar("6", "memory keeps what the sonars do not see any more", "lm-fig06-sonar-memory", 1.1),
    Scene("Lagoudakis & Maida 7, four targets", "the robot visits targets in rooms with blocks",
          "reached, no contact", "lm-fig07-four-targets", {"as the paper": ["lagoudakis_maida"]},
          touches_nothing),
    polar("7, lab", "a smooth way through a lab", "lm-fig07-lab", 1.2),
    polar("8, left", "a U within the scope is avoided", "lm-fig08-u-100in", 1.8),
    Scene("Lagoudakis & Maida 8, beyond", "a larger U traps, since the method is memoryless",
          "no end", "lm-fig08-u-beyond-range", {"as the paper": ["lagoudakis_maida"]}, trapped),
    polar("8, right", "clutter is passed smoothly", "lm-fig08-clutter", 1.25),
    Scene("Lagoudakis & Maida 9", "an office by 13 subgoals", "reached, no contact",
          "lm-fig09-office", {"as the paper": ["lagoudakis_maida"]}, touches_nothing),
    Scene("Lagoudakis & Maida, people", "walking people are no trouble", "reached, no contact",
          "lm-text-walking-people", {"as the paper": ["lagoudakis_maida"]}, touches_nothing),
]
