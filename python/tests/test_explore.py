"""A page that Python serves."""

from __future__ import annotations

import json
import urllib.error
import urllib.request

import pytest
from conftest import MAP

import gearsweep


def test_a_page_is_served_until_it_is_stopped() -> None:
    page = gearsweep.explore("coarse-map", set=MAP, memory=64)
    with urllib.request.urlopen(page.url + "scene") as answer:
        assert json.load(answer)["axes"][0]["name"] == "omega"
    assert page.url in page._repr_html_()
    page.stop()
    with pytest.raises(urllib.error.URLError):
        urllib.request.urlopen(page.url + "scene", timeout=5)
    assert repr(page) == "Exploration(stopped)"


def test_what_is_no_study_is_refused() -> None:
    with pytest.raises(gearsweep.InputError, match="no-such-study"):
        gearsweep.explore("no-such-study")
