#!/usr/bin/env python3
"""The figures in the README and the manual are the program's own output: flies the cases and compares, digit by digit.

`tests/figures.py --write` puts the figures of this build into README.md, docs/results.md, docs/paper.md,
docs/comparison.md and docs/sensors.md, and the pictures into docs/images. A flight is the same bit for bit everywhere,
so there is no tolerance. `--fast` leaves out the hundred seeds of each flight on sensors, which take minutes.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SIMULATOR = Path(os.environ.get("GLISSADE_SIM", ROOT / "target" / "release" / "sim-host"))
README = ROOT / "README.md"
RESULTS = ROOT / "docs" / "results.md"
COMPARISON = ROOT / "docs" / "comparison.md"
SENSORS = ROOT / "docs" / "sensors.md"
PAPER = ROOT / "docs" / "paper.md"
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


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def paper():
    """The paper's study as JSON, its table for its own page, and its figures by name."""
    with tempfile.TemporaryDirectory() as folder:
        command = [str(SIMULATOR), "paper", "--json", "--out", folder]
        study = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
        figures = {path.name: path.read_text(encoding="utf-8") for path in sorted(Path(folder).glob("*.svg"))}
        return study, (Path(folder) / "paper.md").read_text(encoding="utf-8"), figures


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


def measured_table(study, overall, on_sensors):
    """What the README has of all this: a line for each kind of flight."""
    claims = {claim["claim"]: claim for claim in study["claims"]}
    follows = claims["all follow within 0.5 s on average"]
    helix, smc = flight_row("helix"), next(row for row in overall if row["controller"] == "x500-smc")
    others = [f"{row['rms_ratio']:.1f}" for row in overall if row is not smc]
    sensors = {(report["scenario"], row["measure"]): row for report in on_sensors for row in report["rows"]}
    p95 = lambda scenario, measure: short(sensors[scenario, measure]["p95"])
    return table(
        ["what is flown", "measured", "command"],
        [
            ["the paper's own case: x, y, z follow, on average", f"from {follows['here']:.3f} s (the paper: 0.5 s)", "`paper`"],
            ["the helix on a vehicle with limits, from 5 m away", f"within 5 cm from {helix[1]} (to meet it exactly takes "
             f"{helix[2]} at least); then RMS {helix[4]} mm in x / y / z", "`run helix`"],
            ["96 cells of disturbances: RMS of PID, geometric control and INDI over ours, median over the cells",
             " / ".join(others), "`compare x500`"],
            ["hover on GNSS in 5 m/s of wind, 100 seeds: 95 % within", f"{p95('outdoor-hover', 'horizontal-error-p95-m')} m "
             f"horizontally, {p95('outdoor-hover', 'height-error-max-m')} m in height", "`assess outdoor-hover`"],
            ["a rotor lost at 20 m, thrust 3 times the weight, 100 seeds: 95 % touch down with at most", f"{p95('lost-rotor', 'touchdown-m-s')} m/s",
             "`assess lost-rotor`"],
        ],
    )


def picture(scenario, name):
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / scenario
        fly(scenario, "--out", str(out))
        return (out / name).read_text(encoding="utf-8")


def compare():
    """The comparison as JSON, as the text for its own page, and its picture."""
    with tempfile.TemporaryDirectory() as folder:
        command = [str(SIMULATOR), "compare", "x500", "--json", "--out", folder]
        result = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
        read = lambda name: (Path(folder) / name).read_text(encoding="utf-8")
        return result, read("compare.md"), read("compare-ratio.svg")


def comparison_row(overall, first):
    medians = overall["medians"]
    median = lambda key: medians[key]["median"]
    millimetres = lambda key: "lost" if median(key) is None else f"{1e3 * median(key):.1f}"
    against = "" if overall is first else f"{overall['worse_cells']} of {overall['cells']}"
    return [
        f"`{overall['controller']}`",
        millimetres("rms_m"),
        f"{overall['rms_ratio']:.2f}",
        millimetres("max_m"),
        f"{1e-6 * median('chattering_rad2_s3'):.2f}",
        f"{1e3 * median('torque_rms_n_m'):.0f}",
        f"{1e2 * median('saturated_fraction'):.2f}",
        f"{medians['survived']} of {medians['flights']}",
        against,
    ]


def comparison_table(result):
    first, *_ = result["overall"]
    for overall in result["overall"]:
        overall["cells"] = len(result["cells"])
    return table(
        ["tuning", "RMS, mm", "its ratio to the first's", "maximum, mm", "chattering, 10⁶ (rad/s)²/s", "torque RMS, mN m",
         "saturated, %", "survived", "cells with the greater RMS"],
        [comparison_row(overall, first) for overall in result["overall"]],
    )


# What of the flights on sensors stands in docs/results.md: scenario, measure, how it reads there, what is expected.
ON_SENSORS = [
    ("outdoor-hover", "climb-s", "climb to 10 m: from lift-off until within 0.35 m, s", "30; PX4’s test 30"),
    ("outdoor-hover", "height-error-max-m", "then height off its 10 m over 60 s, 5 m/s of wind, m", "PX4’s test 0.25"),
    ("outdoor-hover", "height-wander-max-m", "and off its own mean, m", "0.15"),
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
    ("lost-rotor", "horizontal-error-max-m", "and how far from where it failed, at most, m", "–"),
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
        ["flight", "scenario", "median", "95 %", "worst", "rms", "expected"],
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
    study, claims, paper_figures = paper()
    results = {"flights": flights_table(), "comparison": comparison_table(result)}
    readme, page_of_sensors = {}, {}
    if not fast:
        on_sensors = assess()
        results["sensors"] = sensors_table(on_sensors)
        readme["measured"] = measured_table(study, result["overall"], on_sensors)
        page_of_sensors["sensors"] = sensors_page(on_sensors)
    good = [
        check(README, updated(README.read_text(encoding="utf-8"), readme), write),
        check(RESULTS, updated(RESULTS.read_text(encoding="utf-8"), results), write),
        check(COMPARISON, updated(COMPARISON.read_text(encoding="utf-8"), {"comparison": page}), write),
        check(PAPER, updated(PAPER.read_text(encoding="utf-8"), {"claims": claims}), write),
        *(check(IMAGES / "paper" / name, svg, write) for name, svg in paper_figures.items()),
        check(SENSORS, updated(SENSORS.read_text(encoding="utf-8"), page_of_sensors), write),
        check(IMAGES / "helix.svg", picture("helix", "path.svg"), write),
        check(IMAGES / "outdoor-tour-path.svg", picture("outdoor-tour", "path.svg"), write),
        check(IMAGES / "outdoor-tour-flight.svg", picture("outdoor-tour", "flight.svg"), write),
        check(IMAGES / "compare-ratio.svg", ratios, write),
    ]
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
