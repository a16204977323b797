// The natural frequencies of a gear unit from a file, by four discs on three springs in SI units.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "orders/natural_modes.hpp"
#include "rexs/unit_drawing.hpp"
#include "rexs/unit_text.hpp"
#include "study/imported_gear.hpp"
#include "study/study.hpp"

namespace gearsweep::testing {
namespace {

using Matrix = std::array<std::array<double, 4>, 4>;

double determinant(Matrix a) {
  double product = 1.0;
  for (std::size_t k = 0; k < 4; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < 4; ++i) {
      if (std::fabs(a[i][k]) > std::fabs(a[pivot][k])) pivot = i;
    }
    if (pivot != k) {
      std::swap(a[pivot], a[k]);
      product = -product;
    }
    product *= a[k][k];
    for (std::size_t i = k + 1; i < 4; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < 4; ++j) a[i][j] -= factor * a[k][j];
    }
  }
  return product;
}

// A spring between two discs: its way is of the first angle times a and of the second times b.
void add_spring(std::size_t first, double stiffness, double a, double b, Matrix* matrix) {
  Matrix& k = *matrix;
  k[first][first] += stiffness * a * a;
  k[first][first + 1] += stiffness * a * b;
  k[first + 1][first] += stiffness * a * b;
  k[first + 1][first + 1] += stiffness * b * b;
}

// Steel discs of the reference diameters, 30 mm wide, on the shafts of the file: what is outside of
// the shaft of each gear, and half of the middle shaft at both of its gears.
TEST(ImportedUnit, HasTheNaturalFrequenciesOfItsDiscsAndSprings) {
  const GearUnit unit = gear_unit_of(read_rexs(xml_of(two_stages().unit), "unit.rexs"));
  const ImportedGear imported = imported_unit_study(unit_drawing(unit, ""), "unit.rexs");
  const Study study = read_study(imported.toml, "unit.toml",
                                 {"gear.first.mesh_damping_ratio=0",
                                  "gear.second.mesh_damping_ratio=0", "parameters.zeta_shaft=0"});
  const auto value = [&](const std::string& name) {
    return study.setting.parameters[static_cast<std::size_t>(study.model->find_parameter(name))];
  };
  const double pi = std::numbers::pi, cosine = std::cos(20.0 * pi / 180.0);
  const auto disc = [&](double diameter, double width) {
    return 7850.0 * pi / 32.0 * std::pow(1e-3 * diameter, 4) * 1e-3 * width;
  };
  const double rest = 0.5 * disc(40.0, 150.0);
  const std::array<double, 4> inertia = {disc(30.0, 100.0) + disc(60.0, 30.0) - disc(30.0, 30.0),
                                         rest + disc(123.0, 30.0) - disc(40.0, 30.0),
                                         rest + disc(72.0, 30.0) - disc(40.0, 30.0),
                                         disc(50.0, 120.0) + disc(180.0, 30.0) - disc(50.0, 30.0)};
  Matrix springs = {};
  add_spring(0, value("k0_first"), 0.030 * cosine, 0.0615 * cosine, &springs);
  add_spring(1, 8.1e10 * pi * std::pow(0.04, 4) / 32.0 / 0.08, 1.0, -1.0, &springs);
  add_spring(2, value("k0_second"), 0.036 * cosine, 0.090 * cosine, &springs);
  const auto at = [&](double omega) {
    Matrix dynamic = springs;
    for (std::size_t i = 0; i < 4; ++i) dynamic[i][i] -= omega * omega * inertia[i];
    return determinant(dynamic);
  };
  const std::vector<NaturalMode> modes = natural_modes(*study.model, study.setting);
  ASSERT_EQ(modes.size(), 3U);
  constexpr double kNear = 2e-5;  // inertias have six digits in the study
  for (const NaturalMode& mode : modes) {
    const double omega = mode.frequency * study.scales.varpi;
    EXPECT_LT(at(omega * (1.0 - kNear)) * at(omega * (1.0 + kNear)), 0.0) << omega / 2.0 / pi;
  }
}

}  // namespace
}  // namespace gearsweep::testing
