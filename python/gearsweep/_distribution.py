"""Distributions of uncertain parameters, as `Study.uncertain` takes them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gearsweep._errors import InputError
from gearsweep._place import number_of
from gearsweep._value import numbers_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


def normal(
    std: float, mean: float | None = None, relative: bool = False, *, folded: bool = False
) -> dict[str, Any]:
    """A normal distribution.

    Parameters
    ----------
    std : float
        The standard deviation.
    mean : float, optional
        The parameter's own value without one.
    relative : bool, optional
        The numbers are factors of the point's own value.
    folded : bool, optional
        A draw below 0 loses its sign, as an amplitude does.

    Returns
    -------
    dict
        The keys of ``[uncertain]`` that say so.

    Examples
    --------
    >>> normal(0.01, relative=True)
    {'distribution': 'normal', 'std': 0.01, 'relative': True}
    >>> from gearsweep import Study
    >>> study = Study.gear5().sweep(omega=(0.4, 2.0, 64)).observe("dmf_max")
    >>> study = study.uncertain(samples=50, omega=normal(0.01, relative=True))
    >>> "std = 0.01" in study.toml
    True
    """
    numbers = {"std": number_of(std, "std")}
    if mean is not None:
        numbers["mean"] = number_of(mean, "mean")
    if not isinstance(folded, bool):
        raise InputError(f"folded: expected True or False, not {folded!r}")
    table = _table("normal", numbers, relative)
    return table | {"folded": True} if folded else table


def uniform(from_: float, to: float, relative: bool = False) -> dict[str, Any]:
    """A distribution in which each value between two ends is as likely.

    Parameters
    ----------
    from_, to : float
        The ends.
    relative : bool, optional
        The numbers are factors of the point's own value.

    Returns
    -------
    dict
        The keys of ``[uncertain]`` that say so.

    Examples
    --------
    >>> uniform(0.55, 0.65)
    {'distribution': 'uniform', 'from': 0.55, 'to': 0.65}
    """
    ends = {"from": number_of(from_, "from_"), "to": number_of(to, "to")}
    return _table("uniform", ends, relative)


def triangular(from_: float, mode: float, to: float, relative: bool = False) -> dict[str, Any]:
    """A distribution that is most likely at one value, and never beyond two ends.

    Parameters
    ----------
    from_, mode, to : float
        The lower end, the most likely value, and the upper end.
    relative : bool, optional
        The numbers are factors of the point's own value.

    Returns
    -------
    dict
        The keys of ``[uncertain]`` that say so.

    Examples
    --------
    >>> triangular(0.08, 0.1, 0.12)
    {'distribution': 'triangular', 'from': 0.08, 'mode': 0.1, 'to': 0.12}
    """
    given = {"from": from_, "mode": mode, "to": to}
    numbers = {name: number_of(value, name) for name, value in given.items()}
    return _table("triangular", numbers, relative)


def values(numbers: ArrayLike, relative: bool = False) -> dict[str, Any]:
    """Measured values, each as likely.

    Parameters
    ----------
    numbers : array_like
        The values, shape ``(n,)``.
    relative : bool, optional
        The numbers are factors of the point's own value.

    Returns
    -------
    dict
        The keys of ``[uncertain]`` that say so.

    Raises
    ------
    InputError
        These are no numbers in one row.

    Examples
    --------
    >>> values([0.11, 0.09, 0.1])
    {'distribution': 'values', 'values': [0.11, 0.09, 0.1]}
    """
    measured = numbers_of(numbers, "values", "numbers, as in values([0.09, 0.1])")
    if measured.ndim != 1:
        raise InputError(f"values: expected numbers in one row, not of shape {measured.shape}")
    return _table("values", {"values": measured.tolist()}, relative)


def _table(distribution: str, numbers: dict[str, Any], relative: bool) -> dict[str, Any]:
    if not isinstance(relative, bool):
        raise InputError(f"relative: expected True or False, not {relative!r}")
    table = {"distribution": distribution, **numbers}
    return table | {"relative": True} if relative else table
