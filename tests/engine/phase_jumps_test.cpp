// Jumps and corners of the phase, which no model's file lists: against exact motions.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

constexpr double kFullTurn = 2.0 * std::numbers::pi;
constexpr double kPi = std::numbers::pi;

double step(double x) { return x < 0.0 ? 0.0 : 1.0; }
double sign(double x) { return x < 0.0 ? -1.0 : 0.0 < x ? 1.0 : 0.0; }

// x' = -x + g(phase), at one radian of the phase in a unit of time.
struct Form {
  std::string text;
  std::function<double(double phase, double c)> value;
  std::function<std::vector<double>(double c)> breaks;
};

std::vector<Form> forms() {
  const auto fixed = [](std::vector<double> phases) { return [=](double) { return phases; }; };
  const auto s = [](double phase) { return std::sin(phase); };
  return {
      {"sign(sin(phase))", [=](double p, double) { return sign(s(p)); }, fixed({kPi})},
      {"step(cos(phase))", [=](double p, double) { return step(std::cos(p)); },
       fixed({kPi / 2, 3 * kPi / 2})},
      {"if(phase < 2*pi*(c - 1), 1.3, 0.8)",
       [](double p, double c) { return p < kFullTurn * (c - 1.0) ? 1.3 : 0.8; },
       [](double c) { return std::vector<double>{kFullTurn * (c - 1.0)}; }},
      {"if(sin(phase) > 0, sin(phase), 0)", [=](double p, double) { return std::max(s(p), 0.0); },
       fixed({kPi})},
      {"if(phase >= 1 and phase < 4, 1, -1)",
       [](double p, double) { return p >= 1.0 && p < 4.0 ? 1.0 : -1.0; }, fixed({1, 4})},
      {"if(phase < 1 or not phase <= 4, 1, -1)",
       [](double p, double) { return p < 1.0 || p > 4.0 ? 1.0 : -1.0; }, fixed({1, 4})},
      {"if(phase < 3, if(phase < c, 1, -2), if(cos(phase) > 0, 5, phase))",
       [](double p, double c) {
         if (p < 3.0) return p < c ? 1.0 : -2.0;
         return std::cos(p) > 0.0 ? 5.0 : p;
       },
       [](double c) {
         return std::vector<double>{c, 3.0, 3 * kPi / 2};
       }},
      {"floor(3*phase/(2*pi) + c)",
       [](double p, double c) { return std::floor(3 * p / kFullTurn + c); },
       [](double c) {
         std::vector<double> phases;
         for (double n = std::ceil(c); n < c + 3.0; ++n)
           phases.push_back((n - c) * kFullTurn / 3.0);
         return phases;
       }},
      {"phase/(2*pi) - floor(phase/(2*pi) + 0.3)",
       [](double p, double) { return p / kFullTurn - std::floor(p / kFullTurn + 0.3); },
       fixed({0.7 * kFullTurn})},
      {"abs(sin(phase))", [=](double p, double) { return std::fabs(s(p)); }, fixed({kPi})},
      {"max(cos(phase), 0.2)", [](double p, double) { return std::max(std::cos(p), 0.2); },
       [](double) {
         return std::vector<double>{std::acos(0.2), kFullTurn - std::acos(0.2)};
       }},
      {"sign(sin(phase) - 0.5)*step(cos(2*phase))",
       [=](double p, double) { return sign(s(p) - 0.5) * step(std::cos(2 * p)); },
       fixed({kPi / 6, kPi / 4, 3 * kPi / 4, 5 * kPi / 6, 5 * kPi / 4, 7 * kPi / 4})},
      {"c*sign(cos(phase + c))*sin(2*phase)",
       [](double p, double c) { return c * sign(std::cos(p + c)) * std::sin(2 * p); },
       [](double c) {
         return std::vector<double>{kPi / 2 - c, 3 * kPi / 2 - c, 5 * kPi / 2 - c};
       }},
      {"if(floor(phase) == 2, 3, 1)",
       [](double p, double) { return std::floor(p) == 2.0 ? 3.0 : 1.0; }, fixed({2, 3})},
      {"atan(tan(phase))", [](double p, double) { return std::atan(std::tan(p)); },
       fixed({kPi / 2, 3 * kPi / 2})},
      {"table('jump', phase + c)",
       [](double p, double c) {
         const double at = std::fmod(p + c, kFullTurn);
         return at < 1.0 ? 2.0 - at : at < 4.0 ? 3.0 : 2.0;
       },
       [](double c) {
         std::vector<double> phases;
         for (const double knot : {0.0, 1.0, 4.0, 5.0}) {
           phases.push_back(std::fmod(knot - c + 2.0 * kFullTurn, kFullTurn));
         }
         return phases;
       }},
      {"table('line', phase + c)",
       [](double p, double c) {
         const double at = std::fmod(p + c, kFullTurn);
         return at < 1.0   ? at
                : at < 1.2 ? 1.0 - 10.0 * (at - 1.0)
                           : -1.0 + (at - 1.2) / (kFullTurn - 1.2);
       },
       [](double c) {
         std::vector<double> phases;
         for (const double knot : {0.0, 1.0, 1.2}) {
           phases.push_back(std::fmod(knot - c + 2.0 * kFullTurn, kFullTurn));
         }
         return phases;
       }},
  };
}

struct Exact {
  double mean = 0.0, rms = 0.0;
};

// The periodic motion, by Gauss' rule of eight points on pieces between the breaks.
Exact exact(const Form& form, double c) {
  constexpr std::array<double, 4> kNodes = {0.1834346424956498, 0.5255324099163290,
                                            0.7966664774136267, 0.9602898564975363};
  constexpr std::array<double, 4> kWeights = {0.3626837833783620, 0.3137066458778873,
                                              0.2223810344533745, 0.1012285362903763};
  std::vector<double> bounds = {0.0, kFullTurn};
  for (const double phase : form.breaks(c)) {
    if (phase > 0.0 && phase < kFullTurn) bounds.push_back(phase);
  }
  std::ranges::sort(bounds);
  // The integral of e^(s - to) g(s) from `from` to `to`.
  const auto driven = [&](double from, double to) {
    double sum = 0.0;
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
      for (const double side : {-1.0, 1.0}) {
        const double at = 0.5 * (from + to) + 0.5 * (to - from) * side * kNodes[i];
        sum += 0.5 * (to - from) * kWeights[i] * std::exp(at - to) * form.value(at, c);
      }
    }
    return sum;
  };
  constexpr int kPieces = 400;
  const auto along = [&](double x, const std::function<void(double, double)>& see) {
    for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
      const double piece = (bounds[i + 1] - bounds[i]) / kPieces;
      for (int j = 0; j < kPieces; ++j) {
        const double from = bounds[i] + j * piece, to = from + piece;
        const double middle = x * std::exp(-0.5 * piece) + driven(from, from + 0.5 * piece);
        const double end = x * std::exp(-piece) + driven(from, to);
        see(piece * (x + 4.0 * middle + end) / 6.0,
            piece * (x * x + 4.0 * middle * middle + end * end) / 6.0);
        x = end;
      }
    }
    return x;
  };
  const double gained = along(0.0, [](double, double) {});
  Exact out;
  along(gained / (1.0 - std::exp(-kFullTurn)), [&](double one, double square) {
    out.mean += one / kFullTurn;
    out.rms += square / kFullTurn;
  });
  out.rms = std::sqrt(out.rms);
  return out;
}

// All in one model, a state each, so that the device compiles once.
std::string study_of_forms() {
  std::string states, equations, quantities;
  const std::vector<Form> all = forms();
  for (std::size_t i = 0; i < all.size(); ++i) {
    states += fmt::format("x{} = {{ unit = '1' }}\n", i);
    equations += fmt::format("x{} = \"-x{} + {}\"\n", i, i, all[i].text);
    quantities += fmt::format("'x{}_mean', 'x{}_rms', ", i, i);
  }
  return "[model]\ntext = '''\n[model]\nname = 'forms'\n[states]\n" + states +
         "[parameters]\nc = 1.6\n[equations]\n" + equations +
         "[forcing]\nperiod = '2*pi'\n'''\n"
         "[model.tables]\njump = \"0 2\\n1 1\\n1 3\\n4 3\\n4 2\\n5 2\\n\"\n"
         "line = \"0 0\\n1 1\\n1.2 -1\\n\"\n"
         "[[axes]]\nname = 'c'\nvalues = [1.2, 1.6]\n"
         "[integrate]\nmax_step = 0.05\nsettle = 8\nrecord = 1\nstop = 'never'\n"
         "[observe]\nquantities = [" +
         quantities + "]\n";
}

TEST(PhaseJumps, AreFoundInEveryForm) {
  const std::vector<Form> all = forms();
  for (const std::string engine : {"opencl", "reference"}) {
    const SweepResult result = run(study_of_forms(), {"integrate.engine=\"" + engine + "\""});
    const std::vector<double> values = {1.2, 1.6};
    for (std::size_t point = 0; point < values.size(); ++point) {
      for (std::size_t i = 0; i < all.size(); ++i) {
        const Exact right = exact(all[i], values[point]);
        EXPECT_NEAR(result.values[2 * i][point], right.mean, 1e-6)
            << engine << " " << all[i].text << " at " << values[point];
        EXPECT_NEAR(result.values[2 * i + 1][point], right.rms, 1e-6)
            << engine << " " << all[i].text << " at " << values[point];
      }
    }
  }
}

// A stiffness that jumps where a pair of teeth leaves, at a phase that a parameter moves. The
// numbers are those of DOP853 with the jumps and the contact's limits located (SciPy).
TEST(PhaseJumps, MoveWithAParameter) {
  const SweepResult result = run(
      "[model]\ntext = '''\n[model]\nname = 'pair'\n[states]\nx = { unit = '1', start = '0.7' }\n"
      "v = { unit = '1' }\n[parameters]\nomega = 0.5\nzeta = 0.05\nF = 0.5\ncontact = 1.6\n"
      "[constants]\nk = \"if(phase < 2*pi*(contact - 1), 1.3, 0.8)\"\n"
      "[equations]\nx = \"v\"\nv = \"F - 2*zeta*v - k*backlash(x, 0.2)\"\n"
      "[forcing]\nperiod = \"2*pi/omega\"\n'''\n"
      "[[axes]]\nname = 'omega'\nvalues = [0.5, 0.9, 1.3, 1.9]\n"
      "[integrate]\nmax_step = 0.05\n[observe]\nquantities = ['x_rms']\n");
  const std::vector<double> right = {0.76798, 1.28160, 0.64327, 0.64823};
  for (std::size_t i = 0; i < right.size(); ++i) {
    EXPECT_NEAR(result.values[0][i], right[i], 1e-5) << i;
  }
}

// What rises to a steep piece and falls behind it: a cubic through both sides would go beyond the
// largest value, of the table as of what follows it.
TEST(PhaseJumps, LeaveExtremesBesideSteepPiecesRight) {
  const auto study = [](const std::string& rows) {
    return "[model]\ntext = '''\n[model]\nname = 'steep'\n[states]\nx = { unit = '1' }\n"
           "[parameters]\nshift = 0.1\n[equations]\nx = \"table('t', phase + shift) - x\"\n"
           "[forcing]\nperiod = \"2*pi\"\n[signals]\ndrive = \"table('t', phase + shift)\"\n'''\n"
           "[model.tables]\nt = '''\n" +
           rows +
           "'''\n[[axes]]\nname = 'shift'\nvalues = [0.0, 0.1, 0.37, 2.0]\n"
           "[integrate]\nmax_step = 0.1\nsettle = 8\nrecord = 1\nstop = 'never'\n"
           "[observe]\nquantities = ['drive_max', 'drive_min']\n";
  };
  std::string fine = "0 -0.2\n";
  for (int i = 0; i < 200; ++i) fine += fmt::format("{} {}\n", 1 + i * 1e-3, i % 2 * 1e-3);
  for (const std::string& rows : {std::string("0 0.35\n2 0.3534\n2.02 -1\n4 -0.9\n4.02 0.34\n"),
                                  fine + "2 0.3534\n2.02 -1\n4 -0.9\n4.02 0.34\n"}) {
    for (const std::string engine : {"opencl", "reference"}) {
      const SweepResult result = run(study(rows), {"integrate.engine=\"" + engine + "\""});
      for (std::size_t i = 0; i < result.status.size(); ++i) {
        EXPECT_LE(result.values[0][i], 0.3534 + 1e-12) << engine << i;
        EXPECT_GE(result.values[1][i], -1.0 - 1e-12) << engine << i;
        EXPECT_GE(result.values[0][i], rows.size() < 100 ? 0.3534 - 1e-12 : 0.33) << engine << i;
      }
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
