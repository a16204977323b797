"""Traces by matplotlib, as ``gearsweep plot`` draws them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy
import xarray

from gearsweep import _core
from gearsweep._errors import InputError
from gearsweep._frame import OTHER_MESH_COLOUR, box, draw_heading, draw_key
from gearsweep._shown import Limits

if TYPE_CHECKING:
    import matplotlib.axes
    from numpy.typing import NDArray

_CONTENT = "traces of gearsweep"
_KINDS = {"time": 1, "phase": 2, "section": 2, "spectrum": 1, "force": 1}  # channels of each
_RECENT = 10  # periods that a history shows
_ORDERS = 10.0
_DEPTH, _ABOVE = 100.0, 5.0  # decibels
_INSTANT = 1e-6  # of a period: far less than a step, far more than rounding
_FLANKS = (
    (1, "drive flank", "#d3e4f1"),
    (-1, "back flank", "#e2b9d3"),
    (2, "both flanks (wedged)", "#a9cfae"),
)
_COLOURS = ("#0072b2", "#e69f00", "#009e73", "#000000", "#cc79a7", "#d55e00")
_GRID = "#dddddd"


def is_traces(data: xarray.Dataset) -> bool:
    """Whether the Dataset is what `gearsweep.trace` returns."""
    return data.attrs.get("content") == _CONTENT


@dataclass
class _Layer:
    name: str
    data: xarray.Dataset  # of one trace, without moments beyond its end
    times: NDArray[Any]  # in periods of the forcing; without forcing in the model's time

    @property
    def mesh_periods(self) -> float:
        return float(self.data.get("mesh_periods_per_period", 1.0))

    @property
    def has_clock(self) -> bool:
        return "clockless" not in self.data

    def values(self, channel: str) -> NDArray[Any]:
        values: NDArray[Any] = self.data[channel].values
        return values

    def recent(self) -> _Layer:
        """Its last periods, from time 0 on."""
        if not self.has_clock:
            return self
        start = numpy.ceil(self.times[-1] - _INSTANT) - _RECENT
        kept = self.times >= start - _INSTANT
        if start <= 0.0:
            return self
        return _Layer(self.name, self.data.isel(moment=kept), self.times[kept] - start)


def plot_traces(
    data: xarray.Dataset,
    quantity: str | None,
    *,
    ax: matplotlib.axes.Axes | None,
    limits: Limits,
    title: str | None,
) -> matplotlib.axes.Axes:
    """Draw traces over one another; `gearsweep.Gear.plot` says how."""
    from matplotlib import pyplot

    layers = _layers_of(data)
    kind, *asked = (quantity or "time").split(":")
    if kind not in _KINDS or len(asked) > _KINDS[kind]:
        raise InputError(
            f"{quantity!r}: of a trace there are 'time', 'phase', 'section', 'spectrum' and 'force', "
            "each with a channel behind a colon, as in 'spectrum:dmf' or 'phase:x1:v1'"
        )
    channels = _channels_of(layers[0].data, kind, asked)
    if ax is None:
        ax = pyplot.subplots(layout="constrained")[1]
    ax.grid(color=_GRID, linewidth=0.6)
    ax.set_axisbelow(True)
    key: list[Any] = []
    if kind == "spectrum":
        meaning, key = _draw_spectrum(ax, layers, channels[0])
    elif kind in ("phase", "section"):
        meaning = _draw_plane(ax, layers, channels, kind == "phase")
    else:
        meaning, key = _draw_history(ax, layers, channels[0], kind == "force")
    if limits != (None, None):
        ax.set_ylim(*limits)
    if len(layers) > 1:
        named = [line for line in ax.get_lines() if not line.get_label().startswith("_")]
        key = [*(line for line in named if line.get_label() and line not in key), *key]
    draw_key(ax, key)
    draw_heading(ax, data, meaning, title)
    return ax


def _layers_of(data: xarray.Dataset) -> list[_Layer]:
    traces = [data]
    if "trace" in data.dims:
        traces = [data.isel(trace=i) for i in range(data.sizes["trace"])]
    if len(traces) > len(_COLOURS):
        raise InputError(f"{len(traces)} traces are too many to be told apart; select some of them")
    layers = []
    for one in traces:
        tau = one["tau"].values
        known = one.isel(moment=numpy.isfinite(tau))
        times = known["tau"].values / (1.0 if "clockless" in one else float(one["period"]))
        layers.append(_Layer(_name_of(one), known, times))
    return layers


def _name_of(trace: xarray.Dataset) -> str:
    label = trace["label"].values.item() if "label" in trace else ""
    return (label.decode() if isinstance(label, bytes) else str(label)).strip()


def _channels_of(trace: xarray.Dataset, kind: str, asked: list[str]) -> list[str]:
    known = [str(name) for name, one in trace.data_vars.items() if "moment" in one.dims]
    for name in asked:
        if name not in known:
            raise InputError(
                f"the trace has no channel {name!r}{_core.suggest_name(name, known)}"
            )
    if kind == "force":
        if "contact" not in known:
            raise InputError(
                "'force' shows the flanks in contact, and this model has not one backlash"
            )
        forces = [name for name in known if trace[name].attrs.get("role") == "mesh_force"]
        if not asked and not forces:
            raise InputError("no channel is the force between the teeth; name one: 'force:NAME'")
        return asked or forces[:1]
    if _KINDS[kind] == 1:
        return asked or known[:1]
    if len(asked) == 2:
        return asked
    moving = [name for name in known if trace[name].attrs.get("velocity") in known]
    first = (asked or moving or known)[0]
    velocity = trace[first].attrs.get("velocity", "")
    if velocity not in known:
        raise InputError(f"{first!r} has no velocity beside it; name two channels: '{kind}:x1:v1'")
    return [first, velocity]


def _draw_history(
    ax: matplotlib.axes.Axes, layers: list[_Layer], channel: str, has_flanks: bool
) -> tuple[str, list[Any]]:
    layers = [layer.recent() for layer in layers]
    factor, label = _time_scale(layers[0])
    for layer, colour in zip(layers, _COLOURS, strict=False):
        name = _core.literal_label(layer.name)
        ax.plot(factor * layer.times, layer.values(channel), color=colour, label=name)
    key: list[Any] = []
    if has_flanks and len(layers) == 1:
        times, contact = factor * layers[0].times, numpy.rint(layers[0].values("contact"))
        for flank, words, colour in _FLANKS:
            if not (contact == flank).any():
                continue
            ax.fill_between(
                times,
                0.0,
                1.0,
                where=contact == flank,
                step="mid",
                transform=ax.get_xaxis_transform(),
                color=colour,
                linewidth=0,
                zorder=0,
            )
            key.append(box(colour, words))
    ax.set_xlim(0.0, factor * max(layer.times[-1] for layer in layers))
    ax.set_xlabel(label)
    ax.set_ylabel(_label_of(layers[0], channel))
    return str(layers[0].data[channel].attrs.get("long_name", "")), key


def _time_scale(layer: _Layer) -> tuple[float, str]:
    """What times are multiplied by, and what they are then."""
    if layer.data["tau"].attrs.get("units") == "s":
        per_period = float(layer.data["period"]) if layer.has_clock else 1.0
        return 1e3 * per_period, "time (ms)"
    if not layer.has_clock:
        return 1.0, "time"
    return 1.0, f"time ({_forcing_of(layer, layer.mesh_periods == 1.0)} periods)"


def _forcing_of(layer: _Layer, may_be_mesh: bool) -> str:
    roles = [one.attrs.get("role") for one in layer.data.data_vars.values()]
    return "mesh" if may_be_mesh and "mesh_force" in roles else "forcing"


def _draw_plane(
    ax: matplotlib.axes.Axes, layers: list[_Layer], channels: list[str], has_curve: bool
) -> str:
    if not has_curve and not layers[0].has_clock:
        raise InputError("'section' is at phase 0 of the forcing, and this model has none")
    for layer, colour in zip(layers, _COLOURS, strict=False):
        x, y = (layer.values(channel) for channel in channels)
        name = _core.literal_label(layer.name)
        if has_curve:
            ax.plot(x, y, color=colour, linewidth=0.7, label=name)
        if layer.has_clock:
            section = numpy.abs(layer.times - numpy.rint(layer.times)) <= _INSTANT
            edge = "k" if has_curve else colour
            style = {"color": colour, "markersize": 3.0, "markeredgecolor": edge}
            ax.plot(x[section], y[section], "o", label="" if has_curve else name, **style)
    ax.set_xlabel(_label_of(layers[0], channels[0]))
    ax.set_ylabel(_label_of(layers[0], channels[1]))
    meaning = str(layers[0].data[channels[0]].attrs.get("long_name", ""))
    return meaning if has_curve else meaning + ", at phase 0 of each period"


def _draw_spectrum(
    ax: matplotlib.axes.Axes, layers: list[_Layer], channel: str
) -> tuple[str, list[Any]]:
    highest = 0.0
    last = _ORDERS
    for layer, colour in zip(layers, _COLOURS, strict=False):
        order_step, amplitude = _spectrum_of(layer, channel)
        unit = 1.0 if layer.has_clock else float(layer.data["period"])
        orders = order_step * numpy.arange(len(amplitude))
        levels = 20.0 * numpy.log10(numpy.maximum(amplitude, 1e-300))
        name = _core.literal_label(layer.name)
        ax.plot(orders / unit, levels, color=colour, linewidth=0.9, label=name)
        top = levels[orders <= _ORDERS].max()
        highest = top if colour == _COLOURS[0] else max(highest, top)
        last = _ORDERS / unit
    ax.set_xlim(0.0, last)
    ax.set_ylim(highest + _ABOVE - _DEPTH, highest + _ABOVE)
    forcing = _forcing_of(layers[0], may_be_mesh=True)
    has_clock = layers[0].has_clock
    whole = layers[0].data.attrs
    other = float(whole.get("other_mesh_order", 0.0))
    places = numpy.arange(other, last, other) if other > 0.0 else numpy.array([])
    style = {"linestyle": "--", "linewidth": 0.8, "color": OTHER_MESH_COLOUR}
    marks = [ax.axvline(place, **style, label="_") for place in places]
    for mark in marks[:1]:
        mark.set_label(f"orders of {whole['other_mesh']}")
    phase = f" of {whole['mesh_of_phase']}" if other > 0.0 else ""
    ax.set_xlabel(
        f"order (frequency / {forcing} frequency{phase})" if has_clock else "frequency (1/time)"
    )
    attributes = layers[0].data[channel].attrs
    unit_text = attributes.get("units", "1")
    shown = "" if unit_text == "1" else f" {_core.typeset_label(unit_text)}"
    ax.set_ylabel(f"{_core.quantity_label(channel, '1')} (dB re 1{shown})")
    return f"amplitudes: {attributes.get('long_name', '')}, without its mean", marks[:1]


def _spectrum_of(layer: _Layer, channel: str) -> tuple[float, NDArray[Any]]:
    """Of the last whole periods, under Hann's window; orders are those of the mesh."""
    gaps = numpy.diff(layer.times)
    per_period = 1.0 / gaps.mean() if layer.has_clock else float(layer.data["period"]) / gaps.mean()
    is_even = numpy.allclose(gaps, gaps.mean(), rtol=1e-6, atol=0.0)
    count = round(per_period)
    if not is_even or abs(per_period - count) > 1e-6 * count:
        raise InputError(
            "a spectrum takes evenly spaced moments, a whole number of them in each period: trace "
            "the point with samples_per_period=256"
        )
    whole = len(layer.times) // count
    if whole == 0:
        raise InputError("a spectrum takes a whole period, and this trace is shorter")
    samples = layer.values(channel)[: whole * count]
    order_step, amplitude = _core.amplitude_spectrum(samples, whole)
    return order_step / layer.mesh_periods, amplitude


def _label_of(layer: _Layer, channel: str) -> str:
    return _core.quantity_label(channel, layer.data[channel].attrs.get("units", "1"))
