#!/usr/bin/env python3
"""The explorer's page in a real browser: it shows what `gearsweep run` computes.

page_test.py GEARSWEEP [FOLDER]   FOLDER: where screenshots are left
"""

import csv
import json
import os
import pathlib
import socket
import subprocess
import sys
import tempfile
import time

from selenium import webdriver
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select

STUDY = """
[model]
name = "duffing"
[parameters]
damping = 0.4
[[axes]]
name = "omega"
from = 0.8
to = 1.6
count = 20
[[axes]]
name = "amplitude"
from = 0.1
to = 0.4
count = 10
[integrate]
settle = 60
record = 8
[observe]
quantities = ["x_max", "motion_class", "period"]
"""


def wait_for(condition, what, seconds=90):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        found = condition()
        if found:
            return found
        time.sleep(0.05)
    raise AssertionError(f"{what}: not within {seconds} s")


class Page:
    def __init__(self, address):
        options = webdriver.ChromeOptions()
        for argument in ("--headless=new", "--no-sandbox", "--disable-gpu",
                         "--disable-dev-shm-usage", "--window-size=900,700"):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(options=options)
        self.driver.get(address)

    def ask(self, expression):
        return json.loads(self.driver.execute_script(f"return JSON.stringify({expression} ?? null)"))

    def settle(self, what):
        wait_for(lambda: self.ask("window.gearsweepExplorer?.settled()"), what)

    def find(self, name):
        return self.driver.find_element(By.ID, name)

    def requests(self):
        names = self.ask("performance.getEntriesByType('resource').map(entry => entry.name)")
        return [name for name in names if "favicon" not in name]

    def turn_wheel(self, way):
        self.driver.execute_script(
            "const map = document.getElementById('map'); const box = map.getBoundingClientRect();"
            "map.dispatchEvent(new WheelEvent('wheel', {deltaY: arguments[0], bubbles: true,"
            "cancelable: true, clientX: box.left + box.width / 2, clientY: box.top + box.height / 2}))",
            way)

    def complaints(self):
        return [entry["message"] for entry in self.driver.get_log("browser")
                if entry["level"] == "SEVERE" and "favicon" not in entry["message"]]


def run_at(gearsweep, folder, coordinates):
    """What `gearsweep run` gives at one point, by name, all digits."""
    axes = ", ".join(f'{{name = "{name}", values = [{value!r}]}}' for name, value in coordinates.items())
    result = folder / "point.nc"
    subprocess.run([gearsweep, "run", folder / "study.toml", "--set", f"axes=[{axes}]", "--restart",
                    "--quiet", "-o", result], check=True)
    return rows_of(gearsweep, result)[0]


def rows_of(gearsweep, result):
    """The points of a result file, by name, all digits."""
    table = result.with_suffix(".csv")
    subprocess.run([gearsweep, "export", result, "-o", table], check=True)
    with table.open() as lines:
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    return [{name.split(" ")[0]: value for name, value in row.items()} for row in rows]


TOKEN = "0123456789abcdef0123456789abcdef"  # so that a server started anew is found again


def serve(gearsweep, folder, port=None, more=()):
    command = [gearsweep, "explore", folder / "study.toml", "--no-browser", "--quiet", *more]
    if port is not None:
        command += ["--port", str(port)]
    server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True,
                              env={**os.environ, "GEARSWEEP_EXPLORE_TOKEN": TOKEN})
    return server, server.stdout.readline().strip()


def check_diagram(page, pictures):
    """It opens below the map, with about a column a pixel; diagram_test.cpp looks at its numbers."""
    page.find("diagram-button").click()
    page.settle("the diagram")
    line = page.ask("gearsweepExplorer.diagram()")
    assert line["columns"] > 100, line
    page.driver.save_screenshot(str(pictures / "diagram.png"))
    page.find("diagram-button").click()


def check(gearsweep, servers, address, folder, pictures):
    page = Page(address)
    try:
        page.settle("the first view")
        page.driver.save_screenshot(str(pictures / "first.png"))

        # A pixel has the bits of a run at its point.
        seen = page.ask("gearsweepExplorer.valueAt(200, 150)")
        alone = run_at(gearsweep, folder, seen["coordinates"])
        assert float(alone["x_max"]) == seen["values"]["x_max"], (alone, seen)
        assert float(alone["period"]) == seen["values"]["period"], (alone, seen)

        # Another quantity computes nothing.
        before = page.requests()
        Select(page.find("quantity")).select_by_value("motion_class")
        page.settle("the other quantity")
        assert page.requests() == before
        assert "periodic" in page.find("legend").get_attribute("aria-label")

        # The wheel zooms, and the view is computed anew.
        wide = page.ask("gearsweepExplorer.view()")
        page.turn_wheel(-400)
        wait_for(lambda: page.ask("gearsweepExplorer.view()")["sx"] < 0.9 * wide["sx"], "zooming")
        page.settle("the zoomed view")
        page.driver.save_screenshot(str(pictures / "zoomed.png"))

        # A click shows the motion, with the numbers of the pixel.
        seen = page.ask("gearsweepExplorer.valueAt(220, 160)")
        page.driver.execute_script("gearsweepExplorer.click(220, 160)")
        panel = page.find("motion")
        wait_for(lambda: f"{seen['values']['x_max']:.5g}" in panel.text, "the motion's numbers")
        assert "gearsweep trace" in panel.text, panel.text
        page.driver.save_screenshot(str(pictures / "motion.png"))
        wait_for(lambda: "orbit of period" in panel.text, "the multipliers")
        panel.find_element(By.XPATH, ".//button[text()='other starts']").click()
        wait_for(lambda: "starts:" in panel.text, "motions from other starts")
        ActionChains(page.driver).send_keys(Keys.ESCAPE).perform()

        check_diagram(page, pictures)

        # The view as a study runs.
        study = page.driver.execute_async_script(
            "const done = arguments[0]; const v = gearsweepExplorer.view();"
            "fetch(`study?scene=${v.scene}&x0=${Math.max(0, v.x0)}&x1=${Math.min(1, v.x0 + v.sx)}"
            "&y0=${Math.max(0, v.y0)}&y1=${Math.min(1, v.y0 + v.sy)}&nx=4&ny=3`)"
            ".then(answer => answer.text()).then(done)")
        (folder / "view.toml").write_text(study)
        subprocess.run([gearsweep, "run", folder / "view.toml", "--quiet", "-o", folder / "view.nc"],
                       check=True)

        # The points in view as a result file, which has the numbers of the readout.
        page.driver.set_script_timeout(60)
        bytes_of_file = page.driver.execute_async_script(
            "const done = arguments[0]; const v = gearsweepExplorer.view();"
            "fetch(`result?scene=${v.scene}&x0=${v.x0}&x1=${v.x0 + v.sx}&y0=${v.y0}&y1=${v.y0 + v.sy}"
            "&depth=${v.depth}`).then(answer => answer.arrayBuffer())"
            ".then(bytes => done(Array.from(new Uint8Array(bytes))))")
        (folder / "points.nc").write_bytes(bytes(bytes_of_file))
        seen = page.ask("gearsweepExplorer.valueAt(220, 160)")
        axes = list(seen["coordinates"])
        rows = rows_of(gearsweep, folder / "points.nc")
        same = [row for row in rows if all(float(row[name]) == seen["coordinates"][name] for name in axes)]
        assert len(same) == 1 and float(same[0]["x_max"]) == seen["values"]["x_max"], (same, seen)

        # The link has the whole state.
        link = page.driver.current_url
        view = page.ask("gearsweepExplorer.view()")
        page.driver.get("about:blank")
        page.driver.get(link)
        page.settle("the link")
        again = page.ask("gearsweepExplorer.view()")
        assert abs(again["x0"] - view["x0"]) < 1e-9 and again["quantity"] == "motion_class", again

        assert not page.complaints(), page.complaints()

        # Without its server the page says so, and keeps what it has.
        servers[-1].terminate()
        servers[-1].wait(30)
        page.turn_wheel(-800)
        wait_for(lambda: page.find("banner").is_displayed(), "the banner")
        page.driver.save_screenshot(str(pictures / "lost.png"))

        # It goes on once there is one again.
        servers.append(serve(gearsweep, folder, address.split(":")[2].split("/")[0])[0])
        page.settle("the server that is back")
        assert not page.find("banner").is_displayed(), page.find("banner").text
    finally:
        page.driver.quit()


def knows_localhost():
    try:
        return socket.gethostbyname("localhost").startswith("127.")
    except OSError:
        return False


def main():
    gearsweep = sys.argv[1]
    if not knows_localhost():  # as a bare root without /etc/hosts: chromedriver finds no browser
        print("skipped: this machine does not know 'localhost', by which chromedriver and browser talk")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        pictures = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else folder
        pictures.mkdir(exist_ok=True)
        (folder / "study.toml").write_text(STUDY)
        server, address = serve(gearsweep, folder)
        servers = [server]
        try:
            check(gearsweep, servers, address, folder, pictures)
        finally:
            servers[-1].terminate()
            servers[-1].wait(30)


if __name__ == "__main__":
    main()
