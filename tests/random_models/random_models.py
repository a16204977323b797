#!/usr/bin/env python3
"""Random models against motions of a program of its own, and against themselves written otherwise.

usage: random_models.py --gearsweep BINARY [--first SEED] [--count N] [--long] [--keep-kernels]

Each seed is a model (models.py). gearsweep integrates it at four values of one of its parameters, and
reference.py does so from the model's text. Sections, extremes, means and rms must agree within what the
motion itself makes of small differences. Then the model is written otherwise, with other names, other units,
a state that drives nothing or a phase that is whole turns on, and gearsweep must give the same. With --long,
periods and classes must not contradict a recurrence that the other program sees, or a growth that it measures.
With --fast the reference engine, which compiles nothing, computes models that are written otherwise: a third of
the time, as nearly all of it goes into compiling kernels.

It prints a line for each finding, and counts at the end. The exit status is 1 if there is a finding.
"""

import argparse
import collections
import dataclasses
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

import netCDF4
import numpy

import models
from reference import Reference

SETTLE, RECORD, STEPS = 6, 4, 512
LONG_SETTLE, LONG_RECORD = 300, 128
WAYS = ("min", "max", "mean", "rms")
# A step of a 512th of the period, of fourth order, of motions whose fastest turns some ten times in a
# period: far below this share of the range. What a jump does that is missed lies far above.
TOLERANCE = 2e-5
# Written otherwise a model has the same steps, but for rounding; of more than 16 corners others may be
# the ones that are corrected.
TOLERANCE_REWRITTEN = 1e-9
# Where steps are not cut at a jump with a state, the engine has first order, and says so.
TOLERANCE_AT_JUMPS = 2e-2
MOVE = 1e-7
# Beyond this growth of small differences nothing is compared.
MAX_GROWTH = 300.0
BY_REFERENCE = ("integrate.engine=reference",)


def study_of(model, quantities, settle, record, steps):
    lines = ["[model]", 'file = "model.toml"', "[[axes]]", f'name = "{model.swept}"',
             f"values = {model.swept_values()}", "[integrate]", f"settle = {settle}", f"record = {record}"]
    if steps:
        lines.append(f"steps_per_period = {steps}")
    if settle < 50:
        lines.append('stop = "never"')
    return "\n".join(lines + ["[observe]", f"quantities = {quantities!r}", ""])


class Refused(Exception):
    pass


def run(binary, folder, model, quantities, settle, record, steps=STEPS, more=()):
    """What gearsweep finds: quantity -> array [value] or [value][component], and what it said."""
    folder.mkdir(exist_ok=True)
    (folder / "model.toml").write_text(model.text())
    for file, rows in model.tables.items():
        (folder / file).write_text("degree, value\n" + "".join(f"{a!r}, {b!r}\n" for a, b in rows))
    (folder / "study.toml").write_text(study_of(model, quantities, settle, record, steps))
    command = [binary, "run", "study.toml", "-o", "out.nc"] + [f"--set={text}" for text in more]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=600)
    if done.returncode == 2:
        raise Refused(done.stderr.strip().splitlines()[0] if done.stderr.strip() else "?")
    if done.returncode != 0:
        raise RuntimeError(f"exit status {done.returncode}: {done.stderr.strip()[-400:]}")
    with netCDF4.Dataset(folder / "out.nc") as file:
        found = {name: numpy.ma.filled(variable[...].astype(float), numpy.nan)
                 for name, variable in file.variables.items() if variable.dtype.kind in "fiu"}
    (folder / "out.nc").unlink()
    return found, done.stderr


@dataclasses.dataclass
class Expected:
    motions: list
    growths: list  # what a difference of the start is multiplied by

    @staticmethod
    def of(reference, model, settle, record):
        motions, growths = [], []
        for value in model.swept_values():
            setting = {model.swept: value}
            motion = reference.run(setting, settle, record)
            moved = reference.run(setting, settle, record, MOVE)
            apart = numpy.abs(motion.sections - moved.sections).max() / MOVE
            growths.append(numpy.inf if motion.failure or moved.failure else max(1.0, apart))
            motions.append(motion)
        return Expected(motions, growths)


class Check:
    def __init__(self, binary, folder, is_long, is_fast):
        self.binary, self.folder, self.is_long, self.is_fast = binary, folder, is_long, is_fast
        self.counts = collections.Counter()
        self.findings = []

    def finds(self, seed, text):
        self.counts["findings"] += 1
        self.findings.append((seed, text))
        print(f"seed {seed}: {text}", flush=True)

    def model(self, seed):
        self.counts["models"] += 1
        model = models.random_model(seed)
        folder = self.folder / str(seed)
        folder.mkdir(parents=True)
        reference = Reference(model.text(), model.tables, folder)
        states = [name for name, _, _ in model.states]
        quantities = [f"{name}_{way}" for name in states for way in WAYS] + ["section_min", "section_max"]
        expected = Expected.of(reference, model, SETTLE, RECORD)
        found, said = run(self.binary, folder, model, quantities, SETTLE, RECORD)
        is_rough = "first order" in said
        if model.has_state_jump:
            self.counts["with a state that makes the field jump"] += 1
        if is_rough:
            self.counts["with a jump that steps are not cut at"] += 1
        self.compare(seed, is_rough, states, found, expected)
        if self.is_fast:
            found, _ = run(self.binary, folder, model, quantities, SETTLE, RECORD, more=BY_REFERENCE)
            self.compare(seed, is_rough, states, found, expected)
        rng = random.Random(seed)
        for name in rng.sample(sorted(models.REWRITINGS), 2):
            self.rewritten(seed, model, name, rng, folder, states, quantities, found, expected,
                           TOLERANCE_AT_JUMPS if is_rough else
                           TOLERANCE if "not corrected" in said else TOLERANCE_REWRITTEN)
        if self.is_long and not is_rough:
            self.long(seed, model, reference, folder)
        shutil.rmtree(folder)

    def compare(self, seed, is_rough, states, found, expected):
        base = TOLERANCE_AT_JUMPS if is_rough else TOLERANCE
        for i, (motion, growth) in enumerate(zip(expected.motions, expected.growths)):
            if motion.failure:
                self.counts["points without a reference: " + motion.failure] += 1
                continue
            if growth > MAX_GROWTH:
                self.counts["points too sensitive to compare"] += 1
                continue
            if found["status"][i] != 0:
                self.finds(seed, f"point {i}: status {found['status'][i]}")
                continue
            self.counts["points compared"] += 1
            sections = motion.sections[SETTLE - 1:]  # where recorded periods begin, and the last ends
            for j, state in enumerate(states):
                size = max(motion.max[j] - motion.min[j], abs(motion.max[j]), abs(motion.min[j]))
                allowed = base * growth * size + 1e-9
                pairs = [(way, found[f"{state}_{way}"][i], getattr(motion, way)[j]) for way in WAYS]
                pairs += [("section_min", found["section_min"].reshape(-1, len(states))[i][j], sections[:, j].min()),
                          ("section_max", found["section_max"].reshape(-1, len(states))[i][j], sections[:, j].max())]
                for way, value, right in pairs:
                    if not abs(value - right) <= allowed:
                        self.finds(seed, f"point {i}: {state} {way} is {value:.9g}, right {right:.9g}"
                                         f" (allowed {allowed:.1e})")
                        return

    def rewritten(self, seed, model, name, rng, folder, states, quantities, found, expected, base):
        other, meaning = models.REWRITINGS[name](model, rng)
        new = [f"{meaning[state][0]}_{way}" for state in states for way in WAYS]
        try:
            again, _ = run(self.binary, folder, other, new, SETTLE, RECORD,
                           more=BY_REFERENCE if self.is_fast else ())
        except Refused as refusal:
            if "take another name" in str(refusal):
                self.counts["names that are refused"] += 1
                return
            self.finds(seed, f"{name} is refused: {refusal}")
            return
        self.counts[f"{name} compared"] += 1
        # Other orders of sums round otherwise, and so do kernels that leave states out.
        for i, growth in enumerate(expected.growths):
            if not growth <= MAX_GROWTH or found["status"][i] != 0:
                continue
            for state in states:
                to, factor = meaning[state]
                size = max(abs(found[f"{state}_{way}"][i]) for way in WAYS)
                allowed = base * growth * size + 1e-12
                for way in WAYS:
                    value = again[f"{to}_{way}"][i] / factor
                    if not abs(value - found[f"{state}_{way}"][i]) <= allowed:
                        self.finds(seed, f"{name}: point {i}: {state} {way} is {value:.12g}, was "
                                         f"{found[f'{state}_{way}'][i]:.12g}")
                        return

    def long(self, seed, model, reference, folder):
        """Periods and classes at the defaults."""
        found, _ = run(self.binary, folder, model, ["period", "motion_class"], LONG_SETTLE, LONG_RECORD,
                       steps=0)
        for i, value in enumerate(model.swept_values()):
            motion = reference.run({model.swept: value}, LONG_SETTLE, LONG_RECORD)
            moved = reference.run({model.swept: value}, LONG_SETTLE, LONG_RECORD, MOVE)
            if motion.failure or moved.failure:
                continue
            recorded = motion.sections[LONG_SETTLE:]
            size = numpy.maximum(motion.max - motion.min, 1e-9 * numpy.abs(motion.max) + 1e-12)
            period = 0
            for lag in range(1, 17):
                if (numpy.abs(recorded[lag:] - recorded[:-lag]) / size).max() < 1e-7:
                    period = lag
                    break
            apart = (numpy.abs(motion.sections - moved.sections) / size).max(axis=1)
            is_far = apart[LONG_SETTLE:].mean() > 0.05  # of two starts a ten-millionth apart
            kind = int(found["motion_class"][i])
            seen = int(found["period"][i])
            self.counts["long points"] += 1
            self.counts[f"long points of class {kind}"] += 1
            if period > 0 and not is_far and (seen not in (0, period) or kind in (2, 3)):
                self.finds(seed, f"long: point {i}: period {seen}, class {kind}; right is period {period}")
            elif period == 0 and is_far and kind == 1:
                self.finds(seed, f"long: point {i}: period {seen}, class {kind}, but it does not recur "
                                 "and neighbours part")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--gearsweep", required=True)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--long", action="store_true")
    parser.add_argument("--fast", action="store_true")
    parser.add_argument("--keep-kernels", action="store_true",
                        help="let the driver keep what it compiles where it always does")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as work:
        if not options.keep_kernels:
            os.environ["POCL_CACHE_DIR"] = str(pathlib.Path(work) / "kernels")
        check = Check(os.path.abspath(options.gearsweep), pathlib.Path(work), options.long, options.fast)
        for seed in range(options.first, options.first + options.count):
            try:
                check.model(seed)
            except Exception as error:  # whatever it is, the next model is another one
                check.finds(seed, f"{type(error).__name__}: {error}")
            if not options.keep_kernels:
                shutil.rmtree(pathlib.Path(work) / "kernels", ignore_errors=True)
    for name, count in sorted(check.counts.items()):
        print(f"{count:7d}  {name}")
    print("seeds with a finding:", sorted({seed for seed, _ in check.findings}))
    return 1 if check.findings else 0


if __name__ == "__main__":
    sys.exit(main())
