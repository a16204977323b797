"""What the module gives to NumPy 2 is what it gives to NumPy 1, whatever pybind11 it was built with."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy
import pytest

from gearsweep import _core

# The module alone: it needs nothing else of Debian's, which is built for NumPy 1.
SCRIPT = """
import hashlib, importlib.util, sys
import numpy
spec = importlib.util.spec_from_file_location("gearsweep._core", sys.argv[1])
core = importlib.util.module_from_spec(spec)
spec.loader.exec_module(core)
changes = ["axes.omega.count=3", "axes.e0.count=2", "integrate.settle=5", "integrate.record=3"]
changes += ["observe.quantities=['x1_rms', 'poincare', 'motion_class', 'contact_class']"]
changes += ["observe.poincare=['x1', 'v1']"]
study = core.find_study("coarse-map", changes)
variables, _ = core.Session().run(
    study=study, device="", journal="", call="", progress=None, priority=0
)[0]
points = core.read_draft("[model]\\n", "s", [], [("mu", numpy.array([0.1, 0.2]))])
print("NumPy", numpy.__version__)
print(points.toml)
classes = core.classes_of("status", ["ok", "diverged"], numpy.array([1.0, 0.0, 1.0]), None, None)
print(classes[0].tolist(), classes[1:])
for name, dimensions, array, attributes in variables:
    print(name, dimensions, array.dtype.str, array.shape, array.tolist())
    for key, value in attributes.items():
        is_array = isinstance(value, numpy.ndarray)
        print(" ", key, (value.dtype.str, value.tolist()) if is_array else repr(str(value)))
"""


def numpy_2() -> Path:
    """A folder with NumPy 2, which stays where the package was built."""
    folder = Path(os.environ["NUMPY_2"])
    if not (folder / "numpy").exists():
        pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--retries", "0"]
        pip += ["--timeout", "10", "--target", str(folder), "numpy>=2,<3"]
        done = subprocess.run(pip, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            pytest.skip(f"PyPI gives no NumPy 2 here: {done.stderr.strip().splitlines()[-1:]}")
    return folder


def said_with(path: list[Path]) -> list[str]:
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, path))}
    done = subprocess.run(
        [sys.executable, "-W", "error::RuntimeWarning", "-c", SCRIPT, _core.__file__],
        env=environment, capture_output=True, text=True, check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


def test_the_module_gives_the_same_to_numpy_1_and_2():
    if int(numpy.__version__.partition(".")[0]) > 1:
        pytest.skip("there is no NumPy 1 here")
    first, *one = said_with([])
    second, *two = said_with([numpy_2()])
    assert first.startswith("NumPy 1.") and second.startswith("NumPy 2.")
    assert two == one
    # So that the test compares what once was wrong: codes, and texts as letters.
    assert any("flag_values" in line and "[0, 1, 2" in line for line in one)
    assert any("|S1" in line for line in one)
