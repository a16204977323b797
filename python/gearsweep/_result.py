"""Results: from what the library computed to a Dataset, and what it says of the call."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

import numpy
import xarray
from xarray.backends import InMemoryDataStore


def dataset_of(
    variables: list[tuple[str, tuple[str, ...], numpy.ndarray[Any, Any], dict[str, Any]]],
    attributes: dict[str, Any],
) -> xarray.Dataset:
    """What xarray makes of a file of these variables: it takes the same way, without the file."""
    stored = {name: xarray.Variable(*parts) for name, *parts in variables}
    return xarray.open_dataset(InMemoryDataStore(stored, attributes), cache=False).load()


def call_text(function: str, study: Any, /, **options: Any) -> str:
    """The call that made a result, with the options that were given."""
    is_short = isinstance(study, str | os.PathLike) and "\n" not in os.fspath(study)
    shown = [repr(os.fspath(study)) if is_short else f"<{type(study).__name__}>"]
    for name, value in options.items():
        plain = dict(value) if isinstance(value, Mapping) else value
        if plain is not None and plain != {}:
            shown.append(f"{name}={plain!r}")
    return f"gearsweep.{function}({', '.join(shown)})"
