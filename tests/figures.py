#!/usr/bin/env python3
"""The README's figures are the program's own output: flies the cases and compares, digit by digit.

`tests/figures.py --write` puts the figures of this build into the README and docs/comparison.md, and the pictures into
docs/images. A flight is
the same bit for bit everywhere, so there is nothing to tolerate.
"""

import json
import math
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SIMULATOR = Path(os.environ.get("GLISSADE_SIM", ROOT / "target" / "release" / "sim-host"))
README = ROOT / "README.md"
COMPARISON = ROOT / "docs" / "comparison.md"
IMAGES = ROOT / "docs" / "images"


def simulate(command, scenario, *arguments):
    command = [str(SIMULATOR), command, scenario, "--json", *arguments]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def fly(scenario, *arguments):
    return simulate("run", scenario, *arguments)


def seconds(value):
    return "never" if value is None else f"{value:.3f} s"


def settled(flight):
    """When the last of x, y, z comes within 5 cm for good; None if one does not."""
    times = [flight["axes"][axis]["settle_5cm_s"] for axis in "xyz"]
    return None if None in times else max(times)


def recovery(scenario):
    times = list(fly(scenario)["recovery_s"].values())
    if None in times:
        return "not within 5 cm and 2° at the end"
    return f"within 5 cm and 2° after {seconds(max(times))}" if max(times) else "never beyond 5 cm or 2°"


def strongest(scenario):
    return max((flight for flight in simulate("sweep", scenario) if flight["held"]), key=lambda flight: flight["factor"])


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def paper_table():
    on_accelerations, on_outputs = strongest("paper-disturbed"), strongest("paper-disturbed-output")
    axes = fly("paper-ideal")["axes"]
    settle = {axis: axes[axis]["settle_5cm_s"] for axis in "xyz"}
    mean = None if None in settle.values() else sum(settle.values()) / 3
    return table(
        ["the paper's claim", "paper", "here", "scenario"],
        [
            ["x follows 4 sin t", "from 0 s", f"within 5 cm from {seconds(settle['x'])}", "`paper-ideal`"],
            ["y follows 5 cos t", "from 0.4 s", f"within 5 cm from {seconds(settle['y'])}", "`paper-ideal`"],
            ["z follows 2 + t", "from 0.35 s", f"within 5 cm from {seconds(settle['z'])}", "`paper-ideal`"],
            ["z is off by “nearly 0.002”", "from 0.45 s",
             f"within 2 mm from {seconds(axes['z']['settle_2mm_s'])}", "`paper-ideal`"],
            ["all follow, on average", "within 0.5 s", f"within 5 cm after {seconds(mean)}", "`paper-ideal`"],
            ["noise on the accelerations is removed", "in under 0.2 s", recovery("paper-disturbed"),
             "`paper-disturbed`"],
            ["noise on the outputs is removed", "in under 0.2 s", recovery("paper-disturbed-output"),
             "`paper-disturbed-output`"],
            ["it stays so up to", "",
             f"σ = {on_accelerations['acceleration_m_s2']:.0f} m/s², "
             f"{on_accelerations['angular_acceleration_rad_s2']:.0f} rad/s²", "`sweep paper-disturbed`"],
            ["", "",
             f"σ = {1e2 * on_outputs['position_output_m']:.1f} cm, "
             f"{math.degrees(on_outputs['angle_output_rad']):.1f}°", "`sweep paper-disturbed-output`"],
            ["the same gains on the coupled vehicle", "as above",
             f"all axes within 5 cm: {seconds(settled(fly('paper-literal')))}", "`paper-literal`"],
        ],
    )


def flight_row(name):
    flight = fly(name)
    bound, last = flight["time_optimal_s"], settled(flight)
    axes = [flight["axes"][axis] for axis in "xyz"]
    millimetres = lambda key: " / ".join(f"{1e3 * axis[key]:.3f}" for axis in axes)
    return [
        f"`{name}`",
        seconds(last),
        "not known" if bound is None else f"{bound:.2f} s",
        "" if bound is None or last is None else f"{last / bound:.2f}",
        millimetres("rms_m"),
        millimetres("max_m"),
    ]


def flights_table():
    return table(
        ["scenario", "x, y, z within 5 cm from", "time-optimal", "ratio", "RMS x / y / z, mm", "maximum x / y / z, mm"],
        [flight_row(name) for name in ("helix", "helix-tw4", "helix-lag", "figure-eight")],
    )


def helix_picture():
    with tempfile.TemporaryDirectory() as folder:
        fly("helix", "--out", folder)
        return (Path(folder) / "fig7-helix.svg").read_text(encoding="utf-8")


def compare():
    """The comparison as JSON, as the text for its own page, and its picture."""
    with tempfile.TemporaryDirectory() as folder:
        command = [str(SIMULATOR), "compare", "x500", "--json", "--out", folder]
        result = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
        read = lambda name: (Path(folder) / name).read_text(encoding="utf-8")
        return result, read("compare.md"), read("compare-ratio.svg")


def comparison_row(overall, first):
    median = lambda key: overall["medians"][key]["median"]
    millimetres = lambda key: "lost" if median(key) is None else f"{1e3 * median(key):.1f}"
    against = "" if overall is first else f"{overall['worse_cells']} of {overall['cells']}"
    medians = overall["medians"]
    return [
        f"`{overall['controller']}`",
        millimetres("rms_m"),
        f"{overall['rms_ratio']:.2f}",
        millimetres("max_m"),
        f"{medians['survived']} of {medians['flights']}",
        against,
    ]


def comparison_table(result):
    first, *_ = result["overall"]
    for overall in result["overall"]:
        overall["cells"] = len(result["cells"])
        # What is better or worse is told of the first controller against this one.
    return table(
        ["tuning", "RMS, mm", "its ratio to the first's", "maximum, mm", "survived", "cells in which its RMS is the greater"],
        [comparison_row(overall, first) for overall in result["overall"]],
    )


def updated(text, parts):
    """The text with each generated part made anew."""
    for name, now in parts.items():
        part = re.compile(rf"(<!-- begin: {name} -->\n).*?(<!-- end: {name} -->)", re.DOTALL)
        assert part.search(text), f"there is no part `{name}`"
        text = part.sub(lambda match, now=now: f"{match[1]}{now.strip()}\n{match[2]}", text)
    return text


def check(path, is_now, write):
    was = path.read_text(encoding="utf-8") if path.exists() else ""
    if write:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(is_now, encoding="utf-8")
        return True
    if was != is_now:
        print(f"{path.relative_to(ROOT)} is not what the program says (tests/figures.py --write updates it)")
        old = set(was.splitlines())
        print("\n".join([line[:200] for line in is_now.splitlines() if line not in old][:10]))
    return was == is_now


def main():
    write = sys.argv[1:] == ["--write"]
    assert "TODO" not in README.read_text(encoding="utf-8"), "README.md has a figure that nobody has filled in"
    result, page, ratios = compare()
    readme = {"paper": paper_table(), "flights": flights_table(), "comparison": comparison_table(result)}
    good = [
        check(README, updated(README.read_text(encoding="utf-8"), readme), write),
        check(COMPARISON, updated(COMPARISON.read_text(encoding="utf-8"), {"comparison": page}), write),
        check(IMAGES / "helix.svg", helix_picture(), write),
        check(IMAGES / "compare-ratio.svg", ratios, write),
    ]
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
