"""Studies: what to compute."""

from __future__ import annotations

import html
import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import xarray

from gearsweep import _core
from gearsweep._errors import InputError
from gearsweep._value import assignments, path_of, text_of
from gearsweep._warning import warn

if TYPE_CHECKING:
    from typing import Self

    from gearsweep._core import Study as CoreStudy


class Study:
    """What to compute: a model, its parameters, axes, and what to observe. It never changes.

    Parameters
    ----------
    text : str
        The study as TOML.

    Raises
    ------
    InputError
        The text is no study; the message says where and what would be right.
    """

    __slots__ = ("_core",)
    _core: CoreStudy

    def __init__(self, text: str) -> None:
        self._take(_core.read_study(_text(text), "study", []))

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Self:
        """Read a study.

        Parameters
        ----------
        path : path
            A TOML file, a result file (the study that made it), or the name of a built-in study.

        Returns
        -------
        Study
        """
        return cls._of(_core.find_study(path_of(path, "a path or the name of a study"), []))

    @classmethod
    def _of(cls, core: CoreStudy) -> Self:
        study = object.__new__(cls)
        study._take(core)
        return study

    def _take(self, core: CoreStudy) -> None:
        object.__setattr__(self, "_core", core)
        for notice in core.notices:
            warn(notice)

    @property
    def toml(self) -> str:
        """The whole study as TOML, with all that `set` changed."""
        return self._core.toml

    @property
    def title(self) -> str:
        """What it is about."""
        return self._core.title

    @property
    def model(self) -> str:
        """The name of its model."""
        return self._core.model

    @property
    def axes(self) -> dict[str, int]:
        """The number of values of each axis; the first changes fastest."""
        return dict(zip(self._core.axis_names, self._core.axis_counts, strict=True))

    def set(self, changes: Mapping[str, Any]) -> Study:
        """Make a study that differs.

        Parameters
        ----------
        changes : mapping of str to object
            Paths of keys with their values, such as ``{"axes.omega.count": 100}``.

        Returns
        -------
        Study
        """
        return Study._of(_core.read_study(self.toml, "study", assignments(changes)))

    def run(self, **options: Any) -> xarray.Dataset:
        """Compute it, as `gearsweep.run` does with the same options."""
        from gearsweep._run import run

        return run(self, **options)

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("a Study never changes; Study.set() makes another one")

    def __delattr__(self, name: str) -> None:
        raise AttributeError("a Study never changes; Study.set() makes another one")

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Study):
            return NotImplemented
        return self.toml == other.toml

    def __hash__(self) -> int:
        return hash(self.toml)

    def __reduce__(self) -> tuple[type[Study], tuple[str]]:
        return Study, (self.toml,)

    def __str__(self) -> str:
        return self.toml

    def __repr__(self) -> str:
        return f"<gearsweep.Study {self.title!r}: {self._summary()}>"

    def _summary(self) -> str:
        axes = ", ".join(f"{count} values of {name}" for name, count in self.axes.items())
        return f"{self.model} over {axes}"

    def _repr_html_(self) -> str:
        head = f"<b>{html.escape(self.title)}</b> {html.escape(self._summary())}"
        return (
            f"<details><summary>{head}</summary><pre>{html.escape(self.toml)}</pre></details>"
        )


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
    if isinstance(source, Study):
        return source.set(changes) if changes else source
    if isinstance(source, xarray.Dataset):
        if "study" not in source.attrs:
            raise InputError("the Dataset has no attribute 'study': gearsweep did not make it")
        return Study._of(_core.read_study(source.attrs["study"], "study", made))
    if isinstance(source, os.PathLike):
        return Study._of(_core.find_study(path_of(source, "a path"), made))
    text = _text(source)
    # A name has neither lines nor assignments, and hardly any path.
    if "\n" in text or ("=" in text and not os.path.exists(text)):
        return Study._of(_core.read_study(text, "study", made))
    return Study._of(_core.find_study(text, made))


def _text(source: Any) -> str:
    return text_of(
        source,
        "a study: the name of a built-in one, a path, TOML, a Study or the Dataset of an earlier run",
    )


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
