"""Search for the parameters of a paper that does not state them all.

Chen, Tang, Luo and Wang (2011) give no mesh stiffness, load or error, and the masses that they do
give do not yield their figures. So this draws sets at random, asks of each which of the paper's
claims it keeps, goes on from the best ones, and counts which claims no set keeps together.

You learn to judge thousands of candidates with few calls: `points` holds the sets, `sweep` the one
axis that each of them gets; a claim is a small function of the maps. First come cheap questions to
all sets, then dear ones to the best and to some that luck chooses.
"""

# %%
import argparse
import time
import warnings
from functools import partial
from itertools import islice

import matplotlib.pyplot as plt
import numpy as np

import gearsweep as gs

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("--out", help="write the picture here, in place of showing it")
parser.add_argument("--table", help="write the best sets and their claims here, as CSV")
parser.add_argument("--small", action="store_true", help="few sets, for a look within seconds")
arguments, _ = parser.parse_known_args()

DRAWN = 12_000  # sets at random
GENERATIONS, CHILDREN = 4, 2000  # and sets near the best ones
ASKED, BY_LUCK = 1200, 400  # of those drawn, how many are asked all questions
ASKED_CHILDREN = 200
SETTLE, RECORD = 600, 100  # periods, as in the paper
if arguments.small:
    DRAWN, GENERATIONS, CHILDREN, ASKED, BY_LUCK, ASKED_CHILDREN = 30, 1, 10, 4, 2, 2
    SETTLE, RECORD = 20, 10
random = np.random.default_rng(1)
# Many sets diverge, and keep no claim.
warnings.filterwarnings("ignore", message=".*diverged", category=RuntimeWarning)

# %% A set: a row of numbers, and a form of the equations
FAMILIES = [  # formulation, shape of the stiffness, share of the sets drawn
    ("printed", "fourier", 0.4),
    ("printed", "parabolic", 0.15),
    ("printed", "rectangular", 0.15),
    ("consistent", "fourier", 0.15),
    ("consistent", "parabolic", 0.1),
    ("consistent", "rectangular", 0.05),
]
if arguments.small:  # each has kernels of its own
    FAMILIES = [("printed", "fourier", 1.0)]
# From, to; even ratios are equally likely, for the phase even steps.
RANGES = {
    "m": (0.01, 0.5),  # mass ratio of both shafts
    "k": (0.3, 30.0),  # bearing stiffness
    "c": (0.3, 10.0),  # bearing damping
    "zeta": (0.001, 0.1),  # mesh damping
    "F1": (0.03, 0.4),  # load
    "e0": (0.02, 0.8),  # error
    "kappa": (0.01, 0.4),  # first harmonic of a fourier stiffness,
    "phase": (0.0, 2 * np.pi),  # and its phase
    "q": (0.05, 0.8),  # fall of a parabolic stiffness
}
LOW, HIGH = np.array(list(RANGES.values())).T
IS_LOG = LOW > 0


def draw(count):
    """Families, shape (sets,), and values, shape (sets, names of RANGES)."""
    share = random.random((count, len(RANGES)))
    even = LOW + share * (HIGH - LOW)
    ratio = np.where(IS_LOG, LOW, 1) * (HIGH / np.where(IS_LOG, LOW, 1)) ** share
    family = random.choice(len(FAMILIES), count, p=[share for *_, share in FAMILIES])
    return family, np.where(IS_LOG, ratio, even)


def change(values):
    """Sets near others: about half of the numbers change, some a little, some a lot."""
    size = random.choice([0.01, 0.05, 0.2], (len(values), 1))
    step = size * random.normal(size=values.shape) * (random.random(values.shape) < 0.5)
    changed = np.where(IS_LOG, values * np.exp(step), values + 2 * step)
    return np.where(IS_LOG, np.clip(changed, LOW, HIGH), changed % HIGH)


def columns(values):
    """The same as parameters of gear5: both shafts and both directions are alike."""
    table = dict(zip(RANGES, values.T))
    m, k, c = table.pop("m"), table.pop("k"), table.pop("c")
    bearings = {f"{name}{i}": row for name, row in (("k", k), ("c", c)) for i in (1, 2, 3, 4)}
    return {"m1": m, "m2": m, **bearings, **table}


computed = 0  # points


def sweep(sets, axis, fixed, quantities, backlash="constant", settle=SETTLE):
    """The maps of all sets over one axis: arrays of shape (sets, values of the axis)."""
    global computed
    family, values = sets
    (count,) = (len(grid) for grid in axis.values())
    maps = {name: np.full((len(family), count), np.nan) for name in quantities}
    for number, (formulation, stiffness, _) in enumerate(FAMILIES):
        chosen = family == number
        if not chosen.any():
            continue
        study = (
            gs.Study.gear5("paper", formulation=formulation, stiffness=stiffness, backlash=backlash)
            .points(columns(values[chosen]) | fixed)
            .sweep(**axis)
            .observe(*quantities)
            .integrate(settle=settle, record=RECORD, stop="never", max_step=0.1)
        )
        found = study.run(progress=None)
        computed += found.status.size
        for name in quantities:
            maps[name][chosen] = found[name].values
    return maps


# %% The claims: each the conditions of `gearsweep reproduce`, on fewer values of the axis
CHAOTIC = 0.003  # a largest exponent beyond it is chaos
LARGE = 0.6  # a largest force beyond it: the motion has jumped
B = np.array([0.30, 0.36, 0.39, 0.42, 0.55, 0.70, 0.80, 1.00, 1.20, 1.30])
B_DYNAMIC = np.array([0.30, 0.36, 0.42, 0.48, 0.55, 0.62, 0.70, 0.80, 0.90, 1.00, 1.10, 1.20, 1.30])
OMEGA = np.r_[0.10:0.145:0.01, 0.15:0.34:0.02, 0.40:0.59:0.02, 0.70:1.51:0.2]
OMEGA_CHAOS = np.arange(0.20, 1.51, 0.05)


def share(so):
    return so.mean(axis=1)


def at(maps, name, grid, value):
    return maps[name][:, np.argmin(abs(grid - value))]


def inside(low, high, least, most):
    return (low >= least) & (high <= most)


def ask_all(sets):
    """What a sweep over b tells, with constant backlash."""
    ranges = ["x1_min", "x1_max", "dmf_min", "dmf_max"]
    quantities = ["x1_rms", *ranges, "contact_class", "lyapunov_max"]
    maps = sweep(sets, {"b": B}, {"omega": 0.5}, quantities)
    force, rms, chaos = maps["dmf_max"], maps["x1_rms"], maps["lyapunov_max"] > CHAOTIC
    exponent = partial(at, maps, "lyapunov_max", B)
    small, large = B < 0.421, B > 0.799
    flat = ((force >= 0.21) & (force <= 0.23))[:, small].all(axis=1)
    rises = (np.diff(rms[:, small]) > 0).all(axis=1)
    # The first b at which the force is beyond LARGE and was not before, or the other way round.
    passes = (force[:, 1:] > LARGE) != (force[:, :-1] > LARGE)
    first = np.where(passes.any(axis=1), B[1:][passes.argmax(axis=1)], np.nan)
    beyond = share(chaos[:, large])
    low, high = (at(maps, name, B, 1.2) for name in ("x1_min", "x1_max"))
    wide = (low < -5) & (high > 5) & inside(low, high, -8, 8)
    answers = {
        "7 small b": [flat, rises],
        "7 jump": [(first >= 0.43) & (first <= 0.8)],
        "7 chaos": [beyond >= 0.1, beyond >= 0.8],
        "8 b = 1.2": [exponent(1.2) > CHAOTIC, wide, at(maps, "dmf_min", B, 1.2) < 0],
        "8 b = 0.70": [exponent(0.7) > CHAOTIC],
    }
    return answers, maps


def ask_best(sets, maps):
    """What other sweeps tell; `maps` are those over b."""
    early = at(maps, "x1_min", B, 0.39), at(maps, "x1_max", B, 0.39)
    ends = sweep(sets, {"b": [0.39]}, {"omega": 0.5}, ["x1_min", "x1_max"], settle=5 * SETTLE // 2)
    narrower = (ends["x1_max"] - ends["x1_min"])[:, 0] < 0.8 * (early[1] - early[0])
    # Dynamic backlash over b.
    quantities = ["x1_rms", "dmf_max", "contact_class", "lyapunov_max"]
    dynamic = sweep(sets, {"b": B_DYNAMIC}, {"omega": 0.5}, quantities, backlash="dynamic")
    small = np.flatnonzero(B_DYNAMIC < 0.421)
    force, rms = dynamic["dmf_max"][:, small], dynamic["x1_rms"][:, small]
    slope = (rms[:, -1] - rms[:, 0]) / np.ptp(B_DYNAMIC[small])
    chaos = dynamic["lyapunov_max"][:, B_DYNAMIC > 0.419] > CHAOTIC
    changes = (chaos[:, 1:] != chaos[:, :-1]).sum(axis=1)
    classes = np.hstack([maps["contact_class"], dynamic["contact_class"]])
    # Over omega, without and with friction.
    quantities = ["x1_rms", "x1_min", "x1_max", "dmf_max"]
    without = sweep(sets, {"omega": OMEGA}, {"b": 1.0, "mu": 0.0}, quantities)
    rubbing = sweep(sets, {"omega": OMEGA}, {"b": 1.0, "mu": 0.1}, quantities)
    higher = share(without["x1_rms"] > rubbing["x1_rms"])
    larger = without["dmf_max"] > rubbing["dmf_max"]
    low = share(larger[:, OMEGA < 0.141])
    above = 1 - share(larger[:, (OMEGA > 0.139) & (OMEGA <= 0.25)])
    peaks = []
    for resonance in (0.25, 0.5):
        near = np.flatnonzero((OMEGA > resonance - 0.101) & (OMEGA < resonance + 0.081))
        values = np.nan_to_num(without["x1_rms"][:, near])
        peaks.append(abs(OMEGA[near][values.argmax(axis=1)] - resonance) <= 0.0301)
    slow, middle = np.argmin(abs(OMEGA - 0.1)), np.argmin(abs(OMEGA - 0.7))
    # Where chaos begins over omega.
    begins = {}
    for law in ("constant", "dynamic"):
        found = sweep(sets, {"omega": OMEGA_CHAOS}, {}, ["lyapunov_max"], backlash=law)
        so = found["lyapunov_max"] > CHAOTIC
        begins[law] = np.where(so.any(axis=1), OMEGA_CHAOS[so.argmax(axis=1)], np.inf)
    both = np.isfinite(begins["constant"]) & np.isfinite(begins["dynamic"])
    return {
        "4 resonances": peaks,
        "4 RMS": [higher >= 0.5, higher >= 0.8],
        "4 force": [low >= 0.8, above >= 0.8],
        "5 range": [inside(without["x1_min"], without["x1_max"], 0.925, 0.95)[:, slow]],
        "6 range": [
            inside(case["x1_min"], case["x1_max"], -0.5, 1.8)[:, middle]
            for case in (without, rubbing)
        ],
        "8 b = 0.39": [inside(*early, 0.15, 0.45), narrower],
        "9 dynamic first": [both, both & (begins["dynamic"] < begins["constant"])],
        "10 small b": [np.ptp(force, axis=1) < 0.05 * force[:, 0], abs(slope - 1) <= 0.1],
        "10 alternates": [changes > 0, changes >= 4],
        "11 regimes": [(classes == kind).any(axis=1) for kind in (0, 1, 2)],
    }


def verdicts(answers):
    """1 where a claim holds, 0.5 where in part, else 0: shape (claims, sets)."""
    return np.array([(np.all(met, 0) * 1.0 + np.any(met, 0)) / 2 for met in answers.values()])


def score(verdict):
    """Claims that hold, and a little for those that hold in part."""
    return (verdict == 1).sum(axis=0) + 0.3 * (verdict == 0.5).sum(axis=0)


def best_first(verdict):
    return np.argsort(-score(verdict), kind="stable")


def judge(sets, asked, by_luck=0):
    """The sets that were asked all questions, with the verdicts on both rounds of questions."""
    answers, maps = ask_all(sets)
    first = verdicts(answers)
    kept = best_first(first)[:asked]
    kept = np.union1d(kept, random.choice(len(sets[0]), by_luck, replace=False))
    best = sets[0][kept], sets[1][kept]
    later = ask_best(best, {name: values[kept] for name, values in maps.items()})
    names = [*answers, *later]
    return best, np.vstack([first[:, kept], verdicts(later)]), names


def unlike(verdict):
    """The best sets first, of those that keep the very same claims one alone."""
    seen = set()
    for row in best_first(verdict):
        kept = tuple(verdict[:, row] == 1)
        if kept not in seen:
            yield row
        seen.add(kept)


# %% Random sets, and today's preset among them
started = time.monotonic()


def tell():
    spent = time.monotonic() - started
    print(f"{spent:.0f} s: {judged} sets, the best holds {(verdict == 1).sum(axis=0).max()}")


family, values = draw(DRAWN)
today = {"m": 0.0387, "k": 1.47042, "c": 2.0, "zeta": 0.00250676, "F1": 0.173386, "e0": 0.120023,
         "kappa": 0.03518, "phase": 5.714, "q": 0.35}
family[0], values[0] = 0, [today[name] for name in RANGES]
best, verdict, names = judge((family, values), ASKED, BY_LUCK)
judged = DRAWN
tell()

# %% Sets near the best ones
for generation in range(GENERATIONS):
    parents = best_first(verdict)[random.integers(0, min(40, verdict.shape[1]), CHILDREN)]
    children = best[0][parents], change(best[1][parents])
    found, found_verdict, _ = judge(children, ASKED_CHILDREN)
    best = tuple(np.concatenate(pair) for pair in zip(best, found))
    verdict = np.hstack([verdict, found_verdict])
    judged += CHILDREN
    tell()

# %% The best of them, and today's preset
held = (verdict == 1).sum(axis=0)
mine = np.flatnonzero((best[0] == 0) & np.isclose(best[1], values[0]).all(axis=1))
for row in [*mine[:1], *islice(unlike(verdict), 12)]:
    formulation, stiffness, _ = FAMILIES[best[0][row]]
    numbers = ", ".join(f"{name}={value:.6g}" for name, value in zip(RANGES, best[1][row]))
    print(f"{held[row]} of {len(names)}: {formulation}, {stiffness}, {numbers}")
    print("  not: " + ", ".join(name for name, sure in zip(names, verdict[:, row]) if sure < 1))
print(f"{judged} sets, {computed} points, {time.monotonic() - started:.0f} s")
if arguments.table:
    with open(arguments.table, "w") as table:
        table.write(",".join(["formulation", "stiffness", *RANGES, *names]) + "\n")
        for row in best_first(verdict)[:1000]:
            cells = [*FAMILIES[best[0][row]][:2], *best[1][row], *verdict[:, row]]
            table.write(",".join(map(str, cells)) + "\n")

# %% Which claims hold together
holds = (verdict == 1).astype(int)
together = holds @ holds.T
figure, axes = plt.subplots(figsize=(8.5, 7.5), layout="constrained")
least = np.minimum.outer(holds.sum(axis=1), holds.sum(axis=1))
image = axes.imshow(100 * together / np.maximum(least, 1), cmap="YlGnBu", vmin=0, vmax=100)
for i, j in np.ndindex(together.shape):
    share_of_rarer = together[i, j] / max(least[i, j], 1)
    colour = "white" if share_of_rarer > 0.5 else "black"
    axes.text(j, i, together[i, j], ha="center", va="center", fontsize=7, color=colour)
axes.set_xticks(range(len(names)), names, rotation=50, ha="right")
axes.set_yticks(range(len(names)), names)
axes.set_title(f"Claims that hold together, of {len(held)} sets that were asked all questions")
figure.colorbar(image, label="sets with both, % of those with the rarer claim", shrink=0.8)
if arguments.out:
    figure.savefig(arguments.out, dpi=100)
else:
    plt.show()
