"""What python/core/ gives the package."""

from collections.abc import Callable
from typing import Any

import numpy
from numpy.typing import NDArray

class InputError(ValueError): ...
class RunError(RuntimeError): ...

class FoundStep:
    def __init__(self, max_step: float, orbit_steps: int) -> None: ...

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
    def option_names(self) -> list[str]: ...
    @property
    def parameter_names(self) -> list[str]: ...
    @property
    def constant_names(self) -> list[str]: ...
    @property
    def trajectories(self) -> int: ...
    @property
    def axis_names(self) -> list[str]: ...
    @property
    def axis_counts(self) -> list[int]: ...

_Described = tuple[
    list[tuple[str, tuple[str, ...], numpy.ndarray[Any, Any], dict[str, Any]]],
    dict[str, Any],
]

_Texts = list[tuple[str, list[str]]]
_GivenCurves = tuple[
    Study,
    list[tuple[str, str]],
    float,
    _Texts,
    list[tuple[str, numpy.ndarray[Any, Any]]],
]

class Exploration:
    @property
    def address(self) -> str: ...
    @property
    def is_running(self) -> bool: ...
    def stop(self) -> None: ...

class Session:
    def explore(
        self,
        study: Study,
        pilot_step: FoundStep | None,
        source: str,
        device: str,
        megabytes: int,
        port: int,
        curves_path: str,
        curves: _GivenCurves | None,
    ) -> Exploration: ...
    def run(
        self,
        study: Study,
        device: str,
        journal: str,
        call: str,
        progress: Callable[[float, int, int, float], object] | None,
        priority: int,
    ) -> tuple[_Described, list[str]]: ...
    def trace(
        self,
        study: Study,
        points: list[list[tuple[str, float]]],
        settle: int | None,
        record: int | None,
        samples_per_period: int,
        pilot_step: FoundStep | None,
        device: str,
        call: str,
    ) -> tuple[_Described, list[str]]: ...
    def orders(
        self,
        study: Study,
        over: str,
        place: list[tuple[str, float]],
        channel: str,
        settle: int | None,
        record: int | None,
        highest: float,
        samples_per_period: int,
        has_window: bool,
        pilot_step: FoundStep | None,
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
        equilibrium: bool,
        generations: int,
        device: str,
        call: str,
    ) -> _Described: ...
    def curves(
        self,
        study: Study,
        period: list[float],
        contact: list[float],
        steps: int,
        min_pairs: int,
        pilot_step: FoundStep | None,
        device: str,
        call: str,
    ) -> _Described: ...
    def verify(
        self,
        device: str,
        tell: Callable[[tuple[str, str, str, float, int, int, str]], object] | None,
    ) -> tuple[str, list[tuple[str, str, str, float, int, int, str]]]: ...
    def tolerance_findings(
        self,
        study: Study,
        gears: int,
        tolerance_class: int,
        percentile: float,
        width: float | None,
        journal: str,
        device: str,
        call: str,
    ) -> str: ...
    def run_shard(
        self, study: Study, device: str, journal: str, shard: str, call: str
    ) -> list[str]: ...
    def devices(self) -> list[dict[str, Any]]: ...

_Columns = list[tuple[str, numpy.ndarray[Any, Any]]]

MOST_AXIS_VALUES: int
MAX_ORBIT_STEPS: int

def read_study(text: str, source: str, changes: list[str], points: _Columns, /) -> Study: ...
def read_result_study(text: str, changes: list[str], points: _Columns, /) -> Study: ...
def read_draft(text: str, source: str, changes: list[str], points: _Columns, /) -> Study: ...
def find_study(name_or_path: str, changes: list[str], /) -> Study: ...
def as_built(
    study: Study, gears: int, tolerance_class: int, percentile: float, /
) -> Study: ...
def builtin_study_names() -> list[str]: ...
def tile_for_shards(study: Study, count: int, /) -> int: ...
def merge_shards(journals: list[str], call: str) -> _Described: ...
def is_netcdf(path: str, /) -> bool: ...
def read_pilot_step(path: str, /) -> FoundStep | None: ...
def model_names() -> list[str]: ...
def gear_keys() -> list[tuple[str, str, str, str, float, float]]: ...
def builtin_model(name: str, /) -> dict[str, Any]: ...
def read_model(text: str, source: str, tables: dict[str, str], /) -> dict[str, Any]: ...
def read_model_file(path: str, /) -> dict[str, Any]: ...

class Scales: ...

def scales_in(attributes: dict[Any, Any], /) -> Scales | None: ...
def shown_unit(unit: str, scales: Scales, /) -> tuple[float, str, str] | None: ...

_Numbers = NDArray[Any]
_Companion = tuple[list[str], _Numbers] | None

MISSING_COLOUR: str
MISSING_CLASS_COLOUR: str
FIRST_PART_COLOUR: str
OTHER_PARTS_COLOUR: str
DOT_COLOUR: str
CURVE_COLOUR: str
BAND_COLOUR: str
MEDIAN_COLOUR: str
NOMINAL_MEANING: str
MEDIAN_MEANING: str

def classes_of(
    name: str,
    flags: list[str],
    values: _Numbers,
    motion: _Companion,
    contact: _Companion,
    /,
) -> tuple[_Numbers, list[str], list[str]] | None: ...
def band_of(quantity: str, names: list[str], /) -> tuple[str, str, str, str] | None: ...
def curve_styles() -> list[tuple[str, str, list[float]]]: ...
def usual_colormap(quantity: str, /) -> str: ...
def colour_anchors(name: str, least: float, most: float, /) -> list[tuple[float, str]]: ...
def colour_range(
    values: _Numbers,
    least: float | None,
    most: float | None,
    is_log: bool,
    colormap: str,
    quantity: str,
    /,
) -> tuple[float, float, bool, int, int]: ...
def amplitude_spectrum(samples: _Numbers, periods: int, /) -> tuple[float, _Numbers]: ...
def padded_range(values: _Numbers, /) -> tuple[float, float, bool]: ...
def axis_label(name: str, unit: str, meaning: str, /) -> str: ...
def quantity_label(name: str, unit: str, /) -> str: ...
def literal_label(text: str, /) -> str: ...
def typeset_label(text: str, /) -> str: ...
def suggest_name(name: str, known: list[str], /) -> str: ...
def version() -> str: ...
