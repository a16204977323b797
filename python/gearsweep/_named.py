"""Options that are given by name alone."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable
from typing import ParamSpec, TypeVar

from gearsweep._errors import InputError
from gearsweep._value import shown

_Given = ParamSpec("_Given")
_Made = TypeVar("_Made")


def options_by_name(function: Callable[_Given, _Made]) -> Callable[_Given, _Made]:
    """A function of a study whose error says which names an option without one may have.

    Parameters
    ----------
    function : callable
        It takes the study, and options by name.

    Returns
    -------
    callable
    """
    parameters = inspect.signature(function).parameters.values()
    names = [one.name for one in parameters if one.kind is one.KEYWORD_ONLY]

    @functools.wraps(function)
    def call(*given: _Given.args, **named: _Given.kwargs) -> _Made:
        if len(given) > 1:
            raise InputError(
                f"{function.__name__}: {shown(given[1])} has no name; say what it is, as in "
                f"{names[0]}={shown(given[1])}: one of {', '.join(names)}"
            )
        return function(*given, **named)

    return call
