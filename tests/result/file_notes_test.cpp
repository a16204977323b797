// Every variable of every file says what it is: all quantities of all models, all axes, all
// channels of traces, with and without the scales of a [gear] table.
#include "result/detail/file_notes.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "result/detail/netcdf_file.hpp"
#include "result/example_result.hpp"
#include "result/random_result.hpp"
#include "result/trace_file.hpp"
#include "study/builtin_models.hpp"
#include "support/each_model.hpp"

namespace gearsweep {
namespace {

using gearsweep::testing::example_result;
using gearsweep::testing::few_models;
using gearsweep::testing::kProvenance;
using gearsweep::testing::name_of_model;
using gearsweep::testing::other_models;
using gearsweep::testing::random_result;
using gearsweep::testing::studies_over_each;
using gearsweep::testing::study_of_all;
using gearsweep::testing::trace_of_all;

const Scales kScales = {1000.0, 2e-5, 1e8, 250.0};

class FileNotesTest : public gearsweep::testing::IoTest {
 protected:
  std::string written(const Study& study) { return write(random_result(study, 2, &random_)); }

  // A file of all channels, with these parameters beside them.
  std::string traced(const Study& study, const std::vector<std::string>& placed) const {
    const std::string path = in_folder("trace.nc");
    write_traces({trace_of_all(study)}, {"a point"}, placed, study, path, kProvenance);
    return path;
  }

  std::mt19937_64 random_{1};
};

// A variable of a file.
struct Variable {
  const NetcdfFile& file;
  int id;

  std::string text(const std::string& attribute) const {
    return file.text_attribute(id, attribute).value_or("");
  }
  bool is_text() const {
    nc_type type = NC_NAT;
    nc_inq_vartype(file.id(), id, &type);
    return type == NC_CHAR;
  }
  // Its scale; 0 without one, or without a unit of SI.
  double scale() const {
    const std::vector<double> scale = file.number_attribute(id, "scale_to_SI");
    return scale.empty() || text("SI_units").empty() ? 0.0 : scale.front();
  }
};

Variable find(const NetcdfFile& file, const std::string& name) {
  const int id = file.find_variable(name);
  EXPECT_GE(id, 0) << name;
  return {file, id};
}

// Whether a list of this name stands along one of the variable's dimensions.
bool has_list(const Variable& variable, const std::string& list) {
  const int id = variable.file.find_variable(list);
  if (id < 0) return false;
  const std::vector<int> own = variable.file.dimensions_of(variable.id);
  return std::find(own.begin(), own.end(), variable.file.dimensions_of(id).front()) != own.end();
}

// A unit may be one of a list along a dimension: "see state_units", and so may its scale.
void expect_notes(const std::string& path, bool has_scales) {
  const NetcdfFile file = NetcdfFile::open(path);
  EXPECT_FALSE(file.variables().empty());
  for (const std::string& name : file.variables()) {
    SCOPED_TRACE(name);
    const Variable variable = find(file, name);
    EXPECT_NE(variable.text("long_name"), "");
    if (variable.is_text()) continue;
    const std::string units = variable.text("units");
    EXPECT_NE(units, "");
    EXPECT_TRUE(has_scales || variable.scale() == 0.0);
    if (units.starts_with("see ")) {
      const std::string list = units.substr(4);
      EXPECT_TRUE(has_list(variable, list)) << list;
      const std::size_t stem = list.find("_units");
      ASSERT_NE(stem, std::string::npos);
      if (name.ends_with("_scale_to_SI")) continue;
      EXPECT_EQ(has_list(variable, list.substr(0, stem) + "_scale_to_SI"), has_scales);
      EXPECT_EQ(has_list(variable, list.substr(0, stem) + "_SI_units"), has_scales);
    } else if (has_scales && units != "1") {
      EXPECT_GT(variable.scale(), 0.0) << units;
    }
  }
}

class NotesOfModel : public FileNotesTest, public ::testing::WithParamInterface<std::string> {
 protected:
  static const Model& its_model() { return *find_model(GetParam()); }
  static bool may_have_scales() { return its_model().name.starts_with("gear"); }
};

TEST_P(NotesOfModel, EveryQuantityOfAResultSaysWhatItIs) {
  const Model& model = its_model();
  for (const bool has_scales : {false, true}) {
    if (has_scales && !may_have_scales()) continue;
    Study study = study_of_all(model, {model.parameters.front().name, model.states.back().name});
    if (has_scales) study.scales = kScales;
    expect_notes(written(study), has_scales);
  }
}

TEST_P(NotesOfModel, EveryAxisOfAResultSaysWhatItIs) {
  for (Study study : studies_over_each(its_model())) {
    SCOPED_TRACE(study.axes[0].name);
    study.selection = select_quantities(its_model(), {}, {});
    if (may_have_scales()) study.scales = kScales;
    expect_notes(written(study), may_have_scales());
  }
}

TEST_P(NotesOfModel, EveryVariableOfTracesSaysWhatItIs) {
  for (const bool has_scales : {false, true}) {
    if (has_scales && !may_have_scales()) continue;
    Study study = study_of_all(its_model(), {its_model().states.front().name});
    if (has_scales) study.scales = kScales;
    for (const ParameterInfo& info : its_model().parameters) {
      SCOPED_TRACE(info.name);
      expect_notes(traced(study, {info.name}), has_scales);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Few, NotesOfModel, ::testing::ValuesIn(few_models()), name_of_model);
INSTANTIATE_TEST_SUITE_P(Others, NotesOfModel, ::testing::ValuesIn(other_models()), name_of_model);

TEST_F(FileNotesTest, SamplesOfSeveralStatesHaveAScaleForEach) {
  Study study = study_of_all(*find_model("gear5"), {"omega"});
  study.scales = kScales;
  const NetcdfFile file = NetcdfFile::open(written(study));
  for (const std::string list : {"state", "component"}) {
    const std::size_t states = study.model->states.size();
    const std::vector<double> scales =
        file.read(find(file, list + "_scale_to_SI").id, {0}, {states});
    EXPECT_EQ(scales.front(), 2e-5);          // x1
    EXPECT_EQ(scales.back(), 2e-5 * 1000.0);  // v5
    const std::vector<std::string> units = file.read_texts(find(file, list + "_SI_units").id);
    EXPECT_EQ(units.front(), "m");
    EXPECT_EQ(units.back(), "m/s");
  }
  EXPECT_EQ(find(file, "poincare").text("units"), "see state_units");
  EXPECT_EQ(find(file, "section_min").text("units"), "see component_units");
}

TEST_F(FileNotesTest, SamplesOfOneUnitHaveIt) {
  Study study = study_of_all(*find_model("gear5"), {"omega"});
  study.scales = kScales;
  study.selection.poincare = {0, 1};
  const NetcdfFile file = NetcdfFile::open(written(study));
  EXPECT_EQ(find(file, "poincare").text("units"), "b_n");
  EXPECT_EQ(find(file, "poincare").scale(), 2e-5);
}

TEST_F(FileNotesTest, APeriodOfManyMeshPeriodsSaysHowManyAndWhatTurns) {
  Study study = study_of_all(*find_model("gear5"), {"omega"});
  const auto set = [&](const char* name, double value) {
    study.setting.parameters[static_cast<std::size_t>(study.model->find_parameter(name))] = value;
  };
  const auto attribute = [&](const char* name) {
    return NetcdfFile::open(written(study)).number_attribute(NC_GLOBAL, name);
  };
  EXPECT_TRUE(attribute("mesh_periods_per_period").empty());
  set("zp", 5.0);
  set("teeth_ratio", 1.4);
  set("cycle", 35.0);
  EXPECT_EQ(attribute("mesh_periods_per_period"), std::vector{35.0});
  EXPECT_EQ(attribute("pinion_turns_per_period"), std::vector{7.0});
  EXPECT_EQ(attribute("gear_turns_per_period"), std::vector{5.0});
}

// Each with the number that a user has to multiply by.
TEST_F(FileNotesTest, AScaleIsTheUnitInSi) {
  Study study = study_of_all(*find_model("gear5"), {"c1", "alpha"});
  study.scales = kScales;
  const NetcdfFile maps = NetcdfFile::open(written(study));
  // cm = 2 zeta k0 / varpi
  const double zeta =
      study.setting.parameters[static_cast<std::size_t>(study.model->find_parameter("zeta"))];
  EXPECT_DOUBLE_EQ(find(maps, "c1").scale(), 2.0 * zeta * 1e8 / 1000.0);
  EXPECT_EQ(find(maps, "c1").text("SI_units"), "N s/m");
  EXPECT_DOUBLE_EQ(find(maps, "alpha").scale(), std::acos(-1.0) / 180.0);
  EXPECT_EQ(find(maps, "dmf_max").scale(), 1e8 * 2e-5);
  EXPECT_EQ(find(maps, "lyapunov_max").scale(), 1000.0);
  const NetcdfFile traces = NetcdfFile::open(traced(study, {"omega"}));
  EXPECT_EQ(find(traces, "tau").scale(), 1e-3);
  EXPECT_EQ(find(traces, "tau").text("SI_units"), "s");
  EXPECT_EQ(find(traces, "omega").scale(), 1000.0);
  EXPECT_EQ(find(traces, "v1").scale(), 2e-5 * 1000.0);
  EXPECT_EQ(traces.number_attribute(NC_GLOBAL, "scale_force_N"), std::vector{1e8 * 2e-5});
}

// What a pilot run has found: of the whole, and of each map that it compared.
TEST_F(FileNotesTest, TellTheErrorOfEachMap) {
  SweepResult result = example_result();
  result.pilot = {.step = {0.1, 4},
                  .error = 3e-4,
                  .kept = 0.97,
                  .sensitive = 0.02,
                  .max_sensitive = 0.04,
                  .points = 250,
                  .errors = {{"x1_rms", 3e-4}}};
  const NetcdfFile file = NetcdfFile::open(write(result));
  EXPECT_EQ(file.number_attribute(NC_GLOBAL, "pilot_max_step"), std::vector{0.1});
  EXPECT_EQ(file.number_attribute(NC_GLOBAL, "pilot_orbit_steps"), std::vector{4.0});
  EXPECT_EQ(file.number_attribute(NC_GLOBAL, "pilot_kept"), std::vector{0.97});
  EXPECT_EQ(file.number_attribute(NC_GLOBAL, "pilot_sensitive"), std::vector{0.02});
  EXPECT_EQ(file.number_attribute(NC_GLOBAL, "pilot_sensitive_max"), std::vector{0.04});
  EXPECT_EQ(file.number_attribute(find(file, "x1_rms").id, "pilot_error"), std::vector{3e-4});
  EXPECT_TRUE(file.number_attribute(find(file, "contact_class").id, "pilot_error").empty());
}

TEST_F(FileNotesTest, NameTheStatesThatWereIntegrated) {
  SweepResult result = example_result();
  result.integrated = {"x1", "v1"};
  EXPECT_EQ(NetcdfFile::open(write(result)).text_attribute(NC_GLOBAL, "integrated_states"),
            "x1 v1");
}

// cm is another one at each zeta.
TEST_F(FileNotesTest, AUnitThatIsNotTheSameEverywhereHasNoScale) {
  Study study = study_of_all(*find_model("gear5"), {"c1", "zeta"});
  study.scales = kScales;
  const NetcdfFile file = NetcdfFile::open(written(study));
  EXPECT_EQ(find(file, "c1").text("units"), "cm");
  EXPECT_EQ(find(file, "c1").scale(), 0.0);
}

// The name of a number does not hold what its unit says.
TEST_F(FileNotesTest, NoMeaningRepeatsItsUnit) {
  for (const Model& model : models()) {
    for (const ParameterInfo& info : model.parameters) {
      EXPECT_TRUE(info.unit == "1" || !info.meaning.ends_with("/ " + info.unit))
          << model.name << ", " << info.name << ": " << info.meaning;
    }
  }
}

TEST_F(FileNotesTest, AModelWithoutScalesHasPlainTime) {
  EXPECT_EQ(time_unit(*find_model("gear5")), "1/varpi");
  EXPECT_EQ(time_unit(*find_model("gear1")), "1/varpi");
  EXPECT_EQ(time_unit(*find_model("lorenz")), "1");
  EXPECT_EQ(time_unit(*find_model("duffing")), "1");
}

// A picture of one of them has its own unit.
TEST_F(FileNotesTest, APartIsReadWithItsUnit) {
  const Study study = study_of_all(*find_model("gear5"), {"omega"});
  const ResultFile file(written(study));
  EXPECT_EQ(file.read("section_min:1").unit, "b_n");
  EXPECT_EQ(file.read("section_max:10").unit, "b_n varpi");
  EXPECT_EQ(file.read("section_min").unit, "1");
  EXPECT_EQ(file.read("lyapunov_spectrum:2").unit, "1/tau");
}

}  // namespace
}  // namespace gearsweep
