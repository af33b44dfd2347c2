# SPDX-License-Identifier: Apache-2.0
"""Random cases for tools/chaos: what is run, and what befalls it."""
import pathlib

SOURCE = pathlib.Path(__file__).resolve().parents[1]
STAGES = ["sense", "classify", "recover", "plan", "control", "drive"]
CONTROLS = ["krishna_kalra_fuzzy", "nearest_virtual_target", "fuzzy_behaviourist"]
DETECTORS = ["none", "landmark_revisit", "position_revisit", "oscillation"]


def random_world(numbers):
    """A room with boxes, as the text of a world: the target may be out of reach."""
    width, height = numbers.uniform(4, 9), numbers.uniform(4, 9)
    walls = []
    for _ in range(numbers.randrange(5)):
        x, y = numbers.uniform(1.5, width - 1.5), numbers.uniform(1.5, height - 1.5)
        dx, dy = numbers.uniform(-2, 2), numbers.uniform(-2, 2)
        walls.append([round(v, 2) for v in (x, y, min(max(x + dx, 1), width - 1),
                                            min(max(y + dy, 1), height - 1))])
    return (f"format: clew-world/1\nname: chaos\nbounds: [0, 0, {width:.2f}, {height:.2f}]\n"
            f"start: [0.5, 0.5, {numbers.uniform(-3, 3):.2f}]\n"
            f"target: [{width - 0.5:.2f}, {height - 0.5:.2f}]\ntarget_radius: 0.2\nwalls: {walls}\n")


def stages_of(graph):
    text = (SOURCE / "configs" / "graphs" / f"{graph}.yaml").read_text(encoding="utf-8")
    named = [line.split(":")[0] for line in text.splitlines()]
    return [stage for stage in STAGES if stage in named or (stage == "plan" and "mission" in named)]


def random_case(numbers, kinds):
    """Anything that may befall a run."""
    graph = numbers.choice(sorted(path.stem for path in
                                  (SOURCE / "configs" / "graphs").glob("*.yaml")))
    stages = stages_of(graph)
    worlds = sorted(path.stem for path in (SOURCE / "configs" / "worlds").glob("*.yaml"))
    realtime = numbers.random() < 0.15
    # In real time a tick lasts 0.3 s: half a minute at most.
    ticks = numbers.randrange(40, 100 if realtime else 1200)
    case = {"graph": graph, "seed": numbers.randrange(1, 1000), "max_ticks": ticks,
            "world": random_world(numbers) if numbers.random() < 0.4 else numbers.choice(worlds),
            "pace": "realtime" if realtime else
                    numbers.choice(["lockstep", "100x", f"{numbers.randrange(50, 300)}x"]),
            "middleware": [numbers.choice(["cyclonedds", "fastdds"])] + [
                f"{stage}={numbers.choice(['cyclonedds', 'fastdds'])}" for stage in stages
                if numbers.random() < 0.4],
            "with": [], "at": [], "secure": numbers.random() < 0.05, "faults": []}
    if numbers.random() < 0.3:
        case["with"].append(f"control={numbers.choice(CONTROLS)}")
    if "recover" in stages and numbers.random() < 0.3:
        case["with"].append(f"recover.detector={numbers.choice(DETECTORS)}")
    case["faults"] = random_faults(numbers, stages, kinds, realtime)
    for _ in range(numbers.choice([0, 0, 1, 2])):
        tick = numbers.randrange(2, ticks)
        case["at"].append(f"{tick}:goal={numbers.uniform(1, 3):.2f},{numbers.uniform(1, 3):.2f}"
                          if numbers.random() < 0.5 else
                          f"{tick}:control={numbers.choice(CONTROLS)}")
    return case


def freeze_case(numbers):
    """Freezes of 0.05 to 10 s and nothing else: of one process or all, the supervisor included, at the
    start, on the way, at a restart, while an assignment of 10 MB is read."""
    graph = numbers.choice(sorted(path.stem for path in
                                  (SOURCE / "configs" / "graphs").glob("*.yaml")))
    stages = stages_of(graph)
    vendors = ["cyclonedds", "fastdds"]
    large = numbers.random() < 0.2
    ticks = numbers.randrange(100, 1000)
    # Half of them last for three seconds at least, for ticks of 0.3 s.
    case = {"graph": graph, "seed": 1, "max_ticks": ticks, "world": "unsolvable-behind-wall",
            "large": large, "pace": numbers.choice(["lockstep", f"{ticks // 10}x"]),
            "middleware": [numbers.choice(vendors)] + [
                f"{stage}={numbers.choice(vendors)}" for stage in stages if numbers.random() < 0.4],
            "with": [], "at": [], "secure": False, "faults": []}
    for _ in range(numbers.choice([1, 1, 2])):
        kind = numbers.choice(["freeze", "freeze", "freeze_new"])
        victims = ["sense", "drive"] if large else [*stages, "recorder"]
        if kind == "freeze" and not large:
            victims += ["run", "all", "all"]
        case["faults"].append({
            "kind": kind, "victim": numbers.choice(victims),
            "at_s": round(numbers.choice([numbers.uniform(0.0, 0.4), numbers.uniform(0.3, 2.0)]), 3),
            "for_s": round(10 ** numbers.uniform(-1.3, 1.0), 3)})
    case["faults"].sort(key=lambda fault: fault["at_s"])
    return case


def storm_case(numbers):
    """Thirty kills and short freezes in six seconds."""
    case = {**freeze_case(numbers), "large": False, "faults": []}
    stages = stages_of(case["graph"])
    case["pace"] = f"{max(case['max_ticks'] // 20, 1)}x"
    for _ in range(30):
        fault = {"kind": numbers.choice(["kill", "kill", "kill", "freeze"]),
                 "at_s": round(numbers.uniform(0.1, 6.0), 3),
                 "victim": numbers.choice([*stages, "recorder"])}
        if fault["kind"] == "freeze":
            fault["for_s"] = round(10 ** numbers.uniform(-1.3, 0.0), 3)
        case["faults"].append(fault)
    case["faults"].sort(key=lambda fault: fault["at_s"])
    return case


def realtime_case(numbers):
    """One process of a run in real time is killed, the supervisor or the recorder maybe."""
    case = {**freeze_case(numbers), "large": False, "pace": "realtime", "max_ticks": 10}
    case["faults"] = [{"kind": "kill", "at_s": round(numbers.uniform(0.3, 2.5), 3),
                       "victim": numbers.choice([*stages_of(case["graph"]), "recorder", "run"])}]
    return case


def random_faults(numbers, stages, kinds, realtime):
    faults = []
    for _ in range(numbers.choice([1, 1, 2, 3, 5])):
        kind = numbers.choice(["kill", "freeze"] if realtime else kinds)
        fault = {"kind": kind, "at_s": round(numbers.uniform(0.0, 1.5), 3)}
        if kind in ("kill", "freeze"):
            fault["victim"] = numbers.choice([*stages, "recorder"])
        if kind == "freeze":
            fault["for_s"] = round(10 ** numbers.uniform(-1.3, 0.5), 3)
        if kind == "loss":
            fault["percent"] = numbers.choice([1, 5, 10])
        if kind == "disk":
            fault["size_k"] = numbers.choice([64, 128, 256])
        if kind == "clock":
            fault["jump_s"] = numbers.choice([-3600, -60, -1, 1, 60, 3600])
        # One of a kind that holds for the whole run.
        if kind in ("kill", "freeze", "all") or all(kind != other["kind"] for other in faults):
            faults.append(fault)
    return sorted(faults, key=lambda fault: fault["at_s"])
