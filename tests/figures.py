#!/usr/bin/env python3
"""The README's figures are the program's own output: flies the cases and compares, digit by digit.

`tests/figures.py --write` puts the figures of this build into the README, docs/comparison.md and docs/sensors.md, and
the pictures into docs/images. A flight is
the same bit for bit everywhere, so there is nothing to tolerate. `--fast` leaves out the hundred seeds
of each flight on sensors, which take minutes.
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
SENSORS = ROOT / "docs" / "sensors.md"
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
        return (Path(folder) / "path.svg").read_text(encoding="utf-8")


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


# What of the flights on sensors stands in the README: scenario, measure, how it reads there, what is asked for.
ON_SENSORS = [
    ("outdoor-hover", "climb-s", "take-off to 10 m, within 0.35 m after, s", "30; PX4’s test 30"),
    ("outdoor-hover", "height-wander-max-m", "then height over 60 s, 5 m/s of wind, m", "0.15; PX4’s test 0.25"),
    ("outdoor-hover", "horizontal-error-p95-m", "and distance, 95 % of the time, m", "1.0"),
    ("indoor-hover", "horizontal-error-p95-m", "the same on motion capture, m", "0.05"),
    ("outdoor-hover", "attitude-known-rms-deg", "attitude known in hover, °", "0.3 (root mean square)"),
    ("outdoor-eight", "attitude-known-rms-deg", "and in an eight of 8 m/s, °", "1.0 (root mean square)"),
    ("indoor-helix", "y-error-rms-m", "the helix on motion capture, 3 m/s of wind: y, m", "0.03"),
    ("path-gnss-lost", "disarmed-s", "GNSS lost at 30 s: on the ground, rotors stopped, at s", "60; PX4’s test 60"),
    ("gnss-glitch", "horizontal-error-max-m", "GNSS jumps by 50 m: true distance, m", "5; ArduPilot’s test 20"),
    ("path-mag-off", "miss-max-m", "magnetometer silent on the way: places missed by, m", "1.5"),
    ("path-mag-stuck", "miss-max-m", "magnetometer stuck, m", "1.5"),
    ("path-baro-off", "miss-max-m", "barometer silent, m", "1.5"),
    ("path-baro-stuck", "miss-max-m", "barometer stuck, m", "1.5"),
    ("twist", "roll-max-deg", "torque worth 40 rad/s² about roll for 3 s: roll, °", "20; ArduPilot’s test 20"),
    ("weak-rotor", "height-error-max-m", "a rotor at 65 % for 30 s: height, m", "1; ArduPilot’s test 5"),
    ("weak-rotor", "horizontal-error-max-m", "and drift, m", "2; ArduPilot’s test 10"),
    ("lost-rotor", "touchdown-m-s", "a rotor lost at 20 m: touches down at, m/s", "3"),
]


def assess():
    """What a hundred seeds of each scenario that is judged have measured."""
    command = [str(SIMULATOR), "assess", "--json"]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def short(value):
    return "–" if value is None else f"{value:.3g}" if abs(value) < 100 else f"{value:.0f}"


def sensors_table(reports):
    measured = {(report["scenario"], row["measure"]): row for report in reports for row in report["rows"]}
    row = lambda scenario, measure: [short(measured[scenario, measure][key]) for key in ("p50", "p95", "max", "rms")]
    return table(
        ["flight", "scenario", "median", "95 %", "worst", "rms", "asked for"],
        [[text, f"`{name}`", *row(name, measure), asked] for name, measure, text, asked in ON_SENSORS],
    )


def sensors_page(reports):
    """Every scenario: what is expected of it, what was measured, how consistent the filter is."""
    parts = []
    for report in reports:
        parts.append(f"### `{report['scenario']}`\n")
        parts.append(table(["expected", "found", ""], [expectation(verdict) for verdict in report["verdicts"]]) + "\n")
        rows = [[row["measure"], *(short(row[key]) for key in ("p5", "p50", "p95", "max", "rms"))] for row in report["rows"]]
        parts.append(table(["measure", "5 %", "median", "95 %", "worst", "rms"], rows) + "\n")
        rows = [
            [nis["reading"], str(nis["count"]), *(f"{nis[key]:.3f}" for key in ("mean", "within_95", "within_band", "refused"))]
            for nis in report["nis"]
        ]
        if report["nees"]:
            nees = report["nees"]
            rows.append(["**errors**", str(nees["looks"]), *(f"{nees[key]:.3f}" for key in ("mean", "within_95", "within_band")), ""])
        header = ["reading", "count", "NIS, NEES / degrees", "within 95 %", "in band", "refused"]
        parts.append(table(header, rows) + "\n")
    return "\n".join(parts)


def expectation(verdict):
    of = "root mean square" if verdict["percentile"] is None else f"{verdict['percentile']:g} %"
    most, least = verdict["at_most"], verdict["at_least"]
    bound = f"≥ {least:g}" if most is None else f"≤ {most:g}"
    return [f"{verdict['measure']}, {of}, {bound}", short(verdict["found"]), "" if verdict["met"] else "**not met**"]


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
    write, fast = "--write" in sys.argv, "--fast" in sys.argv
    assert "TODO" not in README.read_text(encoding="utf-8"), "README.md has a figure that nobody has filled in"
    result, page, ratios = compare()
    readme = {
        "paper": paper_table(),
        "flights": flights_table(),
        "comparison": comparison_table(result),
    }
    page_of_sensors = {}
    if not fast:
        on_sensors = assess()
        readme["sensors"] = sensors_table(on_sensors)
        page_of_sensors["sensors"] = sensors_page(on_sensors)
    good = [
        check(README, updated(README.read_text(encoding="utf-8"), readme), write),
        check(COMPARISON, updated(COMPARISON.read_text(encoding="utf-8"), {"comparison": page}), write),
        check(SENSORS, updated(SENSORS.read_text(encoding="utf-8"), page_of_sensors), write),
        check(IMAGES / "helix.svg", helix_picture(), write),
        check(IMAGES / "compare-ratio.svg", ratios, write),
    ]
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
