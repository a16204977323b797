// All that the host works out of a model that is text, in double.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "equations/detail/check_message.hpp"
#include "equations/detail/formula.hpp"
#include "equations/detail/lowering.hpp"
#include "equations/detail/phase_breaks.hpp"
#include "equations/detail/phase_waves.hpp"
#include "equations/detail/tape_of_study.hpp"
#include "expression/tape.hpp"
#include "model/model.hpp"

namespace gearsweep {

struct Tapes {
  // Functions of parameters and choices of options; checks: whether each holds, then the values of
  // all of their messages.
  Tape period, cycle, start, jumps, checks, point;
  TapeOfStudy coefs;  // of the turn, a phase inside and the phase
  // Functions of states, sides, point and coefs.
  Tape rhs, jacobian, signals;
  std::map<SurfaceValue, Tape> of_surfaces;
  // What coefs have, given the turn, too.
  PhaseBreaks breaks;
  PhaseWaves waves;
  struct OfContact {
    Tape direction, direction_slope;  // [state], [state][state]
    Tape gradients;                   // of the deflection, then of the backlash, [state]
  };
  Tape contact_places;  // deflection and backlash of each
  std::vector<OfContact> contacts;
  std::size_t states = 0, points = 0, coef_count = 0;
  std::vector<bool> are_staircases;    // [surface]
  std::vector<std::size_t> choices;    // [option]: how many there are; empty where they are made
  std::vector<CheckMessage> messages;  // [check]
  std::size_t listed = 0;              // jumps that the model's file lists
  std::string file;                    // of the model, for messages
};

// definition: for its options and its file. The formula's graph gains what is worked out.
Tapes make_tapes(const ModelDefinition& definition, const Lowered& lowered, Formula* formula);

// Parameters, then 1 for each choice that is made and 0 for the others.
std::vector<double> inputs_of(const Tapes& tapes, const ModelSetting& setting);

// What is wrong with a cycle; empty if nothing.
std::string wrong_cycle(double cycle);
// How many times the phase begins anew in a period of the forcing. Throws InputError.
std::size_t turns_of(const Tapes& tapes, const ModelSetting& setting);

// Model::phase_table.
void write_phase_table(const Tapes& tapes, const ModelSetting& setting,
                       std::span<const PhasePlace> places, double* rows);

// Model::phase_rows: what the setting decides is worked out once, and what a segment decides once
// for all phases of it that follow on each other. For one thread.
class CoefsAt {
 public:
  CoefsAt(const Tapes& tapes, const ModelSetting& setting);
  void operator()(double psi, double inside, double* row);

 private:
  double cycle_;
  Tape coefs_;  // of the turn, a phase inside and the phase
  double inside_ = -1.0;
  std::optional<Tape> in_segment_;  // of the phase, in the segment of inside_
};

}  // namespace gearsweep
