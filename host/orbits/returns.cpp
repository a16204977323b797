#include "orbits/returns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gearsweep {
namespace {

// The state whose maxima are looked at where a model has no section.
std::size_t returning_state(const Model& model) {
  for (std::size_t i = 0; i < model.states.size(); ++i) {
    if (std::ranges::find(model.angles, i) == model.angles.end()) return i;
  }
  return 0;
}

}  // namespace

std::string place_of_returns(const Model& model) {
  if (!model.sections.empty()) return model.sections.front().place;
  return fmt::format("where {} is largest", model.states[returning_state(model)].name);
}

std::string describe_returns(const Model& model, std::size_t count) {
  return fmt::format("{} {} to {}", count, count == 1 ? "return" : "returns",
                     place_of_returns(model));
}

ReturnLevel::ReturnLevel(const Model& model, HeldField* field)
    : model_(model),
      field_(field),
      values_(model.sections.empty() ? model.states.size() : model.signals.size()) {}

double ReturnLevel::operator()(const double* coefs, const double* x) {
  if (model_.sections.empty()) {
    field_->rhs(coefs, x, values_.data());
    return -values_[returning_state(model_)];
  }
  field_->signals(coefs, x, values_.data());
  const SectionInfo& section = model_.sections.front();
  const double rounding = 64.0 * std::numeric_limits<double>::epsilon() * values_[section.size];
  return std::abs(values_[section.level]) <= rounding ? 0.0 : values_[section.level];
}

void ReturnCount::take(double level) {
  if (ends_.empty()) ends_ = {level, level};
  if (ends_.back() <= 0.0 && level > 0.0) ++count_;
  ends_.back() = level;
}

std::size_t ReturnCount::of_closed_way() const {
  if (ends_.empty()) return 0;
  const bool begins_above = ends_.front() > 0.0, ends_above = ends_.back() > 0.0;
  if (begins_above && !ends_above) return count_ + 1;
  return !begins_above && ends_above && count_ > 0 ? count_ - 1 : count_;
}

}  // namespace gearsweep
