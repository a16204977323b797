"""What python/core/ gives the package."""

from collections.abc import Callable
from typing import Any

import numpy

class InputError(ValueError): ...
class RunError(RuntimeError): ...

class Study:
    @property
    def toml(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def notices(self) -> list[str]: ...
    @property
    def model(self) -> str: ...
    @property
    def axis_names(self) -> list[str]: ...
    @property
    def axis_counts(self) -> list[int]: ...

_Described = tuple[
    list[tuple[str, tuple[str, ...], numpy.ndarray[Any, Any], dict[str, Any]]],
    dict[str, Any],
]

class Session:
    def run(
        self,
        study: Study,
        device: str,
        journal: str,
        call: str,
        progress: Callable[[float, int, int, float], object] | None,
    ) -> tuple[_Described, list[str]]: ...
    def trace(
        self,
        study: Study,
        points: list[list[tuple[str, float]]],
        settle: int | None,
        record: int | None,
        samples_per_period: int,
        is_map: bool,
        pilot_step: float | None,
        device: str,
        call: str,
    ) -> _Described: ...
    def floquet(
        self,
        study: Study,
        place: list[tuple[str, float]],
        along: tuple[str, float, float] | None,
        period: int | None,
        steps: int | None,
        device: str,
        call: str,
    ) -> _Described: ...
    def verify(
        self,
        device: str,
        tell: Callable[[tuple[str, str, str, float, int, int, str]], object] | None,
    ) -> tuple[str, list[tuple[str, str, str, float, int, int, str]]]: ...
    def devices(self) -> list[dict[str, Any]]: ...

def read_study(text: str, source: str, changes: list[str], /) -> Study: ...
def find_study(name_or_path: str, changes: list[str], /) -> Study: ...
def builtin_study_names() -> list[str]: ...
def is_netcdf(path: str, /) -> bool: ...
def read_pilot_step(path: str, /) -> float | None: ...
def model_names() -> list[str]: ...
def model(name: str, /) -> dict[str, Any]: ...
def version() -> str: ...
