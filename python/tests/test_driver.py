"""gearsweep-pocl, the driver for users without root: what it sets and what it leaves alone. `.ci/wheel_trial`
runs it in a bare system."""

import importlib.util
import os
import pathlib
import subprocess

import pytest

PACKAGE = pathlib.Path(__file__).parents[2] / "packaging" / "pocl" / "gearsweep_pocl"


@pytest.fixture
def driver(monkeypatch, tmp_path_factory):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
    for name in ("OCL_ICD_VENDORS", "OPENCL_VENDOR_PATH", "COMPILER_PATH"):
        monkeypatch.setenv(name, "")
    spec = importlib.util.spec_from_file_location("gearsweep_pocl", PACKAGE / "__init__.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_a_machine_without_drivers_takes_the_one_of_the_package(driver, tmp_path):
    assert driver.offer(tmp_path)
    assert os.environ["OCL_ICD_VENDORS"].endswith("gearsweep_pocl/lib/driver/libpocl.so.2")
    assert os.environ["COMPILER_PATH"] == str(PACKAGE / "bin")


def test_other_drivers_of_the_machine_stay(driver, tmp_path):
    (tmp_path / "nvidia.icd").write_text("libnvidia-opencl.so.1\n")
    assert driver.offer(tmp_path)
    named = [path.read_text().strip() for path in pathlib.Path(os.environ["OCL_ICD_VENDORS"]).glob("*.icd")]
    assert len(named) == 2
    assert "libnvidia-opencl.so.1" in named
    assert any(name.endswith("libpocl.so.2") for name in named)


def test_without_a_folder_to_write_in_the_driver_stands_alone(driver, monkeypatch, tmp_path):
    (tmp_path / "nvidia.icd").write_text("libnvidia-opencl.so.1\n")
    monkeypatch.setenv("XDG_CACHE_HOME", "/proc/none")
    assert driver.offer(tmp_path)
    assert os.environ["OCL_ICD_VENDORS"].endswith("libpocl.so.2")


def test_a_machine_with_pocl_keeps_its_own(driver, tmp_path):
    (tmp_path / "pocl.icd").write_text("libpocl.so.2.10.0\n")
    assert not driver.offer(tmp_path)
    assert os.environ["OCL_ICD_VENDORS"] == ""
    assert os.environ["COMPILER_PATH"] == ""


def test_drivers_that_the_user_chose_stay(driver, monkeypatch, tmp_path):
    monkeypatch.setenv("OCL_ICD_VENDORS", "/opt/drivers")
    assert not driver.offer(tmp_path)
    assert os.environ["OCL_ICD_VENDORS"] == "/opt/drivers"


def linked(arguments, tmp_path):
    """Which linker does the work, of the package's and the machine's, and with what."""
    package = tmp_path / "bin"
    machine = tmp_path / "machine"
    for folder, name in ((package, "ld.lld"), (machine, "ld")):
        folder.mkdir()
        program = folder / name
        program.write_text(f'#!/bin/sh\necho "{folder.name}" "$@"\n')
        program.chmod(0o755)
    (package / "ld").write_text((PACKAGE / "bin" / "ld").read_text())
    (package / "ld").chmod(0o755)
    done = subprocess.run([package / "ld", *arguments], env={"PATH": f"{machine}:/usr/bin:/bin"},
                          capture_output=True, text=True, check=True)
    return done.stdout.split()


def test_kernels_are_linked_by_the_package(tmp_path):
    said = linked(["-shared", "-o", "/c/tempfile_Ab12xY.so", "/c/tempfile_0zVQjU.so.o", "-lm"], tmp_path)
    assert said[0] == "bin"
    assert said[1] == "-L"
    assert said[-2:] == ["/c/tempfile_0zVQjU.so.o", "-lm"]


def test_all_else_is_linked_by_the_machine(tmp_path):
    assert linked(["-o", "a.out", "main.o", "-lm"], tmp_path) == ["machine", "-o", "a.out", "main.o", "-lm"]
