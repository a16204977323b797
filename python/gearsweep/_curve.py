"""A quantity over one axis: a curve, several of them, classes, or the dots of samples."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy
import xarray

from gearsweep import _core
from gearsweep._flags import flags_of
from gearsweep._points import is_column
from gearsweep._shown import Limits, Missing, Shown, classes_of

if TYPE_CHECKING:
    import matplotlib.axes
    from numpy.typing import NDArray

_GRID = "#dddddd"
_ZERO = "#777777"
# So few points that each of them should be seen.
_FEW_POINTS = 60
_FEW_DOTS = 3000
# What the samples of a bifurcation diagram cover of the frame when they spread evenly, and how
# dark they then are.
_SPREAD = 0.5
_SHADE = 0.55


def draw_curve(
    maps: xarray.Dataset,
    across: xarray.DataArray,
    shown: Shown,
    missing: Missing,
    ax: matplotlib.axes.Axes,
    limits: Limits,
    is_log: bool,
) -> list[Any]:
    """Draws it; returns its key."""
    x = across.values
    # The neighbours of a point in a list have nothing in common with it.
    is_list = any(is_column(coordinate) for coordinate in maps.coords.values())
    size = 2.0 if len(x) > _FEW_POINTS else 3.0
    has_classes = shown.name in ("period", "attractor_count") or (
        shown.name in maps and bool(flags_of(maps[shown.name]))
    )
    classes = classes_of(maps, shown) if has_classes else None
    if classes is not None:
        indices, names, _ = classes
        ax.plot(x, indices, "o", color=_core.DOT_COLOUR, markersize=size, markeredgewidth=0)
        ax.set_yticks(numpy.arange(len(names)), [_core.literal_label(one) for one in names])
        ax.set_ylim(-0.5, len(names) - 0.5)
    elif shown.dimension == "sample":
        _draw_dots(ax, x, shown.values)
    elif shown.values.ndim == 2:
        _draw_parts(ax, x, shown, "o" if is_list else "-", size)
    else:
        line = "o" if is_list else "o-" if len(x) <= _FEW_POINTS else "-"
        ax.plot(x, shown.values, line, color=_core.CURVE_COLOUR, markersize=size)
    if classes is None:
        _limit_values(ax, shown, limits, is_log)
    ax.set_axisbelow(True)
    if shown.dimension != "sample":
        ax.grid(color=_GRID, linewidth=0.6)
    ax.set_ylabel(_core.quantity_label(shown.name, shown.unit))
    key = ax.get_legend_handles_labels()[0][::-1]
    if missing.note:
        feet = numpy.full(int(missing.mask.sum()), 0.015)
        key += ax.plot(
            x[missing.mask],
            feet,
            "^",
            color=_core.MISSING_COLOUR,
            markersize=3,
            transform=ax.get_xaxis_transform(),
            label=_core.literal_label(missing.note),
        )
    return list(key)


def _limit_values(
    ax: matplotlib.axes.Axes, shown: Shown, limits: Limits, is_log: bool
) -> None:
    least, most, _ = _core.padded_range(shown.values.ravel())
    if is_log:
        ax.set_yscale("log")
    else:
        ax.set_ylim(least, most)
        if least < 0.0 < most and shown.dimension != "sample":
            ax.axhline(0.0, color=_ZERO, linewidth=1.0, zorder=1)
    ax.set_ylim(*limits)


def _draw_dots(ax: matplotlib.axes.Axes, x: NDArray[Any], samples: NDArray[Any]) -> None:
    """Where many samples fall on one place the dots are dark, where they spread they are pale."""
    count = samples.size
    diameter = 1.8 if count < _FEW_DOTS else 1.0  # points
    box = ax.get_window_extent().transformed(ax.figure.dpi_scale_trans.inverted())
    frame = _SPREAD * box.width * box.height * 72.0**2
    layers = max(count * 0.785 * diameter**2 / frame, 1e-3)
    alpha = float(numpy.clip(1.0 - (1.0 - _SHADE) ** (1.0 / layers), 0.02, 1.0))
    ax.plot(
        numpy.repeat(x, samples.shape[1]),
        samples.ravel(),
        "o",
        color=_core.DOT_COLOUR,
        alpha=alpha,
        markersize=diameter,
        markeredgewidth=0,
        rasterized=True,
    )


def _draw_parts(
    ax: matplotlib.axes.Axes, x: NDArray[Any], shown: Shown, line: str, size: float
) -> None:
    """The first curve stands over the others."""
    count = shown.values.shape[1]
    for part in range(count - 1, 0, -1):
        others = f"{shown.dimension} {shown.parts[1]} to {shown.parts[-1]}"
        label = others if part == 1 else None
        look = {"color": _core.OTHER_PARTS_COLOUR, "markersize": size, "label": label}
        ax.plot(x, shown.values[:, part], line, linewidth=1, **look)
    look = {"color": _core.FIRST_PART_COLOUR, "markersize": size}
    ax.plot(x, shown.values[:, 0], line, label=f"{shown.dimension} {shown.parts[0]}", **look)
