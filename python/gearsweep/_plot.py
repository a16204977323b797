"""Pictures of results, as ``gearsweep plot`` draws them, by matplotlib."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy
import xarray

from gearsweep import _core
from gearsweep._errors import InputError
from gearsweep._flags import flags_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    import matplotlib.axes
    from numpy.typing import NDArray

_SAMPLES = "poincare"
_GRID = "#dddddd"
_ZERO = "#777777"
# So few points that each of them should be seen.
_FEW_POINTS = 60
_FEW_DOTS = 3000
# Of a few classes with long names a bar would leave the map no room: they stand below it.
_FEW_CLASSES = 6
_LONG_NAME = 18
_BELOW_AXIS = 36  # points
# What the samples of a bifurcation diagram cover of the frame when they spread evenly, and how
# dark they then are.
_SPREAD = 0.5
_SHADE = 0.55

Limits = tuple[float | None, float | None]


class Shown(NamedTuple):
    """A quantity of a result that is drawn.

    `values` has the axes of the result in front (y, then x), then parts or samples.
    """

    name: str
    unit: str
    meaning: str
    values: NDArray[Any]
    dimension: str


class Missing(NamedTuple):
    """Points without a value: where, and what is said of them."""

    mask: NDArray[Any]
    note: str


def draw(
    maps: xarray.Dataset,
    quantity: str | None,
    *,
    ax: matplotlib.axes.Axes | None,
    colormap: str | None,
    limits: Limits,
    is_log: bool,
    title: str | None,
) -> matplotlib.axes.Axes:
    """Draw a quantity; `gearsweep.Gear.plot` says how."""
    axes = _axes_of(maps)
    if not isinstance(limits, tuple | list) or len(limits) != 2:
        raise InputError(f"range: expected two ends such as (0, 2) or (0, None), not {limits!r}")
    shown = _find(maps, quantity, axes)
    missing = _missing(maps.status, shown.values, len(axes))
    if ax is None:
        ax = _new_axes()
    remark = ""
    if len(axes) == 2:
        key, remark = _draw_heat_map(maps, shown, missing, ax, colormap, limits, is_log)
    elif colormap is not None:
        raise InputError("colormap: a curve has none; it is for maps over two axes")
    else:
        key = _draw_curve(maps, shown, missing, ax, limits, is_log)
    _label_axis(ax.xaxis, maps[axes[-1]])
    _draw_key(ax, key)
    _draw_heading(ax, maps, shown.meaning + remark, title)
    return ax


def _new_axes() -> matplotlib.axes.Axes:
    from matplotlib import pyplot

    return pyplot.subplots(layout="constrained")[1]


def _axes_of(maps: xarray.Dataset) -> list[str]:
    if "status" not in maps:
        raise InputError("the Dataset has no variable 'status': gearsweep did not make it")
    axes = [str(name) for name in maps.status.dims]
    if not axes:
        raise InputError("the Dataset is of one point; there is nothing to draw over")
    return axes


def _find(maps: xarray.Dataset, quantity: str | None, axes: list[str]) -> Shown:
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
    labels = [str(one) for one in maps[extra[0]].values.tolist()]
    if part == "" and (name == _SAMPLES or len(axes) == 2):
        part = labels[0]
    if part == "":
        return _shown(variable, name, extra[0])
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
    return one._replace(meaning=f"{one.meaning}, at phase 0 of each recorded period")


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


def _missing(status: xarray.DataArray, values: NDArray[Any], axes: int) -> Missing:
    beside = tuple(range(axes, values.ndim))
    mask = ~numpy.isfinite(values).any(axis=beside) if beside else ~numpy.isfinite(values)
    notes = []
    for code, name in flags_of(status).items():
        count = int((mask & (status.values == code)).sum())
        said = "undefined" if name == "ok" else name
        notes += [f"{said} at {count} of {mask.size} points"] if count else []
    return Missing(mask, ", ".join(notes))


def _classes(maps: xarray.Dataset, shown: Shown) -> Any:
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


def _draw_heat_map(
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

    classes = _classes(maps, shown)
    clipped = False
    if classes is not None:
        indices, names, colours = classes
        values = indices.reshape(shown.values.shape)
        palette: Any = colors.ListedColormap(colours)
        norm: Any = colors.BoundaryNorm(numpy.arange(len(names) + 1) - 0.5, len(names))
    else:
        values = shown.values
        least, most, clipped = _core.colour_range(values.ravel(), *limits, is_log)
        chosen = colormap or _core.usual_colormap(shown.name, least, most)
        palette = _palette(chosen, least, most)
        norm = colors.LogNorm(least, most) if is_log else colors.Normalize(least, most)
    palette.set_bad(_core.MISSING_COLOUR if classes is None else _core.MISSING_CLASS_COLOUR)
    y, x = (maps[name] for name in maps.status.dims)
    mesh = ax.pcolormesh(
        _edges(x),
        _edges(y),
        numpy.ma.masked_invalid(values),
        cmap=palette,
        norm=norm,
        rasterized=True,
    )
    _label_axis(ax.yaxis, y)
    key: list[Any] = []
    if classes is not None and len(names) <= _FEW_CLASSES and max(map(len, names)) > _LONG_NAME:
        key = [_box(*one) for one in zip(colours, names, strict=True)]
    else:
        bar = ax.figure.colorbar(mesh, ax=ax, extend="both" if clipped else "neither", pad=0.02)
        bar.set_label(_core.quantity_label(shown.name, shown.unit))
        if classes is not None:
            bar.set_ticks(numpy.arange(len(names)), labels=list(map(_core.literal_label, names)))
            bar.ax.minorticks_off()
            bar.ax.tick_params(length=0)
    if missing.note:
        key.append(_box(palette.get_bad(), missing.note))
    return key, "; the colours cover 99.8 % of the points" if clipped else ""


def _box(colour: Any, name: str) -> Any:
    from matplotlib.patches import Patch

    return Patch(facecolor=colour, edgecolor=_ZERO, label=_core.literal_label(name))


def _palette(name: str, least: float, most: float) -> Any:
    from matplotlib.colors import LinearSegmentedColormap

    places, colours = zip(*_core.colour_anchors(name, least, most), strict=True)
    shares = (numpy.array(places) - places[0]) / (places[-1] - places[0])
    return LinearSegmentedColormap.from_list(
        name, list(zip(shares.tolist(), colours, strict=True)), N=1024
    )


def _draw_curve(
    maps: xarray.Dataset,
    shown: Shown,
    missing: Missing,
    ax: matplotlib.axes.Axes,
    limits: Limits,
    is_log: bool,
) -> list[Any]:
    """Draws it; returns its key."""
    (name,) = maps.status.dims
    x = maps[name].values
    has_classes = shown.name in ("period", "attractor_count") or (
        shown.name in maps and bool(flags_of(maps[shown.name]))
    )
    classes = _classes(maps, shown) if has_classes else None
    if classes is not None:
        indices, names, _ = classes
        size = 2.0 if len(x) > _FEW_POINTS else 3.0
        ax.plot(x, indices, "o", color=_core.DOT_COLOUR, markersize=size, markeredgewidth=0)
        ax.set_yticks(numpy.arange(len(names)), [_core.literal_label(one) for one in names])
        ax.set_ylim(-0.5, len(names) - 0.5)
    elif shown.dimension == "sample":
        _draw_dots(ax, x, shown.values)
    elif shown.values.ndim == 2:
        _draw_parts(ax, x, shown)
    else:
        mark = "o" if len(x) <= _FEW_POINTS else ""
        ax.plot(x, shown.values, color=_core.CURVE_COLOUR, marker=mark, markersize=3)
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


def _draw_parts(ax: matplotlib.axes.Axes, x: NDArray[Any], shown: Shown) -> None:
    """The first curve stands over the others."""
    count = shown.values.shape[1]
    for part in range(count - 1, 0, -1):
        label = f"{shown.dimension} 2 to {count}" if part == 1 else None
        ax.plot(x, shown.values[:, part], color=_core.OTHER_PARTS_COLOUR, linewidth=1, label=label)
    first = f"{shown.dimension} 1"
    ax.plot(x, shown.values[:, 0], color=_core.FIRST_PART_COLOUR, label=first)


def _edges(axis: xarray.DataArray) -> NDArray[Any]:
    """Edges of the cells around the values of an axis: one more than values."""
    is_log = axis.attrs.get("scale") == "log"
    places = numpy.log10(axis.values) if is_log else axis.values
    if len(places) == 1:
        half = numpy.array([0.05 if is_log else max(0.05 * abs(places[0]), 1e-3)])
    else:
        half = 0.5 * numpy.diff(places)
    edges: NDArray[Any] = numpy.concatenate(
        [places[:1] - half[:1], places[:-1] + half[: len(places) - 1], places[-1:] + half[-1:]]
    )
    return numpy.asarray(10.0**edges) if is_log else edges


def _label_axis(axis: Any, coordinate: xarray.DataArray) -> None:
    """Label, scale and ends of an axis of the study."""
    attributes = coordinate.attrs
    edges = _edges(coordinate)
    is_x = axis.axis_name == "x"
    if attributes.get("scale") == "log":
        (axis.axes.set_xscale if is_x else axis.axes.set_yscale)("log")
    (axis.axes.set_xlim if is_x else axis.axes.set_ylim)(edges[0], edges[-1])
    axis.set_label_text(_axis_label(coordinate))


def _axis_label(coordinate: xarray.DataArray) -> str:
    attributes = coordinate.attrs
    return _core.axis_label(
        str(coordinate.name), attributes.get("units", ""), attributes.get("long_name", "")
    )


def _draw_key(ax: matplotlib.axes.Axes, handles: list[Any]) -> None:
    """What colours and marks stand for, below the picture."""
    if not handles:
        return
    from matplotlib.transforms import ScaledTranslation

    widest = max(len(handle.get_label()) for handle in handles)
    # Below numbers and label of the axis, however high the picture is.
    below = ScaledTranslation(0, -_BELOW_AXIS / 72, ax.figure.dpi_scale_trans)
    ax.legend(
        handles=handles,
        loc="upper center",
        bbox_to_anchor=(0.5, 0.0),
        bbox_transform=ax.transAxes + below,
        ncol=max(1, min(len(handles), 80 // (widest + 8))),
        frameon=False,
        fontsize="small",
    )


def _draw_heading(
    ax: matplotlib.axes.Axes, maps: xarray.Dataset, meaning: str, title: str | None
) -> None:
    """The title, and smaller below it what is shown and where."""
    if title == "":
        return
    head = maps.attrs.get("title", "") if title is None else title
    small = [_core.typeset_label(line) for line in textwrap.wrap(meaning, 80)]
    small += [f"at {place}" for place in _places(maps)]
    ax.annotate(
        "\n".join(small),
        (0.5, 1.0),
        (0, 4),
        xycoords="axes fraction",
        textcoords="offset points",
        ha="center",
        va="bottom",
        fontsize="small",
    )
    lines = [_core.literal_label(line) for line in textwrap.wrap(head, 64)]
    ax.set_title("\n".join(lines), pad=6 + 13 * len(small))


def _places(maps: xarray.Dataset) -> Sequence[str]:
    """The values of axes that were selected."""
    places = []
    for name, coordinate in maps.coords.items():
        if coordinate.ndim == 0 and "scale" in coordinate.attrs:
            unit = coordinate.attrs.get("units", "1")
            shown = "" if unit == "1" else f" {_core.typeset_label(unit)}"
            symbol = _core.typeset_label(str(name))
            places.append(f"{symbol} = {float(coordinate):.4g}{shown}")
    return places
