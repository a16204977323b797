"""Order maps by matplotlib: amplitudes in dB, natural frequencies and orders as lines."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING, Any

import numpy
import xarray

from gearsweep import _core
from gearsweep._errors import InputError
from gearsweep._frame import OTHER_MESH_COLOUR, draw_heading, edges_of, label_axis
from gearsweep._heat_map import palette_of
from gearsweep._shown import Limits
from gearsweep._si import IN_SI

if TYPE_CHECKING:
    import matplotlib.axes
    from numpy.typing import NDArray

_CONTENT = "order map of gearsweep"
_DEPTH = 80.0  # decibels
_RAYS = (1, 2, 3, 4)
_RAY_COLOUR = "#ff8c5a"


def is_order_map(maps: xarray.Dataset) -> bool:
    """Whether the Dataset is what `gearsweep.orders` returns."""
    return maps.attrs.get("content") == _CONTENT


def plot_orders(
    maps: xarray.Dataset,
    quantity: str | None,
    *,
    ax: matplotlib.axes.Axes | None,
    colormap: str | None,
    limits: Limits,
    title: str | None,
) -> matplotlib.axes.Axes:
    """Draw an order map; `gearsweep.Gear.plot` says how."""
    from matplotlib import colors, pyplot

    if quantity not in (None, "frequency", "order"):
        raise InputError(
            f"{quantity!r}: an order map is drawn over 'frequency', or over 'order'"
        )
    if ax is None:
        ax = pyplot.subplots(layout="constrained")[1]
    axis = maps[maps.attrs["axis"]]
    scale, frequency_unit = _hertz(maps)
    forcing = scale * maps.forcing_frequency.values
    places = edges_of(axis)
    order = edges_of(maps.order).clip(min=0.0)
    is_order = quantity == "order"
    across, upright = numpy.meshgrid(places, order)
    if not is_order:
        upright = upright * _at_edges(axis.values, forcing, places)
    with numpy.errstate(divide="ignore"):
        levels = 20.0 * numpy.log10(maps.amplitude.values.T)
    top = numpy.ceil(numpy.nanmax(levels) / 10.0) * 10.0 if limits[1] is None else limits[1]
    foot = top - _DEPTH if limits[0] is None else limits[0]
    levels = numpy.ma.masked_invalid(numpy.where(numpy.isneginf(levels), foot, levels))
    palette = palette_of(colormap or "viridis", foot, top)
    mesh = ax.pcolormesh(
        across, upright, levels, cmap=palette, norm=colors.Normalize(foot, top), rasterized=True
    )
    other = float(maps.attrs.get("other_mesh_order", 0.0))
    rays = [(ray, float(ray), ":", _RAY_COLOUR) for ray in _RAYS]
    if other > 0.0:
        rays += [(ray, ray * other, "--", OTHER_MESH_COLOUR) for ray in _RAYS]
    for name, ray, dashes, colour in rays:
        line = numpy.full_like(forcing, ray) if is_order else ray * forcing
        ax.plot(axis.values, line, dashes, color=colour, linewidth=1.0)
        end = float(axis.values[-1]), float(line[-1])
        ax.annotate(str(name), end, color=colour, ha="right", va="bottom", clip_on=True)
    modes = _modes(maps, scale)
    for mode in modes:
        ax.plot(axis.values, mode / forcing if is_order else mode, "--", color="w", linewidth=1.2)
    highest = [float(max(_RAYS)) * forcing.max(), *(1.1 * mode[0] for mode in modes)]
    ax.set_ylim(0.0, min(order[-1], max(_RAYS) + 0.5) if is_order else max(highest))
    label_axis(ax.xaxis, axis)
    word = maps.attrs.get("order_of", "forcing")
    whose = f" of {maps.attrs.get('mesh_of_phase', '')}" if other > 0.0 else ""
    ax.set_ylabel(f"{word} order{whose}" if is_order else f"frequency{frequency_unit}")
    channel = maps.attrs["channel"]
    unit = maps.amplitude.attrs.get("units", "1")
    bar = ax.figure.colorbar(mesh, ax=ax, pad=0.02)
    bar.set_label(f"amplitude of {_core.quantity_label(channel, unit)}, dB re 1")
    draw_heading(ax, maps, maps.amplitude.attrs.get("long_name", ""), title)
    return ax


def _hertz(maps: xarray.Dataset) -> tuple[float, str]:
    """What frequencies are multiplied by, and the unit that they are in then."""
    if IN_SI in maps.attrs:  # rpm of the pinion
        turns = maps.attrs["scale_varpi_rad_per_s"] / maps.attrs["scale_rpm_per_omega"]
        return float(turns / (2.0 * pi)), " (Hz)"
    unit = maps.forcing_frequency.attrs.get("units", "1")
    return 1.0, " (ϖ)" if unit == "varpi" else ""


def _at_edges(values: NDArray[Any], forcing: NDArray[Any], places: NDArray[Any]) -> NDArray[Any]:
    """The frequency of order 1 at the edges of the cells."""
    if len(values) == 1:
        return numpy.full_like(places, forcing[0])
    slope = numpy.diff(forcing) / numpy.diff(values)
    inner = numpy.interp(places, values, forcing)
    inner[0] = forcing[0] + slope[0] * (places[0] - values[0])
    inner[-1] = forcing[-1] + slope[-1] * (places[-1] - values[-1])
    made: NDArray[Any] = inner
    return made


def _modes(maps: xarray.Dataset, scale: float) -> list[NDArray[Any]]:
    """Natural frequencies over the axis; equal ones once."""
    if "natural_frequency" not in maps:
        return []
    found: list[NDArray[Any]] = []
    for mode in scale * maps.natural_frequency.values.T:
        if not any(abs(mode[0] - other[0]) < 1e-6 * other[0] for other in found):
            found.append(mode)
    return found
