"""Results in rpm, µm, N: of studies with a [gear] table."""

from __future__ import annotations

from typing import Any

import numpy
import xarray

from gearsweep import _core
from gearsweep._errors import InputError

# What tells the scales of a variable, or of the states along a dimension, before it is converted.
# The attribute of a Dataset that was converted.
IN_SI = "in_si"
_TOLD = ("scale_to_SI", "SI_units")


def in_si(data: xarray.Dataset) -> xarray.Dataset:
    """The same result with coordinates and values in rpm, µm, mm/s, N, ..., as pictures show it.

    Parameters
    ----------
    data : Dataset
        A result, or traces.

    Returns
    -------
    Dataset

    Raises
    ------
    InputError
        The study has no [gear] table.
    """
    scales = _core.scales_in(dict(data.attrs))
    if scales is None:
        raise InputError("the Dataset has no scales; a study with a [gear] table has them")
    told = [name for name in data.variables if str(name).endswith(_TOLD)]
    made = data.drop_vars(told)
    coordinates: dict[Any, xarray.Variable] = {}
    values: dict[Any, xarray.Variable] = {}
    for name, variable in made.variables.items():
        changed = _converted(variable, data, scales, is_axis=name in data.dims)
        if str(name).endswith("_units"):
            changed = _renamed(variable, scales)
        if changed is not None:
            (coordinates if name in made.coords else values)[name] = changed
    return made.assign_coords(coordinates).assign(values).assign_attrs({IN_SI: 1})


def _converted(
    variable: xarray.Variable, data: xarray.Dataset, scales: _core.Scales, is_axis: bool
) -> xarray.Variable | None:
    unit = variable.attrs.get("units", "")
    listed = data.variables.get(unit.removeprefix("see "))
    if unit.startswith("see ") and listed is not None:
        factors = [_scale(str(one), scales) for one in listed.values.tolist()]
        factor = xarray.Variable(listed.dims, numpy.array(factors, dtype=variable.dtype))
        product: xarray.Variable = (variable * factor).transpose(*variable.dims)
        product.attrs.update(variable.attrs)
        product.encoding.update(variable.encoding)
        return product
    shown = _core.shown_unit(unit, scales)
    if shown is None:
        return None
    scale, name, axis_meaning = shown
    changed: xarray.Variable = variable.copy(data=variable.values * scale)
    changed.attrs["units"] = name
    if is_axis and axis_meaning:
        changed.attrs["long_name"] = axis_meaning
    for told in _TOLD:
        changed.attrs.pop(told, None)
    return changed


def _renamed(variable: xarray.Variable, scales: _core.Scales) -> xarray.Variable:
    """A list of units."""
    units = [str(unit) for unit in variable.values.tolist()]
    shown = [_core.shown_unit(unit, scales) for unit in units]
    names = [one if si is None else si[1] for one, si in zip(units, shown, strict=True)]
    renamed: xarray.Variable = variable.copy(data=numpy.array(names, dtype=object))
    return renamed


def _scale(unit: str, scales: _core.Scales) -> float:
    shown = _core.shown_unit(unit, scales)
    return 1.0 if shown is None else shown[0]
