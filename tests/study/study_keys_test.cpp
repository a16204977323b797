// What the table of keys says is what the reader does: it is what the manual page tells.
#include "study/study_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "study/refusal.hpp"
#include "study/settings.hpp"
#include "study/study.hpp"

namespace gearsweep {
namespace {

using gearsweep::testing::refusal;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const char* const kGear =
    "[gear]\nteeth = [40, 40]\nmodule_mm = 3.0\ninertia_kg_mm2 = 2230.0\nmass_kg = 1.0\n"
    "bearing_stiffness_N_per_mm = 3.0e5\nbearing_damping_N_s_per_mm = 1.4\n"
    "mesh_damping_N_s_per_mm = 0.7\nface_width_mm = 20.0\nhalf_backlash_mm = 0.05\n"
    "torque_N_m = 61.3\ntransmission_error_um = 30.0\n";
const char* const kTwoPoints = "[[axes]]\nname = 'omega'\nfrom = 0.5\nto = 0.7\ncount = 2\n";

const char* const kTolerance = "mu = {distribution = 'normal', std = 0.001}\n";

// A study with one key set beside what a study needs; the key's own line comes last in its table.
std::string study_with(const StudyTable& table, const std::string& key, const std::string& value) {
  const std::string line = key + " = " + value + "\n";
  const auto without = [&](std::string text) {
    const std::size_t at = text.find("\n" + key + " = ");
    if (at != std::string::npos) text.erase(at, text.find('\n', at + 1) - at);
    return text;
  };
  if (table.name.empty()) return line + (key == "axes" ? "" : kTwoPoints);
  if (table.name == "axes") return without(kTwoPoints) + line;
  if (table.name == "gear") return without(kGear) + line + kTwoPoints;
  if (key == "slope") {
    return table.heading + "\nnames = ['mu', 'time_share']\nnumbers = '0.1, 1'\n" + line;
  }
  if (table.name == "uncertain") return table.heading + "\n" + kTolerance + line + kTwoPoints;
  return table.heading + "\n" + line + kTwoPoints;
}

// All that the keys of a study decide, in words.
std::string described(const Study& study) {
  std::string text = resolved_settings(study) + study.title + study.preset;
  const Initial& initial = study.initial;
  const Integrate& integrate = study.integrate;
  text += std::to_string(static_cast<int>(initial.policy)) + " " + std::to_string(initial.ensemble);
  text += " " + std::to_string(initial.seed) + " " + std::to_string(integrate.lanes);
  for (const double spread : initial.spread) text += " " + std::to_string(spread);
  text += " " + std::to_string(integrate.tile) + " " + std::to_string(integrate.local_size);
  text += " " + std::to_string(integrate.round) + " " + std::to_string(integrate.contract);
  text += " " + std::to_string(static_cast<int>(integrate.engine));
  text += " " + std::to_string(study.selection.period_tolerance * 1e9);
  text += " " + std::to_string(study.axes.front().logarithmic);
  for (const UncertainParameter& parameter : study.uncertain.parameters) {
    text += fmt::format(" {}", fmt::join(parameter.draws.values, " "));
  }
  text += fmt::format(" {}", fmt::join(study.uncertain.percentiles, " "));
  return text;
}

// A date is no value of any key: whoever reads the key says so.
TEST(StudyKeys, EveryKeyOfTheTableIsRead) {
  for (const StudyTable& table : study_tables()) {
    for (const StudyKey& key : table.keys) {
      if (key.is_pattern) continue;
      EXPECT_THAT(refusal(study_with(table, key.name, "1979-05-27")),
                  AllOf(HasSubstr(key.name), Not(HasSubstr("unknown key"))))
          << table.heading;
    }
  }
}

TEST(StudyKeys, NoOtherKeyIsAccepted) {
  for (const StudyTable& table : study_tables()) {
    if (table.name == "parameters" || table.name == "sections") continue;  // names of one's own
    EXPECT_THAT(refusal(study_with(table, "nonsense", "1")), HasSubstr("unknown key 'nonsense'"))
        << table.heading;
  }
}

TEST(StudyKeys, ADefaultIsWhatAStudyHasWithoutTheKey) {
  int tried = 0;
  for (const StudyTable& table : study_tables()) {
    for (const StudyKey& key : table.keys) {
      const bool is_value = !key.fallback.empty() && key.fallback.find(' ') == std::string::npos &&
                            key.fallback != "required" && key.fallback != "from";
      const bool is_of_ensemble =
          table.name == "initial" && (key.name == "seed" || key.name == "spread");
      if (!is_value || key.is_pattern || is_of_ensemble) continue;
      const std::string others = table.name == "gear"        ? kGear
                                 : table.name == "uncertain" ? table.heading + "\n" + kTolerance
                                                             : "";
      const Study without = read_study(others + kTwoPoints, "");
      EXPECT_EQ(described(read_study(study_with(table, key.name, key.fallback), "")),
                described(without))
          << key.name << " = " << key.fallback;
      ++tried;
    }
  }
  EXPECT_GE(tried, 18);
  const std::string ensemble = std::string(kTwoPoints) + "[initial]\nensemble = 4\n";
  for (const char* name : {"seed", "spread"}) {
    const std::string& fallback = find_key(study_table("initial"), name)->fallback;
    EXPECT_EQ(described(read_study(ensemble + name + " = " + fallback + "\n", "")),
              described(read_study(ensemble, "")));
  }
}

// A value of a key, as TOML, in a study where nothing else refuses it.
std::string study_with_number(const StudyTable& table, const StudyKey& key, double value) {
  const bool is_whole = key.type == "whole number";
  const std::string text =
      is_whole ? fmt::format("{}", static_cast<long long>(value)) : fmt::format("{}", value);
  std::string study = study_with(table, key.name, text);
  if (table.name == "initial" && key.name == "seed")
    study = kTwoPoints + ("[initial]\nensemble = 4\nseed = " + text);
  if (key.name == "mesh_stiffness_N_per_m") study.erase(study.find("face_width_mm"), 21);
  return study;
}

TEST(StudyKeys, RangesEndWhereTheTableSays) {
  for (const StudyTable& table : study_tables()) {
    for (const StudyKey& key : table.keys) {
      if (key.type != "whole number" && key.type != "number") continue;
      if (key.min == 0.0 && key.max == 0.0) continue;
      const auto step = [&](double end) {
        return key.type == "whole number" ? 1.0 : end > 0.0 ? 0.01 * end : 0.01;
      };
      for (const double value : {key.min - step(key.min), key.max + step(key.max)}) {
        EXPECT_THAT(refusal(study_with_number(table, key, value)),
                    ::testing::AnyOf(HasSubstr("out of range"), HasSubstr("is possible"),
                                     HasSubstr("is needed")))
            << table.heading << " " << key.name << " = " << value;
      }
    }
  }
}

// doc/gear.md has a row for each key of [gear], in their order.
TEST(StudyKeys, ThePageOfTheGearHasThem) {
  std::string rows;
  for (const StudyKey& key : study_table("gear").keys) {
    const bool has_range = key.min != 0.0 || key.max != 0.0;
    rows += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, key.type,
                        has_range ? fmt::format("{:g} to {:g}", key.min, key.max)
                                  : fmt::format("{}", fmt::join(key.choices, ", ")),
                        key.fallback, key.meaning);
  }
  std::ifstream in(GEARSWEEP_SOURCE "/doc/gear.md");
  std::string shown;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("| `")) shown += line + "\n";
  }
  EXPECT_EQ(shown, rows);
}

TEST(StudyKeys, AKeyOutsideItsTableIsToldWhereItBelongs) {
  EXPECT_THAT(refusal(kTwoPoints, {"mu=0.1"}),
              HasSubstr("--set mu=0.1: unknown key 'mu' in the study; "
                        "did you mean 'parameters.mu'?"));
  EXPECT_THAT(refusal(kTwoPoints, {"settle=9"}), HasSubstr("'integrate.settle'"));
  EXPECT_THAT(refusal(kTwoPoints, {"backlash=dynamic"}), HasSubstr("'model.backlash'"));
  EXPECT_THAT(refusal(kTwoPoints, {"quantities=x1_rms"}), HasSubstr("'observe.quantities'"));
  EXPECT_THAT(refusal(kTwoPoints, {"count=9"}), HasSubstr("'axes.AXIS.count'"));
  EXPECT_THAT(refusal(kTwoPoints, {"name=gear1"}), HasSubstr("'model.name' or 'axes.AXIS.name'"));
  EXPECT_THAT(refusal(kTwoPoints, {"rho=28", "model.name=lorenz"}), HasSubstr("'parameters.rho'"));
  EXPECT_THAT(refusal(std::string("mu = 0.1\n") + kTwoPoints),
              HasSubstr("s.toml:1: unknown key 'mu' in the study; did you mean 'parameters.mu'?"));
}

TEST(StudyKeys, ATitleHasAnEnd) {
  // Letters of two bytes: they are counted, not their bytes.
  std::string title;
  for (int i = 0; i < 1000; ++i) title += "\xc3\xa4";
  EXPECT_EQ(read_study("title = '" + title + "'\n" + kTwoPoints, "s.toml").title, title);
  EXPECT_THAT(refusal("title = '" + title + "x'\n" + kTwoPoints),
              HasSubstr("s.toml:1: title has 1001 characters; at most 1000 are possible"));
}

TEST(StudyKeys, AnAxisHasAnEnd) {
  std::string values = "[[axes]]\nname = 'omega'\nvalues = [0";
  for (int i = 0; i < 1000000; ++i) values += ",1";
  EXPECT_THAT(refusal(values + "]\n"),
              HasSubstr("axis 'omega' has 1000001 values; at most 1000000 are possible"));
  EXPECT_THAT(refusal("[[axes]]\nname = 'omega'\nfrom = 0.1\nto = 1\ncount = 1000001\n"),
              HasSubstr("count = 1000001; at most 1000000 is possible"));
}

}  // namespace
}  // namespace gearsweep
