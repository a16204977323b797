"""A quantity over one axis: a curve, several of them, classes, or the dots of samples."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy
import xarray

from gearsweep import _core
from gearsweep._flags import flags_of
from gearsweep._frame import box
from gearsweep._points import is_column
from gearsweep._shown import Band, Limits, Missing, Shown, classes_of

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
    band: Band | None,
    ax: matplotlib.axes.Axes,
    limits: Limits,
    is_log: bool,
) -> list[Any]:
    """Draws it; returns its key."""
    key: list[Any] = []
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
        _plot_dots(ax, x, shown.values)
    elif shown.values.ndim == 2:
        _plot_parts(ax, x, shown, "o" if is_list else "-", size)
    else:
        line = "o" if is_list else "o-" if len(x) <= _FEW_POINTS else "-"
        curve = ax.plot(x, shown.values, line, color=_core.CURVE_COLOUR, markersize=size)
        if band is not None:
            curve[0].set_label(_core.NOMINAL_MEANING)
            key = [*curve, *_plot_band(ax, x, band, is_list or len(x) == 1)]
    if classes is None:
        ends = (shown.values,) if band is None else (shown.values, band.low, band.high)
        values = numpy.concatenate([one.ravel() for one in ends])
        _limit_values(ax, values, shown.dimension == "sample", limits, is_log)
    ax.set_axisbelow(True)
    if shown.dimension != "sample":
        ax.grid(color=_GRID, linewidth=0.6)
    ax.set_ylabel(_core.quantity_label(shown.name, shown.unit))
    key = key or ax.get_legend_handles_labels()[0][::-1]
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


def _plot_band(
    ax: matplotlib.axes.Axes, x: NDArray[Any], band: Band, has_bars: bool
) -> list[Any]:
    """Behind the curve, with bars where neighbours have nothing in common; returns its key."""
    look = {"color": _core.BAND_COLOUR, "zorder": 1.5}
    if has_bars:
        ax.vlines(x, band.low, band.high, linewidth=4, **look)
    else:
        ax.fill_between(x, band.low, band.high, linewidth=0, **look)
    key = [box(_core.BAND_COLOUR, band.meaning)]
    if band.median is not None:
        line = "." if has_bars else "-"
        look = {"color": _core.MEDIAN_COLOUR, "linewidth": 0.8, "zorder": 1.8}
        key += ax.plot(x, band.median, line, label=_core.MEDIAN_MEANING, **look)
    return key


def _limit_values(
    ax: matplotlib.axes.Axes,
    values: NDArray[Any],
    is_samples: bool,
    limits: Limits,
    is_log: bool,
) -> None:
    least, most, _ = _core.padded_range(values)
    if is_log:
        ax.set_yscale("log")
    else:
        ax.set_ylim(least, most)
        if least < 0.0 < most and not is_samples:
            ax.axhline(0.0, color=_ZERO, linewidth=1.0, zorder=1)
    ax.set_ylim(*limits)


def _plot_dots(ax: matplotlib.axes.Axes, x: NDArray[Any], samples: NDArray[Any]) -> None:
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


def _plot_parts(
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
