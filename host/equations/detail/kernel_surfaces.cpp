#include "equations/detail/kernel_surfaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "expression/differentiate.hpp"

namespace gearsweep {
namespace {

bool is_reset(const Surface& surface) { return !surface.reset.empty(); }

// The surfaces of which that holds, as a condition of `surface`.
std::string surfaces_where(const Lowered& lowered,
                           const std::function<bool(const Surface&)>& holds) {
  std::string found;
  for (std::size_t i = 0; i < lowered.surfaces.size(); ++i) {
    if (!holds(lowered.surfaces[i])) continue;
    found += fmt::format("{}(surface) == {}", found.empty() ? "" : " || ", i);
  }
  return found.empty() ? "0" : found;
}

class SurfaceWriter {
 public:
  SurfaceWriter(Formula* formula, const Lowered& lowered, KernelText* text)
      : formula_(formula), lowered_(lowered), text_(text) {}

  void write() {
    for (std::size_t i = 0; i < formula_->states.size(); ++i) {
      dx_.push_back(formula_->graph.symbol(fmt::format("dx[{}]", i)));
      w_.push_back(formula_->graph.symbol(fmt::format("w[{}]", i)));
      text_->names[dx_.back()] = fmt::format("dx[{}]", text_->state_index(i));
      text_->names[w_.back()] = fmt::format("w[{}]", text_->state_index(i));
    }
    text_->write_function("model_phase_turn", "const ModelPoint* point, real* turn",
                          {{"*turn", lowered_.phase_turn}}, "point");
    write_values("level", &Surface::level, &Surface::drift);
    if (!has_resets()) {
      for (const char* what : {"values", "along", "rates", "bends"}) {
        text_->out += fmt::format("#define model_held_{0} model_level_{0}\n", what);
      }
      return;
    }
    write_values("held", &Surface::held, &Surface::held_drift);
    std::vector<std::vector<Assignment>> resets, carried_on, rates, turns;
    for (const Surface& surface : lowered_.surfaces) {
      const bool resets_it = is_reset(surface);
      std::vector<NodeId> carried, moved;
      for (std::size_t i = 0; i < formula_->states.size(); ++i) {
        carried.push_back(resets_it ? along(surface.reset[i], dx_) : dx_[i]);
        moved.push_back(
            resets_it ? formula_->graph.make(Operation::add, {carried[i], surface.reset_drift[i]})
                      : dx_[i]);
      }
      resets.push_back(text_->places("out", resets_it ? surface.reset : formula_->states));
      carried_on.push_back(text_->places("out", carried));
      rates.push_back(text_->places("out", moved));
      turns.push_back(resets_it ? text_->places("out", surface.turn) : std::vector<Assignment>());
    }
    const std::string at = "const ModelPoint* point, const PhaseAt* phase, const real* x, ";
    text_->write_by_contact("model_reset", at + "real* out", "point phase x out", resets);
    text_->write_by_contact("model_reset_along", at + "const real* dx, real* out",
                            "point phase x dx out", carried_on);
    text_->write_by_contact("model_reset_rates", at + "const real* dx, real* out",
                            "point phase x dx out", rates);
    text_->write_by_contact("model_reset_turn", at + "real* out", "point phase x out", turns);
  }

 private:
  NodeId along(NodeId value, const std::vector<NodeId>& by) {
    return derivative_along(&formula_->graph, value, formula_->states, by);
  }
  bool has_resets() const { return std::ranges::any_of(lowered_.surfaces, is_reset); }

  // Values of all surfaces; how they change along dx while the phase stands still, and in time;
  // and, of what is held, how that changes along a tangent vector while dx stays.
  void write_values(const std::string& name, NodeId Surface::*value, NodeId Surface::*drift) {
    std::vector<Assignment> values, moved, rates, bends;
    for (std::size_t i = 0; i < lowered_.surfaces.size(); ++i) {
      const Surface& surface = lowered_.surfaces[i];
      const NodeId still = along(surface.*value, dx_);
      const NodeId rate = formula_->graph.make(Operation::add, {still, surface.*drift});
      values.emplace_back(fmt::format("levels[{}]", i), surface.*value);
      moved.emplace_back(fmt::format("rates[{}]", i), still);
      rates.emplace_back(fmt::format("rates[{}]", i), rate);
      bends.emplace_back(fmt::format("bends[{}]", i), along(rate, w_));
    }
    const std::string at = "const ModelPoint* point, const PhaseAt* phase, const real* x, ";
    text_->write_function(fmt::format("model_{}_values", name), at + "real* levels", values,
                          "point phase x");
    text_->write_function(fmt::format("model_{}_along", name), at + "const real* dx, real* rates",
                          moved, "point phase x dx");
    text_->write_function(fmt::format("model_{}_rates", name), at + "const real* dx, real* rates",
                          rates, "point phase x dx");
    if (name != "held" && has_resets()) return;
    text_->write_function(fmt::format("model_{}_bends", name),
                          at + "const real* dx, const real* w, real* bends", bends,
                          "point phase x dx w");
  }

  Formula* formula_;
  const Lowered& lowered_;
  KernelText* text_;
  std::vector<NodeId> dx_, w_;  // symbols: [state]
};

}  // namespace

void write_surface_lists(const Lowered& lowered, KernelText* text) {
  text->out +=
      fmt::format("#define MODEL_SURFACES {}\n#define MODEL_STAIRCASE(surface) ({})\n",
                  lowered.surfaces.size(), surfaces_where(lowered, &Surface::is_staircase));
  std::vector<std::string> slopes;
  for (const auto& [coef, slope] : lowered.phase_slopes) {
    slopes.push_back(fmt::format("w{}, w{}", coef, slope));
  }
  text->write_list("MODEL_PHASE_SLOPES", slopes);
  if (std::ranges::none_of(lowered.surfaces, is_reset)) return;
  text->out += fmt::format("#define MODEL_HAS_RESETS\n#define MODEL_RESETS(surface) ({})\n",
                           surfaces_where(lowered, is_reset));
}

void write_surfaces(Formula* formula, const Lowered& lowered, KernelText* text) {
  SurfaceWriter(formula, lowered, text).write();
}

}  // namespace gearsweep
