#!/usr/bin/env python3
"""A seeded random walk through a map, as several pages make it at once: zooms, pans, clicks, sliders.

walk.py GEARSWEEP [--study coarse-chaos] [--seconds 20] [--pages 2] [--seed 1]

It fails where an answer is wrong or the server's memory grows beyond what the tiles may take; how
long the answers took is printed, and fails nothing.
"""

import argparse
import http.client
import json
import pathlib
import random
import struct
import subprocess
import sys
import threading
import time
import urllib.parse

CELLS = 32


class Server:
    def __init__(self, gearsweep, study, megabytes):
        self.process = subprocess.Popen(
            [gearsweep, "explore", study, "--no-browser", "--quiet", "--memory", str(megabytes)],
            stdout=subprocess.PIPE, text=True)
        self.address = urllib.parse.urlsplit(self.process.stdout.readline().strip())

    def ask(self, method, name, body=None):
        """The answer as it begins: status, connection and response."""
        connection = http.client.HTTPConnection(self.address.hostname, self.address.port, timeout=120)
        text = None if body is None else json.dumps(body)
        connection.request(method, self.address.path + name, text, {"Content-Type": "application/json"})
        return connection, connection.getresponse()

    def get(self, name):
        connection, response = self.ask("GET", name)
        text = response.read()
        connection.close()
        assert response.status == 200, (name, response.status, text[:200])
        return json.loads(text)

    def megabytes(self):
        status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return int(status.split("VmRSS:")[1].split()[0]) / 1024

    def stop(self):
        self.process.terminate()
        self.process.wait(60)


def next_record(response, may_be_refused=False):
    head = response.read(64)
    if len(head) < 64:
        return None
    numbers = struct.unpack("<8d", head)
    body = response.read(int(numbers[4]) * 8)
    assert len(body) == int(numbers[4]) * 8, "a record that is cut off"
    if numbers[0] == 1.0 and may_be_refused:
        return None
    assert numbers[0] != 1.0, body.rstrip(b"\0").decode()
    return numbers


class Page(threading.Thread):
    """One page: it has one stream of tiles, which the next view ends."""

    def __init__(self, server, number, seed, end):
        super().__init__()
        self.server, self.number, self.end = server, number, end
        self.dice = random.Random(seed * 1000 + number)
        self.times = {}
        self.failure = None
        self.scene = server.get("scene")
        self.view = [0.375, 0.375, 0.25]  # x0, y0, span

    def timed(self, kind, begun):
        self.times.setdefault(kind, []).append(time.monotonic() - begun)

    def run(self):
        try:
            while time.monotonic() < self.end:
                act = self.dice.choices([self.look, self.click, self.slide], [6, 2, 1])[0]
                act()
        except Exception as failure:  # told by main()
            self.failure = failure

    def move(self):
        x, y, span = self.view
        way = self.dice.random()
        if way < 0.45 and span > 1e-9:
            factor = self.dice.uniform(0.3, 0.8)
        elif way < 0.6 and span < 0.5:
            factor = self.dice.uniform(1.2, 3.0)
        else:
            factor = 1.0
        x += self.dice.uniform(-0.5, 1.0) * span * (1 - factor if factor != 1.0 else 0.6)
        y += self.dice.uniform(-0.5, 1.0) * span * (1 - factor if factor != 1.0 else 0.6)
        span = min(1.0, span * factor)
        self.view = [min(1 - span, max(0.0, x)), min(1 - span, max(0.0, y)), span]

    def tiles(self):
        x, y, span = self.view
        tiles = []
        depth = 0
        while 2.0 ** -depth > span and depth < 45:
            depth += 1
        for d in (depth, depth + 1):
            for j in range(int(y * 2 ** d), min(2 ** d - 1, int((y + span) * 2 ** d)) + 1):
                for i in range(int(x * 2 ** d), min(2 ** d - 1, int((x + span) * 2 ** d)) + 1):
                    tiles.append([d, i, j])
        return tiles[:256]

    def look(self):
        self.move()
        body = {"scene": self.scene["key"], "page": str(self.number), "tiles": self.tiles()}
        begun = time.monotonic()
        connection, response = self.server.ask("POST", "tiles", body)
        assert response.status == 200, response.read()
        self.timed("a view: its stream begins", begun)
        left = self.dice.randint(0, len(body["tiles"]))
        for k in range(left):  # then the next view comes
            if time.monotonic() > self.end or next_record(response) is None:
                break
            if k == 0:
                self.timed("a view: its first tile", begun)
        connection.close()

    def cell(self):
        x, y, span = self.view
        depth = 24
        return {"depth": depth, "kx": int((x + self.dice.random() * span) * 2 ** depth),
                "ky": int((y + self.dice.random() * span) * 2 ** depth)}

    def click(self):
        at = urllib.parse.urlencode({"scene": self.scene["key"], **self.cell()})
        begun = time.monotonic()
        motion = self.server.get("motion?" + at)
        self.timed("a click: the motion", begun)
        assert motion["status"] in ("ok", "diverged")
        if motion["on_orbit"]:
            self.server.ask("GET", "multipliers?" + at)[0].close()

    def slide(self):
        choice = self.dice.choice([one for one in self.scene["choices"] if not one["is_state"]
                                   and one["value"] and one["name"] not in
                                   [axis["name"] for axis in self.scene["axes"]]])
        value = choice["value"] * self.dice.uniform(0.9, 1.1)
        begun = time.monotonic()
        connection, response = self.server.ask(
            "GET", "scene?" + urllib.parse.urlencode({"set": f"{choice['name']}={value!r}"}))
        text = response.read()
        connection.close()
        if response.status == 400:  # a value that the model refuses
            return
        scene = json.loads(text)
        self.timed("a slider: the scene", begun)
        x, y, span = self.view
        connection, response = self.server.ask(
            "POST", "preview", {"scene": scene["key"], "page": str(self.number),
                                "view": [x, y, x + span, y + span]})
        assert response.status == 200, response.read()
        if next_record(response, may_be_refused=True) is not None:
            self.timed("a slider: its preview", begun)
        connection.close()


def warm(page):
    """Has the kernels compiled: how long a click takes tells when they are there."""
    for act in (page.look, page.slide, page.click):
        act()
    quick = 0  # in a row: the multipliers of an orbit have kernels of their own
    for _ in range(60):
        begun = time.monotonic()
        page.click()
        quick = quick + 1 if time.monotonic() - begun < 0.5 else 0
        if quick == 4:
            return
        time.sleep(0.2)


def summary(pages):
    kinds = {}
    for page in pages:
        for kind, times in page.times.items():
            kinds.setdefault(kind, []).extend(times)
    for kind, times in sorted(kinds.items()):
        times.sort()
        at = lambda share: 1000 * times[min(len(times) - 1, int(share * len(times)))]
        print(f"{kind:28} {len(times):6} times, p50 {at(0.5):6.0f} ms, p95 {at(0.95):6.0f} ms, "
              f"most {1000 * times[-1]:6.0f} ms")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("gearsweep")
    parser.add_argument("--study", default="coarse-chaos")
    parser.add_argument("--seconds", type=float, default=20)
    parser.add_argument("--pages", type=int, default=2)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    tile_megabytes = 16
    server = Server(arguments.gearsweep, arguments.study, tile_megabytes)
    try:
        warm(Page(server, 99, 99, 0.0))
        begun = time.monotonic()
        pages = [Page(server, number, arguments.seed, begun + arguments.seconds)
                 for number in range(arguments.pages)]
        memory = [server.megabytes()]
        for page in pages:
            page.start()
        while any(page.is_alive() for page in pages):
            time.sleep(min(1.0, arguments.seconds / 8))
            memory.append(server.megabytes())
        for page in pages:
            if page.failure:
                raise page.failure
        summary(pages)
        half = memory[len(memory) // 2:]
        print(f"memory: {memory[0]:.0f} MB, half-way {half[0]:.0f} MB, at the end {memory[-1]:.0f} MB, "
              f"at most {max(memory):.0f} MB")
        # Kernels and scenes of the first half stay.
        assert memory[-1] < 1.15 * half[0] + tile_megabytes, memory
    finally:
        server.stop()


main()
