// The keys of a study, as one table: the reader takes from it what it accepts and within which
// ranges, the manual page what it tells.
#pragma once

#include <string>
#include <vector>

namespace gearsweep {

// The most steps on a periodic orbit for one of the run.
inline constexpr double kMaxOrbitSteps = 64.0;
// The least that a study may ask for by integrate.tolerance, but for 0, which is none.
inline constexpr double kMinTolerance = 1e-10;

// The most that a state may begin with, and that it may be limited to.
inline constexpr double kMaxState = 1e300;
// Bounds of a step, in the model's time, whose unit may be anything from a nanosecond to a year.
inline constexpr double kMinMaxStep = 1e-15, kMaxMaxStep = 1e15;

// The model of a study that names none.
inline constexpr const char* kDefaultModel = "gear5";

struct StudyKey {
  std::string name;
  std::string type;      // in words: "whole number", "string", "number or [pinion, gear]"
  std::string fallback;  // what a study without it has: TOML, or words; "required"; may be empty
  std::string meaning;
  // The range of a number (in its own unit), both ends included; of a string its largest length.
  // Both 0: not limited here.
  double min = 0.0, max = 0.0;
  std::vector<std::string> choices = {};  // of a string that must be one of them
  bool is_pattern = false;                // the name stands for names of the model
};

struct StudyTable {
  std::string name;     // of the key in the study; empty: the study itself
  std::string heading;  // as messages name it: "[integrate]", "the study"
  std::string meaning;
  std::vector<StudyKey> keys;
};

// The study itself first, then its tables in the order in which studies have them.
const std::vector<StudyTable>& study_tables();

// The table of a name that is there; throws std::logic_error otherwise.
const StudyTable& study_table(const std::string& name);

// nullptr when the table has no such key.
const StudyKey* find_key(const StudyTable& table, const std::string& name);

// "integrate.settle" for "settle": where in a study a key of that name belongs, with the options
// and parameters of a model that are given beside it. Several when several tables have it. Where
// none has it, keys whose names have more words: "gear.pinion_speed_rpm" for "speed_rpm".
std::vector<std::string> paths_of_key(const std::string& name,
                                      const std::vector<std::string>& options,
                                      const std::vector<std::string>& parameters);

}  // namespace gearsweep
