// A motion that the host follows to learn which step it takes (study/own_step.hpp).
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "model/held_step.hpp"
#include "model/model.hpp"
#include "study/detail/field_reach.hpp"

namespace gearsweep {

class ProbeMotion {
 public:
  static constexpr double kForcedSteps = 16.0;  // of a period of the forcing, at least

  // model: outlives it. start: one number per state.
  ProbeMotion(const Model& model, ModelSetting setting, std::vector<double> start);

  // What a stretch of the motion tells of the step that it takes.
  struct Stretch {
    // The longest step that keeps the local error at this share of each state's range; infinite
    // where nothing moves.
    double step_of(double local_error) const;
    // The shortest time in which a surface's level goes through what it ranges over, or, of a
    // staircase, from one step to the next; infinite where none moves. A level that varies by
    // rounding does not, nor one of a surface that the motion comes to rest at: of the flights
    // that lead there each is shorter than the one before.
    double level_time(const Model& model) const;

    struct Step {
      double length;
      std::vector<double> errors;  // [state]
    };
    std::vector<Step> steps;                        // that were counted
    std::vector<double> low, high;                  // [state], over the stretch
    std::vector<double> low_signals, high_signals;  // [signal]
    std::vector<double> rounding;                   // [state]: what varies by less is rounding
    std::vector<double> low_levels, high_levels;    // [surface]
    std::vector<double> level_speeds;               // [surface]: the fastest
    std::vector<double> level_sizes;                // [surface]: of the level's terms, the largest
    std::vector<bool> rests;                        // [surface]: where a reset may end in rest
    double first_rate = 0.0;                        // at its start
    double rate = 0.0;  // the largest modulus of the Jacobian's eigenvalues
  };
  // Goes on by so many steps, each as long as the local error allows, through at least a period of
  // the forcing. Ends early where a number overflows.
  Stretch go_on(std::size_t steps);

  // Whether the equations and their Jacobian are numbers where it is.
  bool has_finite_rates() const;
  // Whether it went to infinity.
  bool escapes() const { return escapes_; }
  // Times at which it came up through the model's first section, at the ends of steps.
  const std::vector<double>& returns() const { return returns_; }
  double period() const { return period_; }
  // From now on maxima of each state are looked at.
  void watch_peaks() { peaks_.assign(x_.size(), {}); }
  // [state]: whether it came to maxima, and turned there as fast as what comes and goes does. A
  // state that stays at its largest value does not, nor one that varies by rounding.
  std::vector<bool> has_peaks() const;

 private:
  struct Trial {
    std::vector<double> middle, end, errors;
    double excess = 0.0;  // the largest error, relative to the state's range
  };

  // The step that go_on() takes next.
  struct NextStep {
    double length = 0.0, max_length = 0.0;
    double left = -1.0;        // to the end of the segment, where the step shall end there
    bool meets_pulse = false;  // ends where one begins
    bool is_smooth = true;     // no bend or jump is in it
    bool is_short = false;     // to where it shall end: its error is rounding alone
    double fit = 0.0;          // as long as the error lets it be
    int hidden = 0;            // halvings because of what a step may hide
    Trial trial;
    bool ends_segment() const { return length == left; }
  };

  // The maxima of a state.
  struct Peaks {
    std::size_t count = 0;
    double first = 0.0, last = 0.0;  // times
    double turns = 0.0;              // sum of the rates at which its rate falls there
    double fastest = 0.0;            // rate of the state, up or down
    double rate = 0.0;               // where the last step ended
    double low = 0.0, high = 0.0, rounding = 0.0;
  };

  // Puts the phase forward, by so many periods or to the next pulse. Returns the periods.
  double leap(double turns);
  NextStep aim(const Stretch& stretch);
  // Halves the step until its error is small, it hides nothing, or what is in it is no smooth
  // motion's error. Sets escapes_ where it becomes too short.
  void shorten(const Stretch& stretch, NextStep* next);
  void take(NextStep* next, Stretch* stretch);
  void set_next_length(const NextStep& taken);
  std::vector<double> coefs_at(double phase) const;
  void look_at_peaks(const Stretch& stretch, double length);
  void find_pulses();
  // The next phase, behind this one, at which a pulse begins; above 1 where there is none.
  double next_pulse(double phase) const;
  void look_at_signals(Stretch* stretch);
  void look_at_section(const std::vector<double>& signals, double time);
  void look_at_rates(Stretch* stretch) const;
  void look_at_levels(const double* coefs, const double* x, Stretch* stretch);
  // A part of a step of `length`, from one share of it to another.
  std::vector<double> step(const StepMoments& moment_at, double begin, double end,
                           const std::vector<double>& from);
  Trial attempt(const Stretch& stretch, double length);
  // Whether the equations may have more between the moments of a step than these show.
  bool hides_something(const Stretch& stretch, const Trial& trial, double length);
  // Whether a bend or a jump that steps know of explains what a step to `end` is wrong by; what
  // else looks like one is steep.
  bool may_bend(const Trial& trial, double length, double end_phase);
  StepMoments moments_of(double length) const;
  // Sets the sides of surfaces by where it is.
  void look_at_sides();
  // Whether the motion meets a surface in a step to `end`; then `end` is made that of the step that
  // is cut there.
  bool meets_surface(double length, std::vector<double>* end, Stretch* stretch);
  bool crosses_limit(const std::vector<double>& end, double end_phase) const;

  const Model& model_;
  const ModelSetting setting_;
  const bool is_forced_;
  const std::unique_ptr<PreparedPoint> point_;
  const Model::PhaseRow row_at_;
  HeldField held_;
  HeldStep held_step_;
  std::optional<FieldReach> reach_;  // of a model whose field neither jumps nor has a phase
  const bool is_rough_;              // it bends or jumps where steps do not know of it
  const double period_;
  std::vector<double> bounds_;  // of the segments between jumps, from 0 to 1
  // Where coefficients begin to change much faster than on average, rising. A step from well before
  // such a place may end well behind it and see nothing.
  std::vector<double> pulses_;
  std::vector<double> x_;
  std::size_t segment_ = 0;
  double phase_ = 0.0;
  double length_ = 0.0;  // of the next step
  double time_ = 0.0;    // since the start
  double level_ = 0.0;   // of the first section
  std::vector<double> returns_;
  std::vector<Peaks> peaks_;  // [state]; empty: nobody looks
  // How often steps that may hide something are halved. Where equations have no bound on a motion's
  // way, that never ends.
  std::size_t halvings_left_ = 10000;
  bool escapes_ = false;
};

}  // namespace gearsweep
