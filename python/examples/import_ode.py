"""A model of XPPAUT's, opened: its .ode file becomes a file of equations.

You learn how a model looks as text, and you get one for each .ode file that you have: equations,
parameters, functions, hidden and auxiliary quantities, arrays, sums, resets of states at events. What such
a file may have and a study has no place for (delays, noise, boundary conditions, integral operators) is
refused by name; nothing is left out in silence but what concerns pictures and the choice of a solver.

    import_ode.py lorenz.ode > lorenz.toml
    gearsweep model lorenz.toml
"""

# %%
import argparse
import json
import re
import sys
from pathlib import Path

# What expressions of both have under the same name, and what differs.
SAME = "sin cos tan asin acos atan atan2 sinh cosh tanh exp log sqrt abs sign max min".split()
OTHER = {"ln": "log", "heav": "step", "flr": "floor"}
WORDS = {*SAME, "floor", "step", "if", "pi", "phase", "clamp", "backlash", "stop", "table", "sum"}
WORDS |= {"and", "or", "not", "turn", "status", "deflection", "sqrt1pm1", "tau"}
# Lines that make a file more than ordinary differential equations.
REFUSED = {
    "wiener": "noise",
    "markov": "Markov variables",
    "table": "tables",
    "bndry": "boundary conditions",
    "special": "integral operators",
    "volterra": "Volterra integrals",
    "export": "functions in C",
    "solv": "algebraic equations",
    "mksol": "external modules",
}
CALLS = {"delay": "delays", "ran": "noise", "normal": "noise", "int": "integrals", "shift": "shifts of arrays"}
CALLS |= {"hom_bcs": "boundary conditions", "bessel": "Bessel functions", "erf": "erf"}
# i' of a sum; XPPAUT's names are shorter, so that none of a file is the same.
INDEX = "index_of_the_sum"
# The time in a sum: times numbers and one factor.
TIME = re.compile(
    r"(?<=[(+-])\s*(?:[\d.]+\s*\*\s*)*?(?:([\w.]+)\s*\*\s*t|t\s*\*\s*([\w.]+)|t)\b"
    r"(?:\s*[*/]\s*[\d.]+)*\s*(?=[)+-])"
)
# What an event of XPPAUT's may do beside its resets, and a surface cannot.
NO_RESETS = {"out_put": "a line of output", "no_interp": "an event at the end of its step"}


class Refused(Exception):
    """What a file has that a study has no place for."""


def logical_lines(text: str) -> list[str]:
    """Lines without comments, joined where one goes on, in lower case, blocks of arrays written out."""
    lines: list[str] = []
    for raw in re.sub(r"\\\s*\n", "", text).splitlines():
        line = raw.split("#")[0].strip().lower()
        if re.fullmatch(r"d(one)?", line):
            break
        if line and line[0] not in '"@%':
            lines.append(line)
        elif line.startswith("%"):
            raise Refused("blocks of arrays (%)")
    return [one for line in lines for one in unrolled(line)]


def unrolled(line: str) -> list[str]:
    """x[1..3]' = y[j-1] as x1' = y0 and so on; [j] alone is the number."""
    found = re.search(r"\[(\d+)\s*\.\.\s*(\d+)\]", line)
    if not found:
        return [line]
    out = []
    for number in range(int(found[1]), int(found[2]) + 1):
        one = line.replace(found[0], str(number))
        for before, told in ((r"(?<=[a-z_0-9])", "{}"), ("", "({})")):  # of a name; the number alone
            index = before + r"\[\s*j\s*(?:([+-])\s*(\d+)\s*)?\]"
            parts = re.split(index, one)
            one = parts[0]
            for sign, distance, rest in zip(parts[1::3], parts[2::3], parts[3::3], strict=True):
                one += told.format(number + int((sign or "+") + (distance or "0"))) + rest
        out.append(one)
    return out


def assignments(text: str) -> list[tuple[str, str]]:
    """The names and values of 'a=1, b=2 c'; a name alone has 0."""
    text = re.sub(r"\s*=\s*", "=", text)
    pairs = [word.partition("=") for word in re.split(r"[,\s]+", text) if word]
    return [(name, value or "0") for name, _, value in pairs]


def names_in(text: str) -> set[str]:
    return set(re.findall(r"\b[a-z_]\w*", text))


def call_at(text: str, begin: int) -> tuple[list[str], int]:
    """The arguments of the parenthesis that opens at `begin`, and where it ends."""
    arguments: list[str] = []
    depth, start = 0, begin + 1
    for i in range(begin, len(text)):
        if text[i] == "(":
            depth += 1
        elif text[i] == ")":
            depth -= 1
            if depth == 0:
                return [*arguments, text[start:i]], i + 1
        elif text[i] == "," and depth == 1:
            arguments.append(text[start:i])
            start = i + 1
    raise Refused(f"a parenthesis that does not close: {text}")


def call_around(text: str, place: int) -> str:
    """The function whose argument has this place in it, in no other parenthesis; '' where there is none."""
    depth = 0
    for i in range(place - 1, -1, -1):
        depth += {")": 1, "(": -1}.get(text[i], 0)
        if depth < 0:
            return re.sub(r".*?(\w*)\s*$", r"\1", text[:i])
    return ""


def translated(text: str) -> str:
    """An expression of XPPAUT's in the words of a study."""
    text = text.replace("**", "^").replace("!=", "<>")
    text = re.sub(r"&", " and ", re.sub(r"\|", " or ", text))
    found = re.search(r"\b(if|sum|mod|log10)\s*\(", text)
    if found:
        arguments, end = call_at(text, found.end() - 1)
        rest = text[end:]
        inner = [translated(one) for one in arguments]
        if found[1] == "mod":
            made = f"({inner[0]} - ({inner[1]})*floor(({inner[0]})/({inner[1]})))"
        elif found[1] == "log10":
            made = f"(log({inner[0]})/log(10))"
        else:
            made, rest = branches_or_sum(found[1], inner, rest)
        return translated_names(text[: found.start()]) + made + translated(rest)
    return translated_names(text)


def branches_or_sum(word: str, inner: list[str], rest: str) -> tuple[str, str]:
    """if(c)then(a)else(b) and sum(a,b)of(c), of which the first parenthesis has been read."""
    parts = []
    for name in ("then", "else") if word == "if" else ("of",):
        found = re.match(rf"\s*{name}\s*\(", rest)
        if not found:
            raise Refused(f"'{word}' without '{name}': {rest}")
        arguments, end = call_at(rest, found.end() - 1)
        parts.append(translated(",".join(arguments)))
        rest = rest[end:]
    if word == "if":
        return f"if({', '.join([*inner, *parts])})", rest
    term = re.sub(r"\bi'", INDEX, parts[0])
    return f"sum({INDEX}, {', '.join([*inner, term])})", rest


def translated_names(text: str) -> str:
    for name, what in CALLS.items():
        if re.search(rf"\b{name}\s*\(", text):
            raise Refused(what)
    if "<>" in text:
        raise Refused("the comparison !=")
    text = re.sub(r"(?<![\w.])(\d+\.)(?=[^\d]|$)", r"\g<1>0", text)  # 2. is 2.0
    text = re.sub(r"(?<![\w.])\.(\d)", r"0.\1", text)  # .5 is 0.5
    return re.sub(r"\b[a-z_]\w*", lambda match: OTHER.get(match[0], match[0]), text)


class Ode:
    """What a file says."""

    def __init__(self, text: str) -> None:
        self.states: dict[str, str] = {}
        self.starts: dict[str, str] = {}
        self.parameters: dict[str, str] = {}
        self.constants: dict[str, str] = {}
        self.functions: dict[str, str] = {}
        self.signals: dict[str, str] = {}
        self.events: list[tuple[str, dict[str, str]]] = []  # when, and what states become
        self.event_lines: list[str] = []
        self.warnings: list[str] = []
        for line in logical_lines(text):
            self.take(line)
        if not self.states:
            raise Refused("no differential equation")
        for head in [head for head in self.functions if head.endswith("(t)")]:
            self.settle_time(head)
        for line in self.event_lines:
            self.settle_event(line)

    def take(self, line: str) -> None:
        word = re.match(r"[a-z]+\s", line)
        first = word[0].strip() if word and "=" not in line[: word.end() + 1] else ""
        rest = line[len(first) :].strip()
        for name, what in REFUSED.items():
            if first and (name.startswith(first) if len(first) > 1 else first in "wmb" and name[0] == first):
                raise Refused(what)
        if first and "global".startswith(first):
            self.event_lines.append(line)
        elif re.match(r"0\s*=", line):
            raise Refused("algebraic equations")
        elif first and "parameters".startswith(first[:3]) and first[0] == "p":
            self.parameters |= dict(assignments(rest))
        elif first and "number".startswith(first):
            self.constants |= dict(assignments(rest))
        elif first and "init".startswith(first):
            self.starts |= dict(assignments(rest))
        elif first and "aux".startswith(first):
            name, _, value = rest.partition("=")
            self.signals[re.sub(r"\W", "_", name.strip())] = value
        elif first and any(word.startswith(first) for word in ("options", "set", "only")):
            return
        else:
            self.take_equation(line)

    def take_equation(self, line: str) -> None:
        left, equals, right = (part.strip() for part in line.partition("="))
        if not equals:
            raise Refused(f"a line of no known kind: {line}")
        if found := re.fullmatch(r"d(\w+)\s*/\s*dt|(\w+)\s*'", left):
            self.states[found[1] or found[2]] = right
        elif found := re.fullmatch(r"(\w+)\s*\(\s*0\s*\)", left):
            self.starts[found[1]] = right
        elif re.fullmatch(r"\w+\s*\(\s*t\s*\+\s*1\s*\)", left):
            raise Refused("maps")
        elif re.search(r"\bint\s*[\[{]", right):
            raise Refused("integral equations")
        elif found := re.fullmatch(r"(\w+)\s*\(([\w\s,]*)\)", left):
            arguments = ", ".join(part.strip() for part in found[2].split(","))
            self.functions[f"{found[1]}({arguments})"] = right
        elif re.fullmatch(r"!?\w+", left):
            self.constants[left.lstrip("!")] = right
        else:
            raise Refused(f"a line of no known kind: {line}")

    def settle_time(self, head: str) -> None:
        """f(t) = ... is a quantity, not a function, where it is only called as f(t)."""
        name, body = head[: -len("(t)")], self.functions.pop(head)
        tables = (self.states, self.constants, self.signals, self.functions)
        calls = re.compile(rf"\b{name}\s*\(")
        whole = re.compile(rf"\b{name}\s*\(\s*t\s*\)")
        texts = [text for table in tables for text in table.values()]
        if all(len(calls.findall(text)) == len(whole.findall(text)) for text in texts):
            for table in tables:
                table.update({key: whole.sub(name, text) for key, text in table.items()})
            self.constants[name] = body
        else:
            self.functions[f"{name}(t_)"] = re.sub(r"\bt\b", "t_", body)

    def settle_event(self, line: str) -> None:
        """global SIGN {condition} {name=value; ...} is a surface with a reset.

        The manual of XPPAUT (xppodes.html, "global"): with sign 1 it happens where the condition changes
        from negative to positive, with -1 from positive to negative, with 0 where it "vanishes
        identically": not on the way through 0, but where a step ends with 0 itself. Values are worked
        out one after the other (flags.c): in {x=y; y=x} both become y. Quantities of the file's own keep
        what they were before the event.
        """
        found = re.match(r"[a-z]+\s+([+-]?\d+)\s*(?:{([^{}]+)}|([^{}\s][^{}]*))\s*{([^{}]*)}", line)
        if not found or int(found[1]) not in (-1, 0, 1):
            raise Refused(f"an event of no known kind: {line}")
        if int(found[1]) == 0:
            raise Refused(f"an event of sign 0; write one of sign 1 and one of sign -1: {line}")
        condition = (found[2] or found[3]).strip()
        if not self.depended_on(names_in(condition)) & set(self.states):
            raise Refused(f"an event that waits for no state: {line}")
        resets: dict[str, str] = {}
        for part in filter(None, map(str.strip, found[4].split(";"))):
            name, _, value = (one.strip() for one in part.partition("="))
            if name in NO_RESETS:
                self.warnings.append(f"left out is {NO_RESETS[name]} ({name}): {line}")
            elif name == "arret":
                raise Refused(f"the end of a motion at an event: {line}")
            elif name not in self.states:
                what = "parameters" if name in self.parameters else f"'{name}', which is no state"
                raise Refused(f"resets of {what}: {line}")
            else:
                resets[name] = self.after(resets, value, line)
        if resets:
            self.events.append((condition if int(found[1]) == 1 else f"-({condition})", resets))

    def after(self, resets: dict[str, str], value: str, line: str) -> str:
        """A value in which the states that have been reset before stand as what they have become."""
        calls = [head for head in self.functions if head.partition("(")[0] in names_in(value)]
        if set(resets) & set().union(*map(self.read_by, calls)):
            raise Refused(f"a function of a state that has just been reset: {line}")
        return re.sub(
            r"\b[a-z_]\w*", lambda name: f"({resets[name[0]]})" if name[0] in resets else name[0], value
        )

    def read_by(self, head: str) -> set[str]:
        """What a function or a quantity depends on beside its arguments."""
        body = self.functions.get(head) or self.constants[head]
        return self.depended_on(names_in(body) - set(re.findall(r"\w+", head)[1:]))

    def depended_on(self, names: set[str]) -> set[str]:
        """These names, and what those of functions and quantities stand for."""
        heads = [head for head in (*self.functions, *self.constants) if head.partition("(")[0] in names]
        return names.union(*map(self.read_by, heads))


def forcing_of(ode: Ode) -> tuple[str, str]:
    """The period of the forcing, and by what factor the phase is the time; both '' without forcing."""
    texts = [*ode.states.values(), *ode.constants.values(), *ode.signals.values(), *ode.functions.values()]
    texts += [text for when, resets in ode.events for text in (when, *resets.values())]
    factors = set()
    for text in texts:
        for found in re.finditer(r"\bt\b", text):
            if call_around(text, found.start()) not in ("sin", "cos"):
                raise Refused(f"the time outside of a sine or cosine: {text}")
        terms = list(TIME.finditer(text))
        if len(terms) < len(re.findall(r"\bt\b", text)):
            raise Refused(f"the time in another product than 'w*t': {text}")
        factors |= {term[1] or term[2] or "1" for term in terms}
    if not factors:
        return "", ""
    if len(factors) > 1:
        raise Refused(f"the time in more than one product: {', '.join(sorted(factors))}")
    (factor,) = factors
    if not (factor in ode.parameters or re.fullmatch(r"[\d.]+", factor)):
        raise Refused(f"the time times {factor}, which is no parameter")
    return f"2*pi/{factor}", factor


def with_phase(text: str, factor: str) -> str:
    if not factor:
        return text
    text = re.sub(rf"\b{re.escape(factor)}\s*\*\s*t\b|\bt\s*\*\s*{re.escape(factor)}\b", "phase", text)
    return re.sub(r"\bt\b", "phase", text)


def model_text(ode: Ode, name: str) -> str:
    """The file of equations."""
    period, factor = forcing_of(ode)
    own = {*ode.states, *ode.parameters, *ode.constants, *ode.signals}
    own |= {head.partition("(")[0] for head in ode.functions}
    new = {old: old + "_" for old in own if old in WORDS}

    def written(text: str) -> str:
        told = re.sub(r"[a-z_]\w*", lambda match: named(match[0]), translated(text))
        return json.dumps(re.sub(r"\s+", " ", with_phase(told, named(factor))).strip())

    def named(old: str) -> str:
        return new.get(old, old)

    plain = re.sub(r"\W", "_", name)
    lines = ["[model]", f"name = {json.dumps(plain if plain[0].isalpha() else 'm' + plain)}", "[states]"]
    for state in ode.states:
        lines.append(f"{named(state)} = {{ start = {written(ode.starts.get(state, '0'))} }}")
    lines.append("[parameters]")
    lines += [f"{named(key)} = {float(value)!r}" for key, value in ode.parameters.items()]
    if not ode.parameters:  # a model must have one; this name is longer than any of XPPAUT's
        lines.append('no_parameters = { value = 0.0, meaning = "the .ode file has none" }')
    for table, entries in (("constants", ode.constants), ("functions", ode.functions)):
        if entries:
            lines.append(f"[{table}]")
        for key, value in entries.items():
            head = key.partition("(")
            told = named(head[0]) + head[1] + head[2]
            lines.append(f"{json.dumps(told) if head[1] else told} = {written(value)}")
    lines.append("[equations]")
    lines += [f"{named(key)} = {written(value)}" for key, value in ode.states.items()]
    if factor:
        lines += ["[forcing]", f"period = {written(period)}"]
    for number, (when, resets) in enumerate(ode.events, 1):
        values = ", ".join(f"{named(key)} = {written(value)}" for key, value in resets.items())
        lines += [f"[surfaces.event_{number}]", f"when = {written(when)}", f"reset = {{ {values} }}"]
    taken = {*ode.states, *ode.parameters, *ode.constants}
    signals = {key + "_aux" if key in taken else key: value for key, value in ode.signals.items()}
    if signals:
        lines.append("[signals]")
    lines += [f"{named(key)} = {written(value)}" for key, value in signals.items()]
    return "\n".join(lines) + "\n"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", type=Path, help="the .ode file")
    arguments = parser.parse_args()
    try:
        ode = Ode(arguments.file.read_text(errors="replace"))
        text = model_text(ode, arguments.file.stem)
    except Refused as what:
        print(f"{arguments.file}: there is no place for {what}", file=sys.stderr)
        return 2
    for warning in ode.warnings:
        print(f"{arguments.file}: warning: {warning}", file=sys.stderr)
    print(text, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
