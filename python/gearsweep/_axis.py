"""Axes of studies."""

from __future__ import annotations

from typing import Any

from gearsweep._errors import InputError
from gearsweep._value import numbers_of, shown


def axis_table(name: str, values: Any) -> dict[str, Any]:
    """An axis as a table of a study."""
    is_range = isinstance(values, tuple) and len(values) in (3, 4)
    if is_range and (len(values) == 3 or values[3] in ("log", "linear")):
        # 2.0 is refused: three numbers in a tuple may be meant as three values.
        if not hasattr(values[2], "__index__"):
            raise InputError(
                f"axis {name!r}: {shown(values)} is (from, to, count), and count must be a whole "
                "number; values come in a list"
            )
        axis = {"name": name, **dict(zip(("from", "to", "count"), values, strict=False))}
        return axis | ({"scale": values[3]} if len(values) == 4 else {})
    if isinstance(values, tuple) and len(values) == 2:
        raise InputError(
            f"axis {name!r}: {shown(values)} has no count; a range is (from, to, count), and values "
            "come in a list"
        )
    numbers = numbers_of(
        values,
        f"axis {name!r}",
        "(from, to, count), (from, to, count, 'log') or an array of numbers",
    )
    if numbers.ndim > 1:
        raise InputError(f"axis {name!r}: expected a list of numbers, not of shape {numbers.shape}")
    return {"name": name, "values": numbers}
