// Parameters and initial states whose names something else in a file bears: every model is walked,
// every axis that it can have meets every quantity that it offers.
#include "result/detail/file_names.hpp"

#include <gmock/gmock.h>

#include <set>

#include "model/names.hpp"
#include "result/detail/netcdf_file.hpp"
#include "result/example_result.hpp"
#include "result/random_result.hpp"
#include "result/trace_file.hpp"
#include "study/builtin_models.hpp"
#include "support/each_model.hpp"
#include "support/study_text.hpp"

namespace gearsweep {
namespace {

using gearsweep::testing::few_models;
using gearsweep::testing::kProvenance;
using gearsweep::testing::kPushed;
using gearsweep::testing::name_of_model;
using gearsweep::testing::other_models;
using gearsweep::testing::random_result;
using gearsweep::testing::studies_over_each;
using gearsweep::testing::study_of_all;
using gearsweep::testing::trace_of_all;
using ::testing::Contains;
using ::testing::IsSupersetOf;

class FileNames : public gearsweep::testing::IoTest {
 protected:
  // Writes a result of the study, and finds all that the study asks for in it.
  std::string written(const Study& study) {
    const std::string path = write(random_result(study, 2, &random_));
    const ResultFile file(path);
    std::vector<std::string> wanted = {"status", "poincare"};
    for (const Quantity& quantity : study.selection.quantities) wanted.push_back(quantity.name);
    EXPECT_THAT(file.quantities(), IsSupersetOf(wanted));
    for (std::size_t i = 0; i < study.axes.size(); ++i) {
      EXPECT_EQ(file.axes().at(i).name, name_in_result(study.axes[i], study));
      EXPECT_EQ(file.axes().at(i).values, study.axes[i].values);
    }
    EXPECT_EQ(file.poincare_states().size(), study.model->states.size());
    return path;
  }

  std::mt19937_64 random_{1};
};

TEST_F(FileNames, AnAxisGivesWayOnlyToWhatItsFileHas) {
  const Study alone =
      read_study(kPushed + std::string("[[axes]]\nname = 'period'\nvalues = [1, 2]\n"), "test");
  EXPECT_EQ(name_in_result(alone.axes[0], alone), "period");
  const Study both = study_of_all(*alone.model, {"period", "c"});
  const ResultFile file(written(both));
  EXPECT_EQ(file.axes()[0].name, "parameter_period");
  EXPECT_EQ(file.axes()[0].meaning, "time from push to push");
  EXPECT_EQ(file.read("period").values.size(), 1U);
}

// As of a model that someone adds.
TEST_F(FileNames, OfTheFilesOwnVariablesAreNotAnAxis) {
  Study study = study_of_all(*find_model("jerk"), {"damping", "x"});
  for (const std::string name : {"status", "poincare", "sample", "state", "state_strlen",
                                 "exponent", "component", "attractor_number", "attractor_x_rms"}) {
    SCOPED_TRACE(name);
    study.axes[0].name = name;
    study.axes[1].name = name;
    const ResultFile file(written(study));
    EXPECT_EQ(file.axes()[0].name, "parameter_" + name);
    EXPECT_EQ(file.axes()[1].name, "initial_" + name);
  }
}

class NamesOfModel : public FileNames, public ::testing::WithParamInterface<std::string> {
 protected:
  static const Model& its_model() { return *find_model(GetParam()); }
};

// A clash of a new model shows here.
TEST_P(NamesOfModel, StandBesideEachOther) {
  for (const Study& study : studies_over_each(its_model())) {
    EXPECT_EQ(name_in_result(study.axes[0], study), study.axes[0].name);
  }
}

// No axis can meet what is not known of the file.
TEST_P(NamesOfModel, AllOfTheFileIsTaken) {
  Study study = study_of_all(its_model(), {its_model().parameters.front().name});
  const NetcdfFile file = NetcdfFile::open(written(study));
  const std::string own = study.axes[0].name;
  for (const std::string& variable : file.variables()) {
    std::vector<std::string> names = {variable};
    for (const int dimension : file.dimensions_of(file.find_variable(variable))) {
      names.push_back(file.dimension_name(dimension));
    }
    for (const std::string& name : names) {
      study.axes[0].name = name;
      EXPECT_TRUE(name == own || name_in_result(study.axes[0], study) != name) << name;
    }
  }
}

TEST_P(NamesOfModel, ParametersStandBesideTheTracesOfChannels) {
  const Model& model = its_model();
  const Study study = study_of_all(model, {model.states.front().name});
  const Trace trace = trace_of_all(study);
  std::vector<std::string> parameters;
  for (const ParameterInfo& info : model.parameters) parameters.push_back(info.name);
  const std::string path = in_folder("trace.nc");
  write_traces({trace}, {"a point"}, parameters, study, path, kProvenance);
  const StoredTrace stored = read_traces(path).at(0);
  EXPECT_EQ(stored.trace.period, 1.0);
  EXPECT_EQ(stored.trace.channels.size(), trace.channels.size());

  const std::string table = in_folder("trace.csv");
  write_traces({trace}, {"a point"}, parameters, study, table, kProvenance);
  std::string header = content(table);
  header.resize(header.find('\n'));
  const std::vector<std::string> columns = split(header, ',');
  EXPECT_EQ(std::set<std::string>(columns.begin(), columns.end()).size(), columns.size());
  if (model.find_parameter("period") >= 0) {
    EXPECT_THAT(columns, Contains("parameter_period [1]"));
  }
}

INSTANTIATE_TEST_SUITE_P(Few, NamesOfModel, ::testing::ValuesIn(few_models()), name_of_model);
INSTANTIATE_TEST_SUITE_P(Others, NamesOfModel, ::testing::ValuesIn(other_models()), name_of_model);

}  // namespace
}  // namespace gearsweep
