"""The bifurcation curves that border the motions of a map, and their picture."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy
import xarray

from gearsweep import _core
from gearsweep._errors import InputError
from gearsweep._frame import draw_key
from gearsweep._place import count_of, number_of, pilot_step_of
from gearsweep._result import call_text, dataset_of
from gearsweep._session import SESSION, device_text
from gearsweep._study_source import study_of
from gearsweep._value import path_of

if TYPE_CHECKING:
    import matplotlib.axes

_CONTENT = "border curves of gearsweep"
_HEAVY, _THIN = 1.8, 0.6  # points


def curves(
    maps: str | os.PathLike[str] | xarray.Dataset,
    *,
    steps: int | None = None,
    min_pairs: int | None = None,
    device: int | str | None = None,
) -> xarray.Dataset:
    """Find the bifurcation curves that border the motions of a map.

    Folds, flips, Neimark-Sacker curves, symmetry breakings and grazing curves, each exact, and for
    all other borders what parts their pixels.

    Parameters
    ----------
    maps : Dataset or path
        A result of `run` over two parameters, with ``period`` among its quantities; or its file.
        With ``contact_class``, too, grazing curves are looked for where it changes.
    steps : int, optional
        Integration steps of a forcing period; by default 256, or the study's if that is more.
    min_pairs : int, optional
        Borders of fewer pairs of neighbouring pixels are left out; by default 10.
    device : int or str, optional
        A number of `devices`.

    Returns
    -------
    Dataset
        Ragged arrays. Along ``point``, curve after curve: both parameters, ``section`` (state),
        ``multiplier_real`` and ``multiplier_imag``, ``angle``, ``stable`` and ``residual``. Along
        ``curve``: ``curve_kind``, ``curve_period``, ``curve_points`` (how many it has),
        ``curve_limit`` of a grazing curve, ``curve_step_error`` in pixels, and the gradient by each
        ``parameter``. Along ``special`` and ``border`` the special points and what parts the pixels.
        ``found.gear.plot(ax=maps.gear.plot("period"))`` draws the curves over the map.

    Raises
    ------
    InputError
        The map has no period, or is not over two parameters.
    KeyboardInterrupt
        After Ctrl-C.

    Examples
    --------
    >>> import gearsweep as gs
    >>> small = {"axes.omega.count": 12, "axes.b.count": 12, "observe.quantities": ["period"]}
    >>> maps = gs.run("coarse-backlash", set=small)
    >>> found = gs.curves(maps, min_pairs=8)
    >>> "flip" in found.curve_kind.values
    True
    """
    chosen_steps = count_of(steps, "steps", 64, 65536)
    chosen_pairs = count_of(min_pairs, "min_pairs", 1, 1_000_000)
    named = device_text(device)
    whole = _map_of(maps)
    study = study_of(whole)._core
    names = list(reversed(study.axis_names))
    if len(names) != 2:
        raise InputError("maps: curves take a map of two axes")
    if "period" not in whole:
        raise InputError("maps: there is no 'period', by which borders are found; observe it, too")
    contact = next((name for name in map(str, whole.data_vars) if _tells_contact(name)), None)
    described = SESSION.curves(
        study=study,
        period=_flat(whole["period"], names),
        contact=[] if contact is None else _flat(whole[contact], names),
        steps=chosen_steps or 0,
        min_pairs=chosen_pairs or 10,
        pilot_step=pilot_step_of(whole),
        device=named,
        call=call_text("curves", maps, steps=steps, min_pairs=min_pairs),
    )
    return dataset_of(*described)


def _tells_contact(name: str) -> bool:
    return name == "contact_class" or name.endswith(("_contact_class", "_impacts"))


def _map_of(maps: Any) -> xarray.Dataset:
    if isinstance(maps, xarray.Dataset):
        return maps
    if not isinstance(maps, str | os.PathLike):
        raise InputError(f"maps: expected a Dataset or a file, not a {type(maps).__name__}")
    path = path_of(maps, "a path")
    if not os.path.exists(path) or not _core.is_netcdf(path):
        raise InputError(f"maps: '{path}' is no result file; gearsweep.run(...).to_netcdf makes one")
    with xarray.open_dataset(path) as opened:
        return opened.load()


def _flat(values: xarray.DataArray, names: list[str]) -> list[float]:
    if sorted(map(str, values.dims)) != sorted(names):
        raise InputError(f"maps: {values.name!r} is not over {names[1]} and {names[0]} alone")
    numbers: list[float] = values.transpose(*names).values.astype(float).ravel().tolist()
    return numbers


def is_curves(maps: xarray.Dataset) -> bool:
    """Whether the Dataset is what `gearsweep.curves` returns."""
    return maps.attrs.get("content") == _CONTENT


def path_of_curves(curves: Any) -> str:
    """The path of a file of curves; empty where there is none."""
    if curves is None or isinstance(curves, xarray.Dataset):
        return ""
    if not isinstance(curves, str | os.PathLike):
        raise InputError(f"curves: expected a Dataset or a file, not a {type(curves).__name__}")
    path = path_of(curves, "a path")
    if not os.path.exists(path) or not _core.is_netcdf(path):
        raise InputError(f"curves: '{path}' is no file of gearsweep curves")
    return path


def given_curves(found: xarray.Dataset) -> _core._GivenCurves:
    """What the core takes of a Dataset of curves; it refuses what is wrong in it."""
    if not is_curves(found):
        raise InputError("curves: the Dataset is not one that gearsweep.curves() returned")
    texts: list[tuple[str, list[str]]] = []
    numbers: list[tuple[str, numpy.ndarray[Any, Any]]] = []
    for name, variable in found.variables.items():
        if variable.dtype.kind in "fiub":
            numbers.append((str(name), variable.values.astype(float)))
        elif variable.ndim == 1:
            texts.append((str(name), [_text(text) for text in variable.values]))
    return (
        study_of(found)._core,
        [(str(name), note) for name, note in found.attrs.items() if isinstance(note, str)],
        number_of(found.attrs.get("steps_per_period", 0), "steps_per_period"),
        texts,
        numbers,
    )


def _text(text: Any) -> str:
    return text.decode(errors="replace") if isinstance(text, bytes) else str(text)


def plot_curves(
    found: xarray.Dataset, ax: matplotlib.axes.Axes | None, title: str | None
) -> matplotlib.axes.Axes:
    """Draw curves, over what `ax` has; `gearsweep.Gear.plot` says how."""
    from matplotlib import pyplot
    from matplotlib.lines import Line2D

    x, y = (_variable(found, found.attrs[name]) for name in ("x", "y"))
    if ax is None:
        ax = pyplot.subplots(layout="constrained")[1]
        for axis, coordinate in ((ax.xaxis, x), (ax.yaxis, y)):
            text = _core.axis_label(
                str(coordinate.name),
                coordinate.attrs.get("units", ""),
                coordinate.attrs.get("long_name", ""),
            )
            axis.set_label_text(text)
        if title:
            ax.set_title(title)
    styles = {kind: (colour, dashes) for kind, colour, dashes in _core.curve_styles()}
    ends = numpy.cumsum(found.curve_points.values.astype(int))
    kinds = [str(kind) for kind in found.curve_kind.values]
    for kind, end, count in zip(kinds, ends, found.curve_points.values.astype(int), strict=True):
        points = slice(end - count, end)
        colour, dashes = styles[kind]
        across, up = x.values[points], y.values[points]
        stable = found.stable.values[points] == 1
        both = stable & numpy.append(stable[1:], False)
        heavy = both | numpy.append(False, both[:-1])
        ax.plot(across, up, color=colour, linewidth=_THIN)
        shown = numpy.where(heavy, up, numpy.nan)
        ax.plot(across, shown, color="white", linewidth=2 * _HEAVY)
        ax.plot(across, shown, color=colour, linewidth=_HEAVY, dashes=dashes or (None, None))
    handles = [
        Line2D([], [], color=colour, dashes=dashes or (None, None), linewidth=_HEAVY, label=kind)
        for kind, (colour, dashes) in styles.items()
        if kind in kinds
    ]
    draw_key(ax, _handles_of(ax) + handles)
    return ax


def _handles_of(ax: matplotlib.axes.Axes) -> list[Any]:
    """What the key of the map has, with its texts."""
    key = ax.get_legend()
    if key is None:
        return []
    handles = list(getattr(key, "legend_handles", None) or key.legendHandles)
    for handle, text in zip(handles, key.get_texts(), strict=True):
        handle.set_label(text.get_text())
    return handles


def _variable(found: xarray.Dataset, parameter: str) -> xarray.DataArray:
    name = "parameter_" + parameter
    return found[name if name in found else parameter]
