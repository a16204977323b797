"""Lists of points: parameters and initial states that lie on no grid."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy
import xarray

from gearsweep._errors import InputError
from gearsweep._value import numbers_of, text_of

# The attribute of a coordinate that is a column of a list of points (host/result/dataset.hpp).
_SWEEPS = "sweeps"

Columns = list[tuple[str, "numpy.ndarray[Any, Any]"]]


def columns_of(points: Any) -> Columns:
    """The columns of a list of points.

    Parameters
    ----------
    points : mapping of str to array_like, or DataFrame
        Names of parameters and states with their values, shape ``(points,)``. A single number
        stands for all points.

    Returns
    -------
    list of (str, numpy.ndarray)
        Columns of one length, finite.

    Raises
    ------
    InputError
        It is no such table.
    """
    if hasattr(points, "columns") and hasattr(points, "to_dict"):
        points = {name: points[name].to_numpy() for name in points.columns}
    if not isinstance(points, Mapping):
        raise InputError(
            "points: expected a DataFrame, or a dict of arrays such as {'omega': [0.6, 0.7], "
            f"'mu': [0, 0.1]}}, not one of the type {type(points).__name__}"
        )
    columns = [_column(name, values) for name, values in points.items()]
    counts = {name: numbers.size for name, numbers in columns if numbers.ndim == 1}
    if not counts:
        raise InputError("points: there is no column with a value for each point")
    count = max(counts.values())
    for name, size in counts.items():
        if size != count:
            raise InputError(f"points: {name!r} has {size} values, but another column has {count}")
    if count == 0:
        raise InputError("points: there are no points")
    return [(name, numpy.broadcast_to(numbers, count)) for name, numbers in columns]


def is_column(coordinate: xarray.DataArray) -> bool:
    """Whether a coordinate is a column of a list of points."""
    return _SWEEPS in coordinate.attrs and coordinate.dims == ("point",)


def points_in(maps: xarray.Dataset) -> Columns:
    """The columns of the list of points that made a Dataset; none where it has axes alone."""
    return [
        _column(str(coordinate.attrs[_SWEEPS]), coordinate.values)
        for coordinate in maps.coords.values()
        if is_column(coordinate)
    ]


def _column(name: Any, values: Any) -> tuple[str, numpy.ndarray[Any, Any]]:
    text = text_of(name, "points with the names of parameters and states")
    numbers = numbers_of(values, f"points: {text!r}", "an array of numbers")
    if numbers.ndim > 1:
        raise InputError(
            f"points: {text!r} has the shape {numbers.shape}; each point has one number"
        )
    bad = numpy.flatnonzero(~numpy.isfinite(numbers))
    if bad.size > 0:
        value = numbers.reshape(-1)[bad[0]]
        raise InputError(f"points: {text!r} is {value} at point {bad[0] + 1}; it must be finite")
    return text, numbers
