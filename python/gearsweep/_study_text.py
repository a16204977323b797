"""A study as its text: what it says, and another that differs from it."""

from __future__ import annotations

import html
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from gearsweep import _core
from gearsweep._errors import InputError
from gearsweep._value import assignments
from gearsweep._warning import warn

if TYPE_CHECKING:
    from typing import Self

    from gearsweep._core import Study as CoreStudy


class StudyText:
    """The text of a `Study`, which never changes."""

    __slots__ = ("_core",)
    _core: CoreStudy

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
        """The number of values of each axis; the first changes fastest. Empty without axes."""
        return dict(zip(self._core.axis_names, self._core.axis_counts, strict=True))

    def set(self, changes: Mapping[str, Any]) -> Self:
        """Make a study that differs.

        Parameters
        ----------
        changes : mapping of str to object
            Paths of keys with their values, such as ``{"axes.omega.count": 100}``.

        Returns
        -------
        Study
        """
        return self._of(_core.read_draft(self.toml, "study", assignments(changes), []))

    def _with(self, table: str, keys: Mapping[str, Any]) -> Self:
        return self._built(table, keys, {f"{table}.{key}": value for key, value in keys.items()})

    def _built(self, step: str, keys: Mapping[str, Any], changes: Mapping[str, Any]) -> Self:
        """As `set`; messages begin with the step, since no user has written its assignments."""
        try:
            return self.set(changes)
        except InputError as error:
            place, colon, reason = str(error).partition(": ")
            if not colon or not place.startswith("--set "):
                raise
            raise InputError(f"{step}({', '.join(keys)}): {reason}") from None

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("a Study never changes; Study.set() makes another one")

    def __delattr__(self, name: str) -> None:
        raise AttributeError("a Study never changes; Study.set() makes another one")

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, StudyText):
            return NotImplemented
        return self.toml == other.toml

    def __hash__(self) -> int:
        return hash(self.toml)

    def __reduce__(self) -> tuple[type[Self], tuple[str]]:
        return type(self), (self.toml,)

    def __str__(self) -> str:
        return self.toml

    def __repr__(self) -> str:
        title = f" {self.title!r}" if self.title else ""
        return f"<gearsweep.Study{title}: {self._summary()}>"

    def _summary(self) -> str:
        if not self.axes:
            return f"{self.model}, without axes"
        axes = ", ".join(f"{count} values of {name}" for name, count in self.axes.items())
        return f"{self.model} over {axes}"

    def _repr_html_(self) -> str:
        head = f"<b>{html.escape(self.title)}</b> {html.escape(self._summary())}"
        return (
            f"<details><summary>{head}</summary><pre>{html.escape(self.toml)}</pre></details>"
        )
