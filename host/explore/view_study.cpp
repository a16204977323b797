#include "explore/view_study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "model/error.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kMaxCount = 4096;  // of values on an axis

std::string as_toml(const Scene& scene, const ViewRange& view, std::size_t number) {
  const double from = view.shares.from[number], to = view.shares.to[number];
  const std::size_t count = view.count[number];
  if (count < 2 || count > kMaxCount) {
    throw InputError(fmt::format("{} values on an axis; 2 to {} are possible", count, kMaxCount));
  }
  const Axis& axis = scene.study().axes[number];
  return fmt::format("{{name = \"{}\", from = {}, to = {}, count = {}, scale = \"{}\"}}", axis.name,
                     scene.value_at(number, from), scene.value_at(number, to), count,
                     axis.logarithmic ? "log" : "linear");
}

}  // namespace

Study study_with_axes(const Scene& scene, const std::vector<std::string>& axes) {
  std::vector<std::string> overrides = {fmt::format("axes=[{}]", fmt::join(axes, ", "))};
  const Integrate& integrate = scene.study().integrate;
  if (integrate.steps_per_period == 0) {
    const std::vector<std::string> steps = FoundStep::of(scene.study()).overrides();
    overrides.insert(overrides.end(), steps.begin(), steps.end());
  }
  return read_study(scene.study().toml, "the view", overrides, {}, {}, NamedFiles::refused);
}

std::string view_study(const Scene& scene, const ViewRange& view) {
  require_view(view.shares);
  return study_with_axes(scene, {as_toml(scene, view, 0), as_toml(scene, view, 1)}).toml;
}

}  // namespace gearsweep
