"""What a picture shows of a result: a quantity, its classes, and points without a value."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy
import xarray

from gearsweep import _core
from gearsweep._errors import InputError
from gearsweep._flags import flags_of
from gearsweep._points import is_column

if TYPE_CHECKING:
    from numpy.typing import NDArray

_SAMPLES = "poincare"

Limits = tuple[float | None, float | None]


class Shown(NamedTuple):
    """A quantity of a result that is drawn.

    `values` has the axes of the result in front (y, then x), then parts or samples; `parts` are
    what the parts are called.
    """

    name: str
    unit: str
    meaning: str
    values: NDArray[Any]
    dimension: str
    parts: tuple[str, ...] = ()


class Band(NamedTuple):
    """Tolerances around a curve: its lowest and highest percentile, and the median if known."""

    low: NDArray[Any]
    high: NDArray[Any]
    median: NDArray[Any] | None
    meaning: str


class Missing(NamedTuple):
    """Points without a value: where, and what is said of them."""

    mask: NDArray[Any]
    note: str


def axes_of(maps: xarray.Dataset) -> list[str]:
    if "moment" in maps.dims:
        raise InputError("this is a trace; draw it with trace.x1.plot(x='tau'), for example")
    if "multipliers" in maps:
        raise InputError("these are orbits; draw them with abs(orbits.multipliers).plot()")
    if "status" not in maps:
        raise InputError("the Dataset has no variable 'status': gearsweep did not make it")
    axes = [str(name) for name in maps.status.dims]
    if not axes:
        raise InputError("the Dataset is of one point; there is nothing to draw over")
    return axes


def across_of(maps: xarray.Dataset, axes: list[str], over: str | None) -> xarray.DataArray:
    """What the horizontal axis has: the first axis, or a column of a list of points."""
    if over is None:
        return maps[axes[-1]]
    columns = [
        str(name)
        for name, coordinate in maps.coords.items()
        if is_column(coordinate) and list(coordinate.dims) == axes
    ]
    if over not in columns:
        known = f"; there are {', '.join(columns)}" if columns else ""
        raise InputError(f"over: {over!r} is no column of a list of points{known}")
    return maps[over]


def find_shown(maps: xarray.Dataset, quantity: str | None, axes: list[str]) -> Shown:
    """What the name stands for."""
    known = [
        str(name)
        for name, variable in maps.data_vars.items()
        if list(variable.dims[: len(axes)]) == axes
    ]
    asked = _default(known, len(axes)) if quantity is None else quantity
    if not isinstance(asked, str):
        raise InputError(f"quantity: expected a name such as {known[0]!r}, not {asked!r}")
    name, _, part = asked.partition(":")
    if name not in known:
        raise InputError(f"the Dataset has no quantity '{name}'{_core.suggest_name(name, known)}")
    variable = maps[name]
    extra = [str(one) for one in variable.dims[len(axes) :]]
    if name == _SAMPLES and len(axes) == 2:
        raise InputError(
            f"a bifurcation diagram has one axis, and this result two; select one value: "
            f"maps.isel({axes[0]}=0).gear.plot({asked!r})"
        )
    if not extra:
        return _shown(variable, name, "")
    labels = [_label(one) for one in maps[extra[0]].values.tolist()]
    if part == "" and (name == _SAMPLES or len(axes) == 2):
        part = labels[0]
    if part == "":
        return _shown(variable, name, extra[0])._replace(parts=tuple(labels))
    if part not in labels:
        raise InputError(f"{name} has no '{part}'{_core.suggest_name(part, labels)}")
    chosen = variable.isel({extra[0]: labels.index(part)})
    units, meanings = (f"{extra[0]}_{what}" for what in ("units", "long_name"))
    one = _shown(
        chosen,
        part if name == _SAMPLES else f"{name}:{part}",
        "sample" if name == _SAMPLES else "",
    )
    if units in chosen.coords:
        one = one._replace(unit=str(chosen[units].item()), meaning=str(chosen[meanings].item()))
    if name != _SAMPLES:
        return one._replace(meaning=f"{variable.attrs.get('long_name', '')}, {extra[0]} {part}")
    sampled = str(variable.attrs.get("long_name", ""))
    return one._replace(meaning=f"{one.meaning},{sampled.removeprefix('states')}")


def find_band(maps: xarray.Dataset, shown: Shown) -> Band | None:
    """Of a quantity that has percentiles in the result."""
    if shown.dimension or shown.name not in maps:
        return None
    found = _core.band_of(shown.name, [str(name) for name in maps.data_vars])
    if found is None:
        return None
    low, median, high, meaning = found
    return Band(
        low=maps[low].values.astype(float),
        high=maps[high].values.astype(float),
        median=maps[median].values.astype(float) if median else None,
        meaning=meaning,
    )


def _label(part: Any) -> str:
    """What a part is called: a state, a number, an order, which need not be whole."""
    return str(int(part)) if isinstance(part, float) and part.is_integer() else str(part)


def _default(known: list[str], axes: int) -> str:
    if axes == 1 and _SAMPLES in known:
        return _SAMPLES
    return next((name for name in known if name not in ("status", _SAMPLES)), "status")


def _shown(variable: xarray.DataArray, name: str, dimension: str) -> Shown:
    attributes = variable.attrs
    return Shown(
        name=name,
        unit=attributes.get("units", "1"),
        meaning=attributes.get("long_name", name),
        values=variable.values.astype(float),
        dimension=dimension,
    )


def missing_in(status: xarray.DataArray, values: NDArray[Any], axes: int) -> Missing:
    beside = tuple(range(axes, values.ndim))
    mask = ~numpy.isfinite(values).any(axis=beside) if beside else ~numpy.isfinite(values)
    notes = []
    for code, name in flags_of(status).items():
        count = int((mask & (status.values == code)).sum())
        said = "undefined" if name == "ok" else name
        notes += [f"{said} at {count} of {mask.size} points"] if count else []
    return Missing(mask, ", ".join(notes))


def classes_of(maps: xarray.Dataset, shown: Shown) -> Any:
    """(index of each value, names, colours), or None of what has no classes."""

    def companion(name: str) -> Any:
        if name not in maps or name == shown.name:
            return None
        return _names(maps[name]), maps[name].values.astype(float).ravel()

    flags = _names(maps[shown.name]) if shown.name in maps else []
    return _core.classes_of(
        shown.name,
        flags,
        shown.values.ravel(),
        companion("motion_class"),
        companion("contact_class"),
    )


def _names(variable: xarray.DataArray) -> list[str]:
    flags = flags_of(variable)
    return [flags.get(code, "") for code in range(max(flags, default=-1) + 1)]
