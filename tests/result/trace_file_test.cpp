// Files of traces: what is written is read back, and a table holds the same.
#include "result/trace_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "model/error.hpp"

namespace gearsweep::testing {
namespace {

Study gear_study() { return read_study("[[axes]]\nname = 'omega'\nvalues = [0.5]\n", "test"); }

// A trace of so many moments with two channels.
Trace made_trace(const Study& study, std::size_t moments) {
  Trace trace;
  trace.setting = study.setting;
  trace.period = 2.5;
  trace.settled = 40;
  trace.channels = {{"x1", "b_n", "a state"}, {"dmf", "k0 b_n", "a force", Role::mesh_force}};
  trace.values.resize(2);
  for (std::size_t i = 0; i < moments; ++i) {
    trace.tau.push_back(0.1 * static_cast<double>(i));
    trace.values[0].push_back(1.0 / static_cast<double>(3 * i + 1));
    trace.values[1].push_back(-1e-3 * static_cast<double>(i));
  }
  return trace;
}

class TraceFile : public ::testing::Test {
 protected:
  TraceFile()
      : folder_(::testing::TempDir() + "traces_" +
                ::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    std::filesystem::create_directories(folder_);
  }
  ~TraceFile() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  std::string content(const std::string& name) const {
    std::ifstream in(path(name));
    return {std::istreambuf_iterator<char>(in), {}};
  }

 private:
  std::string folder_;
};

// Traces of different length stand beside each other; each comes back with its own.
TEST_F(TraceFile, GivesBackWhatWasWritten) {
  Study study = gear_study();
  study.title = "two gears";
  const std::vector<Trace> traces = {made_trace(study, 7), made_trace(study, 4)};
  write_traces(traces, {"omega=0.5", "omega=0.75, b=1"}, {"omega"}, study, path("t.nc"), {});
  EXPECT_TRUE(is_trace_file(path("t.nc")));
  const std::vector<StoredTrace> back = read_traces(path("t.nc"));
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(back[0].title, "two gears");
  EXPECT_EQ(back[0].label, "omega=0.5");
  EXPECT_EQ(back[1].label, "omega=0.75, b=1");
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back[i].trace.tau, traces[i].tau);
    EXPECT_EQ(back[i].trace.values, traces[i].values);
    EXPECT_EQ(back[i].trace.period, 2.5);
    ASSERT_EQ(back[i].trace.channels.size(), 2U);
    EXPECT_EQ(back[i].trace.channels[1].name, "dmf");
    EXPECT_EQ(back[i].trace.channels[0].role, Role::none);
    EXPECT_EQ(back[i].trace.channels[1].role, Role::mesh_force);
    EXPECT_EQ(back[i].trace.channels[1].unit, "k0 b_n");
  }
}

TEST_F(TraceFile, IsATableToo) {
  const Study study = gear_study();
  write_traces({made_trace(study, 2)}, {"omega=0.5"}, {"omega"}, study, path("t.csv"), {});
  EXPECT_EQ(content("t.csv"),
            "trace,omega [varpi],tau [1/varpi],x1 [b_n],dmf [k0 "
            "b_n]\n1,0.7,0,1,-0\n1,0.7,0.1,0.25,-0.001\n");
}

// Scales of powers of two, which keep all digits; 1500 rpm make one omega.
TEST_F(TraceFile, IsATableInUnitsOfSi) {
  Study study = gear_study();
  EXPECT_THROW(ensure_trace_file("t.csv", study, TableUnits::si), InputError);
  study.scales = {0x1p12, 0x1p-16, 0x1p28, 1500.0};
  EXPECT_THROW(ensure_trace_file("t.nc", study, TableUnits::si), InputError);
  write_traces({made_trace(study, 2)}, {"omega=0.5"}, {"omega"}, study, path("t.csv"), {},
               TableUnits::si);
  EXPECT_EQ(content("t.csv"),
            "trace,omega [rpm],tau [s],x1 [µm],dmf [N]\n1,1050,0,15.2587890625,-0\n"
            "1,1050,2.44140625e-05,3.814697265625,-4.096\n");
}

TEST_F(TraceFile, RefusesOtherFiles) {
  EXPECT_FALSE(is_trace_file(path("nothing.nc")));
  std::ofstream(path("text.nc")) << "no NetCDF";
  EXPECT_FALSE(is_trace_file(path("text.nc")));
  EXPECT_THROW(read_traces(path("text.nc")), InputError);
  EXPECT_THROW(ensure_trace_file("trace.txt", gear_study(), TableUnits::model), InputError);
}

}  // namespace
}  // namespace gearsweep::testing
