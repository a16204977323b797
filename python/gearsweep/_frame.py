"""What stands around a picture: axes, key and heading."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any

import numpy
import xarray

from gearsweep import _core
from gearsweep._points import is_column

if TYPE_CHECKING:
    from collections.abc import Sequence

    import matplotlib.axes
    from numpy.typing import NDArray

_BELOW_AXIS = 36  # points
_EDGE = "#777777"
OTHER_MESH_COLOUR = "#d070ff"  # of the orders of a second mesh


def edges_of(axis: xarray.DataArray) -> NDArray[Any]:
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


def label_axis(axis: Any, coordinate: xarray.DataArray) -> None:
    """Label, scale and ends of an axis of the study."""
    attributes = coordinate.attrs
    axis.set_label_text(_axis_label(coordinate))
    if is_column(coordinate):
        return
    edges = edges_of(coordinate)
    is_x = axis.axis_name == "x"
    if attributes.get("scale") == "log":
        (axis.axes.set_xscale if is_x else axis.axes.set_yscale)("log")
    (axis.axes.set_xlim if is_x else axis.axes.set_ylim)(edges[0], edges[-1])


def _axis_label(coordinate: xarray.DataArray) -> str:
    attributes = coordinate.attrs
    return _core.axis_label(
        str(coordinate.name), attributes.get("units", ""), attributes.get("long_name", "")
    )


def box(colour: Any, name: str) -> Any:
    from matplotlib.patches import Patch

    return Patch(facecolor=colour, edgecolor=_EDGE, label=_core.literal_label(name))


def draw_key(ax: matplotlib.axes.Axes, handles: list[Any]) -> None:
    """What colours and marks stand for, below the picture."""
    if not handles:
        return
    from matplotlib.transforms import ScaledTranslation

    widths = [len(handle.get_label()) + 8 for handle in handles]
    in_one_row = sum(widths) <= 80
    # Below numbers and label of the axis, however high the picture is.
    below = ScaledTranslation(0, -_BELOW_AXIS / 72, ax.figure.dpi_scale_trans)
    ax.legend(
        handles=handles,
        loc="upper center",
        bbox_to_anchor=(0.5, 0.0),
        bbox_transform=ax.transAxes + below,
        ncol=len(handles) if in_one_row else max(1, min(len(handles), 80 // max(widths))),
        frameon=False,
        fontsize="small",
    )


def draw_heading(
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
