// Results made by hand for the tests of this folder, and a folder of its own for each test.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "model/error.hpp"
#include "result/result_file.hpp"
#include "study/builtin_models.hpp"

namespace gearsweep::testing {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

inline Axis make_axis(const std::string& name, const std::string& unit, const std::string& meaning,
                      double from, double to, std::size_t count) {
  Axis axis;
  axis.name = name;
  axis.unit = unit;
  axis.meaning = meaning;
  const auto last = static_cast<double>(count > 1 ? count - 1 : 1);
  for (std::size_t i = 0; i < count; ++i) {
    const auto done = static_cast<double>(i);
    axis.values.push_back((from * (last - done) + to * done) / last);
  }
  return axis;
}

// 4 x 3 points over omega and b, the maps x1_rms (10 iy + ix + 0.1) and contact_class (ix % 3),
// samples of x1 and v1 (point + 0.01 state + 0.001 sample). Point 5 diverged.
inline SweepResult example_result(std::size_t nx = 4, std::size_t ny = 3) {
  SweepResult result;
  Study& study = result.study;
  study.title = "omega x b, \"coarse\" gear";
  study.model = find_model("gear5");
  study.setting = study.model->default_setting();
  study.axes.push_back(make_axis("omega", "varpi", "mesh frequency / varpi", 0.4, 2.0, nx));
  if (ny > 0) study.axes.push_back(make_axis("b", "b_n", "half backlash", 0.3, 1.5, ny));
  study.selection =
      select_quantities(*study.model, {"x1_rms", "contact_class", "poincare"}, {"x1", "v1"});
  study.integrate.record = 5;
  study.toml = "title = 'ϖ'\n[model]\nname = \"gear5\"\n";
  result.engine = {"a device", "3.1", "-DLANES=8"};
  result.steps = 12345.0;
  result.seconds = 0.5;
  const std::size_t points = nx * (ny > 0 ? ny : 1);
  result.values.resize(2);
  for (std::size_t point = 0; point < points; ++point) {
    const bool diverged = point == 5;
    result.status.push_back(diverged ? 1 : 0);
    const auto ix = static_cast<double>(point % nx), iy = static_cast<double>(point / nx);
    result.values[0].push_back(diverged ? kNaN : 10.0 * iy + ix + 0.1);
    result.values[1].push_back(diverged ? kNaN : std::fmod(ix, 3.0));
    for (int state = 0; state < 2; ++state) {
      for (int sample = 0; sample < 5; ++sample) {
        const double value = static_cast<double>(point) + 0.01 * state + 0.001 * sample;
        result.samples.push_back(diverged ? kNaN : value);
      }
    }
  }
  return result;
}

// The same points with a quantity of several numbers: lyapunov_spectrum, whose exponent j (from 1)
// is 0.3 + 0.01 point - 0.1 j, and lyapunov_max, which is the first of them. Point 5 diverged.
inline SweepResult spectrum_result(std::size_t nx = 4, std::size_t ny = 3) {
  SweepResult result = example_result(nx, ny);
  result.study.selection =
      select_quantities(*result.study.model, {"lyapunov_max", "lyapunov_spectrum"}, {});
  result.values.assign(2, {});
  result.samples.clear();
  for (std::size_t point = 0; point < result.status.size(); ++point) {
    for (int j = 1; j <= 10; ++j) {
      const double exponent = 0.3 + 0.01 * static_cast<double>(point) - 0.1 * j;
      result.values[1].push_back(point == 5 ? kNaN : exponent);
      if (j == 1) result.values[0].push_back(result.values[1].back());
    }
  }
  return result;
}

inline const Provenance kProvenance = {"gearsweep run study.toml -o 'map one.nc'", "0.1.0",
                                       "abcdef"};

class IoTest : public ::testing::Test {
 protected:
  IoTest() {
    std::string test = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::ranges::replace(test, '/', '_');  // before a parameter
    folder_ =
        std::filesystem::temp_directory_path() / fmt::format("gearsweep_io_{}_{}", test, getpid());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~IoTest() override { std::filesystem::remove_all(folder_); }

  std::string in_folder(const std::string& name) const { return (folder_ / name).string(); }

  std::string write(const SweepResult& result, const std::string& name = "map.nc") const {
    write_result(result, in_folder(name), kProvenance);
    return in_folder(name);
  }

  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder_), {}));
  }

  static std::string content(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  // The message of the InputError that `action` must throw.
  template <typename Action>
  static std::string refusal(const Action& action) {
    try {
      action();
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  std::filesystem::path folder_;
};

}  // namespace gearsweep::testing
