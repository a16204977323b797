"""Where studies come from: files, names, text, earlier results."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

import xarray

from gearsweep import _core
from gearsweep._errors import InputError
from gearsweep._model import Model
from gearsweep._points import points_in
from gearsweep._study import Study, study_text
from gearsweep._value import assignments, path_of


def study_of(source: Any, changes: Mapping[str, Any] | None = None) -> Study:
    """The study that `source` stands for, with changes.

    Parameters
    ----------
    source : str, path, Study or Dataset
        The name of a built-in study, a file, TOML, a study, or an earlier result.
    changes : mapping of str to object, optional
        As `Study.set` takes them.

    Returns
    -------
    Study
    """
    made = assignments(changes)
    if isinstance(source, Model):
        raise InputError("a Model is no study yet; gearsweep.Study(model) makes one")
    if isinstance(source, Study):
        return source.set(changes) if changes else source
    if isinstance(source, xarray.Dataset):
        if "study" not in source.attrs:
            raise InputError("the Dataset has no attribute 'study': gearsweep did not make it")
        text = source.attrs["study"]
        if not isinstance(text, str):
            raise InputError(
                "the attribute 'study' of the Dataset must be a text, "
                f"not one of the type {type(text).__name__}"
            )
        return Study._of(_core.read_result_study(text, made, points_in(source)))
    if isinstance(source, os.PathLike):
        return Study._of(_core.find_study(path_of(source, "a path"), made))
    text = study_text(source)
    # A name has neither lines nor assignments, and hardly any path.
    if "\n" in text or ("=" in text and not os.path.exists(text)):
        return Study._of(_core.read_study(text, "study", made, []))
    return Study._of(_core.find_study(text, made))


def studies() -> dict[str, str]:
    """The built-in studies.

    Returns
    -------
    dict of str to str
        Names with titles.

    Examples
    --------
    >>> import gearsweep as gs
    >>> gs.studies()["coarse-map"]
    'Coarse gear pair'
    """
    return {name: _core.find_study(name, []).title for name in _core.builtin_study_names()}
