"""Gears as they are built."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from typing import Any

import xarray

from gearsweep import _core
from gearsweep._errors import InputError
from gearsweep._maps import means_of
from gearsweep._named import options_by_name
from gearsweep._place import count_of, number_of
from gearsweep._progress import Watch
from gearsweep._result import call_text
from gearsweep._run import run
from gearsweep._session import SESSION
from gearsweep._study import Study
from gearsweep._study_source import study_of


@options_by_name
def tolerance(
    study: str | os.PathLike[str] | Study | xarray.Dataset,
    *,
    gears: int = 2000,
    tolerance_class: int = 7,
    percentile: float = 99.0,
    set: Mapping[str, Any] | None = None,
    progress: Watch = True,
    journal: str | os.PathLike[str] | None = None,
    device: int | str | None = None,
) -> xarray.Dataset:
    """Compute what tolerances make of a gear over a speed.

    Each gear is a draw of the study's ``[uncertain]`` table, or of usual tolerances where a study
    with a ``[gear]`` table has none, and starts from the motion of the nominal gear. The ranking of
    tolerances and the worst gears are what `tolerance_findings` tells.

    Parameters
    ----------
    study : str, path, Study or Dataset
        As `run` takes it, with one axis, a speed.
    gears : int
        How many gears are drawn.
    tolerance_class : int
        Of ISO 1328-1, 1 to 11, for the flanks of a study without ``[uncertain]``.
    percentile : float
        Which percentile, and that as far from the other end, become maps beside the median.
    set : mapping of str to object, optional
        Changes of the study before its tolerances.
    progress, journal, device
        As `run` takes them.

    Returns
    -------
    Dataset
        Force, load factor, transmission error, bearing forces and contact over the speed, as far as
        the model has them: nominal, percentiles (``dmf_max_p99``), shares of the classes of
        contact, and in each gear (``dmf_max_draws``), with the parameters of each gear in
        ``uncertain_value``.

    Examples
    --------
    >>> study = Study.gear5("consistent").sweep(omega=(0.8, 1.2, 3)).integrate(max_step=0.2)
    >>> maps = tolerance(study.uncertain(mu={"distribution": "normal", "std": 0.005}), gears=20)
    >>> dict(maps.dmf_max_p99.sizes)
    {'omega': 3}
    """
    drawn, flanks, judged = _numbers_of(gears, tolerance_class, percentile)
    built = _core.as_built(study_of(study, set)._core, drawn, flanks, judged)
    return run(Study._of(built), progress=progress, journal=journal, device=device)


def tolerance_findings(
    study: str | os.PathLike[str] | Study | xarray.Dataset,
    *,
    gears: int = 2000,
    tolerance_class: int = 7,
    percentile: float = 99.0,
    width: float | None = None,
    set: Mapping[str, Any] | None = None,
    journal: str | os.PathLike[str] | None = None,
    device: int | str | None = None,
) -> dict[str, Any]:
    """Find what tolerances make of a gear over a speed, and which of them matters.

    The numbers of the page of ``gearsweep tolerance``, as its option ``--json`` writes them: worst
    speeds, percentiles with the halves of their 95 % intervals, the share of the gears that lose
    contact, the ranking of tolerances, the worst gears, and what was assumed.

    Parameters
    ----------
    study, gears, tolerance_class, percentile, set, device
        As `tolerance` takes them.
    width : float, optional
        More gears are drawn until the percentile at the worst speed is known to this share of
        itself.
    journal : path, optional
        Where the runs over all speeds keep what is done, each with ``-`` and its number of gears
        behind it, so that a call that was interrupted goes on.

    Returns
    -------
    dict
        With the names that the page of tolerances lists. What is not known is None.

    Examples
    --------
    >>> study = Study.gear5("consistent").sweep(omega=(0.8, 1.2, 3)).integrate(max_step=0.2)
    >>> study = study.uncertain(mu={"distribution": "normal", "std": 0.005})
    >>> found = tolerance_findings(study, gears=20)
    >>> found["ranking"][0]["tolerance"]
    'mu'
    """
    drawn, flanks, judged = _numbers_of(gears, tolerance_class, percentile)
    known = None if width is None else number_of(width, "width")
    if known is not None and not 1e-4 <= known <= 1.0:
        raise InputError(f"width: expected a number between 0.0001 and 1, not {known}")
    text = SESSION.tolerance_findings(
        study_of(study, set)._core,
        drawn,
        flanks,
        judged,
        known,
        *means_of(journal, device),
        call_text("tolerance_findings", study, gears=gears, set=set),
    )
    findings: dict[str, Any] = json.loads(text)
    return findings


def _numbers_of(gears: int, tolerance_class: int, percentile: float) -> tuple[int, int, float]:
    drawn = count_of(gears, "gears", 2, 100_000)
    flanks = count_of(tolerance_class, "tolerance_class", 1, 11)
    if drawn is None or flanks is None:
        raise InputError("gears and tolerance_class are numbers")
    judged = number_of(percentile, "percentile")
    if not 50.0 < judged < 100.0:
        raise InputError(f"percentile: expected a number between 50 and 100, not {judged}")
    return drawn, flanks, judged
