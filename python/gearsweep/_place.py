"""Points of studies and maps, and the numbers that belong to them."""

from __future__ import annotations

import operator
import os
from collections.abc import Mapping
from typing import Any

import numpy
import xarray

from gearsweep import _core
from gearsweep._errors import InputError
from gearsweep._value import numbers_of, path_of, shown, text_of


def place_of(*values: Mapping[str, Any]) -> list[tuple[str, float]]:
    """Names of parameters and initial states with their values; the last mapping wins."""
    merged: dict[str, Any] = {}
    for mapping in values:
        if not isinstance(mapping, Mapping):
            raise InputError("at: a point is a dict such as {'omega': 0.7, 'b': 1.0}")
        merged.update(mapping)
    return [(_name(name), number_of(value, name)) for name, value in merged.items()]


def _name(name: Any) -> str:
    return text_of(name, "the name of a parameter or a state")


def number_of(value: Any, name: str) -> float:
    """A number, whatever holds it: NumPy's and xarray's scalars, too."""
    if not isinstance(value, str | bytes | bool) and numpy.size(value) == 1:
        return float(numbers_of(value, name, "a number").reshape(-1)[0])
    raise InputError(f"{name}: expected a number, not {shown(value)}")


def count_of(value: Any, name: str, smallest: int, largest: int) -> int | None:
    """A whole number of this range, or None."""
    if value is None:
        return None
    try:
        count = operator.index(value)
    except TypeError:
        raise InputError(f"{name}: expected a whole number, not {shown(value)}") from None
    if isinstance(value, bool) or not smallest <= count <= largest:
        raise InputError(f"{name}: {shown(value)} is not in {smallest} .. {largest}")
    return count


def pilot_step_of(source: Any) -> _core.FoundStep | None:
    """The step that the pilot run of a map has found, of a study that comes with its map."""
    if isinstance(source, xarray.Dataset):
        step = source.attrs.get("pilot_max_step")
        if step is None:
            return None
        parts = number_of(source.attrs.get("pilot_orbit_steps", 1), "pilot_orbit_steps")
        if parts not in range(1, _core.MAX_ORBIT_STEPS + 1):
            most = _core.MAX_ORBIT_STEPS
            raise InputError(f"pilot_orbit_steps: {shown(parts)} is not in 1 .. {most}")
        return _core.FoundStep(number_of(step, "pilot_max_step"), int(parts))
    if isinstance(source, str | os.PathLike):
        path = path_of(source, "a path or the name of a study")
        if _core.is_netcdf(path):
            return _core.read_pilot_step(path)
    return None
