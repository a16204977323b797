// The size that is told of a result file is a bound, whatever the study and its numbers.
#include "result/result_size.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "result/example_result.hpp"
#include "result/random_result.hpp"
#include "study/builtin_models.hpp"

namespace gearsweep {
namespace {

namespace fs = std::filesystem;
using gearsweep::testing::all_quantities;
using gearsweep::testing::all_states;
using gearsweep::testing::kProvenance;
using gearsweep::testing::random_result;

class ResultSizeTest : public gearsweep::testing::IoTest {
 protected:
  // The size of a result of random numbers, which nothing compresses.
  double written(const Study& study, std::size_t attractors) {
    SweepResult result = random_result(study, attractors, &random_);
    result.engine.macros.assign(1000, 'm');
    return static_cast<double>(fs::file_size(write(result)));
  }
  static double bound(const Study& study) { return size_of_result(study, kProvenance).file; }

  std::size_t one_of(const std::vector<std::size_t>& values) {
    return values[random_() % values.size()];
  }

  // With any model, shape, precision and choice of quantities, and a few hundred thousand numbers.
  Study random_study() {
    const Model& model = models()[random_() % models().size()];
    const bool is_map = random_() % 2 == 0;
    std::string toml = fmt::format("[model]\nname = '{}'\n", model.name);
    for (const ChannelInfo& state :
         std::vector<ChannelInfo>(model.states.begin(), model.states.begin() + (is_map ? 2 : 1))) {
      toml += fmt::format("[[axes]]\nname = '{}'\nvalues = [0.5]\n", state.name);
    }
    toml += fmt::format("[initial]\nensemble = {}\n", one_of({2, 3, 16}));
    toml += fmt::format("[integrate]\nprecision = '{}'\nrecord = {}\n",
                        random_() % 2 == 0 ? "fp32" : "fp64", one_of({1, 2, 7, 100, 5000}));
    const std::string quantities =
        random_() % 3 == 0 ? all_quantities(model)
        : random_() % 2 == 0
            ? fmt::format("['{}_rms', 'poincare', 'attractor']", model.states[0].name)
            : fmt::format("['attractor_count', 'motion_class', '{}']",
                          model.is_clockless ? "settling_time" : "section_min");
    const std::string states =
        random_() % 2 == 0 ? all_states(model) : fmt::format("['{}']", model.states.back().name);
    toml += fmt::format("[observe]\nquantities = {}\npoincare = {}\n", quantities, states);
    Study study = read_study(toml, "test");
    const double numbers_of_point =
        1.0 + static_cast<double>(study.selection.output_count() +
                                  study.selection.poincare.size() * study.integrate.record);
    for (Axis& axis : study.axes) {
      const double left = 3e5 / (numbers_of_point * static_cast<double>(study.points()));
      axis.values.resize(std::clamp<std::size_t>(static_cast<std::size_t>(left), 1,
                                                 one_of({1, 2, 3, 40, 1000, 30000})));
      for (std::size_t i = 0; i < axis.values.size(); ++i) {
        axis.values[i] = static_cast<double>(i);
      }
    }
    study.title.assign(one_of({0, 20, 100'000}), 't');
    study.toml += study.title;
    return study;
  }

  std::mt19937_64 random_{1};
};

TEST_F(ResultSizeTest, IsABoundOfEveryStudy) {
  for (int round = 0; round < 30; ++round) {
    const Study study = random_study();
    for (const std::size_t attractors : {std::size_t{0}, study.trajectories()}) {
      const double size = written(study, attractors);
      EXPECT_LE(size, bound(study))
          << study.model->name << ", " << study.axes[0].values.size() << " of " << study.points()
          << " points, ensemble " << study.initial.ensemble << ", record " << study.integrate.record
          << ", " << study.selection.quantities.size() << " quantities, " << attractors
          << " attractors";
    }
  }
}

// It took 47,340 bytes where 42,385 had been told.
TEST_F(ResultSizeTest, CountsTheListOfAttractors) {
  Study study = read_study(
      "[[axes]]\nname = 'omega'\nfrom = 0.5\nto = 1.0\ncount = 40\n"
      "[[axes]]\nname = 'b'\nfrom = 0.5\nto = 1.0\ncount = 30\n[initial]\nensemble = 16\n"
      "[observe]\nquantities = ['attractor_count', 'x1_rms']\n",
      "test");
  const double without = written(study, 0);
  EXPECT_GT(written(study, 19200), without + 19200 * 44);
  EXPECT_LE(written(study, 19200), bound(study));
}

// Not one that says nothing: of many numbers that cannot be compressed it is their size.
TEST_F(ResultSizeTest, IsNearTheSizeOfWhatCannotBeCompressed) {
  const Study study = read_study(
      "[[axes]]\nname = 'omega'\nfrom = 0.5\nto = 1.0\ncount = 2000\n"
      "[integrate]\nrecord = 200\n[observe]\nquantities = ['poincare', 'x1_rms']\n",
      "test");
  // The exponents of random numbers can be, by a tenth or so.
  EXPECT_GT(1.25 * written(study, 0), bound(study));
}

// A row of few samples is not a chunk by itself: each takes room, and time, of its own.
TEST_F(ResultSizeTest, ShortRowsShareAChunk) {
  Study study = read_study(
      "[[axes]]\nname = 'omega'\nvalues = [0.5, 0.6]\n[[axes]]\nname = 'b'\nvalues = [1]\n"
      "[integrate]\nrecord = 3\n[observe]\nquantities = ['poincare']\n",
      "test");
  study.axes[1].values.resize(50'000);
  for (std::size_t i = 0; i < 50'000; ++i) study.axes[1].values[i] = static_cast<double>(i);
  const SampleBlock block = block_of_samples(study);
  EXPECT_EQ(block.columns, 2U);
  EXPECT_GT(block.rows, 10'000U);
  const SweepResult result = random_result(study, 0, &random_);
  EXPECT_EQ(ResultFile(write(result)).read("poincare").values, result.samples);
}

}  // namespace
}  // namespace gearsweep
