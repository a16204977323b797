// A model of equations gives what its header gives.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "support/pair_model.hpp"
#include "support/run.hpp"
#include "support/study_text.hpp"

namespace gearsweep::testing {
namespace {

// All tests ask for the same, and few of their axes shape the phase table, so that there are few
// programs to build.
const std::string kObserve =
    "[observe]\nquantities = ['x_rms', 'dmf_max', 'contact_losses', 'lyapunov_max']\n";

// By name, over all points.
const std::vector<double>& values_of(const SweepResult& result, const std::string& name) {
  const std::vector<Quantity>& quantities = result.study.selection.quantities;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    if (quantities[i].name == name) return result.values[i];
  }
  throw std::logic_error("no map " + name);
}

// The host evaluates the tree, the device compiles it: the reference engine is a second opinion.
TEST(TextModel, IsTheSameOnTheHost) {
  const std::string study =
      "[model]\ntext = '''\n" + pair_model() +
      "'''\n[parameters]\nFte = 0.05\n[[axes]]\nname = 'omega'\nfrom = 0.4\nto = 1.6\ncount = 12\n"
      "[[axes]]\nname = 'Fm'\nfrom = 0.02\nto = 0.2\ncount = 6\n[integrate]\nmax_step = 0.05\n"
      "settle = 4\nrecord = 6\nstop = 'never'\nwarm_up = 5\n" +
      kObserve;
  const SweepResult device = run(study);
  const SweepResult host = run(study, {"integrate.engine=\"reference\""});
  EXPECT_GT(std::ranges::max(values_of(device, "contact_losses")), 0.0);
  for (const char* name : {"x_rms", "dmf_max"}) {
    for (std::size_t i = 0; i < device.status.size(); ++i) {
      EXPECT_NEAR(values_of(device, name)[i], values_of(host, name)[i], 1e-10) << name << " " << i;
    }
  }
}

// Each function where a state changes it, where the phase does, and where neither does: a signal
// for each argument, so that the device compiles once.
TEST(TextModel, HasEveryFunctionOnTheDevice) {
  const std::vector<std::string> functions = {"sin(A)",
                                              "cos(A)",
                                              "tan(A/4)",
                                              "asin(A/4)",
                                              "acos(A/4)",
                                              "atan(A)",
                                              "atan2(A, 2)",
                                              "sinh(A)",
                                              "cosh(A)",
                                              "tanh(A)",
                                              "exp(A)",
                                              "log(2 + A^2)",
                                              "sqrt(2 + A^3)",
                                              "sqrt1pm1(A/20)",
                                              "sqrt1pm1(A/2000)",
                                              "abs(A)",
                                              "sign(A - 0.3)",
                                              "floor(2*A + 0.37)",
                                              "min(A, 0.5)",
                                              "max(A, 0.5)",
                                              "clamp(A, 0.2, 0.5)",
                                              "step(A - 0.4)",
                                              "stop(A, 0.3)",
                                              "backlash(A, 0.3)",
                                              "(2 + A)^1.5",
                                              "(2 + A)^A",
                                              "max(A - 0.3, 0)^1.5",
                                              "max(A - 0.3, 0)^(1 + A)",
                                              "1/(2 + A)^3",
                                              "if(A < 0.3 and not A <= 0.1 or A == 2, A, 1 - A)"};
  const std::vector<std::string> arguments = {"x", "sin(phase)", "p", "x + sin(phase) + p", "x*p"};
  std::string signals, quantities;
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    std::string sum = "p";
    for (std::size_t i = 0; i < functions.size(); ++i) {
      std::string text = functions[i];
      for (std::size_t at = 0; (at = text.find('A')) != std::string::npos;) {
        text.replace(at, 1, "(" + arguments[k] + ")");
      }
      sum += " + " + std::to_string(i + 1) + "*" + text;
    }
    signals += fmt::format("all{} = \"{}\"\n", k, sum);
    quantities += fmt::format("'all{0}_mean', 'all{0}_max', ", k);
  }
  const std::string study =
      "[model]\ntext = '''\n[model]\nname = \"functions\"\n[states]\nx = { start = \"0.1\" }\n"
      "[parameters]\np = 0.45\n[equations]\nx = \"0.3 - 0.5*x + 0.1*cos(phase)\"\n[forcing]\n"
      "period = \"2*pi\"\n[signals]\n" +
      signals +
      "'''\n[[axes]]\nname = 'p'\nfrom = 0.05\nto = 0.7\ncount = 9\n[integrate]\n"
      "max_step = 0.1\nsettle = 2\nrecord = 2\nextend = 1\nstop = 'never'\n"
      "[observe]\nquantities = [" +
      quantities + "]\n";
  const SweepResult device = run(study);
  const SweepResult host = run(study, {"integrate.engine=\"reference\""});
  ASSERT_EQ(device.values.size(), 2 * arguments.size());
  for (std::size_t map = 0; map < device.values.size(); ++map) {
    for (std::size_t point = 0; point < device.status.size(); ++point) {
      EXPECT_NEAR(device.values[map][point], host.values[map][point], 1e-9)
          << arguments[map / 2] << ": map " << map << ", point " << point;
    }
  }
}

// The mesh stiffness as a table of its values, and of nothing else.
std::string table_study(const std::string& table, int count, const std::string& rest) {
  std::string model = pair_model();
  const std::string wave = "cos(phase)", first = "k*" + wave;
  model.replace(model.find(first) + 2, wave.size(), table);
  std::string study = "[model]\ntext = '''\n" + model + "'''\n";
  if (count > 0) study += "[model.tables]\n'cosine.csv' = '''\n";
  for (int i = 0; i < count; ++i) {
    const double phase = 2.0 * std::numbers::pi * i / count;
    study += fmt::format("{} {}\n", phase, std::cos(phase));
  }
  if (count > 0) study += "'''\n";
  return study + rest;
}

const std::string kFewPeriods =
    "[[axes]]\nname = 'omega'\nfrom = 0.4\nto = 1.6\ncount = 12\n[integrate]\nmax_step = 0.05\n"
    "settle = 20\nrecord = 10\nstop = 'never'\nwarm_up = 5\n" +
    kObserve;

double largest_difference(const SweepResult& one, const SweepResult& other) {
  double largest = 0.0;
  for (std::size_t map = 0; map < one.values.size(); ++map) {
    for (std::size_t i = 0; i < one.values[map].size(); ++i) {
      largest = std::max(largest, std::fabs(one.values[map][i] - other.values[map][i]));
    }
  }
  return largest;
}

// Van der Pol's oscillator with numbers in its equations: a state is swept.
TEST(TextModel, NeedsNoParameters) {
  for (const char* engine : {"opencl", "reference"}) {
    SCOPED_TRACE(engine);
    const SweepResult result = run(study_of_text(
        "[model]\nname = \"plain\"\n[states]\nx = { start = 1.0 }\ny = {}\n[equations]\nx = \"y\"\n"
        "y = \"(1 - x^2)*y - x\"\n",
        fmt::format("[[axes]]\nname = 'x'\nvalues = [0.5, 3.0]\n[integrate]\nengine = '{}'\n"
                    "max_step = 0.05\n[observe]\nquantities = ['cycle_time', 'lyapunov_max']\n",
                    engine)));
    for (std::size_t point = 0; point < 2; ++point) {
      EXPECT_NEAR(map_of(result, "cycle_time")[point], 6.663286859, 1e-5);
      EXPECT_NEAR(map_of(result, "lyapunov_max")[point], 0.0, 1e-5);
    }
  }
}

// To the error of the interpolation, which is h^2/8 of the second derivative, or h^4/384 of the
// fourth: 1.5e-6 and 2e-13 of 1800 points. A resonance makes up to ten times that of it.
TEST(TextModel, HasTheMotionOfWhatItsTableHolds) {
  for (const std::string engine : {"opencl", "reference"}) {
    const std::vector<std::string> on = {"integrate.engine=\"" + engine + "\""};
    const SweepResult exact = run(table_study("cos(phase)", 0, kFewPeriods), on);
    const auto error = [&](const std::string& table) {
      return largest_difference(run(table_study(table, 1800, kFewPeriods), on), exact);
    };
    EXPECT_LT(error("table('cosine.csv', phase)"), 1.5e-5) << engine;
    EXPECT_LT(error("table('cosine.csv', phase, cubic)"), 1e-11) << engine;
  }
}

// An argument that a swept parameter moves is among them.
TEST(TextModel, ReadsTablesOnBothEngines) {
  const std::string rest =
      "[[axes]]\nname = 'Fm'\nfrom = 0.05\nto = 0.2\ncount = 5\n" + kFewPeriods;
  for (const std::string place : {"phase", "phase + 4*Fm", "3*phase"}) {
    const std::string table = "table('cosine.csv', " + place + ")";
    const SweepResult device = run(table_study(table, 50, rest));
    const SweepResult host = run(table_study(table, 50, rest), {"integrate.engine=\"reference\""});
    for (const char* name : {"x_rms", "dmf_max"}) {
      for (std::size_t i = 0; i < device.status.size(); ++i) {
        EXPECT_NEAR(values_of(device, name)[i], values_of(host, name)[i], 1e-10)
            << name << " " << i;
      }
    }
  }
}

// Steps end at the jumps, so the motion is that of the same jumps as conditions.
TEST(TextModel, HasTheMotionOfATableThatJumps) {
  std::string with_conditions = table_study("if(phase < 1 or phase >= 4, 1, -1)", 0, kFewPeriods);
  const std::string period = "period = \"2*pi/omega\"\n";
  with_conditions.insert(with_conditions.find(period) + period.size(), "jumps = [\"1\", \"4\"]\n");
  const std::string with_table =
      table_study("table('square.csv', phase)", 0,
                  "[model.tables]\n'square.csv' = \"1 1\\n1 -1\\n4 -1\\n4 1\\n\"\n" + kFewPeriods);
  EXPECT_LT(largest_difference(run(with_table), run(with_conditions)), 1e-12);
}

// A spline has no corners, so a step over one of its points loses nothing; at those of straight
// lines steps end.
TEST(TextModel, KeepsItsOrderWithTables) {
  const auto order = [](const std::string& table) {
    const auto x_rms = [&](double step) {
      return values_of(run(table_study(table, 9,
                                       "[[axes]]\nname = 'omega'\nvalues = [0.55, 0.6, 0.65, 0.7, "
                                       "1.1, 1.2, 1.3, 1.4]\n[integrate]\nsettle = 0\nrecord = "
                                       "10\nstop = 'never'\nmax_step = " +
                                           std::to_string(step) + "\n" + kObserve)),
                       "x_rms");
    };
    const std::vector<double> fine = x_rms(0.0025), half = x_rms(0.04), whole = x_rms(0.08);
    double error = 0.0, error_of_half = 0.0;
    for (std::size_t i = 0; i < fine.size(); ++i) {
      error += std::fabs(whole[i] - fine[i]);
      error_of_half += std::fabs(half[i] - fine[i]);
    }
    return std::log2(error / error_of_half);
  };
  EXPECT_GT(order("table('cosine.csv', phase, cubic)"), 3.5);
  EXPECT_GT(order("table('cosine.csv', phase)"), 3.5);
}

// Halving the step leaves a sixteenth of the error where contacts are corrected.
TEST(TextModel, KeepsItsOrderWhereTeethMeetAndPart) {
  const auto x_rms = [](double step) {
    return values_of(run("[model]\ntext = '''\n" + pair_model() +
                         "'''\n[parameters]\nFte = 0.08\n[[axes]]\nname = 'omega'\nvalues = [0.55, "
                         "0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9]\n[integrate]\nsettle = 0\nrecord = "
                         "10\nstop = 'never'\nmax_step = " +
                         std::to_string(step) + "\n" + kObserve),
                     "x_rms");
  };
  const std::vector<double> fine = x_rms(0.0025), half = x_rms(0.04), whole = x_rms(0.08);
  double orders = 0.0;
  for (std::size_t i = 0; i < fine.size(); ++i) {
    orders += std::log2(std::abs(whole[i] - fine[i]) / std::abs(half[i] - fine[i]));
  }
  EXPECT_GT(orders / static_cast<double>(fine.size()), 3.5);
}

}  // namespace
}  // namespace gearsweep::testing
