"""Results with units that pint computes with."""

from __future__ import annotations

import re
from typing import Any

import xarray

_WORD = re.compile(r"[^\W\d]\w*")
# Units of a study with a [gear] table, with the attributes that say what they are.
_SCALES = {
    "b_n": ("scale_b_n_m", "meter"),
    "k0": ("scale_k0_N_per_m", "newton/meter"),
    "varpi": ("scale_varpi_rad_per_s", "1/second"),
}
# What pint takes for another unit: a litre, a day, a centimetre. The last one is c_m, the damping of
# the mesh, where it stands alone.
_MISTAKEN = {"L": "unit_L", "d": "unit_d"}
_MISTAKEN_ALONE = {"cm": "c_m"}


def quantified(maps: xarray.Dataset) -> xarray.Dataset:
    """The result with units of pint, those of the model among them.

    Parameters
    ----------
    maps : Dataset
        A result, or traces.

    Returns
    -------
    Dataset
    """
    import pint
    import pint_xarray

    registry: Any = pint_xarray.setup_registry(pint.UnitRegistry(force_ndarray_like=True))
    made = maps.copy()
    for variable in made.variables.values():
        unit = variable.attrs.get("units", "")
        if not isinstance(unit, str) or unit.startswith("see ") or "flag_values" in variable.attrs:
            variable.attrs.pop("units", None)
            continue
        unit = _MISTAKEN_ALONE.get(unit, unit)
        unit = _WORD.sub(lambda word: _MISTAKEN.get(word[0], word[0]), unit)
        variable.attrs["units"] = unit
        for word in _WORD.findall(unit):
            if word not in registry:
                registry.define(f"{word} = {_definition(word, maps.attrs)}")
    quantified: xarray.Dataset = made.pint.quantify(unit_registry=registry)
    return quantified


def _definition(word: str, attributes: dict[Any, Any]) -> str:
    """A dimension of its own, or so much of a unit of SI."""
    scale, unit = _SCALES.get(word, ("", ""))
    if word == "tau" and _SCALES["varpi"][0] in attributes:
        return f"{1.0 / float(attributes[_SCALES['varpi'][0]])!r} second"
    return f"{float(attributes[scale])!r} {unit}" if scale in attributes else f"[{word}]"
