"""A quantity over two axes, in colours."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy
import xarray

from gearsweep import _core
from gearsweep._frame import box, edges_of, label_axis
from gearsweep._shown import Limits, Missing, Shown, classes_of

if TYPE_CHECKING:
    import matplotlib.axes

# A bar for a few classes with long names would leave the map no room: they stand below it.
_FEW_CLASSES = 6
_LONG_NAME = 18


def plot_heat_map(
    maps: xarray.Dataset,
    shown: Shown,
    missing: Missing,
    ax: matplotlib.axes.Axes,
    colormap: str | None,
    limits: Limits,
    is_log: bool,
) -> tuple[list[Any], str]:
    """Draws it with its bar; returns its key, and what is to be said of the colours."""
    from matplotlib import colors

    classes = classes_of(maps, shown)
    clipped, extend = False, "neither"
    if classes is not None:
        indices, names, colours = classes
        values = indices.reshape(shown.values.shape)
        palette: Any = colors.ListedColormap(colours)
        norm: Any = colors.BoundaryNorm(numpy.arange(len(names) + 1) - 0.5, len(names))
    else:
        values = shown.values
        chosen = colormap or _core.usual_colormap(shown.name)
        least, most, clipped, below, above = _core.colour_range(
            values.ravel(), *limits, is_log, chosen, shown.name
        )
        extend = {(1, 1): "both", (1, 0): "min", (0, 1): "max", (0, 0): "neither"}[below, above]
        palette = palette_of(chosen, least, most)
        norm = colors.LogNorm(least, most) if is_log else colors.Normalize(least, most)
    palette.set_bad(_core.MISSING_COLOUR if classes is None else _core.MISSING_CLASS_COLOUR)
    y, x = (maps[name] for name in maps.status.dims)
    mesh = ax.pcolormesh(
        edges_of(x),
        edges_of(y),
        numpy.ma.masked_invalid(values),
        cmap=palette,
        norm=norm,
        rasterized=True,
    )
    label_axis(ax.yaxis, y)
    key: list[Any] = []
    if classes is not None and len(names) <= _FEW_CLASSES and max(map(len, names)) > _LONG_NAME:
        key = [box(*one) for one in zip(colours, names, strict=True)]
    else:
        bar = ax.figure.colorbar(mesh, ax=ax, extend=extend, pad=0.02)
        bar.set_label(_core.quantity_label(shown.name, shown.unit))
        if classes is not None:
            bar.set_ticks(numpy.arange(len(names)), labels=list(map(_core.literal_label, names)))
            bar.ax.minorticks_off()
            bar.ax.tick_params(length=0)
    if missing.note:
        key.append(box(palette.get_bad(), missing.note))
    return key, "; the colours cover 99.8 % of the points" if clipped else ""


def palette_of(name: str, least: float, most: float) -> Any:
    """The colours of this name as matplotlib takes them."""
    from matplotlib.colors import LinearSegmentedColormap

    places, colours = zip(*_core.colour_anchors(name, least, most), strict=True)
    shares = (numpy.array(places) - places[0]) / (places[-1] - places[0])
    return LinearSegmentedColormap.from_list(
        name, list(zip(shares.tolist(), colours, strict=True)), N=1024
    )
