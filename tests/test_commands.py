"""The release binary as `cargo build --release` makes it: what it leaves out, it says how to get."""

import subprocess

import pytest


@pytest.mark.parametrize("arguments", [["plan", "helix"], ["tune", "x500-smc", "--out", "never-made"]])
def test_a_search_names_the_build_that_can(arguments, simulator_path, tmp_path):
    result = subprocess.run(
        [simulator_path, *arguments], cwd=tmp_path, capture_output=True, text=True, timeout=60, check=False
    )
    assert result.returncode == 2 and result.stdout == ""
    assert result.stderr.count("\n") == 1
    assert f"use `cargo run --release --features search -- {arguments[0]} …`" in result.stderr
    assert not list(tmp_path.iterdir())
