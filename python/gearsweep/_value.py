"""Values of Python as a study or a model writes them: TOML."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Mapping
from typing import Any

import numpy

from gearsweep import _core
from gearsweep._errors import InputError

# Numbers of a list in a study: those of an axis.
_MOST = _core.MOST_AXIS_VALUES
# Words that a study takes without quotes, and that its messages then show as they were given.
_WORD = re.compile(r"(?!(?:true|false|inf|nan)\Z)[A-Za-z][A-Za-z0-9_-]*\Z")
# Keys that TOML takes without quotes.
_KEY = re.compile(r"[A-Za-z0-9_-]+\Z")


def text_of(value: Any, expected: str) -> str:
    """A text that users gave.

    Parameters
    ----------
    value : str
        What they gave.
    expected : str
        What would be right, for the message.

    Raises
    ------
    InputError
        It is no text, or has characters that no file can hold.
    """
    if not isinstance(value, str):
        raise InputError(f"expected {expected}, not one of the type {type(value).__name__}")
    try:
        value.encode()
    except UnicodeEncodeError as error:
        raise InputError(f"expected {expected}, but {value!r} is no text: {error.reason}") from None
    return value


def path_of(value: Any, expected: str) -> str:
    """A path that users gave, as `text_of`."""
    return text_of(os.fspath(value) if isinstance(value, os.PathLike) else value, expected)


def assignments(changes: Mapping[str, Any] | None) -> list[str]:
    """Changes as the command's --set takes them.

    Parameters
    ----------
    changes : mapping of str to object, optional
        Paths of keys, such as ``"integrate.record"``, with their values.

    Returns
    -------
    list of str
        One ``"path=value"`` for each.
    """
    if changes is None:
        return []
    if not isinstance(changes, Mapping):
        raise InputError("set: expected a dict such as {'integrate.record': 20}")
    return [f"{_path(path)}={_word(value, path)}" for path, value in changes.items()]


def toml_key(key: str) -> str:
    """A key, in quotes where it needs them."""
    return key if _KEY.match(key) else json.dumps(key, ensure_ascii=False)


def toml_value(value: Any, place: str) -> str:
    """A value.

    Parameters
    ----------
    value : bool, number, str, array, list or mapping
        What is written.
    place : str
        Where it belongs, for messages.

    Returns
    -------
    str
        TOML.
    """
    count = value.size if isinstance(value, numpy.ndarray) else 1
    count = len(value) if isinstance(value, list | tuple) else count
    if count > _MOST:
        raise InputError(f"{place}: {count} values; at most {_MOST} are possible")
    _refuse_masked(value, place)
    if isinstance(value, numpy.ndarray | numpy.generic):
        value = value.tolist()
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int) and not -(1 << 63) <= value < 1 << 63:
        raise InputError(f"{place}: {shown(value)} is too large for a whole number; 1e20 is a number")
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, str):
        return json.dumps(text_of(value, f"a text for {place}"), ensure_ascii=False)
    if isinstance(value, list | tuple):
        return "[" + ", ".join(toml_value(item, place) for item in value) + "]"
    if isinstance(value, Mapping):
        items = (f"{toml_key(str(key))} = {toml_value(item, place)}" for key, item in value.items())
        return "{ " + ", ".join(items) + " }" if value else "{}"
    raise InputError(f"{place}: there are no values of the type {type(value).__name__}")


def numbers_of(values: Any, place: str, expected: str) -> numpy.ndarray[Any, Any]:
    """An array of numbers that users gave.

    Parameters
    ----------
    values : array_like
        What they gave.
    place : str
        What it is, for messages: ``"axis 'omega'"``.
    expected : str
        What would be right, for messages.

    Returns
    -------
    numpy.ndarray
        The same as floating-point numbers.

    Raises
    ------
    InputError
        Some are no real numbers, or masked: there is no value to compute with.
    """
    _refuse_masked(values, place)
    try:
        numbers = numpy.asarray(values)
        # NumPy leaves out imaginary parts, reads texts and dates as numbers, and makes None a NaN.
        is_real = numbers.dtype.kind in "fiub" or (
            numbers.dtype.kind == "O"
            and not any(item is None or numpy.iscomplexobj(item) for item in numbers.flat)
        )
        if is_real or numbers.size == 0:
            return numbers.astype(float)
    except (TypeError, ValueError, OverflowError):
        pass  # told below
    raise InputError(f"{place}: expected {expected}, not {shown(values)}")


def shown(value: Any) -> str:
    """A value of any kind and size for a message."""
    try:
        text = repr(value)
    except ValueError:  # more digits than Python writes
        return f"a value of the type {type(value).__name__}"
    return text if len(text) <= 200 else f"{text[:200]}..."


def _refuse_masked(values: Any, place: str) -> None:
    masked = int(numpy.ma.count_masked(values)) if isinstance(values, numpy.ma.MaskedArray) else 0
    if masked > 0:
        raise InputError(f"{place}: {masked} of the values are masked; leave them out: .compressed()")


def _path(path: Any) -> str:
    if not isinstance(path, str) or "=" in path:
        raise InputError(f"set: {path!r} is no path of a key, such as 'integrate.record'")
    return text_of(path, "a path of a key, such as 'integrate.record'")


def _word(value: Any, path: str) -> str:
    is_word = isinstance(value, str) and _WORD.match(value) is not None
    return str(value) if is_word else toml_value(value, f"--set {path}")
