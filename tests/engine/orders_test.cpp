// Amplitude and phase of orders of the mesh frequency, against linear responses, Parseval's theorem
// and the reference engine.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "model/error.hpp"
#include "study/builtin_models.hpp"
#include "support/run.hpp"
#include "support/text.hpp"

namespace gearsweep::testing {
namespace {

using Complex = std::complex<double>;

// Amplitude and phase of one order of a point as one number.
Complex part_of(const SweepResult& result, const std::string& channel, std::size_t order,
                std::size_t point = 0) {
  const std::size_t width = result.study.selection.orders.size();
  return std::polar(map_of(result, channel + "_order_amplitude")[point * width + order],
                    map_of(result, channel + "_order_phase")[point * width + order]);
}

std::string orders_of(const std::vector<std::string>& channels) {
  std::string list;
  for (const std::string& channel : channels) {
    list += fmt::format("'{0}_order_amplitude', '{0}_order_phase', '{0}_std', ", channel);
  }
  return list;
}

// x1, x3 and x5 of gear5 while the teeth touch, with stiffness 1 and without friction, under
// e0 w^2 sin(w tau): x = Re(X exp(i w tau)), by the equations of motion.
struct LinearResponse {
  Complex x1, x3, x5;
  explicit LinearResponse(double w, double e0) {
    const double zeta = 0.04008, m = 0.3507525, k = 1.38, c = 2.0;
    const Complex z(0.0, w), mesh = 1.0 + 4.0 * zeta * z;
    const Complex shaft = z * z + 2.0 * m * c * zeta * z + m * k;
    Eigen::Matrix3cd matrix;
    matrix << z * z + mesh, -mesh, mesh,         //
        -m * mesh, shaft + m * mesh, -m * mesh,  //
        m * mesh, -m * mesh, shaft + m * mesh;
    const Eigen::Vector3cd answer =
        matrix.partialPivLu().solve(Eigen::Vector3cd(Complex(0.0, -e0 * w * w), 0.0, 0.0));
    x1 = answer[0], x3 = answer[1], x5 = answer[2];
  }
};

// All waves but that of the forcing vanish, fractions of it too. The classical method is off by
// (w h)^4/120, some 3e-9 with 256 steps of a period.
TEST(Orders, OfALinearResponseAreItsAmplitudeAndItsPhase) {
  const double w = 0.7, e0 = 0.02;
  const SweepResult result =
      run("[model]\nstiffness = 'fourier'\n[parameters]\nkappa = 0.0\nmu = 0.0\ne0 = 0.02\n"
          "omega = 0.7\n[[axes]]\nname = 'b'\nvalues = [1.0]\n[integrate]\nsettle = 600\n"
          "record = 6\nsteps_per_period = 256\nstop = 'never'\n[observe]\norders = [1, 0.5, 2, "
          "0.3333333333333333, "
          "3]\nquantities = [" +
          orders_of({"x1", "x3", "dte", "dmf"}) + "]\n");
  const LinearResponse exact(w, e0);
  const auto expect = [&](const std::string& channel, Complex expected) {
    EXPECT_LT(std::abs(part_of(result, channel, 0) - expected), 1e-9) << channel;
    for (std::size_t other = 1; other < 5; ++other) {
      EXPECT_LT(std::abs(part_of(result, channel, other)), 1e-10) << channel << " " << other;
    }
  };
  expect("x1", exact.x1);
  expect("x3", exact.x3);
  expect("dte", exact.x1 + Complex(0.0, -e0));
  expect("dmf", exact.x1 - exact.x3 + exact.x5);
}

// With impacts there are waves of every order. The squares of what is cut off fall as n^-7 or
// faster for x1, whose third derivative jumps. The period-3 motion has its waves at thirds of the
// mesh frequency; a record of 50 periods does not hold these, but it stops on its orbit.
TEST(Orders, HaveTheEnergyOfTheMotion) {
  std::string all;
  for (int i = 1; i <= 30; ++i) all += digits(i / 3.0) + ", ";
  for (const auto& [omega, period] : {std::pair("0.5", 1.0), std::pair("1.2", 3.0)}) {
    const SweepResult result = run(
        "[model]\npreset = 'consistent'\n[[axes]]\nname = 'omega'\nvalues = [" +
        std::string(omega) + "]\n[integrate]\nsettle = 1000\nrecord = 50\nmax_step = 0.01\n" +
        "[observe]\norders = [" + all + "]\nquantities = ['period', " + orders_of({"x1"}) + "]\n");
    EXPECT_EQ(map_of(result, "period")[0], period);
    double energy = 0.0, of_thirds = 0.0;
    for (std::size_t i = 0; i < 30; ++i) {
      const double square = 0.5 * std::norm(part_of(result, "x1", i));
      energy += square;
      if (i % 3 != 2) of_thirds += square;
    }
    const double variance = std::pow(map_of(result, "x1_std")[0], 2);
    EXPECT_NEAR(energy, variance, 1e-6 * variance) << omega;
    if (period == 1.0) {
      EXPECT_LT(of_thirds, 1e-16) << omega;
    } else {
      EXPECT_GT(of_thirds, 0.1 * variance) << omega;
    }
  }
}

// Chaotic points among them; fractions, and a record in which their waves do not fit. Driven
// oscillators are among the models below.
TEST(Orders, AgreeWithTheReferenceEngine) {
  for (const std::string model :
       {"name = 'gear5'\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [0.7, 1.3, 1.7]\n",
        "name = 'vanderpol'\n[[axes]]\nname = 'x'\nvalues = [0.5, 1.0]\n"}) {
    const std::string first = model.find("gear5") != std::string::npos ? "x1" : "x";
    const std::string study =
        "[model]\n" + model +
        "[integrate]\nsettle = 2\nrecord = 5\nmax_step = 0.02\nstop = 'never'\n[observe]\n"
        "orders = [1, 0.25, 7.1]\nquantities = [" +
        orders_of({first}) + "]\n";
    const SweepResult kernel = run(study);
    const SweepResult reference = run(study, {"integrate.engine='reference'"});
    for (std::size_t point = 0; point < kernel.study.points(); ++point) {
      for (std::size_t order = 0; order < 3; ++order) {
        EXPECT_LT(std::abs(part_of(kernel, first, order, point) -
                           part_of(reference, first, order, point)),
                  1e-9)
            << model << " " << order;
      }
    }
  }
}

// At random parameters, of models with one contact, two, a stop, and none: what the kernels and the
// other engine's own code read out of the same steps.
TEST(Orders, AndImpactsAgreeWithTheReferenceEngineWhateverTheModel) {
  std::mt19937 random(20261125);
  std::uniform_real_distribution<double> factor(0.7, 1.4);
  for (const char* const name : {"gear1", "two_flanks", "shaw_holmes", "pendulum"}) {
    const Model& model = *find_model(name);
    const std::string first = model.states.front().name;
    std::string study = "[model]\nname = '" + model.name + "'\n[parameters]\n";
    for (const ParameterInfo& info : model.parameters) {
      const double value = info.default_value * factor(random);
      if (info.shapes_phase || value == 0.0) continue;
      study += info.name + " = " + digits(std::clamp(value, info.min, info.max)) + "\n";
    }
    study += fmt::format(
        "[[axes]]\nname = '{0}'\nvalues = [-1.2, 0.4, 1.7]\n[integrate]\nsettle = 1\nrecord = 2\n"
        "stop = 'never'\n[observe]\norders = [1, 0.5, 3]\nquantities = ['{0}_order_amplitude', "
        "'{0}_order_phase', '{0}_peak_to_peak'",
        first);
    for (const ContactInfo& contact : model.contacts) {
      const std::string stem = contact.name.empty() ? "" : contact.name + "_";
      for (const char* const what : {"drive", "back", "speed", "depth"}) {
        study += fmt::format(", '{}contact_impacts_{}'", stem, what);
      }
    }
    study += "]\n";
    SCOPED_TRACE(study);
    const SweepResult kernel = run(study);
    const SweepResult reference = run(study, {"integrate.engine='reference'"});
    ASSERT_EQ(kernel.status, reference.status);
    for (std::size_t point = 0; point < 3; ++point) {
      for (std::size_t order = 0; order < 3; ++order) {
        EXPECT_LT(std::abs(part_of(kernel, first, order, point) -
                           part_of(reference, first, order, point)),
                  1e-9);
      }
      for (const Quantity& quantity : kernel.study.selection.quantities) {
        if (quantity.width > 1) continue;
        const double value = map_of(kernel, quantity.name)[point];
        EXPECT_NEAR(value, map_of(reference, quantity.name)[point],
                    1e-8 * std::max(1.0, std::abs(value)))
            << quantity.name;
      }
    }
  }
}

// A thousand turns of a third of a wave in single precision, and of a number of lanes of its own.
TEST(Orders, KeepTheirDigitsInSinglePrecision) {
  const std::string study =
      "[model]\npreset = 'consistent'\n[[axes]]\nname = 'omega'\nvalues = [0.5, 0.7, 1.2]\n"
      "[integrate]\nsettle = 500\nrecord = 999\nstop = 'never'\nmax_step = 0.05\n[observe]\n"
      "orders = [1, 0.3333333333333333, 5]\nquantities = [" +
      orders_of({"x1"}) + "]\n";
  const SweepResult fp64 = run(study);
  const SweepResult fp32 = run(study, {"integrate.precision=fp32"});
  for (std::size_t point = 0; point < 2; ++point) {
    for (std::size_t order = 0; order < 3; ++order) {
      EXPECT_LT(std::abs(part_of(fp64, "x1", order, point) - part_of(fp32, "x1", order, point)),
                1e-4);
    }
  }
  for (std::size_t order = 0; order < 3; ++order) {  // which of three motions is chance
    EXPECT_NEAR(std::abs(part_of(fp64, "x1", order, 2)), std::abs(part_of(fp32, "x1", order, 2)),
                1e-3);
  }
}

// A wave has eight steps at least, whatever the longest step is and whichever engine takes them.
TEST(Orders, AskForStepsThatTellTheirWaves) {
  const std::string study =
      "[model]\n[[axes]]\nname = 'omega'\nvalues = [2.0]\n[integrate]\nsettle = 0\nrecord = 1\n"
      "stop = 'never'\nengine = 'reference'\n";
  const std::string observe = "[observe]\norders = [50]\nquantities = ['x1_order_amplitude']\n";
  EXPECT_GE(run(study + "max_step = 0.1\n" + observe).steps, 400.0);
  EXPECT_LT(run(study + "max_step = 0.1\n").steps, 100.0);
  EXPECT_THROW(run(study + "steps_per_period = 64\n" + observe), InputError);
}

}  // namespace
}  // namespace gearsweep::testing
