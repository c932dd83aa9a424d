#!/usr/bin/env python3
"""Checks a flight's truth.csv against the equations of docs/simulation.md, without any code of the project.

From each row the motion is integrated to the next row's time, and compared with that row. For flights of the paper's
airframe on the rigid-body plant, in the air and undisturbed: `tests/check_truth.py runs/helix/truth.csv [LAG_S]`. The
rotors' lag is that of the scenario and the airframe beside the file, unless LAG_S is given. What else was flown with, by
the scenario, is named in one line, and the exit code is 2.
"""

import csv
import math
import sys
import tomllib
from pathlib import Path

# Table 2 of the paper.
B, D, MASS, ARM, ROTOR_INERTIA = 29.8e-4, 33e-6, 0.823, 0.350, 28.4e-4
DRAG, TURNING_DRAG, INERTIA, GRAVITY = 0.3729, 0.0556, (0.5e-2, 0.5e-2, 0.1e-2), 9.81
STEP_S = 1e-3
# Rounding of f64 over a step, in m, m/s and rad/s.
TOLERANCE = 1e-12


def derivative(state, omega):
    """Of position, velocity, attitude (body to world) and body rates; NWU and FLU."""
    _, _, _, vx, vy, vz, w, x, y, z, p, q, r = state
    w1, w2, w3, w4 = (speed * speed for speed in omega)
    lift = B * (w1 + w2 + w3 + w4) / MASS
    ix, iy, iz = INERTIA
    spin = ROTOR_INERTIA * (-omega[0] + omega[1] - omega[2] + omega[3])
    return (
        vx, vy, vz,
        2 * (x * z + w * y) * lift - DRAG / MASS * vx,
        2 * (y * z - w * x) * lift - DRAG / MASS * vy,
        (1 - 2 * (x * x + y * y)) * lift - DRAG / MASS * vz - GRAVITY,
        (-x * p - y * q - z * r) / 2,
        (w * p + y * r - z * q) / 2,
        (w * q - x * r + z * p) / 2,
        (w * r + x * q - y * p) / 2,
        (ARM * B * (w4 - w2) - (iz - iy) * q * r - spin * q - TURNING_DRAG * p * abs(p)) / ix,
        (ARM * B * (w3 - w1) - (ix - iz) * p * r + spin * p - TURNING_DRAG * q * abs(q)) / iy,
        (D * (w1 - w2 + w3 - w4) - (iy - ix) * p * q - TURNING_DRAG * r * abs(r)) / iz,
    )


def add(state, slope, h):
    return tuple(a + h * b for a, b in zip(state, slope))


def next_state(state, omega, command, lag_s):
    """A step of RK4; the rotors approach their command exponentially."""
    after = lambda time: [c + (o - c) * math.exp(-time / lag_s) for o, c in zip(omega, command)] if lag_s else omega
    half, end = after(STEP_S / 2), after(STEP_S)
    k1 = derivative(state, omega)
    k2 = derivative(add(state, k1, STEP_S / 2), half)
    k3 = derivative(add(state, k2, STEP_S / 2), half)
    k4 = derivative(add(state, k3, STEP_S), end)
    slope = [(a + 2 * b + 2 * c + d) / 6 for a, b, c, d in zip(k1, k2, k3, k4)]
    state = add(state, slope, STEP_S)
    norm = math.sqrt(sum(value * value for value in state[6:10]))
    return state[:6] + tuple(value / norm for value in state[6:10]) + state[10:]


def largest_difference(path, lag_s):
    predicted, largest, rows = None, 0.0, 0
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            values = [float(value) for value in row.values()]
            state, omega, command = tuple(values[1:14]), values[14:18], values[32:36]
            if predicted is not None:
                largest = max(largest, *(abs(a - b) for a, b in zip(state, predicted)))
            predicted, rows = next_state(state, omega, command, lag_s), rows + 1
    return largest, rows


def settings(folder):
    """The scenario and the airframe of a flight's folder; empty where there is none."""
    toml = lambda name: tomllib.loads((folder / name).read_text(encoding="utf-8")) if (folder / name).is_file() else {}
    return toml("scenario.toml"), toml("airframe.toml")


def rotor_lag_s(folder):
    """The plant's: the truth's, the scenario's, the airframe's, in this order."""
    flown, airframe = settings(folder)
    tables = (flown.get("truth", {}), flown, airframe)
    return next((table["rotor_lag_s"] for table in tables if "rotor_lag_s" in table), 0.0)


def not_modelled(folder):
    """What of a flight's folder these equations do not have."""
    flown, airframe = settings(folder)
    found = [f"plant = {flown['plant']}"] if flown.get("plant", "rigid-body") != "rigid-body" else []
    found += ["another airframe"] if airframe.get("mass_kg", MASS) != MASS else []
    found += [key for key in ("ground", "wind", "push", "battery", "fault") if flown.get(key)]
    pushes = ("acceleration_m_s2", "angular_acceleration_rad_s2")
    found += ["disturbance"] if any(flown.get("disturbance", {}).get(key) for key in pushes) else []
    sound = {"mass_factor": 1.0, "inertia_factor": 1.0, "rotor_effectiveness": [1.0] * 4}
    found += [f"truth.{key}" for key, value in flown.get("truth", {}).items() if key in sound and value != sound[key]]
    return found + [f"world.{key}" for key, value in flown.get("world", {}).items() if value]


def main():
    if len(sys.argv) not in (2, 3) or not Path(sys.argv[1]).is_file():
        print("usage: check_truth.py FOLDER/truth.csv [LAG_S], of a flight that `sim-host run … --out FOLDER` has written")
        return 2
    folder = Path(sys.argv[1]).parent
    found = not_modelled(folder)
    if found:
        print(f"{sys.argv[1]}: cannot be checked, for it was flown with {', '.join(found)}, which this script does not model")
        return 2
    largest, rows = largest_difference(sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else rotor_lag_s(folder))
    print(f"{rows} rows; the largest difference from one row to the next is {largest:.1e}")
    return 0 if rows > 1 and largest < TOLERANCE else 1


if __name__ == "__main__":
    sys.exit(main())
