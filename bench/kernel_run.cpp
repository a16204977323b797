#include "kernel_run.hpp"

#include <chrono>
#include <optional>

#include "opencl/opencl_engine.hpp"

namespace gearsweep::bench {
namespace {

constexpr const char* kStudy = R"(
[model]
name = "gear5"
preset = "coarse"
[[axes]]
name = "omega"
from = 0.4
to = 2.0
count = 64
[[axes]]
name = "b"
from = 0.3
to = 1.5
count = 64
[integrate]
settle = 24
record = 1
round = 4
[observe]
quantities = ["x1_max"]
)";

}  // namespace

KernelRun::KernelRun(const std::vector<std::string>& overrides, bool settling)
    : study_(read_study(kStudy, "kernel_run", overrides)),
      plan_(study_, study_.points()),
      settling_(settling),
      engine_(make_opencl_engine(study_, std::nullopt)) {
  for (const std::size_t point : tile().points) {
    const std::vector<double> state = plan_.own_initial_state(point);
    initial_.insert(initial_.end(), state.begin(), state.end());
  }
  run();  // the first launch finishes the build
}

KernelRun::Rounds KernelRun::run() {
  const Integrate& integrate = study_.integrate;
  const std::size_t periods = settling_ ? integrate.settle : integrate.record;
  const std::size_t last = periods / integrate.round;
  std::size_t round = 0;
  Rounds rounds;
  std::chrono::steady_clock::time_point start;
  engine_->compute(plan_, tile(), initial_, windows_of(study_).front(), [&](double steps) {
    const auto now = std::chrono::steady_clock::now();
    ++round;
    if (round == 1) start = now;
    if (round > 1 && round <= last) rounds.steps += steps;
    if (round == last) rounds.seconds = std::chrono::duration<double>(now - start).count();
    return true;
  });
  return rounds;
}

}  // namespace gearsweep::bench
