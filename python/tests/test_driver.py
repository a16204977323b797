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
    for name in ("OCL_ICD_VENDORS", "OPENCL_VENDOR_PATH", "COMPILER_PATH", "CONDA_PREFIX"):
        monkeypatch.setenv(name, "")
    spec = importlib.util.spec_from_file_location("gearsweep_pocl", PACKAGE / "__init__.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def named_drivers():
    folder = pathlib.Path(os.environ["OCL_ICD_VENDORS"])
    return [path.read_text().strip() for path in sorted(folder.glob("*.icd"))]


def test_a_machine_without_drivers_takes_the_one_of_the_package(driver, tmp_path):
    assert driver.offer(tmp_path)
    assert named_drivers() == [str(PACKAGE / "lib" / "driver" / "libpocl.so.2")]
    assert os.environ["COMPILER_PATH"] == str(PACKAGE / "bin")


def test_other_drivers_of_the_machine_stay(driver, tmp_path):
    (tmp_path / "nvidia.icd").write_text("libnvidia-opencl.so.1\n")
    assert driver.offer(tmp_path)
    named = named_drivers()
    assert len(named) == 2
    assert "libnvidia-opencl.so.1" in named
    assert any(name.endswith("libpocl.so.2") for name in named)


def test_drivers_of_conda_stay(driver, monkeypatch, tmp_path):
    vendors = tmp_path / "etc" / "OpenCL" / "vendors"
    vendors.mkdir(parents=True)
    (vendors / "intel.icd").write_text("libintelocl.so\n")
    monkeypatch.setenv("CONDA_PREFIX", str(tmp_path))
    assert driver.offer(tmp_path)
    assert "libintelocl.so" in named_drivers()


def test_a_folder_that_others_may_write_into_names_no_driver(driver, tmp_path):
    assert driver.offer(tmp_path)
    folder = pathlib.Path(os.environ["OCL_ICD_VENDORS"])
    folder.chmod(0o777)
    os.environ["OCL_ICD_VENDORS"] = ""
    assert driver.offer(tmp_path)
    assert os.environ["OCL_ICD_VENDORS"].endswith("libpocl.so.2")


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


def linked(arguments, tmp_path, **environment):
    """Which linker does the work, of the package's, a compiler's and the machine's, and with what."""
    package = tmp_path / "bin"
    for folder, name in (("lib/driver", "ld.lld"), ("compilers", "ld"), ("machine", "ld")):
        program = tmp_path / folder / name
        program.parent.mkdir(parents=True)
        program.write_text(f'#!/bin/sh\necho "{program.parent.name}" "$@"\n')
        program.chmod(0o755)
    package.mkdir()
    (package / "ld").write_text((PACKAGE / "bin" / "ld").read_text())
    (package / "ld").chmod(0o755)
    done = subprocess.run([package / "ld", *arguments], capture_output=True, text=True, check=True,
                          env={"PATH": f"{tmp_path / 'machine'}:/usr/bin:/bin", **environment})
    return done.stdout.split()


def test_kernels_are_linked_by_the_package(tmp_path):
    said = linked(["-shared", "-o", "/c/tempfile_Ab12xY.so", "/c/tempfile_0zVQjU.so.o", "-lm"], tmp_path)
    assert said[0] == "driver"
    assert said[1] == "-L"
    assert said[-2:] == ["/c/tempfile_0zVQjU.so.o", "-lm"]


def test_all_else_is_linked_by_the_machine(tmp_path):
    assert linked(["-o", "a.out", "main.o", "-lm"], tmp_path) == ["machine", "-o", "a.out", "main.o", "-lm"]


def test_a_compiler_that_has_a_linker_of_its_own_keeps_it(tmp_path):
    folders = f"{tmp_path / 'bin'}:{tmp_path / 'compilers'}"
    assert linked(["main.o"], tmp_path, COMPILER_PATH=folders) == ["compilers", "main.o"]
