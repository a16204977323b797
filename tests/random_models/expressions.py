"""Expressions as trees: written as the text of a model, and random ones that keep a motion bounded.

A number is a float, a name is a Name, everything else is a tuple whose first entry says what it is:
("+", a, b), ("neg", a), ("call", "sin", (a,)), ("if", condition, yes, no); conditions are ("<", a, b),
("and", c, d), ("or", c, d), ("not", c).
"""

import dataclasses
import random


@dataclasses.dataclass(frozen=True)
class Name:
    text: str


PHASE = Name("phase")
BINARY = {"+", "-", "*", "/", "^", "<", ">", "<=", ">=", "and", "or"}


def write(tree):
    """The text of a tree, with every operation in parentheses."""
    if isinstance(tree, Name):
        return tree.text
    if isinstance(tree, (int, float)):
        return f"({tree!r})" if tree < 0 else repr(tree)
    kind = tree[0]
    if kind == "call":
        return f"{tree[1]}({', '.join(write(part) for part in tree[2])})"
    if kind == "table":
        return f"table('{tree[1]}', {write(tree[2])}, {tree[3]})"
    if kind == "if":
        return f"if({', '.join(write(part) for part in tree[1:])})"
    if kind == "neg":
        return f"(-{write(tree[1])})"
    if kind == "not":
        return f"(not {write(tree[1])})"
    assert kind in BINARY, tree
    return f"({write(tree[1])} {kind} {write(tree[2])})"


def replace(tree, meanings):
    """The tree with other trees in the place of some names."""
    if isinstance(tree, Name):
        return meanings.get(tree.text, tree)
    if not isinstance(tree, tuple):
        return tree
    return tuple(replace(part, meanings) if isinstance(part, (tuple, Name)) else part for part in tree)


def call(name, *arguments):
    return ("call", name, arguments)


def sum_of(terms):
    total = terms[0]
    for term in terms[1:]:
        total = ("+", total, term)
    return total


class Maker:
    """Random parts of right-hand sides. All draws come from one generator, so a seed is a model."""

    def __init__(self, rng: random.Random, parameter, tables):
        self.rng = rng
        self.parameter = parameter  # (smallest, largest) -> a name or a number
        self.tables = tables  # () -> the file of a new table

    def number(self, low, high):
        return round(self.rng.uniform(low, high), 3)

    def turns(self):
        """A number of whole turns of the phase, moved by some angle."""
        many = self.rng.choice((1, 1, 1, 2, 3))
        angle = PHASE if many == 1 else ("*", many, PHASE)
        return angle if self.rng.random() < 0.5 else ("+", angle, self.number(0.1, 6.0))

    def wave(self):
        """Smooth in the phase, between -1 and 1."""
        return call(self.rng.choice(("sin", "cos")), self.turns())

    def share(self):
        """A place in the period, in radians: from a number or from a parameter."""
        place = self.parameter(0.1, 0.9) if self.rng.random() < 0.5 else self.number(0.1, 0.9)
        return ("*", ("*", 2, Name("pi")), place)

    def phase_condition(self, depth=0):
        kind = self.rng.randrange(6 if depth < 2 else 3)
        level = self.number(-0.7, 0.7)
        if kind == 0:
            return ("<", PHASE, self.share())
        if kind == 1:
            return (self.rng.choice(("<", ">", "<=", ">=")), self.wave(), level)
        if kind == 2:
            return ("<", ("+", self.wave(), ("*", 0.5, self.wave())), level)
        if kind == 3:
            return ("not", self.phase_condition(depth + 1))
        return (self.rng.choice(("and", "or")), self.phase_condition(depth + 1),
                self.phase_condition(depth + 1))

    def phase_jump(self, depth=0):
        """Of size 1 or so; jumps in the phase."""
        kind = self.rng.randrange(6)
        if kind == 0:
            return call("sign", ("+", self.wave(), self.number(-0.6, 0.6)))
        if kind == 1:
            return call("step", ("-", self.wave(), self.number(-0.6, 0.6)))
        if kind == 2:
            pieces = self.rng.choice((2, 3, 4))
            moved = ("+", ("/", ("*", pieces, PHASE), ("*", 2, Name("pi"))), self.number(0.1, 0.9))
            return ("*", round(1 / pieces, 3), call("floor", moved))
        if kind == 3 and depth < 2:
            return ("if", self.phase_condition(), self.phase_jump(depth + 1), self.wave())
        if kind == 4:
            return ("*", self.wave(), call("sign", self.wave()))
        return ("if", self.phase_condition(), self.number(0.2, 1.2), self.number(-1.2, 0.1))

    def phase_corner(self):
        kind = self.rng.randrange(4)
        if kind == 0:
            return call("abs", ("+", self.wave(), self.number(-0.5, 0.5)))
        if kind == 1:
            return call("max", self.wave(), self.number(-0.5, 0.5))
        if kind == 2:
            return call("clamp", self.wave(), self.number(-0.8, -0.2), self.number(0.2, 0.8))
        return ("if", (">", self.wave(), 0), self.wave(), self.wave())

    def drive(self, kinds):
        """A function of the phase of size 1 or so."""
        kind = self.rng.choice(kinds)
        if kind == "jump":
            return self.phase_jump()
        if kind == "corner":
            return self.phase_corner()
        if kind == "table":
            moved = PHASE if self.rng.random() < 0.5 else ("+", PHASE, self.number(0.1, 3.0))
            return ("table", self.tables(), moved, self.rng.choice(("linear", "cubic")))
        return self.wave()

    def bounded(self, state, kinds):
        """A bounded function of a state."""
        kind = self.rng.choice(kinds)
        level = self.number(-0.5, 0.5)
        if kind == "corner":
            return self.rng.choice((
                call("clamp", state, self.number(-1.0, -0.2), self.number(0.2, 1.0)),
                call("min", call("abs", ("-", state, level)), 1.5),
                call("max", call("min", state, 1.2), level),
                call("min", call("stop", state, level), 2.0),
            ))
        if kind == "jump":
            return self.rng.choice((
                call("sign", ("-", state, level)),
                call("step", ("-", state, level)),
                ("if", (">", state, level), self.number(0.3, 1.0), self.number(-1.0, 0.0)),
            ))
        return self.rng.choice((
            call("sin", state), call("cos", state), call("tanh", ("*", self.number(0.5, 2.0), state)),
            ("/", state, ("+", 1, ("^", state, 2))), call("exp", ("neg", ("^", state, 2))),
        ))

    def restoring(self, state, kinds):
        """A force that holds a displacement."""
        kind = self.rng.choice(kinds)
        if kind == "contact":
            return self.rng.choice((
                ("*", self.number(1.0, 3.0), call("backlash", state, self.number(0.1, 0.6))),
                ("+", state, ("*", self.number(1.0, 8.0), call("stop", state, self.number(0.0, 0.8)))),
                ("+", ("*", 0.5, state), ("*", 3.0, call("max", ("-", state, self.number(0.0, 0.5)), 0))),
                ("+", state, ("*", self.number(0.2, 0.8), call("abs", state))),
            ))
        return self.rng.choice((
            state, ("+", ("*", -1, state), ("^", state, 3)), ("+", state, ("*", 0.5, ("^", state, 3))),
            call("sinh", state), ("*", 1.5, state),
        ))
