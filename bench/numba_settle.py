#!/usr/bin/env python3
"""The settle kernel's strongest rival that a user may write: blocks of points in numba.

numba_settle.py GEARSWEEP SETTLE_BENCH [ROUNDS]

It integrates gear5 (constant backlash, no correction of steps, as odeint's steppers) on all cores.
The inner loop runs over the points of a block, so LLVM makes vectors of them as wide as the machine
has. First its sections are compared with gearsweep's, and its tangent vectors with differences of
its own motions. Then it, settle_bench and two maps of gearsweep are timed in turn, ROUNDS times,
and the medians printed, per second of a core, so that other work on the machine matters less. The
time that a map takes numba and odeint is its steps over their speed, with nothing for recording.
For coarse-map their steps are those of a pilot run without correction.
"""

import csv
import os
import re
import resource
import subprocess
import sys
import tempfile
import time

try:
  import llvmlite.binding as llvm

  # Compilers that tune for some CPUs prefer half of their width.
  os.environ["NUMBA_CPU_NAME"] = llvm.get_host_cpu_name()
  os.environ["NUMBA_CPU_FEATURES"] = llvm.get_host_cpu_features().flatten() + ",-prefer-256-bit"
  import numba
  import numpy as np
except ImportError as missing:
  sys.exit(f"{missing}: numba_settle.py needs numba ('pip install numba')")

POINTS = 128  # of a block: they differ in b and share omega, and so a phase grid
OMEGAS = np.linspace(0.4, 2.0, 32)
BACKLASHES = np.linspace(0.3, 1.5, POINTS)
MAX_STEP = 0.05
STUDY = f"""
[model]
name = "gear5"
preset = "coarse"
[[axes]]
name = "omega"
from = 0.4
to = 2.0
count = {len(OMEGAS)}
[[axes]]
name = "b"
from = 0.3
to = 1.5
count = {POINTS}
[integrate]
settle = 2
record = 1
max_step = {MAX_STEP}
events = false
stop = "never"
[observe]
quantities = ["poincare"]
poincare = ["x1", "x2", "x3", "x4", "x5", "v1", "v2", "v3", "v4", "v5"]
"""
CHAOS = ["coarse-chaos", "--set", "axes.0.count=160", "--set", "axes.1.count=120", "--set",
         "observe.quantities=['lyapunov_max']"]
# The preset `coarse`.
MU, F1, E0, ZETA, MASS, K, C, EPS, APPROACH, ALPHA, TEETH, Q = (
    0.05, 0.1, 0.6, 0.04008, 0.3507525, 1.38, 2.0, 1.718, 0.5, np.radians(20.0), 40.0, 0.35)
DAMPING, STIFFNESS = 2.0 * MASS * C * ZETA, MASS * K  # of a bearing


def coefs(psi, inside):
  """Of the mesh at a phase, as seen from `inside`: Q, 2 zeta G, B, mu C, 2 zeta mu H, sin."""
  total = np.zeros(5)
  for pair in (0, 1):
    if inside + pair >= EPS:
      continue
    s = psi + pair
    slide = 1.0 if inside + pair < APPROACH * EPS else -1.0
    kappa = (1.0 - Q * ((s - EPS / 2) / (EPS / 2)) ** 2) / (EPS * (1.0 - Q / 3.0))
    total += kappa, slide * np.tan(ALPHA) * kappa, slide * np.tan(ALPHA), slide * kappa, slide
  stiffness, lever, lever_damping, slide, slide_damping = total
  return (stiffness - MU * lever, 4 * ZETA - 2 * ZETA * MU * lever_damping, stiffness, MU * slide,
          2 * ZETA * MU * slide_damping, np.sin(2 * np.pi * psi))


def phase_grid(omega, max_step=MAX_STEP):
  """Coefficients of each step's start, middle and end, and the steps' lengths."""
  wanted, steps = 2 * np.pi / omega / max_step, 16
  while steps < wanted:  # 16, 20, 24, 28, 32, 40, ...
    steps += max(4, 1 << (steps.bit_length() - 3))
  bounds = [0.0, EPS - 1.0, APPROACH * EPS, 1.0]
  rows, lengths = [], []
  for begin, end in zip(bounds, bounds[1:]):
    count = int(np.ceil((end - begin) * steps - 1e-6))
    at = [coefs(begin + (end - begin) * i / (2 * count), (begin + end) / 2)
          for i in range(2 * count + 1)]
    rows += [at[2 * i] + at[2 * i + 1] + at[2 * i + 2] for i in range(count)]
    lengths += [(end - begin) / count * 2 * np.pi / omega] * count
  return np.array(rows), np.array(lengths)


@numba.njit(fastmath=True, inline="always")
def motion(drive, m, f, rate, x2, x3, x4, x5, v1, v2, v3, v4, v5):
  normal = 4 * ZETA * rate + m[2] * f
  sliding = m[4] * rate + m[3] * f
  return (v1, v2, v3, v4, v5, drive - m[0] * f - m[1] * rate,
          -MASS * sliding - DAMPING * v2 - STIFFNESS * x2,
          MASS * normal - DAMPING * v3 - STIFFNESS * x3,
          MASS * sliding - DAMPING * v4 - STIFFNESS * x4,
          -MASS * normal - DAMPING * v5 - STIFFNESS * x5)


@numba.njit(fastmath=True, inline="always")
def slope(forcing, m, b, x):
  deflection = x[0] - x[2] + x[4]
  f = deflection - min(max(deflection, -b), b)
  return motion(F1 + forcing * m[5], m, f, x[5] - x[7] + x[9], x[1], x[2], x[3], x[4], x[5], x[6],
                x[7], x[8], x[9])


@numba.njit(fastmath=True, inline="always")
def slope_of_tangent(m, b, x, w):
  deflection = x[0] - x[2] + x[4]
  f = w[0] - w[2] + w[4] if abs(deflection) > b else 0.0
  return motion(0.0, m, f, w[5] - w[7] + w[9], w[1], w[2], w[3], w[4], w[5], w[6], w[7], w[8],
                w[9])


@numba.njit(fastmath=True, inline="always")
def moved(x, h, d):
  return (x[0] + h * d[0], x[1] + h * d[1], x[2] + h * d[2], x[3] + h * d[3], x[4] + h * d[4],
          x[5] + h * d[5], x[6] + h * d[6], x[7] + h * d[7], x[8] + h * d[8], x[9] + h * d[9])


# A block is one array, row after row: where rows lie is then known to the compiler.
@numba.njit(fastmath=True, inline="always")
def column(x, i):
  return (x[i], x[POINTS + i], x[2 * POINTS + i], x[3 * POINTS + i], x[4 * POINTS + i],
          x[5 * POINTS + i], x[6 * POINTS + i], x[7 * POINTS + i], x[8 * POINTS + i],
          x[9 * POINTS + i])


@numba.njit(fastmath=True, inline="always")
def put(x, i, y):
  (x[i], x[POINTS + i], x[2 * POINTS + i], x[3 * POINTS + i], x[4 * POINTS + i], x[5 * POINTS + i],
   x[6 * POINTS + i], x[7 * POINTS + i], x[8 * POINTS + i], x[9 * POINTS + i]) = y


@numba.njit(fastmath=True, inline="always")
def mesh(rows, step, at):
  return (rows[step, at], rows[step, at + 1], rows[step, at + 2], rows[step, at + 3],
          rows[step, at + 4], rows[step, at + 5])


@numba.njit(fastmath=True, parallel=True)
def settle(x, rows, lengths, counts, forcing, b, periods):
  for block in numba.prange(x.shape[0]):
    y = x[block]
    for step in range(periods * counts[block]):
      step %= counts[block]
      h = lengths[block, step]
      start, middle, end = (mesh(rows[block], step, 0), mesh(rows[block], step, 6),
                            mesh(rows[block], step, 12))
      for i in range(POINTS):
        old = column(y, i)
        d = slope(forcing[block], start, b[i], old)
        new = moved(old, h / 6, d)
        d = slope(forcing[block], middle, b[i], moved(old, h / 2, d))
        new = moved(new, h / 3, d)
        d = slope(forcing[block], middle, b[i], moved(old, h / 2, d))
        new = moved(new, h / 3, d)
        d = slope(forcing[block], end, b[i], moved(old, h, d))
        put(y, i, moved(new, h / 6, d))


@numba.njit(fastmath=True, parallel=True)
def settle_with_tangent(x, log_stretching, rows, lengths, counts, forcing, b, periods):
  """As settle, with a tangent vector after the states; its length is made 1 after each period."""
  for block in numba.prange(x.shape[0]):
    y = x[block]
    for period in range(periods):
      for step in range(counts[block]):
        h = lengths[block, step]
        start, middle, end = (mesh(rows[block], step, 0), mesh(rows[block], step, 6),
                              mesh(rows[block], step, 12))
        for i in range(POINTS):
          old, was = column(y, i), column(y, 10 * POINTS + i)
          d, g = slope(forcing[block], start, b[i], old), slope_of_tangent(start, b[i], old, was)
          new, now = moved(old, h / 6, d), moved(was, h / 6, g)
          at, to = moved(old, h / 2, d), moved(was, h / 2, g)
          d, g = slope(forcing[block], middle, b[i], at), slope_of_tangent(middle, b[i], at, to)
          new, now = moved(new, h / 3, d), moved(now, h / 3, g)
          at, to = moved(old, h / 2, d), moved(was, h / 2, g)
          d, g = slope(forcing[block], middle, b[i], at), slope_of_tangent(middle, b[i], at, to)
          new, now = moved(new, h / 3, d), moved(now, h / 3, g)
          at, to = moved(old, h, d), moved(was, h, g)
          d, g = slope(forcing[block], end, b[i], at), slope_of_tangent(end, b[i], at, to)
          put(y, i, moved(new, h / 6, d))
          put(y, 10 * POINTS + i, moved(now, h / 6, g))
      for i in range(POINTS):
        length = 0.0
        for j in range(10, 20):
          length += y[j * POINTS + i] ** 2
        length = np.sqrt(length)
        log_stretching[block, i] += np.log(length)
        for j in range(10, 20):
          y[j * POINTS + i] /= length


class Points:
  def __init__(self):
    grids = [phase_grid(omega) for omega in OMEGAS]
    self.counts = np.array([len(lengths) for _, lengths in grids])
    self.rows = np.zeros((len(grids), self.counts.max(), 18))
    self.lengths = np.zeros((len(grids), self.counts.max()))
    for block, (rows, lengths) in enumerate(grids):
      self.rows[block, :len(rows)], self.lengths[block, :len(rows)] = rows, lengths
    self.x = np.zeros((len(grids), 20, POINTS))  # at rest on the drive flank; a tangent vector
    self.x[:, 0] = BACKLASHES + F1 * (1.0 + 2.0 / K)
    self.x[:, 2], self.x[:, 4] = F1 / K, -F1 / K
    self.x[:, 10:] = np.sqrt(0.1)
    self.log_stretching = np.zeros((len(grids), POINTS))

  def settle(self, periods):
    settle(self.x.reshape(len(OMEGAS), -1), self.rows, self.lengths, self.counts, E0 * OMEGAS**2,
           BACKLASHES, periods)

  def settle_with_tangent(self, periods):
    settle_with_tangent(self.x.reshape(len(OMEGAS), -1), self.log_stretching, self.rows,
                        self.lengths, self.counts, E0 * OMEGAS**2, BACKLASHES, periods)

  def rate(self, advance, periods):
    begin = time.process_time()
    advance(periods)
    return self.counts.sum() * POINTS * periods / (time.process_time() - begin)


def core_seconds(gearsweep, *arguments):
  """Of all cores together, for a run from its start to the closed file."""
  spent = lambda: sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])
  with tempfile.TemporaryDirectory() as folder:
    begin = spent()
    subprocess.run([gearsweep, "run", *arguments, "--quiet", "-o", f"{folder}/map.nc"],
                   stderr=subprocess.DEVNULL, check=True)
    return spent() - begin


def kernel_rate(gearsweep, study, steps, key, *settings):
  """Steps per core second, by how much longer a run takes that has 100 periods more."""
  settings = [word for setting in settings for word in ("--set", setting)]
  seconds = [core_seconds(gearsweep, study, *settings, "--set", f"integrate.{key}={periods}")
             for periods in (120, 20)]
  return 100 * steps / (seconds[0] - seconds[1])


def check_sections(gearsweep):
  with tempfile.TemporaryDirectory() as folder:
    with open(f"{folder}/study.toml", "w") as study:
      study.write(STUDY)
    subprocess.run([gearsweep, "run", f"{folder}/study.toml", "-o", f"{folder}/sections.nc",
                    "--quiet"], check=True)
    subprocess.run([gearsweep, "export", f"{folder}/sections.nc", "-q", "poincare", "-o",
                    f"{folder}/sections.npy"], check=True)
    wanted = np.load(f"{folder}/sections.npy")["poincare"][..., 0]  # b, omega, state
  points = Points()
  points.settle(3)
  apart = np.abs(points.x[:, :10] - wanted.transpose(1, 2, 0)).max()
  print(f"sections of {points.x[:, 0].size} points: within {apart:.1e} of gearsweep's")
  if not apart < 1e-9:
    sys.exit("These are not the same orbits.")


def check_tangents():
  one, other, size = Points(), Points(), 1e-7
  other.x[:, :10] += size * other.x[:, 10:]
  one.settle_with_tangent(1)
  other.settle(1)
  seen = (other.x - one.x)[:, :10] / size
  wanted = one.x[:, 10:] * np.exp(one.log_stretching)[:, None]
  apart = np.median(np.abs(seen - wanted))  # of some a limit lies between the two motions
  print(f"tangent vectors after a period: within {apart:.1e} of differences (median)")
  if not apart < 1e-5:
    sys.exit("These are not tangent vectors.")


def times_odeint(settle_bench):
  """How many times the speed of odeint's faster stepper with SIMD the kernel has, uncorrected."""
  found = subprocess.run(
      [settle_bench, "--benchmark_filter=settle/fp64/constant/uncorrected",
       "--benchmark_format=csv"], capture_output=True, text=True, check=True).stdout.splitlines()
  first = next(i for i, line in enumerate(found) if line.startswith("name,"))
  row = next(csv.DictReader(found[first:]))
  return min(float(row["vs_odeint_simd"]), float(row["vs_classic_simd"]))


def found_step(gearsweep, study, events):
  """The longest step that a pilot run finds right enough, with or without the correction."""
  found = subprocess.run([gearsweep, "run", *study, "--set", f"integrate.events={events}",
                          "--dry-run"], capture_output=True, text=True, check=True)
  return float(re.search(r"steps +at most ([\d.]+):", found.stdout).group(1))


def map_steps(omegas, others, periods, max_step):
  return others * periods * sum(len(phase_grid(omega, max_step)[1]) for omega in omegas)


def main():
  gearsweep, settle_bench = sys.argv[1:3]
  rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 5
  check_sections(gearsweep)
  check_tangents()
  is_wide = all("zmm" in "".join(f.inspect_asm().values()) for f in (settle, settle_with_tangent))
  print(f"vectors of {'512' if is_wide else 'less than 512'} bits")
  points = Points()
  map_step = found_step(gearsweep, ["coarse-map"], "false")
  # Without the correction no step in reach makes this map as right, so the rival takes ours.
  chaos_step = found_step(gearsweep, CHAOS, "true")
  steps_of_map = map_steps(np.linspace(0.4, 2.0, 480), 360, 400, map_step)
  steps_of_chaos = map_steps(np.linspace(0.4, 2.0, 160), 120, 1, chaos_step)  # for each period
  exponents = ["integrate.settle=2", "observe.quantities=['lyapunov_max']"]
  seen = []
  with tempfile.TemporaryDirectory() as folder:
    study = f"{folder}/study.toml"
    with open(study, "w") as text:
      text.write(STUDY)
    steps = points.counts.sum() * POINTS
    for _ in range(rounds):
      corrected = kernel_rate(gearsweep, study, steps, "settle", "integrate.events=true")
      plain = kernel_rate(gearsweep, study, steps, "settle")
      # A map of the force has no need of six of the ten states; numba has them all.
      mapped = [kernel_rate(gearsweep, study, steps, "settle", "observe.quantities=['dmf_max']",
                            f"integrate.events={events}") for events in ("true", "false")]
      settled = points.rate(points.settle, 64)
      odeint = plain / times_odeint(settle_bench)
      record = kernel_rate(gearsweep, study, steps, "record", "integrate.events=true", *exponents)
      tangent = points.rate(points.settle_with_tangent, 32)
      # A map of exponents: 300 periods without, 400 with a tangent vector.
      rival_chaos = 300 * steps_of_chaos / settled + 400 * steps_of_chaos / tangent
      seen.append((corrected / 1e6, plain / 1e6, odeint / 1e6, settled / 1e6, record / 1e6,
                   tangent / 1e6, core_seconds(gearsweep, "coarse-map"), steps_of_map / odeint,
                   steps_of_map / settled, 19.2 / core_seconds(gearsweep, *CHAOS),
                   19.2 / rival_chaos, mapped[0] / 1e6, mapped[1] / 1e6))
  seen = np.array(seen)

  def line(what, ours, *rivals):
    cells = [f"{np.median(seen[:, ours]):.3g}"]
    for rival in rivals:
      cells.append("" if rival is None else f"{np.median(seen[:, rival]):.3g} "
                   f"({np.median(seen[:, ours] / seen[:, rival]):.2f})")
    print(f"| {what} | " + " | ".join(cells) + " |")

  print(f"steps of numba and odeint: {map_step} for coarse-map, {chaos_step} for coarse-chaos\n")
  print("| per core second; ours / theirs | gearsweep | odeint, SIMD | numba |")
  print("| --- | --- | --- | --- |")
  line("settle, all states, M steps", 0, 2, 3)
  line("settle, all states, uncorrected, M steps", 1, 2, 3)
  line("settle for a map of the force, M steps", 11, 2, 3)
  line("settle for a map of the force, uncorrected, M steps", 12, 2, 3)
  line("with a tangent vector, M steps", 4, None, 5)
  line("coarse-map, core seconds", 6, 7, 8)
  line("coarse-chaos 160 x 120, thousand points", 9, None, 10)


if __name__ == "__main__":
  main()
