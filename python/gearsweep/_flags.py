"""Classes with names, as results have them."""

from __future__ import annotations

import numpy
import xarray

from gearsweep import _core
from gearsweep._errors import InputError
from gearsweep._value import text_of


def flags_of(variable: xarray.DataArray) -> dict[int, str]:
    """The names of a map's classes.

    Parameters
    ----------
    variable : DataArray
        A map of a result.

    Returns
    -------
    dict of int to str
        Names by the value that stands for each; empty of what is no map of classes.
    """
    values = numpy.atleast_1d(variable.attrs.get("flag_values", []))
    names = variable.attrs.get("flag_meanings", "").split()
    return {int(value): name for value, name in zip(values, names, strict=False)}


def names_of_flags(variable: xarray.DataArray) -> xarray.DataArray:
    """The names in place of the numbers; empty where a point has none.

    Parameters
    ----------
    variable : DataArray
        A map of classes.

    Returns
    -------
    DataArray
    """
    flags = flags_of(variable)
    codes = numpy.nan_to_num(variable.values.astype(float), nan=-1.0)
    names = numpy.array([flags.get(int(code), "") for code in codes.flat], dtype=object)
    made = variable.copy(data=names.reshape(codes.shape))
    made.attrs = {key: value for key, value in made.attrs.items() if not key.startswith("flag_")}
    return made


def class_names(maps: xarray.Dataset, quantity: str) -> xarray.DataArray:
    """The map of classes of a result, by its name, as `names_of_flags` has it."""
    name = text_of(quantity, "the name of a map of classes")
    known = [str(one) for one, variable in maps.data_vars.items() if flags_of(variable)]
    if name not in known:
        known_to_it = _core.suggest_name(name, known) if known else ""
        raise InputError(f"the Dataset has no map of classes '{name}'{known_to_it}")
    return names_of_flags(maps[name])
