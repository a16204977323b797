"""Classes with names, as results have them."""

from __future__ import annotations

import numpy
import xarray


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
