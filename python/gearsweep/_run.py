"""Runs: from a study to its maps."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy
import xarray
from xarray.backends import AbstractDataStore, InMemoryDataStore

from gearsweep._errors import InputError
from gearsweep._session import SESSION
from gearsweep._study import Study, study_of
from gearsweep._value import path_of, text_of
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
        device=_devices(device),
        journal="" if journal is None else path_of(journal, "a path as journal"),
        call=_call(study, set),
        progress=tell,
    )
    for trouble in troubles:
        warn(trouble)
    made = _dataset(*described)
    if made.status.values.all():
        warn("every point failed; the maps are empty")
    return made


def _devices(device: int | str | None) -> str:
    if device is None:
        return ""
    if isinstance(device, bool) or not isinstance(device, int | numpy.integer | str):
        raise InputError(f"device: expected a number or a text such as '0,1', not {device!r}")
    return text_of(str(device), "numbers of devices")


def _call(study: Any, changes: Mapping[str, Any] | None) -> str:
    is_short = isinstance(study, str | os.PathLike) and "\n" not in os.fspath(study)
    shown = repr(os.fspath(study)) if is_short else f"<{type(study).__name__}>"
    return f"gearsweep.run({shown}" + (f", set={dict(changes)!r})" if changes else ")")


def _dataset(
    variables: list[tuple[str, tuple[str, ...], numpy.ndarray[Any, Any], dict[str, Any]]],
    attributes: dict[str, Any],
) -> xarray.Dataset:
    """What xarray makes of a file of these variables: it takes the same way, without the file."""
    # Debian's xarray has no types for these two.
    variable: Callable[..., xarray.Variable] = xarray.Variable
    store: Callable[..., AbstractDataStore] = InMemoryDataStore
    stored = {name: variable(*parts) for name, *parts in variables}
    return xarray.open_dataset(store(stored, attributes), cache=False).load()
