// The list of what a result consists of is what its file has.
#include "result/dataset.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

#include "result/detail/netcdf_file.hpp"
#include "result/example_result.hpp"
#include "result/example_trace.hpp"
#include "result/trace_file.hpp"

namespace gearsweep {
namespace {

using gearsweep::testing::example_result;
using gearsweep::testing::kNaN;
using gearsweep::testing::kProvenance;
using gearsweep::testing::made_trace;
using gearsweep::testing::spectrum_result;
using ::testing::ElementsAre;

class DatasetTest : public gearsweep::testing::IoTest {};

// Names, shapes and numbers.
void expect_same(const Dataset& dataset, const NetcdfFile& file) {
  std::vector<std::string> names;
  for (const DataVariable& variable : dataset.variables) {
    SCOPED_TRACE(variable.name);
    names.push_back(variable.name);
    const int id = file.find_variable(variable.name);
    ASSERT_GE(id, 0);
    std::vector<std::string> dimensions;
    std::vector<std::size_t> shape;
    for (const int dimension : file.dimensions_of(id)) {
      dimensions.push_back(file.dimension_name(dimension));
      shape.push_back(file.dimension_size(dimension));
    }
    EXPECT_EQ(variable.dimensions, dimensions);
    EXPECT_EQ(dataset.shape_of(variable), shape);
    if (variable.stored == Stored::letter) continue;
    const std::vector<double> stored = file.read(id, std::vector<std::size_t>(shape.size()), shape);
    std::vector<double> own(stored.size());
    if (variable.stored == Stored::byte) {
      std::vector<signed char> classes(stored.size());
      variable.copy(0, std::span<signed char>(classes));
      own.assign(classes.begin(), classes.end());
    } else {
      variable.copy(0, std::span<double>(own));
    }
    EXPECT_THAT(own, ::testing::Pointwise(::testing::NanSensitiveDoubleEq(), stored));
  }
  EXPECT_EQ(names, file.variables());
}

TEST_F(DatasetTest, IsWhatTheFileHas) {
  for (const SweepResult& result : {example_result(), example_result(7, 0), spectrum_result()}) {
    expect_same(dataset_of(result, kProvenance), NetcdfFile::open(write(result)));
  }
}

// One trace, and two of different length.
TEST_F(DatasetTest, OfTracesIsWhatTheirFileHas) {
  const Study study = example_result().study;
  const std::vector<Trace> two = {made_trace(study, 2, 8), made_trace(study, 3, 8)};
  const std::string path = in_folder("traces.nc");
  for (const std::vector<Trace>& traces : {two, {two.front()}}) {
    const std::vector<std::string> labels(traces.size(), "omega=0.5");
    write_traces(traces, labels, {"omega"}, study, path, kProvenance);
    const Dataset dataset = dataset_of(traces, labels, {"omega"}, study, kProvenance);
    expect_same(dataset, NetcdfFile::open(path));
    EXPECT_EQ(dataset.size_of("trace"), traces.size());
    EXPECT_EQ(dataset.size_of("moment"), traces.back().tau.size());
  }
}

TEST_F(DatasetTest, WhatIsNoNumberHasNoClass) {
  const DataVariable variable = {.name = "contact_class",
                                 .stored = Stored::byte,
                                 .dimensions = {"omega"},
                                 .attributes = {},
                                 .elements = std::vector{1.0, kNaN, 2.0}};
  std::vector<signed char> classes(2);
  variable.copy(1, std::span<signed char>(classes));
  EXPECT_THAT(classes, ElementsAre(kNoClass, 2));
}

TEST_F(DatasetTest, RefusesDimensionsThatItHasNot) {
  const SweepResult result = example_result();
  const Dataset dataset = dataset_of(result, kProvenance);
  EXPECT_EQ(dataset.size_of("omega"), 4U);
  EXPECT_THROW(dataset.size_of("e0"), std::logic_error);
}

}  // namespace
}  // namespace gearsweep
