"""A program of a user's, whose types mypy follows from the package into it. It need not run."""

from __future__ import annotations

from pathlib import Path
from typing import Any, assert_type

import numpy
import xarray

import gearsweep as gs


def tell(news: gs.Progress) -> None:
    assert_type(news.share, float)
    assert_type(news.points_done, int)


def strongest(folder: Path, frictions: list[float]) -> list[float]:
    base = gs.Study.read(folder / "mine.toml")
    assert_type(base, gs.Study)
    assert_type(base.axes, dict[str, int])
    found = []
    for friction in frictions:
        study = base.set({"parameters.mu": friction, "axes.omega.values": numpy.arange(0.5, 1.5)})
        maps = gs.run(study, progress=tell, journal=folder / "run.journal", device=0)
        assert_type(maps, xarray.Dataset)
        found.append(float(maps.dmf_max.max()))
    return found


def tolerant(study: gs.Study, loads: list[float]) -> gs.Study:
    mass = gs.triangular(0.3, 0.35, 0.4)
    assert_type(mass, dict[str, Any])
    return study.uncertain(m1=mass, b=gs.normal(0.01, mean=1.0), F1=gs.values(loads))


def describe() -> str:
    gear = gs.model("gear5")
    limits = [(parameter.minimum, parameter.maximum) for parameter in gear.parameters]
    assert_type(limits, list[tuple[float, float]])
    assert_type(gs.models(), dict[str, str])
    assert_type([device.fp64 for device in gs.devices()], list[bool])
    try:
        return gs.Study("[model]").toml
    except gs.InputError as error:
        assert_type(error, gs.InputError)
        refusal: ValueError = error
        return str(refusal)


def look_closer(maps: xarray.Dataset) -> bool:
    trace = gs.trace(maps, omega=maps.omega[2], e0=0.5, record=8)
    assert_type(trace, xarray.Dataset)
    gs.trace(maps, at=[{"omega": 0.7}, {"omega": numpy.float64(0.9)}], e0=0.5)
    orbit = gs.floquet(maps, e0=0.5, along=("omega", 0.5, 0.7))
    assert_type(orbit, xarray.Dataset)
    gs.floquet(maps, e0=0.5, along=("omega", 0.5, 0.7), switch=2)
    page = gs.explore(maps, curves=gs.curves(maps))
    assert_type(page.url, str)
    page.stop()
    gs.explore(maps, curves="curves.nc").stop()
    verification = gs.verify(progress=lambda check: print(check.figures))
    assert_type(verification.checks, tuple[gs.Check, ...])
    return verification.passed


def mistakes() -> None:
    """Mypy finds each of these; where it does not, the comment is an error of its own."""
    gs.run(3)  # type: ignore[arg-type]
    gs.run("coarse-map", progress=3)  # type: ignore[arg-type]
    gs.run("coarse-map", engine="opencl")  # type: ignore[call-arg]
    gs.trace("coarse-map", omega="fast")  # type: ignore[arg-type]
    gs.floquet("coarse-map", along="omega")  # type: ignore[arg-type]
    gs.floquet("coarse-map", along=("omega", 0.5, 0.7), switch="two")  # type: ignore[arg-type]
    gs.Study.read("coarse-map").toml = "mine"  # type: ignore[misc]
