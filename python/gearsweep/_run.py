"""Runs: from a study to its maps."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

import numpy
import xarray
from xarray.backends import InMemoryDataStore

from gearsweep._errors import InputError
from gearsweep._flags import flags_of
from gearsweep._progress import Watch, watched
from gearsweep._session import SESSION
from gearsweep._study import Study, study_of
from gearsweep._warning import warn


def run(
    study: str | os.PathLike[str] | Study | xarray.Dataset,
    *,
    set: Mapping[str, Any] | None = None,
    progress: Watch = True,
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
    progress : bool, callable or None, optional
        True, the default: a bar in terminals and notebooks where tqdm is installed. None or False:
        nothing. A function is called with a `Progress` now and then, by the thread that called
        `run`; what it raises stops the run.
    journal : path, optional
        Where finished parts are kept until all are there. A run with the same study and journal
        goes on where an interrupted one ended.
    device : int or str, optional
        A number of `devices`, or several as in the command: ``"0,1"``, ``"all"``.

    Returns
    -------
    xarray.Dataset
        What ``xarray.open_dataset`` makes of the file that ``gearsweep run`` writes.

    Raises
    ------
    InputError
        The study or an option is wrong.
    RunError
        A device or a disk failed.
    KeyboardInterrupt
        After Ctrl-C, once the running round is over. A journal keeps what is finished.

    Warns
    -----
    RuntimeWarning
        Some points failed; the message says how many.

    Examples
    --------
    >>> study = Study.of("duffing").sweep(omega=(0.5, 1.5, 3)).observe("x_rms")
    >>> maps = run(study.integrate(settle=20, record=10))
    >>> dict(maps.x_rms.sizes)
    {'omega': 3}
    """
    asked = study_of(study, set)
    with watched(progress) as tell:
        described, troubles = SESSION.run(
            study=asked._core,
            device=_devices(device),
            journal="" if journal is None else os.fspath(journal),
            call=_call(study, set),
            progress=tell,
        )
    for trouble in troubles:
        warn(trouble)
    made = _dataset(*described)
    _warn_of_failures(made.status)
    return made


def _warn_of_failures(status: xarray.DataArray) -> None:
    points = status.size
    failures = [
        f"{name} at {count} of {points} points"
        for code, name in flags_of(status).items()
        if code != 0 and (count := int((status.values == code).sum()))
    ]
    if not failures:
        return
    said = ", ".join(failures)
    if status.values.all():
        warn(f"every point failed; the maps are empty ({said})")
    else:
        warn(f"{said}: these have no values, and 'status' tells which they are")


def _devices(device: int | str | None) -> str:
    if device is None:
        return ""
    if isinstance(device, bool) or not isinstance(device, int | numpy.integer | str):
        raise InputError(f"device: expected a number or a text such as '0,1', not {device!r}")
    return str(device)


def _call(study: Any, changes: Mapping[str, Any] | None) -> str:
    is_short = isinstance(study, str | os.PathLike) and "\n" not in os.fspath(study)
    shown = repr(os.fspath(study)) if is_short else f"<{type(study).__name__}>"
    return f"gearsweep.run({shown}" + (f", set={dict(changes)!r})" if changes else ")")


def _dataset(
    variables: list[tuple[str, tuple[str, ...], numpy.ndarray, dict[str, Any]]],
    attributes: dict[str, Any],
) -> xarray.Dataset:
    """What xarray makes of a file of these variables: it takes the same way, without the file."""
    stored = {name: xarray.Variable(*variable) for name, *variable in variables}
    store = InMemoryDataStore(stored, attributes)
    return xarray.open_dataset(store, cache=False).load()
