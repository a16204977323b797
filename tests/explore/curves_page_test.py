#!/usr/bin/env python3
"""Bifurcation curves over the explorer's map in a real browser: drawn, hidden, clicked.

curves_page_test.py GEARSWEEP [FOLDER]   FOLDER: where screenshots are left
"""

import pathlib
import subprocess
import sys
import tempfile

from selenium.webdriver.common.by import By

from page_test import Page, knows_localhost, serve, wait_for

# The pendulum doubles its period between dampings 0.73 and 0.755.
STUDY = """
[model]
name = "pendulum"
[parameters]
omega = 0.6666666666666666
phase = 1.5707963267948966
[[axes]]
name = "damping"
from = 0.73
to = 0.755
count = 16
[[axes]]
name = "drive"
from = 1.49
to = 1.51
count = 16
[integrate]
max_step = 0.1
settle = 400
record = 50
[observe]
quantities = ["period", "x_max"]
"""

INK = """
const canvas = document.getElementById('curves-map');
const data = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
let count = 0;
for (let k = 3; k < data.length; k += 4) if (data[k] > 0) count++;
return count;
"""

# As a finger or a mouse clicks, at pixels of the map.
CLICK = """
const map = document.getElementById('map');
map.setPointerCapture = () => {};  // no such finger is there
const box = map.getBoundingClientRect();
for (const type of ['pointerdown', 'pointerup']) {
  map.dispatchEvent(new PointerEvent(type, { pointerId: 1, pointerType: arguments[2], button: 0,
    isPrimary: true, bubbles: true, clientX: box.left + arguments[0], clientY: box.top + arguments[1] }));
}
"""


def make_curves(gearsweep, folder):
    (folder / "study.toml").write_text(STUDY)
    subprocess.run([gearsweep, "run", folder / "study.toml", "--quiet", "-o", folder / "map.nc",
                    "--set", "integrate.settle=2000"], check=True)
    subprocess.run([gearsweep, "curves", folder / "map.nc", "--quiet", "--min-pairs", "5", "-o",
                    folder / "curves.nc"], check=True, stdout=subprocess.DEVNULL)


def middle_point(page):
    """A point of a curve well inside the view, and as pixels."""
    view = page.ask("gearsweepExplorer.view()")
    inside = [point for point in page.ask("gearsweepExplorer.curves()")
              if 0.3 < point["px"] / view["width"] < 0.7 and 0.2 < point["py"] / view["height"] < 0.8]
    assert inside, page.ask("gearsweepExplorer.curves()")
    return inside[len(inside) // 2]


def click(page, px, py, kind="mouse"):
    page.driver.execute_script(CLICK, px, py, kind)


def check_orbit(page, point):
    """The panel has what the service tells of the point, which explore/curves_test.cpp compares."""
    panel = page.find("motion")
    wait_for(lambda: f"{point['kind']} of period 1" in panel.text, "the orbit on the curve")
    told = page.driver.execute_async_script(
        "const done = arguments[2]; const v = gearsweepExplorer.view();"
        "fetch(`border?scene=${v.scene}&curve=${arguments[0]}&point=${arguments[1]}`)"
        ".then(answer => answer.json()).then(done)", point["curve"], point["point"])
    assert told["label"] in panel.text, (told["label"], panel.text)
    for fact in told["values"]:
        assert fact["text"] in panel.text, (fact, panel.text)
    for at in told["at"]:
        assert str(at["value"]) in panel.text, (at, panel.text)
    assert "begins at the file's state" in panel.text, panel.text
    assert not panel.find_element(By.XPATH, ".//button[text()='other starts']").is_displayed()


def check(gearsweep, address, pictures):
    page = Page(address)
    page.driver.set_script_timeout(60)
    try:
        page.settle("the first view")
        key = page.find("curves")
        assert "flip" in key.text, key.text
        drawn = page.driver.execute_script(INK)
        assert drawn > 200, drawn
        page.driver.save_screenshot(str(pictures / "curves.png"))

        # A click near the curve opens its orbit, and the link has it.
        point = middle_point(page)
        click(page, point["px"] + 2, point["py"] + 2)
        check_orbit(page, point)
        page.settle("the orbit")
        page.driver.save_screenshot(str(pictures / "orbit.png"))
        wait_for(lambda: f"curve={point['curve']}%2C{point['point']}" in page.driver.current_url,
                 "the link of the orbit")
        link = page.driver.current_url

        # Further away a mouse opens the motion of the map; a finger still opens the orbit.
        click(page, point["px"] + 11, point["py"], "mouse")
        panel = page.find("motion")
        wait_for(lambda: "x_max" in panel.text and "bifurcation" not in panel.text, "the map's motion")
        page.settle("the map's motion")
        click(page, point["px"] + 11, point["py"], "touch")
        wait_for(lambda: "bifurcation" in panel.text, "the orbit by a finger")

        # Hidden, they are neither seen nor clicked, which the link has, too.
        page.find("curves-shown").click()
        wait_for(lambda: page.driver.execute_script(INK) == 0, "no curves")
        click(page, point["px"], point["py"])
        wait_for(lambda: "bifurcation" not in panel.text, "the motion below a hidden curve")
        wait_for(lambda: "curves=0" in page.driver.current_url, "the link without curves")
        page.find("curves-shown").click()
        wait_for(lambda: page.driver.execute_script(INK) == drawn, "the curves again")

        # Deep inside they are drawn where their points are.
        for _ in range(12):
            page.driver.execute_script(
                "const map = document.getElementById('map'); const box = map.getBoundingClientRect();"
                "const at = gearsweepExplorer.curves().find(one => one.curve === arguments[0] &&"
                " one.point === arguments[1]);"
                "map.dispatchEvent(new WheelEvent('wheel', {deltaY: -450, bubbles: true, cancelable: true,"
                "clientX: box.left + at.px, clientY: box.top + at.py}))", point["curve"], point["point"])
            wait_for(lambda: page.ask("gearsweepExplorer.curves()"), "a point of the curve in view")
        assert page.ask("gearsweepExplorer.view()")["sx"] < 1e-3
        wait_for(lambda: page.driver.execute_script(INK) > 200, "the curve deep inside")
        page.driver.save_screenshot(str(pictures / "deep.png"))

        # The picture has them as vectors, dashes included, and their key.
        svg = page.driver.execute_async_script(
            "const done = arguments[0]; const make = URL.createObjectURL;"
            "URL.createObjectURL = blob => { blob.text().then(done); return make(blob); };"
            "document.getElementById('export').open = true;"
            "document.getElementById('export-svg').click()")
        assert "stroke-dasharray" in svg and ">flip<" in svg, svg[-2000:]

        # Another parameter has other curves.
        page.driver.get("about:blank")
        page.driver.get(address + "#set=omega%3D0.7")
        page.settle("another scene")
        assert "curves are not shown" in page.find("curves").text, page.find("curves").text
        assert page.driver.execute_script(INK) == 0

        page.driver.get("about:blank")
        page.driver.get(link)
        page.settle("the link")
        check_orbit(page, point)
        assert not page.complaints(), page.complaints()
    finally:
        page.driver.quit()


def main():
    gearsweep = sys.argv[1]
    if not knows_localhost():
        print("skipped: this machine does not know 'localhost', by which chromedriver and browser talk")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        pictures = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else folder
        pictures.mkdir(exist_ok=True)
        make_curves(gearsweep, folder)
        server, address = serve(gearsweep, folder, more=["--curves", folder / "curves.nc"])
        try:
            check(gearsweep, address, pictures)
        finally:
            server.terminate()
            server.wait(30)


main()
