// How breaks are found at one setting.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "equations/detail/phase_breaks.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kMaxBreaks = 1000;      // breaks of a period
constexpr std::size_t kMaxIntervals = 50000;  // looked at for one function between two breaks
// No grid of phases tells breaks that are closer (plan/phase_grid.cpp); in radians.
constexpr double kClose = 1e-9 * kWholePhase;
// So far around a place where a function only touches a level, rounding may show a crossing.
constexpr double kTouch = 1e-7;
// So long may a function stay within rounding of a level: longer than where two smooth curves
// touch.
constexpr double kMaxTouch = 1e-6 * kWholePhase;

}  // namespace

class PhaseBreaks::Search {
 public:
  Search(const PhaseBreaks& breaks, const std::vector<double>& inputs)
      : breaks_(breaks),
        constants_(breaks.first_step() + breaks.steps_.size()),
        chosen_(&constants_),
        points_(constants_.size()),
        enclosures_(constants_.size()) {
    breaks_.constants_.run(inputs.data(), constants_.data() + 1);
    for (std::size_t i = 1; i < breaks_.first_step(); ++i) {
      points_[i] = constants_[i];
      enclosures_[i] = {{constants_[i], constants_[i]}, {}};
    }
    is_live_ = reached(0);
    for (std::size_t i = 0; i < breaks_.steps_.size(); ++i) {
      const Step& step = breaks_.steps_[i];
      has_choices_ |=
          is_live_[i] && step.operation == Operation::select && step.a >= breaks_.first_step();
    }
  }

  std::vector<double> run() {
    for (const Breaker& breaker : breaks_.breakers_) {
      if (!is_live_[breaker.step]) continue;
      breaker_ = &breaker;
      std::vector<double> found;
      double from = 0.0;
      for (std::size_t i = 0; i <= bounds_.size(); ++i) {
        const double to = i < bounds_.size() ? bounds_[i] : kWholePhase;
        look_between(from, to, &found);
        from = to;
      }
      bounds_.insert(bounds_.end(), found.begin(), found.end());
      tidy();
      if (bounds_.size() > kMaxBreaks) refuse_many();
    }
    return bounds_;
  }

 private:
  struct Span {
    double from, to;
  };

  [[noreturn]] void refuse_many() const {
    throw InputError(fmt::format(
        "{} jumps or bends more than {} times in a period; steps end at each such phase, and there "
        "may be at most {}",
        breaker_->text, kMaxBreaks, kMaxBreaks));
  }
  [[noreturn]] void refuse_untold(double phase) const {
    throw InputError(fmt::format(
        "it cannot be told where in a period {} jumps or bends: from phase {:.6g} on what decides "
        "it does not differ from 0 by more than rounding, or varies too fast",
        breaker_->text, phase));
  }

  // What is too close to another break, or to phase 0, is no break of its own.
  void tidy() {
    std::ranges::sort(bounds_);
    std::vector<double> kept;
    for (const double phase : bounds_) {
      const double before = kept.empty() ? 0.0 : kept.back();
      if (phase > before + kClose && phase < kWholePhase - kClose) kept.push_back(phase);
    }
    bounds_ = std::move(kept);
  }

  // The values in the middle between two breaks; most breakers find no other ones.
  void choose_between(double from, double to) {
    const auto [known, is_new] = middles_.try_emplace({from, to});
    std::vector<double>& values = known->second;
    chosen_ = &values;
    if (!is_new) return;
    values = constants_;
    values[0] = 0.5 * (from + to);
    for (std::size_t i = 0; i < breaks_.steps_.size(); ++i) {
      if (!is_live_[i]) continue;
      const Step& step = breaks_.steps_[i];
      const double a = values[step.a], b = values[step.b];
      values[breaks_.first_step() + i] = step.operation == Operation::table
                                             ? step.table->at(a, b)
                                             : apply(step.operation, a, b, values[step.c]);
    }
  }

  void look_between(double from, double to, std::vector<double>* found) {
    choose_between(from, to);
    if (has_choices_ && !reached(breaks_.ranks_[breaker_->step])[breaker_->step]) return;
    for (const Function& function : breaker_->functions) look_at(function, {from, to}, found);
  }

  // A part that the phase does not change decides what is joined by `and` or `or`.
  bool is_decided(const Step& step) const {
    const bool is_or = step.operation == Operation::disjunction;
    if (!is_or && step.operation != Operation::conjunction) return false;
    const auto decides = [&](std::size_t place) {
      return place > 0 && place < breaks_.first_step() && ((*chosen_)[place] != 0.0) == is_or;
    };
    return decides(step.a) || decides(step.b);
  }

  // The steps that a root is made of where the choices that are known are made: those of conditions
  // below a rank, and those that the phase does not change.
  std::vector<bool> reached(std::size_t rank) const {
    const std::size_t first = breaks_.first_step();
    std::vector<bool> seen(breaks_.steps_.size(), false);
    std::vector<std::size_t> open;
    const auto push = [&](std::size_t place) {
      if (place < first || seen[place - first]) return;
      seen[place - first] = true;
      open.push_back(place - first);
    };
    for (const std::size_t root : breaks_.roots_) push(root);
    while (!open.empty()) {
      const Step& step = breaks_.steps_[open.back()];
      open.pop_back();
      if (is_decided(step)) continue;
      const bool is_choice = step.operation == Operation::select;
      const bool is_known = is_choice && (step.a < first || breaks_.ranks_[step.a - first] < rank);
      push(step.a);
      if (!is_known || (*chosen_)[step.a] != 0.0) push(step.b);
      if (!is_known || (*chosen_)[step.a] == 0.0) push(step.c);
    }
    return seen;
  }

  // The value of what does not only choose.
  static double compute(const Step& step, double a, double b) {
    return apply(step.operation, a, b, 0.0);
  }
  static Enclosure compute(const Step& step, const Enclosure& a, const Enclosure& b) {
    return enclose(step.operation, a, b);
  }
  double read(const Step& step, double a) const { return step.table->at(a, (*chosen_)[step.a]); }
  Enclosure read(const Step& step, const Enclosure& a) const {
    const PeriodicTable::Range range =
        step.table->range(a.value.low, a.value.high, (*chosen_)[step.a]);
    const Enclosure slope{rounded(range.slope_low, range.slope_high), {}};
    return {rounded(range.low, range.high),
            enclose(Operation::multiply, slope, {a.slope, {}}).value};
  }
  static double constant(double value, double) { return value; }
  static Enclosure constant(double value, const Enclosure&) { return {{value, value}, {}}; }

  // A step where all that chooses does so as in the middle between the breaks.
  template <class Value>
  Value value_of(std::size_t index, const std::vector<Value>& values) const {
    const Step& step = breaks_.steps_[index];
    const Value &a = values[step.a], &b = values[step.b];
    const double at_a = (*chosen_)[step.a], at_b = (*chosen_)[step.b];
    switch (step.operation) {
      case Operation::select:
        return at_a != 0.0 ? b : values[step.c];
      case Operation::min:
        return at_b < at_a ? b : a;
      case Operation::max:
        return at_a < at_b ? b : a;
      case Operation::absolute:
        return at_a < 0.0 ? -a : a;
      case Operation::stop:
        return at_b < at_a ? a - b : constant(0.0, a);
      case Operation::backlash: {
        const bool drives = at_b < at_a, backs = at_a < -at_b;
        if (drives && backs) return a + a;
        return drives ? a - b : backs ? a + b : constant(0.0, a);
      }
      case Operation::sign:
      case Operation::floor:
        return constant((*chosen_)[breaks_.first_step() + index], a);
      case Operation::table:
        return read(step, a);
      default:
        break;
    }
    if (step.is_condition) return constant((*chosen_)[breaks_.first_step() + index], a);
    return compute(step, a, b);
  }

  template <class Value>
  Value run(const Function& function, const Value& phase, std::vector<Value>* values) const {
    (*values)[0] = phase;
    for (const std::size_t i : breaker_->cone) {
      (*values)[breaks_.first_step() + i] = value_of(i, *values);
    }
    Value all = (*values)[function.a];
    if (function.sign < 0.0) all = all - (*values)[function.b];
    if (function.sign > 0.0) all = all + (*values)[function.b];
    if (function.offset != 0.0) all = all + constant(function.offset, all);
    return all;
  }
  double at(const Function& function, double phase) { return run(function, phase, &points_); }
  Enclosure over(const Function& function, const Span& span) {
    return run(function, {{span.from, span.to}, {1.0, 1.0}}, &enclosures_);
  }

  // Rising; no more than one above the limit.
  static std::vector<double> levels_in(const Function& function, double low, double high) {
    if (function.levels == Levels::zero) {
      return low <= 0.0 && 0.0 <= high ? std::vector<double>{0.0} : std::vector<double>{};
    }
    const bool is_table = function.levels == Levels::table;
    const double length = is_table                           ? kWholePhase
                          : function.levels == Levels::poles ? std::numbers::pi
                                                             : 1.0;
    const std::vector<double> one = {function.levels == Levels::poles ? 0.5 * length : 0.0};
    const std::vector<double>& offsets = is_table ? function.phases : one;
    std::vector<double> levels;
    const double first = std::floor(low / length) - 1.0;
    for (double n = first; n * length <= high && levels.size() <= kMaxBreaks; ++n) {
      if (n + 1.0 == n) return std::vector<double>(kMaxBreaks + 1, n * length);
      for (const double offset : offsets) {
        const double level = offset + n * length;
        if (low <= level && level <= high && levels.size() <= kMaxBreaks) levels.push_back(level);
      }
    }
    return levels;
  }
  static bool has_level(const Function& function, const Interval& values) {
    if (!values.is_finite()) return true;
    return !levels_in(function, values.low, values.high).empty();
  }

  void look_at(const Function& function, const Span& whole, std::vector<double>* found) {
    std::vector<Span> open = {whole}, leaves;
    std::size_t count = 0;
    while (!open.empty()) {
      const Span span = open.back();
      open.pop_back();
      const Enclosure values = over(function, span);
      if (values.is_constant() || !has_level(function, values.value)) continue;
      if (values.value.is_finite() && (values.slope.low > 0.0 || values.slope.high < 0.0)) {
        take_crossings(function, span, whole, found);
      } else if (span.to - span.from < kClose) {
        const bool goes_on = !leaves.empty() && span.from <= leaves.back().to;
        if (goes_on) leaves.back().to = span.to;
        if (!goes_on) leaves.push_back(span);
        if (leaves.back().to - leaves.back().from > kMaxTouch) refuse_untold(span.from);
      } else {
        const double middle = 0.5 * (span.from + span.to);
        open.push_back({middle, span.to});
        open.push_back({span.from, middle});
      }
      if (++count > kMaxIntervals) refuse_untold(span.from);
    }
    for (const Span& leaf : leaves) take_leaf(function, leaf, whole, found);
  }

  // What is too close to the breaks around it is one of these: values are those of the middles
  // between breaks, so nothing but that short piece is lost.
  void take(double phase, const Span& whole, std::vector<double>* found) const {
    if (phase <= whole.from + kTouch || phase >= whole.to - kTouch) return;
    if (!found->empty() && std::fabs(phase - found->back()) < kClose) return;
    found->push_back(phase);
    if (found->size() > kMaxBreaks) refuse_many();
  }

  // A zero that only touches, a pole, or several that no step tells apart: one break.
  void take_leaf(const Function& function, const Span& leaf, const Span& whole,
                 std::vector<double>* found) {
    const auto is_near = [&](double phase) {
      return leaf.from - kTouch < phase && phase < leaf.to + kTouch;
    };
    std::erase_if(*found, is_near);
    if (is_near(whole.from) || is_near(whole.to)) return;
    found->push_back(inside(function, leaf));
  }

  // Where the function rises or falls all along.
  void take_crossings(const Function& function, const Span& span, const Span& whole,
                      std::vector<double>* found) {
    const double first = at(function, span.from), last = at(function, span.to);
    const std::vector<double> levels =
        levels_in(function, std::min(first, last), std::max(first, last));
    if (levels.size() > kMaxBreaks) refuse_many();
    for (const double level : levels) {
      take(crossing(function, level, span), whole, found);
    }
  }

  double inside(const Function& function, const Span& leaf) {
    const double first = at(function, leaf.from), last = at(function, leaf.to);
    const std::vector<double> levels =
        levels_in(function, std::min(first, last), std::max(first, last));
    return levels.empty() ? 0.5 * (leaf.from + leaf.to) : crossing(function, levels[0], leaf);
  }

  // Newton's method, with halves where that leaves the span.
  double crossing(const Function& function, double level, Span span) {
    constexpr double kRounding = 2e-16 * kWholePhase;
    const bool rises = at(function, span.from) < at(function, span.to);
    double phase = 0.5 * (span.from + span.to);
    while (true) {
      const Enclosure here = over(function, {phase, phase});
      const double off = at(function, phase) - level;
      if (off == 0.0) return phase;
      ((off < 0.0) == rises ? span.from : span.to) = phase;
      double next = phase - off / here.slope.middle();
      if (!(span.from < next && next < span.to)) next = 0.5 * (span.from + span.to);
      if (std::fabs(next - phase) < kRounding || span.to - span.from < kRounding) return next;
      phase = next;
    }
  }

  const PhaseBreaks& breaks_;
  const Breaker* breaker_ = nullptr;
  // [place]: in the middle between two breaks, at a phase, over an interval.
  std::vector<double> constants_;      // in their places; the others are 0
  const std::vector<double>* chosen_;  // one of middles_, or the constants
  std::vector<double> points_;
  std::vector<Enclosure> enclosures_;
  std::map<std::pair<double, double>, std::vector<double>> middles_;
  std::vector<bool> is_live_;  // [step]: whatever the phase is
  bool has_choices_ = false;   // that the phase makes
  std::vector<double> bounds_;
};

std::vector<double> PhaseBreaks::search(const std::vector<double>& inputs) const {
  return Search(*this, inputs).run();
}

}  // namespace gearsweep
