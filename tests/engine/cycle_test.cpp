// A forcing that comes back after several periods of the mesh, against the closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

// x'' + 0.1 x' + x = sin(omega tau/teeth), written with a phase that begins anew seven times.
TEST(Cycle, HasTheAmplitudeOfTheClosedForm) {
  const std::string model = R"~([model]
name = "shaft"
[states]
x = {}
v = {}
[parameters]
omega = 7.0
teeth = { value = 7, min = 1, max = 100 }
[equations]
x = "v"
v = "sin((phase + 2*pi*turn)/teeth) - 0.1*v - x"
[forcing]
period = "2*pi/omega"
cycle = "teeth"
)~";
  const std::string study =
      "[model]\nfile = 'shaft.toml'\ntext = '''\n" + model +
      "'''\n[[axes]]\nname = 'omega'\nvalues = [3.5, 7.0, 10.5]\n[integrate]\nsettle = 200\n"
      "record = 2\nmax_step = 0.02\n[observe]\nquantities = ['x_max', 'period']\n";
  const SweepResult result = run(study);
  for (std::size_t i = 0; i < 3; ++i) {
    const double w = 0.5 + 0.5 * static_cast<double>(i);
    EXPECT_NEAR(result.values[0][i], 1.0 / std::hypot(1.0 - w * w, 0.1 * w), 1e-7) << w;
    EXPECT_EQ(result.values[1][i], 1.0);
  }
}

}  // namespace
}  // namespace gearsweep::testing
