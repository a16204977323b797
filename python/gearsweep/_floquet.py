"""Periodic orbits, their multipliers, and the bifurcations along a parameter."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any, SupportsFloat

import xarray

from gearsweep._errors import InputError
from gearsweep._named import options_by_name
from gearsweep._place import count_of, number_of, place_of
from gearsweep._result import call_text, dataset_of
from gearsweep._session import SESSION, device_text
from gearsweep._study import Study
from gearsweep._study_source import study_of
from gearsweep._value import text_of


@options_by_name
def floquet(
    study: str | os.PathLike[str] | Study | xarray.Dataset,
    *,
    at: Mapping[str, SupportsFloat] | None = None,
    along: tuple[str, float, float] | None = None,
    period: int | None = None,
    steps: int | None = None,
    equilibrium: bool = False,
    switch: int | None = None,
    set: Mapping[str, Any] | None = None,
    device: int | str | None = None,
    **place: SupportsFloat,
) -> xarray.Dataset:
    """Find the periodic orbit at a point, or the equilibrium, and follow it through a parameter.

    The motion settles on the device; Newton's method finds the orbit, stable or not. Where nothing
    drives the model that is a cycle, whose time is found, too, or an equilibrium.

    Parameters
    ----------
    study : str, path, Study or Dataset
        As `run` takes it.
    **place : float
        A value for each axis; other parameters and an initial state may be given, too. In the
        model's units, as in ``omega=0.65, b=0.6``.
    at : mapping of str to float, optional
        The same as a dict, for parameters that are called like an option.
    along : (str, float, float), optional
        A parameter, and from where to where the orbit is followed: ``("omega", 0.5, 0.7)``. It
        begins where the place says, or else at the first of the two values.
    period : int, optional
        The orbit's length in forcing periods, of a cycle in returns to its first section. By
        default the smallest after which the motion repeats, 64 at most. Finds an unstable orbit
        inside chaos, too.
    steps : int, optional
        Integration steps of a forcing period, of a cycle from one return to the next; by default
        2048, or the study's if that is more.
    equilibrium : bool, optional
        Find the equilibrium that Newton's method comes to from the start, stable or not, of a model
        that nothing drives.
    switch : int, optional
        With `along`: follow also the branches that leave at flips and where branches cross (a
        symmetry breaks), those that leave these, and so on, so many times; by default 0. Of models
        that nothing drives only those that leave at flips of cycles are followed.
    set : mapping of str to object, optional
        Changes of the study, as `run` takes them.
    device : int or str, optional
        A number of `devices`.

    Returns
    -------
    xarray.Dataset
        Of one orbit, without `along`: ``period`` in forcing periods, ``stable``, ``section``
        (state), which is the state at phase 0, and ``multipliers`` (multiplier), complex, largest
        modulus first. ``section_error`` (state) and ``multiplier_error`` (multiplier) say how far
        they may be off at most, ``grazing`` why.

        ``attrs["kind"]`` is ``"forced"``, ``"cycle"`` or ``"equilibrium"``. A cycle has
        ``cycle_time`` and ``multiplier_along``, which is 1 but for the steps' error; ``multipliers``
        are the others, and ``period`` counts maxima. An equilibrium has ``eigenvalues``
        (eigenvalue), largest real part first, and no period.

        With `along`, all orbits of the branch stand along the dimension ``orbit``, in one line
        from the first value to the second, with the parameter as a coordinate; the errors are
        those of the orbit at the start, number ``attrs["start_orbit"]``. Along the dimension
        ``bifurcation`` stand ``bifurcation_kind``, ``bifurcation_value`` of the parameter with
        ``bifurcation_error``, ``bifurcation_grazing``, ``bifurcation_born_of``, the period of the
        orbits that the branch was born of there, or 0, and what an orbit has, as
        ``bifurcation_multipliers``. ``attrs["ended"]`` says how each way ended.

        With `switch`, the orbits and bifurcations of the branches that leave follow, branch after
        branch: ``orbit_branch`` and ``bifurcation_branch`` say on which each is, 0 for the first.
        Along the dimension ``branch``, numbered from 1, stand ``branch_leaves``, the branch that it
        leaves, ``branch_origin``, the number of the bifurcation where, ``branch_period``,
        ``branch_orbits``, how many it has, and ``branch_ended``.

    Raises
    ------
    InputError
        The study, the place or an option is wrong.
    RunError
        There is no such orbit; the message says what to try.
    KeyboardInterrupt
        After Ctrl-C.

    Examples
    --------
    >>> import gearsweep as gs
    >>> orbit = gs.floquet("coarse-map", omega=0.7, e0=0.5)
    >>> int(orbit.period), bool(orbit.stable), orbit.multipliers.shape
    (1, True, (10,))
    >>> branch = gs.floquet("pendulum-cascade", along=("damping", 0.745, 0.735))
    >>> branch.bifurcation_kind.values.tolist(), round(float(branch.bifurcation_value[0]), 6)
    (['flip'], 0.741173)
    >>> tree = gs.floquet("pendulum-cascade", along=("damping", 0.745, 0.735), switch=1)
    >>> tree.branch_period.values.tolist(), tree.branch_origin.values.tolist()
    ([2], [1])
    """
    generations = count_of(switch, "switch", 0, 12)
    if generations is not None and along is None:
        raise InputError("switch: branches leave along a parameter: give along, too")
    described = SESSION.floquet(
        study=study_of(study, set)._core,
        place=place_of(place, {} if at is None else at),
        along=_range(along),
        period=count_of(period, "period", 1, 4096),
        steps=count_of(steps, "steps", 16, 65536),
        equilibrium=_truth(equilibrium),
        generations=generations or 0,
        device=device_text(device),
        call=call_text(
            "floquet",
            study,
            at=at,
            along=along,
            period=period,
            steps=steps,
            equilibrium=equilibrium or None,
            switch=switch,
            set=set,
            **place,
        ),
    )
    return _with_python_types(dataset_of(*described))


def _truth(equilibrium: Any) -> bool:
    if not isinstance(equilibrium, bool):
        raise InputError(f"equilibrium: True or False, not {equilibrium!r}")
    return equilibrium


def _range(along: Any) -> tuple[str, float, float] | None:
    if along is None:
        return None
    if not isinstance(along, tuple | list) or len(along) != 3 or not isinstance(along[0], str):
        raise InputError("along: expected a parameter and two values: ('omega', 0.6, 0.8)")
    name = text_of(along[0], "the name of a parameter")
    return name, number_of(along[1], "along"), number_of(along[2], "along")


def _with_python_types(stored: xarray.Dataset) -> xarray.Dataset:
    """Complex numbers and truth values, which a NetCDF file has not."""
    made = {}
    for name, variable in stored.data_vars.items():
        stem = str(name).removesuffix("_real")
        if str(name).endswith(("stable", "grazing")):
            made[name] = variable.astype(bool)
        elif stem != name:
            numbers = variable + 1j * stored[f"{stem}_imag"]
            meaning = "Floquet multipliers, largest modulus first"
            if stem.endswith("eigenvalue"):
                meaning = "eigenvalues of the Jacobian, largest real part first"
            made[f"{stem}s"] = numbers.assign_attrs(units="1", long_name=meaning)
        elif not str(name).endswith(("multiplier_imag", "eigenvalue_imag")):
            made[name] = variable
    attributes = dict(stored.attrs)
    if "start_orbit" in attributes:
        attributes["start_orbit"] = int(attributes["start_orbit"])
    return xarray.Dataset(made, stored.coords, attributes)
