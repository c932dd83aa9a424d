#!/usr/bin/env python3
"""Applies the worked examples of docs/extending.md to a copy of the tree, builds it once, runs each example's own test,
and flies each, judged by the true motion.

    python3 tests/examples.py            check
    python3 tests/examples.py --apply    only whether the patches apply
    python3 tests/examples.py --refresh  re-make docs/examples/*.patch after the code around them has moved

Each patch must apply to the tree as it stands, alone and after those before it.
"""

import csv
import json
import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WORK = ROOT / "target" / "examples"
TREE = WORK / "tree"
NAMES = ["trajectory", "reaching-law", "controller", "parameter", "sensor"]
# The examples' own tests: package, target, filters.
TESTS = [
    ("firmware", ["--features=pil-wire", "--lib"], ["derivatives_are_those", "settings_out_of_range", "is_decoded_as_it_was_encoded"]),
    ("firmware", ["--features=pil-wire", "--test=suite"], ["sliding::rational", "sliding::every_law"]),
    ("glissade-sil", ["--lib"], ["baseline::lqr", "sensors::flow", "controller::tests"]),
]
# git must take the copy for what it is: files, not a part of the repository above it.
ENVIRONMENT = {
    **os.environ,
    "GIT_CEILING_DIRECTORIES": str(WORK),
    "CARGO_TARGET_DIR": str(WORK / "build"),
}


def patch(name):
    return ROOT / "docs" / "examples" / f"{name}.patch"


def run(command, cwd=TREE, **more):
    return subprocess.run(command, cwd=cwd, env=ENVIRONMENT, text=True, capture_output=True, check=False, **more)


def must(command, what, cwd=TREE):
    done = run(command, cwd)
    if done.returncode != 0:
        sys.exit(f"{what}:\n{done.stdout}{done.stderr}")
    return done.stdout


def copy_tree():
    """The files of the working tree with their times, so that cargo rebuilds what has changed."""
    shutil.rmtree(TREE, ignore_errors=True)
    listed = must(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], "no list of files", ROOT)
    for name in filter(None, listed.split("\0")):
        if (ROOT / name).is_file():
            (TREE / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, TREE / name)


def apply_all():
    for name in NAMES:
        done = run(["git", "apply", "--check", patch(name)])
        if done.returncode != 0:
            sys.exit(
                f"docs/examples/{name}.patch no longer applies:\n{done.stderr}"
                "re-make it with `python3 tests/examples.py --refresh`, and look at the difference"
            )
    for name in NAMES:
        must(["git", "apply", patch(name)], f"docs/examples/{name}.patch does not apply after those before it")


# ---------------------------------------------------------------------------------------------------- the flights


def fly(arguments):
    """The rows of truth.csv."""
    out = WORK / "flight"
    shutil.rmtree(out, ignore_errors=True)
    binary = WORK / "build" / "fast" / "sim-host"
    summary = must([binary, "run", *arguments, "--json", "--out", out], f"`sim-host run {' '.join(arguments)}` failed")
    assert json.loads(summary)["survived"], f"{arguments}: the vehicle was lost"
    with (out / "truth.csv").open() as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


# The satellites are lost at 30 s, and the vehicle comes down: it has landed at 55 s.
LOST = ["path-gnss-lost", "--set", "duration_s=60"]


def off(row):
    return math.dist([row["x_m"], row["y_m"], row["z_m"]], [row["ref_x_m"], row["ref_y_m"], row["ref_z_m"]])


def worst(rows, from_s):
    return max(off(row) for row in rows if row["t_s"] >= from_s)


def at(rows, t_s):
    return rows[round(t_s * 1e3)]


def trajectory():
    rows = fly(["sim-host/scenarios/circle.toml"])
    radii = [math.hypot(row["x_m"], row["y_m"]) for row in rows if row["t_s"] > 5]
    assert 2.98 < min(radii) and max(radii) < 3.02, f"the circle's radius is 3 m, not {min(radii)} to {max(radii)}"
    assert worst(rows, 5) < 0.02, worst(rows, 5)


def reaching_law():
    law = "control.x.reaching={ rational = { rho = 0.1 } }"
    rows = fly(["helix", "--set", law, "--set", law.replace(".x.", ".y.")])
    assert worst(rows, 5) < 0.05, worst(rows, 5)
    assert worst(rows, 5) != worst(fly(["helix"]), 5), "the law is flown"


def controller():
    rows = fly(["x500-helix", "--set", "tuning=./sim-host/tunings/x500-lqr.toml"])
    assert worst(rows, 6) < 0.2, worst(rows, 6)


def parameter():
    """A descent from 5 m to 3 m at the speed of a touchdown takes (1 m/s)/(0.4 m/s) times as long as before."""

    def from_5_to_3(height):
        rows = fly([*LOST, "--set", f"modes.final_height_m={height}"])
        last = max(row["t_s"] for row in rows if row["z_m"] > 5)
        return max(row["t_s"] for row in rows if row["z_m"] > 3) - last

    ratio = from_5_to_3(6) / from_5_to_3(2)
    assert 2.2 < ratio < 2.8, ratio


def sensor():
    """By the flow the vehicle stops where the satellites are lost, and lands there."""
    rows = fly([*LOST, "--set", 'sensors={ suite = "gnss", flow = { part = "flow" } }'])
    drift = math.dist([at(rows, 38)["x_m"], at(rows, 38)["y_m"]], [rows[-1]["x_m"], rows[-1]["y_m"]])
    assert drift < 1.0, f"{drift} m from where it stopped to where it stands"
    plain = fly(LOST)
    without = math.dist([at(plain, 38)["x_m"], at(plain, 38)["y_m"]], [plain[-1]["x_m"], plain[-1]["y_m"]])
    assert drift < 0.5 * without, f"{drift} m with the sensor, {without} m without"


# ---------------------------------------------------------------------------------------------------------- main


def check(build):
    copy_tree()
    apply_all()
    if not build:
        return
    must(["cargo", "build", "--quiet", "--profile", "fast", "-p", "sim-host"], "the tree with the examples does not build")
    failed = 0
    for package, target, filters in TESTS:
        command = ["cargo", "test", "--quiet", "--profile", "fast", "-p", package, *target, "--", *filters]
        told = must(command, f"a test of the examples fails ({package})")
        assert "running 0 tests" not in told, f"{package} {target}: no test is called {filters}"
    for example in [trajectory, reaching_law, controller, parameter, sensor]:
        try:
            example()
            print(f"{example.__name__}: applied, built, tested, flown")
        except AssertionError as error:
            failed += 1
            print(f"{example.__name__}: FAILED: {error}")
    print(f"\n{len(NAMES) - failed} passed, {failed} failed")
    sys.exit(failed > 0)


def refresh():
    """One commit an example on a clone of HEAD, by three-way merges; what conflicts is left there to be resolved."""
    clone = WORK / "refresh"
    git = ["git", "-c", "user.name=examples", "-c", "user.email=examples@localhost"]
    shutil.rmtree(clone, ignore_errors=True)
    must(["git", "clone", "--quiet", "--shared", ROOT, clone], "no clone", ROOT)
    for name in NAMES:
        done = run([*git, "apply", "--3way", "--index", patch(name)], clone)
        if done.returncode != 0:
            sys.exit(
                f"{name}: {done.stderr}resolve it in {clone.relative_to(ROOT)}, `git add` it, then\n"
                f"    git -C {clone.relative_to(ROOT)} diff --cached > docs/examples/{name}.patch\n"
                "commit, and refresh again"
            )
        patch(name).write_text(must([*git, "diff", "--cached"], "no difference", clone))
        must([*git, "commit", "--quiet", "-m", name], "cannot commit", clone)


if __name__ == "__main__":
    refresh() if "--refresh" in sys.argv[1:] else check(build="--apply" not in sys.argv[1:])
