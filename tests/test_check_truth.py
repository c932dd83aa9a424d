"""The independent check of truth.csv says what it does not model."""

import subprocess
import sys
from pathlib import Path

CHECK = Path(__file__).resolve().parent / "check_truth.py"


def test_a_flight_in_wind_is_refused_in_one_line(tmp_path):
    (tmp_path / "scenario.toml").write_text('plant = "rigid-body"\n[wind]\nmean_m_s = [3.0, 0.0, 0.0]\n')
    truth = tmp_path / "truth.csv"
    truth.touch()
    done = subprocess.run([sys.executable, CHECK, truth], capture_output=True, text=True, check=False)
    expected = f"{truth}: cannot be checked, for it was flown with wind, which this script does not model\n"
    assert (done.returncode, done.stdout, done.stderr) == (2, expected, "")


def test_a_file_that_is_not_there_is_answered_with_the_usage(tmp_path):
    done = subprocess.run([sys.executable, CHECK, tmp_path / "none.csv"], capture_output=True, text=True, check=False)
    assert done.returncode == 2 and done.stdout.startswith("usage: ") and done.stderr == ""
