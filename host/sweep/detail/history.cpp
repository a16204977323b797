#include "sweep/detail/history.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "model/held_step.hpp"

namespace gearsweep {
namespace {

class History {
 public:
  History(const Plan& plan, std::size_t point, const std::vector<double>& rows)
      : model_(*plan.study().model),
        setting_(plan.setting_of(point)),
        point_(model_.prepare(setting_)),
        row_at_(model_.phase_rows(setting_)),
        held_(model_, point_.get()),
        held_step_(&held_),
        grid_(plan.phase_grid_of(point)),
        bounds_(segment_bounds(model_, setting_)),
        rows_(rows) {}

  Trace at_steps() {
    Trace trace = empty();
    for_each_step([&](const Step& step) {
      if (step.is_first) {
        look_at(step, 0.0, step.start);
        add(step.from, step.coefs, step.start, &trace);
      }
      add_surfaces(step, &trace);
      look_at(step, 1.0, step.end);
      add(step.to, step.coefs + 2 * model_.phase_coefs.size(), step.end, &trace);
    });
    return trace;
  }

  Trace resampled(std::size_t per_period) {
    Trace trace = empty();
    const std::size_t states = model_.states.size();
    std::vector<double> slope_from(states), slope_to(states), x(states);
    std::vector<double> coefs(model_.phase_coefs.size());
    std::size_t next = 0;
    for_each_step([&](const Step& step) {
      const auto phase_of = [&](std::size_t sample) {
        return static_cast<double>(sample) / static_cast<double>(per_period);
      };
      if (!model_.surfaces.empty()) {
        look_at(step, 0.0, step.start);
        const auto take = [&](double from, double to, const HeldMotion& before,
                              const HeldMotion& after) {
          for (; phase_of(next) < step.from + to * (step.to - step.from); ++next) {
            const double share = (phase_of(next) - step.from) / (step.to - step.from);
            HeldMotion motion = before;
            held_step_.carry(moments_of(step), from, share, &motion);
            add_held(phase_of(next), moments_of(step)(share), motion.state.data(), &trace);
            event_ = 0;
          }
          if (const int event = event_at(step, to, after); event != 0) event_ = event;
        };
        HeldMotion motion{Eigen::VectorXd::Map(step.start, static_cast<Eigen::Index>(states)), {}};
        held_step_.take(moments_of(step), &motion, take);
        return;
      }
      bool has_slopes = false;
      for (; phase_of(next) < step.to; ++next) {
        if (!has_slopes) {
          point_->rhs(step.coefs, step.start, slope_from.data());
          point_->rhs(step.coefs + 2 * coefs.size(), step.end, slope_to.data());
          has_slopes = true;
        }
        const double h = (step.to - step.from) * point_->period();
        const double s = (phase_of(next) - step.from) / (step.to - step.from);
        for (std::size_t i = 0; i < states; ++i) {
          const double a = step.start[i], b = step.end[i];
          x[i] = a + s * s * (3.0 - 2.0 * s) * (b - a) +
                 h * s * (1.0 - s) * ((1.0 - s) * slope_from[i] - s * slope_to[i]);
        }
        const double phase = phase_of(next) - std::floor(step.from);
        row_at_(std::min(phase, 1.0), step.inside, coefs.data());
        add(phase_of(next), coefs.data(), x.data(), &trace);
      }
    });
    return trace;
  }

 private:
  struct Step {
    double from = 0.0, to = 0.0;    // in periods
    const double* start = nullptr;  // states
    const double* end = nullptr;
    const double* coefs = nullptr;  // rows of phase coefficients: start, middle, end
    double inside = 0.0;            // a phase of this segment
    bool is_first = false;          // of its segment
  };

  StepMoments moments_of(const Step& step) const {
    return {&row_at_,
            model_.phase_coefs.size(),
            step.from - std::floor(step.from),
            step.to - step.from,
            step.inside,
            point_->period(),
            step.coefs};
  }

  // Holds the sides of surfaces that a state at a share of the step is on, and slides along them
  // where it does.
  void look_at(const Step& step, double share, const double* x) {
    if (model_.surfaces.empty()) return;
    const StepMoments moment_at = moments_of(step);
    held_.begin(moment_at(share).data(), moment_at.length * moment_at.period, x);
    held_.signals(moment_at(share).data(), x, shown_.data());
  }

  // What the channel kEvents has of a motion that comes to a share of a step.
  int event_at(const Step& step, double share, const HeldMotion& motion) {
    if (share == 1.0) return 0;
    const auto met = held_.left_behind(moments_of(step)(share).data(), motion.state.data());
    leaves_ = met && *met < model_.surfaces.size() && held_.slides(*met);
    return met && *met < model_.surfaces.size() ? number_of(*met) : 0;
  }

  int number_of(std::size_t surface) const {
    const int number = static_cast<int>(surface) + 1;
    return model_.surfaces[surface].resets ? number : -number;
  }

  // The moments before and behind each surface within a step, which are the same.
  void add_surfaces(const Step& step, Trace* trace) {
    if (model_.surfaces.empty()) return;
    look_at(step, 0.0, step.start);
    const StepMoments moment_at = moments_of(step);
    const auto add_at = [&](double share, const HeldMotion& motion) {
      add_held(step.from + share * (step.to - step.from), moment_at(share), motion.state.data(),
               trace);
    };
    event_ = 0;
    Eigen::VectorXd came;  // to the surface
    const auto take = [&](double from, double to, const HeldMotion& before,
                          const HeldMotion& after) {
      // Through a surface that resets on the other way.
      if (event_ > 0 && !leaves_ && before.state == came) {
        drop_last(trace);
        event_ = 0;
      }
      if (event_ != 0) add_at(from, before);
      event_ = event_at(step, to, after);
      if (event_ == 0) return;
      came = after.state;
      add_at(to, after);
    };
    HeldMotion motion{
        Eigen::VectorXd::Map(step.start, static_cast<Eigen::Index>(model_.states.size())), {}};
    held_step_.take(moment_at, &motion, take);
    event_ = 0;
  }

  static void drop_last(Trace* trace) {
    trace->tau.pop_back();
    for (std::vector<double>& values : trace->values) values.pop_back();
  }

  template <class Visit>
  void for_each_step(const Visit& visit) const {
    const std::size_t states = model_.states.size();
    const std::size_t width = model_.phase_coefs.size();
    const double* row = rows_.data();
    const double* const end = row + rows_.size();
    for (std::size_t period = 0; row < end; ++period) {
      const double* coefs = grid_.coefs.data();
      for (std::size_t segment = 0; segment < grid_.segment_steps.size(); ++segment) {
        const std::size_t steps = grid_.segment_steps[segment];
        const double first = bounds_[segment], last = bounds_[segment + 1];
        const auto place = [&](std::size_t step) {
          const double share = static_cast<double>(step) / static_cast<double>(steps);
          return static_cast<double>(period) +
                 (step == steps ? last : first + share * (last - first));
        };
        for (std::size_t step = 0; step < steps; ++step) {
          visit(Step{place(step), place(step + 1), row, row + states, coefs, 0.5 * (first + last),
                     step == 0});
          row += states;
          coefs += 2 * width;
        }
        row += states;
        coefs += width;
      }
    }
  }

  Trace empty() const {
    Trace trace;
    trace.setting = setting_;
    trace.period = point_->period();
    trace.mesh_periods = model_.mesh_periods(setting_);
    trace.is_clockless = model_.is_clockless;
    trace.channels = model_.states;
    std::ranges::copy_if(model_.signals, std::back_inserter(trace.channels),
                         [](const ChannelInfo& signal) { return !signal.is_hidden; });
    for (const ContactInfo& contact : model_.contacts) {
      trace.channels.push_back(
          {contact.name.empty() ? "contact" : contact.name + "_contact", "1",
           "1 on the drive flank, 0 in the gap, -1 on the back flank, 2 on both"});
    }
    if (!model_.surfaces.empty()) trace.channels.push_back(event_channel());
    trace.values.resize(trace.channels.size());
    return trace;
  }

  // "surface that the motion comes to, or leaves: 1 wall, which resets the state; -2 sign(v -
  // belt); 0 none"
  ChannelInfo event_channel() const {
    std::string meaning = "surface that the motion comes to, or leaves: ";
    for (std::size_t i = 0; i < model_.surfaces.size(); ++i) {
      const SurfaceInfo& surface = model_.surfaces[i];
      meaning += fmt::format(
          "{} {}; ", number_of(i),
          surface.resets ? surface.name + ", which resets the state" : surface.expression);
    }
    return {kEvents, "1", meaning + "0 none"};
  }

  void add(double periods, const double* coefs, const double* x, Trace* trace) {
    if (model_.surfaces.empty()) point_->signals(coefs, x, shown_.data());
    add_signals(periods, x, shown_, trace);
  }

  void add_held(double periods, const std::vector<double>& coefs, const double* x, Trace* trace) {
    held_.signals(coefs.data(), x, shown_.data());
    add_signals(periods, x, shown_, trace);
  }

  void add_signals(double periods, const double* x, const std::vector<double>& signals,
                   Trace* trace) const {
    trace->tau.push_back(periods * trace->period);
    std::size_t channel = 0;
    for (std::size_t i = 0; i < model_.states.size(); ++i) trace->values[channel++].push_back(x[i]);
    for (std::size_t i = 0; i < signals.size(); ++i) {
      if (!model_.signals[i].is_hidden) trace->values[channel++].push_back(signals[i]);
    }
    for (const ContactInfo& contact : model_.contacts) {
      const double deflection = signals[contact.deflection], backlash = signals[contact.backlash];
      const bool drive = deflection > backlash;
      const bool back = !contact.is_one_sided && deflection < -backlash;
      trace->values[channel++].push_back(drive && back ? 2.0 : drive ? 1.0 : back ? -1.0 : 0.0);
    }
    if (!model_.surfaces.empty()) trace->values[channel++].push_back(static_cast<double>(event_));
  }

  const Model& model_;
  const ModelSetting setting_;
  const std::unique_ptr<PreparedPoint> point_;
  const Model::PhaseRow row_at_;
  HeldField held_;
  HeldStep held_step_;
  const PhaseGrid grid_;
  const std::vector<double> bounds_;
  const std::vector<double>& rows_;
  std::vector<double> shown_ = std::vector<double>(model_.signals.size());  // signals
  int event_ = 0;        // of the moment that is added next
  bool leaves_ = false;  // where it stayed
};

}  // namespace

Trace trace_of(const Plan& plan, std::size_t point, const std::vector<double>& rows,
               std::size_t samples_per_period) {
  History history(plan, point, rows);
  return samples_per_period > 0 ? history.resampled(samples_per_period) : history.at_steps();
}

}  // namespace gearsweep
