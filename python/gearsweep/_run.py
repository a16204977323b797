"""Runs: from a study to its maps."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import xarray

from gearsweep._errors import InputError
from gearsweep._result import call_text, dataset_of
from gearsweep._session import SESSION, device_text
from gearsweep._study import Study, study_of
from gearsweep._value import path_of
from gearsweep._warning import warn


class Progress(NamedTuple):
    """How far a run is: share of the work from 0 to 1, points, and seconds since it began."""

    share: float
    points_done: int
    points: int
    seconds: float


def run(
    study: str | os.PathLike[str] | Study | xarray.Dataset,
    *,
    set: Mapping[str, Any] | None = None,
    progress: Callable[[Progress], object] | None = None,
    journal: str | os.PathLike[str] | None = None,
    device: int | str | None = None,
) -> xarray.Dataset:
    """Compute the maps of a study.

    Parameters
    ----------
    study : str, path, Study or Dataset
        The name of a built-in study, a path of a study or a result, TOML, a `Study`, or the
        Dataset of an earlier run.
    set : mapping of str to object, optional
        Changes of the study, such as ``{"parameters.mu": 0, "axes.omega.count": 100}``.
    progress : callable, optional
        Called with a `Progress` now and then, by the thread that called `run`. What it raises
        stops the run.
    journal : path, optional
        Where finished parts are kept until all are there. A run with the same study and journal
        goes on where an interrupted one ended.
    device : int or str, optional
        A number of `devices`, or several as in the command: ``"0,1"``, ``"all"``.

    Returns
    -------
    xarray.Dataset
        What ``xarray.open_dataset`` makes of the file that ``gearsweep run`` writes. A quantity has
        one dimension for each axis, the first axis last; its unit is its attribute ``units``.

    Raises
    ------
    InputError
        The study or an option is wrong.
    RunError
        A device or a disk failed.
    KeyboardInterrupt
        After Ctrl-C, once the running round is over. A journal keeps what is finished.

    Examples
    --------
    >>> import gearsweep as gs
    >>> maps = gs.run("coarse-map", set={"axes.omega.count": 8, "axes.e0.count": 4})
    >>> maps.dmf_max.dims, maps.dmf_max.shape, maps.dmf_max.units
    (('e0', 'omega'), (4, 8), 'k0 b_n')
    >>> gs.run("coarse-mop")
    Traceback (most recent call last):
    gearsweep.InputError: there is no built-in study 'coarse-mop'; did you mean 'coarse-map'?
    """
    if progress is not None and not callable(progress):
        raise InputError("progress: expected a function that takes a Progress")
    asked = study_of(study, set)
    tell = None if progress is None else lambda *news: progress(Progress(*news))
    described, troubles = SESSION.run(
        study=asked._core,
        device=device_text(device),
        journal="" if journal is None else path_of(journal, "a path as journal"),
        call=call_text("run", study, set=set),
        progress=tell,
    )
    for trouble in troubles:
        warn(trouble)
    made = dataset_of(*described)
    if made.status.values.all():
        warn("every point failed; the maps are empty")
    return made
