"""Axes of studies."""

from __future__ import annotations

from typing import Any

import numpy

from gearsweep._errors import InputError


def axis_table(name: str, values: Any) -> dict[str, Any]:
    """An axis as a table of a study."""
    is_range = isinstance(values, tuple) and len(values) in (3, 4)
    if is_range and (len(values) == 3 or values[3] in ("log", "linear")):
        axis = {"name": name, **dict(zip(("from", "to", "count"), values, strict=False))}
        return axis | ({"scale": values[3]} if len(values) == 4 else {})
    if isinstance(values, tuple) and len(values) == 2:
        raise InputError(
            f"axis {name!r}: {values!r} has no count; a range is (from, to, count), and values "
            "come in a list"
        )
    try:
        numbers = numpy.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise InputError(
            f"axis {name!r}: expected (from, to, count), (from, to, count, 'log') or an array of "
            f"numbers, not {values!r}"
        ) from None
    if numbers.ndim > 1:
        raise InputError(f"axis {name!r}: expected a list of numbers, not of shape {numbers.shape}")
    return {"name": name, "values": numbers}
