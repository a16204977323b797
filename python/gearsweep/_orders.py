"""Order maps: the spectrum of a channel at each value of an axis."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any, SupportsFloat

import xarray

from gearsweep._errors import InputError
from gearsweep._named import options_by_name
from gearsweep._place import count_of, number_of, pilot_step_of, place_of
from gearsweep._result import call_text, dataset_of
from gearsweep._session import SESSION, device_text
from gearsweep._study import Study
from gearsweep._study_source import study_of
from gearsweep._value import text_of


@options_by_name
def orders(
    study: str | os.PathLike[str] | Study | xarray.Dataset,
    *,
    over: str | None = None,
    channel: str | None = None,
    at: Mapping[str, SupportsFloat] | None = None,
    orders: float = 10.0,
    settle: int | None = None,
    record: int | None = None,
    samples_per_period: int | None = None,
    window: str | None = None,
    set: Mapping[str, Any] | None = None,
    device: int | str | None = None,
    **place: SupportsFloat,
) -> xarray.Dataset:
    """Take the spectrum of a channel at each value of an axis, such as the speed.

    Parameters
    ----------
    study : str, path, Study or Dataset
        As `run` takes it.
    over : str, optional
        The axis; by default the study's first.
    channel : str, optional
        A state or signal; by default the force between the teeth, else the first state.
    **place : float
        Values of the study's other axis and of parameters, as in ``e0=0.3``; by default the
        study's own.
    at : mapping of str to float, optional
        The same as a dict, for parameters that are called like an option.
    orders : float, optional
        The highest order, in multiples of the mesh frequency.
    settle, record : int, optional
        Mesh periods before, exactly so many, and of each spectrum: its orders are 1/`record`
        apart. By default as the study settles, and 48. Up to whole periods of the forcing, which
        are many mesh periods where a gear has a fault.
    samples_per_period : int, optional
        Moments of each mesh period, by default 256. Orders above half of it come down to lower ones.
    window : {"none", "hann"}, optional
        By default none: the lines of a motion whose period divides the record are exact.
    set : mapping of str to object, optional
        Changes of the study, as `run` takes them.
    device : int or str, optional
        A number of `devices`.

    Returns
    -------
    xarray.Dataset
        ``amplitude`` (axis, order) in the unit of the channel, its ``mean``, and
        ``forcing_frequency``, that of order 1, over the axis; ``natural_frequency`` and
        ``damping_ratio`` (axis, mode). ``maps.gear.plot()`` draws it as a Campbell diagram.

    Raises
    ------
    InputError
        The study, the place or an option is wrong.
    RunError
        All points diverge, or the device failed.
    KeyboardInterrupt
        After Ctrl-C.

    Examples
    --------
    >>> import gearsweep as gs
    >>> small = {"axes.omega.count": 4, "integrate.settle": 20}
    >>> lines = gs.orders("coarse-map", e0=0.3, record=4, orders=3, set=small)
    >>> lines.amplitude.dims, lines.amplitude.shape, lines.amplitude.units
    (('omega', 'order'), (4, 13), 'k0 b_n')
    """
    if window is not None and (not isinstance(window, str) or window not in ("none", "hann")):
        raise InputError(f"window: expected 'none' or 'hann', not {window!r}")
    samples = count_of(samples_per_period, "samples_per_period", 4, 1 << 16)
    highest = number_of(orders, "orders")
    if not 0.0 < highest < float("inf"):
        raise InputError(f"orders: {orders!r} is not greater than 0")
    described = SESSION.orders(
        study=study_of(study, set)._core,
        over="" if over is None else text_of(over, "the name of an axis"),
        place=place_of(place, {} if at is None else at),
        channel="" if channel is None else text_of(channel, "the name of a state or a signal"),
        settle=count_of(settle, "settle", 0, 1_000_000_000),
        record=count_of(record, "record", 1, 100_000),
        highest=highest,
        samples_per_period=256 if samples is None else samples,
        has_window=window == "hann",
        pilot_step=pilot_step_of(study),
        device=device_text(device),
        call=call_text(
            "orders",
            study,
            over=over,
            channel=channel,
            at=at,
            orders=orders,
            settle=settle,
            record=record,
            samples_per_period=samples_per_period,
            window=window,
            set=set,
            **place,
        ),
    )
    return dataset_of(*described)
