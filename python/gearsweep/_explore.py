"""A page to walk around in a map."""

from __future__ import annotations

import atexit
import html
import os
from collections.abc import Mapping
from typing import Any

import xarray

from gearsweep import _core
from gearsweep._curves import given_curves, path_of_curves
from gearsweep._errors import InputError
from gearsweep._named import options_by_name
from gearsweep._place import count_of, pilot_step_of
from gearsweep._session import SESSION, device_text
from gearsweep._study import Study
from gearsweep._study_source import study_of


class Exploration:
    """A page that this process serves: `url` opens in a browser of this machine.

    In a notebook that runs on this machine the cell shows the page. It is served until `stop` is
    called, or Python ends. Whoever has the address can compute here.
    """

    def __init__(self, core: _core.Exploration, height: int) -> None:
        self._core = core
        self._height = height
        atexit.register(core.stop)

    @property
    def url(self) -> str:
        """The address, with its token."""
        return self._core.address

    def stop(self) -> None:
        """End the service; a page that is still open keeps what it has."""
        self._core.stop()
        atexit.unregister(self._core.stop)

    def __repr__(self) -> str:
        return f"Exploration({self.url!r})" if self._core.is_running else "Exploration(stopped)"

    def _repr_html_(self) -> str:
        url = html.escape(self.url, quote=True)
        return (
            f'<iframe src="{url}" width="100%" height="{self._height}" title="gearsweep explore" '
            'style="border: 1px solid #ccc"></iframe>'
        )


@options_by_name
def explore(
    study: str | os.PathLike[str] | Study | xarray.Dataset,
    *,
    curves: str | os.PathLike[str] | xarray.Dataset | None = None,
    set: Mapping[str, Any] | None = None,
    device: int | str | None = None,
    height: int = 800,
    memory: int = 512,
    port: int | None = None,
) -> Exploration:
    """Serve a page on which the map of a study is alive: zoom, click, move a slider.

    Parameters
    ----------
    study : str, path, Study or Dataset
        As `run` takes it; axes that are missing are other parameters.
    curves : Dataset or path, optional
        Bifurcation curves of the same plane, drawn over the map: what `curves` returns, or a file
        of ``gearsweep curves``.
    set : mapping of str to object, optional
        Changes of the study, as `run` takes them.
    device : int or str, optional
        A number of `devices`, or several, as in ``"0,1"``.
    height : int, optional
        Of the page in a notebook's cell, in pixels.
    memory : int, optional
        Megabytes of computed tiles that are kept.
    port : int, optional
        A port of this machine's own address; by default any that is free.

    Returns
    -------
    Exploration
        Its `url` is the address of the page.

    Raises
    ------
    InputError
        The study or an option is wrong, or the curves are of another plane.
    RunError
        The port is taken.

    Examples
    --------
    >>> import gearsweep as gs
    >>> page = gs.explore("coarse-chaos")
    >>> page.url[:17]
    'http://127.0.0.1:'
    >>> page.stop()
    """
    if isinstance(study, str | os.PathLike):
        source = os.fspath(study)
    else:
        source = "study.toml"
    pixels = count_of(height, "height", 100, 100_000)
    megabytes = count_of(memory, "memory", 16, 1 << 20)
    if pixels is None or megabytes is None:
        raise InputError("height and memory are numbers")
    core = SESSION.explore(
        study=study_of(study, set)._core,
        pilot_step=pilot_step_of(study),
        source=str(source),
        device=device_text(device),
        megabytes=megabytes,
        port=count_of(port, "port", 1, 65535) or 0,
        curves_path=path_of_curves(curves),
        curves=given_curves(curves) if isinstance(curves, xarray.Dataset) else None,
    )
    return Exploration(core, pixels)
