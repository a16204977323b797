"""Traces: the motion at single points in time."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, SupportsFloat

import xarray

from gearsweep._errors import InputError
from gearsweep._named import options_by_name
from gearsweep._place import count_of, pilot_step_of, place_of
from gearsweep._result import call_text, dataset_of
from gearsweep._session import SESSION, device_text
from gearsweep._study import Study
from gearsweep._study_source import study_of
from gearsweep._warning import warn

_MOST = 1_000_000_000  # periods
_MOST_SAMPLES = 1 << 20  # of a period


@options_by_name
def trace(
    study: str | os.PathLike[str] | Study | xarray.Dataset,
    *,
    at: Mapping[str, SupportsFloat] | Sequence[Mapping[str, SupportsFloat]] | None = None,
    settle: int | None = None,
    record: int | None = None,
    samples_per_period: int | None = None,
    set: Mapping[str, Any] | None = None,
    device: int | str | None = None,
    **place: SupportsFloat,
) -> xarray.Dataset:
    """Follow the motion at one point, or at several.

    Parameters
    ----------
    study : str, path, Study or Dataset
        As `run` takes it. Of a map, which is the Dataset or the file of an earlier run, the
        trace takes the steps.
    **place : float
        A value for each axis, which need be none of the axis's own; other parameters and initial states may be given, too. In the
        model's units, as in ``omega=1.3, b=0.6``.
    at : mapping, or sequence of mappings, of str to float, optional
        The same as a dict, or several points: ``at=[{"omega": 1.3}, {"omega": 1.4}]``. What
        stands in `place` holds for each of them.
    settle : int, optional
        Mesh periods before the trace, exactly so many. By default those of the study, or
        fewer where the motion is periodic before. 0 shows the start.
    record : int, optional
        Mesh periods of the trace. By default those of the study. It and `settle` go up to whole
        periods of the forcing, which are many mesh periods where a gear has a fault.
    samples_per_period : int, optional
        Evenly spaced moments of each mesh period, interpolated. By default the moments are both
        ends of each integration step. A spectrum goes up to half as many orders of the mesh; what
        is above comes down to lower ones.
    set : mapping of str to object, optional
        Changes of the study, as `run` takes them.
    device : int or str, optional
        A number of `devices`.

    Returns
    -------
    xarray.Dataset
        The states and signals over the dimension ``moment``, with the coordinate ``tau``, the
        dimensionless time since the first moment. A list of points gives what
        ``xarray.open_dataset`` makes of the file that ``gearsweep trace`` writes: everything over
        ``(trace, moment)``, with NaN beyond a trace's end, and ``tau`` as a variable.

    Raises
    ------
    InputError
        The study, the place or an option is wrong.
    RunError
        The point diverges, or the device failed.
    KeyboardInterrupt
        After Ctrl-C, once the running round is over.

    Examples
    --------
    >>> import gearsweep as gs
    >>> trace = gs.trace("coarse-map", omega=0.7, e0=0.5, record=2, samples_per_period=64)
    >>> trace.dmf.dims, trace.dmf.shape, trace.dmf.units
    (('moment',), (128,), 'k0 b_n')
    >>> two = gs.trace("coarse-map", at=[{"omega": 0.7}, {"omega": 0.9}], e0=0.5, record=2)
    >>> two.dmf.dims
    ('trace', 'moment')
    """
    described, notices = SESSION.trace(
        study=study_of(study, set)._core,
        points=[place_of(place, point) for point in _points(at)],
        settle=count_of(settle, "settle", 0, _MOST),
        record=count_of(record, "record", 1, _MOST),
        samples_per_period=count_of(samples_per_period, "samples_per_period", 1, _MOST_SAMPLES)
        or 0,
        pilot_step=pilot_step_of(study),
        device=device_text(device),
        call=call_text(
            "trace",
            study,
            at=at,
            settle=settle,
            record=record,
            samples_per_period=samples_per_period,
            set=set,
            **place,
        ),
    )
    for notice in notices:
        warn(notice)
    made = dataset_of(*described)
    is_one = at is None or isinstance(at, Mapping)
    return made.isel(trace=0).set_coords("tau") if is_one else made


def _points(
    at: Mapping[str, SupportsFloat] | Sequence[Mapping[str, SupportsFloat]] | None,
) -> list[Mapping[str, SupportsFloat]]:
    if at is None:
        return [{}]
    if isinstance(at, Mapping):
        return [at]
    if isinstance(at, str) or not isinstance(at, Sequence) or len(at) == 0:
        raise InputError("at: expected a point such as {'omega': 0.7}, or a list of points")
    return list(at)
