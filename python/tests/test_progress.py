"""The bar of a run, and what is said of points that failed."""

from __future__ import annotations

import io
import sys
import types
import warnings

import pytest
from conftest import MAP

import gearsweep
from gearsweep import Study, _progress

pytest.importorskip("tqdm")


class Terminal(io.StringIO):
    """A stderr that somebody looks at."""

    def isatty(self) -> bool:
        return True


@pytest.fixture(autouse=True)
def at_once(monkeypatch):
    monkeypatch.setattr(_progress, "_SECONDS_BEFORE_THE_BAR", 0)


def run_into(stream: io.StringIO, monkeypatch, **options) -> str:
    monkeypatch.setattr(sys, "stderr", stream)
    gearsweep.run("coarse-map", set=MAP, **options)
    return stream.getvalue()


def test_a_terminal_gets_a_bar(monkeypatch):
    assert "/35 [" in run_into(Terminal(), monkeypatch)


@pytest.mark.parametrize("progress", [None, False])
def test_none_is_nothing(monkeypatch, progress):
    assert run_into(Terminal(), monkeypatch, progress=progress) == ""


def test_a_file_gets_nothing(monkeypatch):
    assert run_into(io.StringIO(), monkeypatch, progress=True) == ""


def test_a_notebook_gets_a_bar(monkeypatch):
    shell = types.SimpleNamespace(kernel=object())
    notebook = types.SimpleNamespace(get_ipython=lambda: shell)
    monkeypatch.setitem(sys.modules, "IPython", notebook)
    assert "points" in run_into(io.StringIO(), monkeypatch)


def test_nothing_needs_tqdm(monkeypatch):
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    assert run_into(Terminal(), monkeypatch) == ""


def test_a_function_gets_the_news_and_no_bar(monkeypatch):
    seen: list[gearsweep.Progress] = []
    assert run_into(Terminal(), monkeypatch, progress=seen.append) == ""
    assert seen[-1].points_done == seen[-1].points


def test_points_that_failed_are_counted():
    # The stiffer bearings are too much for the step.
    study = Study.gear5("coarse").sweep(k1=[1.0, 2.0, 1e6]).observe("x1_rms", "contact_class")
    study = study.integrate(settle=20, record=10, states="all", stop="never")
    with pytest.warns(RuntimeWarning, match="diverged at 1 of 3 points") as told:
        study.run()
    assert told[0].filename == __file__
    with pytest.warns(RuntimeWarning, match=r"every point failed.*diverged at 2 of 2 points"):
        study.sweep(k1=[1e5, 1e6]).run()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        study.sweep(k1=[1.0, 2.0]).run()
