"""Random models, and the same models written otherwise."""

import copy
import dataclasses
import math
import random

from expressions import Maker, Name, call, replace, sum_of, write

# Words of the languages that models are translated to, and names that their headers have. Names that a
# model's own text gives a meaning (phase, pi, functions, and, or, not) are none of them.
WORDS = """auto break case char const continue default do double else enum extern float for goto int
long register return short signed sizeof static struct switch typedef union unsigned void volatile while
inline restrict bool true false class delete friend mutable namespace new operator private protected
public template this throw try using virtual typename explicit export alignas constexpr nullptr
half uint uchar ushort ulong size_t ptrdiff_t float4 double2 double4 double8 int4 kernel global local
constant private image2d_t event_t NULL NAN INFINITY M_PI M_E HUGE_VAL FLT_MAX DBL_MAX LANES
X TABLE UNROLL SHARED_FN real scalar mask ModelPoint ModelSignals scale point x dx w base out inside
lane_max lane_select fma pow mad dot cross length rint round ceil trunc sincos
stdin errno main printf assert lambda def None True pass yield import global raise""".split()


@dataclasses.dataclass
class Model:
    states: list  # of (name, start, equation)
    parameters: dict  # name -> value
    period: object  # an expression of parameters
    tables: dict  # file -> (columns, rows)
    constants: dict = dataclasses.field(default_factory=dict)
    is_forced: bool = True
    has_state_jump: bool = False
    swept: str = ""

    def swept_values(self):
        """Of the axis, rising."""
        value = self.parameters[self.swept]
        return sorted(value * factor for factor in (1.0, 1.04, 0.97, 1.09))

    def names(self):
        return [name for name, _, _ in self.states] + list(self.parameters) + list(self.constants)

    def text(self):
        lines = ["[model]", 'name = "random"', "[states]"]
        lines += [f"{name} = {{ start = \"{write(start)}\" }}" for name, start, _ in self.states]
        lines += ["[parameters]"]
        lines += [f"{name} = {value!r}" for name, value in self.parameters.items()]
        if self.constants:
            lines += ["[constants]"]
            lines += [f'{name} = "{write(tree)}"' for name, tree in self.constants.items()]
        lines += ["[equations]"]
        lines += [f'{name} = "{write(equation)}"' for name, _, equation in self.states]
        return "\n".join(lines + ["[forcing]", f'period = "{write(self.period)}"', ""])


def random_table(rng):
    """Points of a smooth closed curve of size 1, over degrees."""
    count = rng.choice((9, 13, 19))
    phase, other = rng.uniform(0, 6), rng.uniform(0, 6)
    rows = []
    for i in range(count):
        angle = 2 * math.pi * i / (count - 1)
        rows.append((360 * i / (count - 1),
                     round(0.6 * math.sin(angle + phase) + 0.3 * math.cos(2 * angle + other), 4)))
    rows[-1] = (360.0, rows[0][1])
    return rows


def random_model(seed):
    rng = random.Random(seed)
    parameters, tables = {}, {}

    def parameter(low, high):
        name = f"p{len(parameters)}"
        parameters[name] = round(rng.uniform(low, high), 3)
        return Name(name)

    def table():
        file = f"table{len(tables)}.csv"
        tables[file] = random_table(rng)
        return file

    make = Maker(rng, parameter, table)
    is_forced = rng.random() < 0.8
    drives = rng.choice((("wave",), ("jump",), ("jump", "corner"), ("corner",), ("wave", "table"),
                         ("jump", "corner", "wave", "table")))
    couplings = rng.choice((("smooth",), ("smooth", "corner"), ("corner",),
                            ("smooth", "jump") if rng.random() < 0.4 else ("smooth",)))
    forces = rng.choice((("smooth",), ("contact",)))
    omega = parameter(0.4, 2.0)
    oscillators = rng.choice((0, 1, 1, 2)) if rng.random() < 0.9 else 3
    followers = rng.randrange(1 if oscillators == 0 else 0, 3)
    if followers + 2 * oscillators > 6:
        followers = 0
    names = [f"{kind}{i}" for i in range(oscillators) for kind in ("q", "u")]
    names += [f"y{i}" for i in range(followers)]
    places = [Name(name) for name in names if not name.startswith("u")]

    def pushes(own):
        terms = []
        if is_forced and rng.random() < 0.8:
            terms.append(("*", parameter(0.1, 0.8), make.drive(drives)))
        for other in places:
            if other != own and rng.random() < 0.5:
                terms.append(("*", parameter(-0.6, 0.6), make.bounded(other, couplings)))
        return terms or [("*", parameter(0.1, 0.5), make.drive(drives) if is_forced else 1)]

    states = []
    for i in range(oscillators):
        place, speed = Name(f"q{i}"), Name(f"u{i}")
        damping = parameter(0.05, 0.4)
        resists = [("neg", ("*", damping, speed)), ("neg", make.restoring(place, forces))]
        if not is_forced and rng.random() < 0.5:  # swings by itself
            resists[0] = ("*", ("*", damping, ("-", 1, ("^", place, 2))), speed)
        states.append((place.text, make.number(-0.5, 0.5), speed))
        states.append((speed.text, make.number(-0.5, 0.5), sum_of(resists + pushes(place))))
    for i in range(followers):
        own = Name(f"y{i}")
        states.append((own.text, make.number(-0.5, 0.5),
                       sum_of([("neg", ("*", parameter(0.3, 1.5), own))] + pushes(own))))
    model = Model(states, parameters, ("/", ("*", 2, Name("pi")), omega), tables, is_forced=is_forced,
                  has_state_jump="jump" in couplings and any(
                      jumps_with_state(equation, names) for _, _, equation in states))
    used = set(names_in([equation for _, _, equation in states] + [model.period]))
    model.parameters = {name: value for name, value in parameters.items() if name in used}
    model.swept = rng.choice(list(model.parameters))
    return model


def names_in(trees):
    for tree in trees:
        if isinstance(tree, Name):
            yield tree.text
        elif isinstance(tree, tuple):
            yield from names_in(tree)


def jumps_with_state(tree, states):
    if not isinstance(tree, tuple):
        return False
    jumps = tree[0] in ("<", ">", "<=", ">=") or (tree[0] == "call" and tree[1] in ("sign", "step", "floor"))
    if jumps and any(name in states for name in names_in(tree[1:])):
        return True
    return any(jumps_with_state(part, states) for part in tree)


# The same motion, written otherwise. Each function gives the model and, by the states' old names, new
# names and the factors of their numbers.

def renamed(model, rng):
    """Other names, other orders."""
    words = rng.sample(sorted(set(WORDS)), len(model.names()))
    new = dict(zip(model.names(), words))
    meanings = {old: Name(word) for old, word in new.items()}
    states = [(new[name], replace(start, meanings), replace(equation, meanings))
              for name, start, equation in model.states]
    parameters = [(new[name], value) for name, value in model.parameters.items()]
    rng.shuffle(states)
    rng.shuffle(parameters)
    out = dataclasses.replace(model, states=states, parameters=dict(parameters),
                              period=replace(model.period, meanings), swept=new[model.swept])
    return out, {name: (new[name], 1.0) for name, _, _ in model.states}


def rescaled(model, rng):
    """Other units of each state and of time. Powers of two, so that only ranges of exponents differ."""
    units = {name: 2.0 ** rng.choice((-30, -20, 20, 30)) for name, _, _ in model.states}
    time = 2.0 ** rng.choice((-20, 20))
    meanings = {name: ("*", 1 / unit, Name(name)) for name, unit in units.items()}
    states = [(name, ("*", units[name], start), ("*", units[name] / time, replace(equation, meanings)))
              for name, start, equation in model.states]
    out = dataclasses.replace(model, states=states, period=("*", time, model.period))
    return out, {name: (name, units[name]) for name in units}


def padded(model, rng):
    """A state that drives nothing, and a constant written out."""
    victim = rng.choice([name for name in model.parameters if name != model.swept] or [None])
    out = copy.deepcopy(model)
    if victim is not None:
        meanings = {victim: model.parameters[victim]}
        out.states = [(name, start, replace(equation, meanings)) for name, start, equation in out.states]
        out.period = replace(out.period, meanings)
        del out.parameters[victim]
    driver = rng.choice(model.states)[0]
    idle = ("idle", 0.3, ("-", call("sin", Name(driver)), ("*", 0.7, Name("idle"))))
    out.states.insert(rng.randrange(1, len(out.states) + 1), idle)
    return out, {name: (name, 1.0) for name, _, _ in model.states}


def turned(model, rng):
    """The phase of sines and cosines counted from whole turns earlier or later."""
    turns = ("*", rng.choice((-6, -2, 2, 4, 10)), Name("pi"))
    meanings = {"phase": ("+", Name("phase"), turns)}

    def turn(tree):
        if not isinstance(tree, tuple):
            return tree
        if tree[0] == "call" and tree[1] in ("sin", "cos"):
            return replace(tree, meanings)
        return tuple(turn(part) for part in tree)

    states = [(name, start, turn(equation)) for name, start, equation in model.states]
    return dataclasses.replace(model, states=states), {name: (name, 1.0) for name, _, _ in model.states}


REWRITINGS = {"renamed": renamed, "rescaled": rescaled, "padded": padded, "turned": turned}
