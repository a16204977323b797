"""Motions of a model's text by a program of its own: the text is read with Python's parser, written as C,
and integrated with steps that end where anything switches.

Nothing of gearsweep takes part. Whatever has two branches (a condition, a sign, a whole part, the larger of
two numbers) is a switch. Within a step all switches stay as they are, so the field is smooth there; where one
of them would change, the step ends at that moment, found by bisection. The phase needs no special case.
"""

import ast
import ctypes
import pathlib
import re
import subprocess
import tomllib

import numpy
import scipy.interpolate

WORDS_OF_TEXT = {"and", "or", "not", "pi", "phase"}
# What is the same in C.
PLAIN = {"sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "exp", "log", "sqrt"}


class _Writer:
    """One expression after the other as C: `value` with the switches as they stand in m[], and the lines
    that find how they would stand now."""

    def __init__(self, tables):
        self.switches = []  # C expressions of whole numbers
        self.tables = tables  # file -> (points, values)
        self.splines = []

    def switch(self, now):
        self.switches.append(now)
        return f"m[{len(self.switches) - 1}]"

    def larger(self, a, b):
        return f"({self.switch(f'({a}) < ({b})')} ? ({b}) : ({a}))"

    def smaller(self, a, b):
        return f"({self.switch(f'({b}) < ({a})')} ? ({b}) : ({a}))"

    def table(self, file, phase, kind):
        angles, values = self.tables[file]
        if kind == "cubic":
            spline = scipy.interpolate.CubicSpline(angles, values, bc_type="periodic")
        else:
            slopes = numpy.diff(values) / numpy.diff(angles)
            spline = scipy.interpolate.PPoly(numpy.array([slopes, values[:-1]]), angles)
        self.splines.append(spline)
        number = len(self.splines) - 1
        turned = f"turned({phase})"
        return f"piece_{number}({turned}, {self.switch(f'find_{number}({turned})')})"

    def write(self, node):
        if isinstance(node, ast.Constant):
            return repr(float(node.value))
        if isinstance(node, ast.Name):
            return {"pi": "M_PI"}.get(node.id, node.id)
        if isinstance(node, ast.UnaryOp):
            sign = {ast.USub: "-", ast.UAdd: "+", ast.Not: "!"}[type(node.op)]
            return f"({sign}({self.write(node.operand)}))"
        if isinstance(node, ast.BinOp):
            a, b = self.write(node.left), self.write(node.right)
            if isinstance(node.op, ast.Pow):
                return f"pow({a}, {b})"
            sign = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}[type(node.op)]
            return f"(({a}) {sign} ({b}))"
        if isinstance(node, ast.BoolOp):
            sign = {ast.And: " && ", ast.Or: " || "}[type(node.op)]
            return "(" + sign.join(self.write(value) for value in node.values) + ")"
        if isinstance(node, ast.Compare):
            sign = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">="}[type(node.ops[0])]
            a, b = self.write(node.left), self.write(node.comparators[0])
            return f"({self.switch(f'({a}) {sign} ({b})')} != 0)"
        assert isinstance(node, ast.Call), ast.dump(node)
        return self.called(node.func.id, node.args)

    def called(self, name, arguments):
        if name == "table":
            kind = arguments[2].id if len(arguments) > 2 else "linear"
            return self.table(arguments[0].value, self.write(arguments[1]), kind)
        parts = [self.write(argument) for argument in arguments]
        if name in PLAIN:
            return f"{name}({', '.join(parts)})"
        a = parts[0]
        if name == "abs":
            return f"({self.switch(f'({a}) < 0')} ? -({a}) : ({a}))"
        if name == "sign":
            return f"((double){self.switch(f'(({a}) > 0) - (({a}) < 0)')})"
        if name == "floor":
            return f"((double){self.switch(f'(int)floor({a})')})"
        if name == "step":
            return f"({self.switch(f'({a}) < 0')} ? 0.0 : 1.0)"
        if name == "max":
            return self.larger(a, parts[1])
        if name == "min":
            return self.smaller(a, parts[1])
        if name == "clamp":
            return self.smaller(self.larger(a, parts[1]), parts[2])
        if name == "stop":
            return self.larger(f"({a}) - ({parts[1]})", "0.0")
        if name == "backlash":
            return (f"({self.larger(f'({a}) - ({parts[1]})', '0.0')} + "
                    f"{self.smaller(f'({a}) + ({parts[1]})', '0.0')})")
        assert name == "if_", name
        return f"({a} ? ({parts[1]}) : ({parts[2]}))"


def _as_python(text):
    """The text with names that no language knows, and what Python writes otherwise."""
    def word(match):
        name = match.group(0)
        if match.group(1) or name in WORDS_OF_TEXT:
            return name
        if text[match.end():].lstrip().startswith("("):
            return "if_" if name == "if" else name
        return name if name in ("linear", "cubic") else "n_" + name
    plain = re.compile(r"('[^']*'|\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?)|[A-Za-z_]\w*")
    return plain.sub(word, text).replace("^", "**")


SOURCE = """
#include <math.h>
#include <stdlib.h>
#include <string.h>
#define STATES {states}
#define SWITCHES {switches}
{names}
static double turned(double phase) {{ return phase - 2*M_PI*floor(phase/(2*M_PI)); }}
{splines}
static void field(double phase, const double* x, const double* p, const int* m, double* dx) {{
  (void)phase; (void)x; (void)p; (void)m;
  {constants}
  {equations}
}}
// How the switches would stand now.
static void look(double phase, const double* x, const double* p, int* out) {{
  (void)phase; (void)x; (void)p;
  int m[SWITCHES + 1] = {{0}};
  {looks}
  memcpy(out, m, sizeof(int)*SWITCHES);
}}
double period(const double* p) {{ (void)p; return {period}; }}
void start(const double* p, double* x) {{ (void)p; {starts} }}

static const double A[7][6] = {{{{0}}, {{1./5}}, {{3./40, 9./40}}, {{44./45, -56./15, 32./9}},
  {{19372./6561, -25360./2187, 64448./6561, -212./729}},
  {{9017./3168, -355./33, 46732./5247, 49./176, -5103./18656}},
  {{35./384, 0, 500./1113, 125./192, -2187./6784, 11./84}}}};
static const double C[7] = {{0, 1./5, 3./10, 4./5, 8./9, 1, 1}};
static const double E[7] = {{71./57600, 0, -71./16695, 71./1920, -17253./339200, 22./525, -1./40}};

// A step of Dormand and Prince; gives the error over the tolerance.
static double try_step(double t, double h, double w, const double* x, const double* p, const int* m,
                       double* y, double* k0, double* k6) {{
  double k[7][STATES];
  for (int s = 0; s < 7; ++s) {{
    for (int i = 0; i < STATES; ++i) {{
      double sum = 0;
      for (int j = 0; j < s; ++j) sum += A[s][j]*k[j][i];
      y[i] = x[i] + h*sum;
    }}
    field(w*(t + C[s]*h), y, p, m, k[s]);
  }}
  double worst = 0;
  for (int i = 0; i < STATES; ++i) {{
    double e = 0;
    for (int s = 0; s < 7; ++s) e += E[s]*k[s][i];
    worst = fmax(worst, fabs(h*e)/(1e-12 + 1e-11*fmax(fabs(x[i]), fabs(y[i]))));
    k0[i] = k[0][i];
    k6[i] = k[6][i];
  }}
  return worst;
}}

static void middle(double h, const double* x, const double* y, const double* k0, const double* k1,
                   double* out) {{
  for (int i = 0; i < STATES; ++i) out[i] = 0.5*(x[i] + y[i]) + h*(k0[i] - k1[i])/8;
}}

// Largest and smallest of a cubic in a step.
static void extremes(double a, double b, double da, double db, double* min, double* max) {{
  *min = fmin(*min, fmin(a, b));
  *max = fmax(*max, fmax(a, b));
  const double c2 = 3*(b - a) - 2*da - db, c3 = 2*(a - b) + da + db;
  const double under = c2*c2 - 3*c3*da;
  if (under < 0) return;
  const double q = -(c2 + (c2 < 0 ? -sqrt(under) : sqrt(under)));
  const double roots[2] = {{c3 == 0 ? -1 : q/(3*c3), q == 0 ? -1 : da/q}};
  for (int i = 0; i < 2; ++i) {{
    const double s = roots[i];
    if (!(s > 0 && s < 1)) continue;
    const double value = a + s*(da + s*(c2 + s*c3));
    *min = fmin(*min, value);
    *max = fmax(*max, value);
  }}
}}

// Sections of all periods, and of the last `record` ones min, max, mean, mean square of each state.
// Gives 0, or 1 where it went out of bounds, 2 where switches change without end.
int run(const double* p, double* x, int settle, int record, double* sections, double* out) {{
  const double whole = period(p), w = 2*M_PI/whole;
  for (int i = 0; i < STATES; ++i) {{
    out[i] = INFINITY; out[STATES + i] = -INFINITY; out[2*STATES + i] = out[3*STATES + i] = 0;
  }}
  double h = whole/1000;
  for (int n = 0; n < settle + record; ++n) {{
    double t = 0;
    int m[SWITCHES + 1], now[SWITCHES + 1];
    look(0, x, p, m);
    long changes = 0, steps = 0;
    while (t < whole) {{
      double y[STATES], mid[STATES], k0[STATES], k6[STATES];
      h = fmin(h, whole/256);
      double taken = fmin(h, whole - t);
      if (whole - t - taken < 1e-13*whole) taken = whole - t;
      double error = try_step(t, taken, w, x, p, m, y, k0, k6);
      if (++steps > 400000) return 2;
      if (!(error <= 1) && taken > 1e-13*whole) {{
        if (!(error < 1e300)) error = 1e10;
        h = taken*fmax(0.1, 0.9*pow(error, -0.2));
        continue;
      }}
      const double next = taken*fmin(5, 0.9*pow(fmax(error, 1e-10), -0.2));
      const int is_last = t + taken >= whole;
      middle(taken, x, y, k0, k6, mid);
      look(w*(t + 0.5*taken), mid, p, now);
      int changed = memcmp(now, m, sizeof(int)*SWITCHES) != 0;
      if (!changed) {{
        look(is_last ? 2*M_PI*(1 - 1e-15) : w*(t + taken), y, p, now);
        changed = memcmp(now, m, sizeof(int)*SWITCHES) != 0;
      }}
      if (changed) {{
        double low = 0, high = taken;
        while (high - low > 1e-15*whole) {{
          const double half = 0.5*(low + high);
          if (half <= low || half >= high) break;
          try_step(t, half, w, x, p, m, y, k0, k6);
          look(w*(t + half), y, p, now);
          if (memcmp(now, m, sizeof(int)*SWITCHES) != 0) high = half; else low = half;
        }}
        taken = high;
        try_step(t, taken, w, x, p, m, y, k0, k6);
        look(w*(t + taken), y, p, now);
        memcpy(m, now, sizeof(int)*SWITCHES);
        if (++changes > 2000) return 2;
        middle(taken, x, y, k0, k6, mid);
      }} else {{
        h = next;
      }}
      for (int i = 0; i < STATES; ++i) {{
        if (!(fabs(y[i]) < 1e6)) return 1;
        if (n >= settle) {{
          extremes(x[i], y[i], taken*k0[i], taken*k6[i], &out[i], &out[STATES + i]);
          out[2*STATES + i] += taken*(x[i] + 4*mid[i] + y[i])/6;
          out[3*STATES + i] += taken*(x[i]*x[i] + 4*mid[i]*mid[i] + y[i]*y[i])/6;
        }}
      }}
      memcpy(x, y, sizeof(double)*STATES);
      t = is_last && !changed ? whole : t + taken;
    }}
    memcpy(sections + (long)n*STATES, x, sizeof(double)*STATES);
  }}
  for (int i = 2*STATES; i < 4*STATES; ++i) out[i] /= record*whole;
  return 0;
}}
"""


class Motion:
    """What a run found: sections [period][state], and of the record min, max, mean, rms [state]."""

    def __init__(self, failure, sections, looked_at):
        self.failure = ("", "out of bounds", "switches without end")[failure]
        self.sections = sections
        self.min, self.max, self.mean, square = looked_at
        self.rms = numpy.sqrt(square)


class Reference:
    def __init__(self, text, tables, folder):
        """text: of a model; tables: file -> rows (degree, value)."""
        parsed = tomllib.loads(text)
        self.states = list(parsed["states"])
        self.parameters = dict(parsed["parameters"])
        angles = {file: (numpy.radians([row[0] for row in rows]), numpy.array([row[1] for row in rows]))
                  for file, rows in tables.items()}
        writer = _Writer(angles)

        def written(expression):
            return writer.write(ast.parse(_as_python(expression), mode="eval").body)

        # What a switch is made of comes before it, so each is looked at when all within it are known.
        constants, looks = "", ""

        def look_from(first):
            return "".join(f"m[{first + i}] = {now};\n" for i, now in enumerate(writer.switches[first:]))

        for name, expression in parsed.get("constants", {}).items():
            known = len(writer.switches)
            line = f"const double n_{name} = {written(expression)};\n"
            constants += line
            looks += look_from(known) + line
        known = len(writer.switches)
        equations = "".join(f"dx[{i}] = {written(parsed['equations'][name])};\n"
                            for i, name in enumerate(self.states))
        looks += look_from(known)
        names = "".join(f"#define n_{name} x[{i}]\n" for i, name in enumerate(self.states))
        names += "".join(f"#define n_{name} p[{i}]\n" for i, name in enumerate(self.parameters))
        source = SOURCE.format(
            states=len(self.states), switches=len(writer.switches), names=names,
            splines="".join(self._spline(i, spline) for i, spline in enumerate(writer.splines)),
            constants=constants, equations=equations, looks=looks,
            period=written(parsed["forcing"]["period"]),
            starts="".join(f"x[{i}] = {written(parsed['states'][name].get('start', '0'))};"
                           for i, name in enumerate(self.states)))
        path = pathlib.Path(folder)
        (path / "motion.c").write_text(source)
        subprocess.run(["cc", "-O1", "-shared", "-fPIC", "-w", "-o", path / "motion.so", path / "motion.c",
                        "-lm"], check=True)
        self._library = ctypes.CDLL(str(path / "motion.so"))
        self._library.period.restype = ctypes.c_double

    @staticmethod
    def _spline(number, spline):
        """A function that finds the piece that an angle lies in, and one that gives the piece's value."""
        pieces = len(spline.x) - 1
        knots = ", ".join(repr(float(x)) for x in spline.x)
        rows = ",\n".join("{" + ", ".join(repr(float(c)) for c in spline.c[:, i]) + "}"
                          for i in range(pieces))
        powers = len(spline.c)
        return (f"static const double knots_{number}[] = {{{knots}}};\n"
                f"static const double pieces_{number}[][{powers}] = {{{rows}}};\n"
                f"static int find_{number}(double a) {{ int i = 0; while (i < {pieces - 1} && "
                f"a >= knots_{number}[i + 1]) ++i; return i; }}\n"
                f"static double piece_{number}(double a, int i) {{ double s = 0; for (int j = 0; j < "
                f"{powers}; ++j) s = s*(a - knots_{number}[i]) + pieces_{number}[i][j]; return s; }}\n")

    def run(self, setting, settle, record, moved=0.0):
        """setting: parameter -> value, of those that differ from the text's; moved: added to each state
        of the start."""
        values = numpy.array([setting.get(name, value) for name, value in self.parameters.items()])
        pointer = ctypes.POINTER(ctypes.c_double)
        state = numpy.zeros(len(self.states))
        self._library.start(values.ctypes.data_as(pointer), state.ctypes.data_as(pointer))
        state += moved
        sections = numpy.zeros((settle + record, len(self.states)))
        looked_at = numpy.zeros((4, len(self.states)))
        failure = self._library.run(
            values.ctypes.data_as(pointer), state.ctypes.data_as(pointer), settle, record,
            sections.ctypes.data_as(pointer), looked_at.ctypes.data_as(pointer))
        return Motion(failure, sections, looked_at)
