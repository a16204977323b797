#include <stdexcept>
#include <vector>

#include "fuzz/targets.hpp"
#include "model/error.hpp"
#include "plan/plan.hpp"
#include "study/settings.hpp"
#include "study/study.hpp"

namespace gearsweep::testing {
namespace {

// Larger plans would take the fuzzer's time, and nothing in them differs from smaller ones.
constexpr std::size_t kMaxPoints = 512;

// Takes "--set PATH=VALUE" lines off the front.
std::vector<std::string> take_overrides(std::string* text) {
  const std::string mark = "--set ";
  std::vector<std::string> overrides;
  while (text->starts_with(mark)) {
    const std::size_t end = std::min(text->find('\n'), text->size());
    overrides.push_back(text->substr(mark.size(), end - mark.size()));
    text->erase(0, end + 1);
  }
  return overrides;
}

void plan(const Study& study) {
  constexpr std::size_t kTile = 64;
  const Plan made(study, kTile);
  for (const std::size_t point : {std::size_t{0}, study.points() - 1}) {
    made.phase_grid_of(point);
    made.own_initial_state(point);
  }
}

// "Reading it gives this study": what a result file keeps must never be refused.
void read_again(const Study& study) {
  try {
    read_study(study.toml, "again");
  } catch (const InputError& error) {
    throw std::logic_error(std::string("a study that was read is refused as written: ") +
                           error.what());
  }
}

}  // namespace

void read_hostile_study(const std::string& bytes) {
  std::string text = bytes;
  const std::vector<std::string> overrides = take_overrides(&text);
  try {
    const Study study = read_study(text, "hostile.toml", overrides);
    read_again(study);
    resolved_settings(study);
    if (study.trajectories() <= kMaxPoints) plan(study);
  } catch (const InputError&) {
  }
}

}  // namespace gearsweep::testing
