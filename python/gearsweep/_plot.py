"""Pictures of results, as ``gearsweep plot`` draws them, by matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING

import xarray

from gearsweep._curve import draw_curve
from gearsweep._errors import InputError
from gearsweep._frame import draw_heading, draw_key, label_axis
from gearsweep._heat_map import plot_heat_map
from gearsweep._shown import Limits, across_of, axes_of, find_band, find_shown, missing_in

if TYPE_CHECKING:
    import matplotlib.axes


def draw(
    maps: xarray.Dataset,
    quantity: str | None,
    *,
    over: str | None,
    ax: matplotlib.axes.Axes | None,
    colormap: str | None,
    limits: Limits,
    is_log: bool,
    has_band: bool,
    title: str | None,
) -> matplotlib.axes.Axes:
    """Draw a quantity; `gearsweep.Gear.plot` says how."""
    axes = axes_of(maps)
    across = across_of(maps, axes, over)
    if not isinstance(limits, tuple | list) or len(limits) != 2:
        raise InputError(f"range: expected two ends such as (0, 2) or (0, None), not {limits!r}")
    shown = find_shown(maps, quantity, axes)
    missing = missing_in(maps.status, shown.values, len(axes))
    if ax is None:
        ax = _new_axes()
    remark = ""
    if len(axes) == 2:
        key, remark = plot_heat_map(maps, shown, missing, ax, colormap, limits, is_log)
    elif colormap is not None:
        raise InputError("colormap: a curve has none; it is for maps over two axes")
    else:
        band = find_band(maps, shown) if has_band else None
        key = draw_curve(maps, across, shown, missing, band, ax, limits, is_log)
    label_axis(ax.xaxis, across)
    draw_key(ax, key)
    draw_heading(ax, maps, shown.meaning + remark, title)
    return ax


def _new_axes() -> matplotlib.axes.Axes:
    from matplotlib import pyplot

    return pyplot.subplots(layout="constrained")[1]
