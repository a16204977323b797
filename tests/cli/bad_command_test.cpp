// Bad commands: a clear message that names the place, exit status 2, no file left behind.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cli/good_study.hpp"
#include "support/process.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class BadCommandTest : public ::testing::Test {
 protected:
  // The command is refused with these words, and leaves the folder as it was.
  void expect_refused(const std::string& arguments, const std::vector<std::string>& messages,
                      const std::string& environment = "") {
    const std::set<std::string> before = folder_.files();
    const Outcome outcome =
        run_in(folder_, environment + " " + std::string(GEARSWEEP_BINARY) + " " + arguments);
    EXPECT_EQ(outcome.status, 2) << arguments << "\n" << outcome.err;
    for (const std::string& message : messages) EXPECT_THAT(outcome.err, HasSubstr(message));
    EXPECT_EQ(folder_.files(), before);
  }

  Folder folder_;
};

TEST_F(BadCommandTest, EmptyStudyIsRefused) {
  folder_.write("empty.toml", "");
  expect_refused("run empty.toml -o out.nc", {"empty.toml", "empty"});
}

TEST_F(BadCommandTest, BinaryStudyIsRefused) {
  folder_.write("binary.toml", std::string("\x7f"
                                           "ELF\0\1\2\3\xff\xfe",
                                           10));
  expect_refused("run binary.toml -o out.nc", {"binary.toml"});
}

TEST_F(BadCommandTest, MissingStudyIsRefused) {
  expect_refused("run nowhere.toml", {"nowhere.toml", "no such file"});
  expect_refused("run coarse-mpa", {"no built-in study 'coarse-mpa'", "did you mean"});
}

TEST_F(BadCommandTest, UnwritableOutputIsRefusedBeforeTheRun) {
  folder_.write("study.toml", kGoodStudy);
  expect_refused("run study.toml -o missing/out.nc", {"missing"});
  expect_refused("run study.toml -o study.toml/out.nc", {"study.toml/out.nc"});
  expect_refused("run study.toml -o .", {"folder"});
  expect_refused("run study.toml -o out.nc --plot missing/map.png", {"missing"});
  expect_refused("run study.toml -o out.nc --plot map.jpg", {"map.jpg", ".png"});
}

TEST_F(BadCommandTest, OutputsThatWouldDestroyAFileAreRefused) {
  folder_.write("study.toml", kGoodStudy);
  folder_.write("notes.txt", "mine");
  expect_refused("run study.toml -o study.toml", {"its own study"});
  expect_refused("run study.toml -o notes.txt", {"notes.txt", "no result file"});
  expect_refused("run study.toml -o ''", {"must not be empty"});
  EXPECT_EQ(read_all(folder_ / "study.toml"), kGoodStudy);
  EXPECT_EQ(read_all(folder_ / "notes.txt"), "mine");
}

TEST_F(BadCommandTest, WhatToDrawIsCheckedBeforeTheRun) {
  folder_.write("study.toml", kGoodStudy);
  expect_refused("run study.toml -o out.nc --plot map.png -q x1_rsm",
                 {"x1_rsm", "did you mean 'x1_rms'?"});
  expect_refused("run study.toml -o out.nc -q x1_rms", {"--plot"});
}

TEST_F(BadCommandTest, UnknownDeviceIsRefused) {
  folder_.write("study.toml", kGoodStudy);
  expect_refused("run study.toml -o out.nc --device 99", {"no device 99", "gearsweep devices"});
  expect_refused("run study.toml -o out.nc --device -1", {"--device"});
}

TEST_F(BadCommandTest, NoOpenClDeviceIsRefused) {
  folder_.write("study.toml", kGoodStudy);
  expect_refused("run study.toml -o out.nc", {"no OpenCL device", "pocl-opencl-icd"},
                 "OCL_ICD_VENDORS=/nonexistent-vendors");
}

TEST_F(BadCommandTest, WhatHidesAnInstalledDriverIsNamed) {
  folder_.write("study.toml", kGoodStudy);
  const std::string run = "run study.toml -o out.nc";
  expect_refused(run,
                 {"no OpenCL device", "/proc/none' cannot be written", "POCL_CACHE_DIR", "HOME"},
                 "POCL_CACHE_DIR=/proc/none");
  expect_refused(run, {"/proc/pocl/kcache' cannot be written", "POCL_CACHE_DIR", "HOME"},
                 "env -u POCL_CACHE_DIR XDG_CACHE_HOME=/proc TMPDIR=/proc");
  expect_refused(run, {"no OpenCL device", "POCL_DEVICES = 'none'"}, "POCL_DEVICES=none");
}

TEST_F(BadCommandTest, WrongOverridesAreRefused) {
  folder_.write("study.toml", kGoodStudy);
  expect_refused("run study.toml -o out.nc --set integrate.setle=3",
                 {"--set integrate.setle=3", "unknown key 'setle'"});
  expect_refused("run study.toml -o out.nc --set settle", {"PATH=VALUE"});
  expect_refused("run study.toml -o out.nc --set axes.b.count=3", {"no element 'b'", "omega"});
}

TEST_F(BadCommandTest, SettingsThatContradictEachOtherAreRefused) {
  folder_.write("study.toml", kGoodStudy);
  expect_refused("run study.toml --set model.formulation=printed --set parameters.teeth_ratio=2",
                 {"equal gears"});
  expect_refused("run study.toml --set parameters.rho_p=0.7", {"rho_p + rho_g must be 1"});
}

TEST_F(BadCommandTest, WrongArgumentsAreRefused) {
  expect_refused("", {"no command is given", "run, merge", "gearsweep --help"});
  expect_refused("rum coarse-map", {"unknown command 'rum'", "did you mean 'run'?"});
  expect_refused("--bogus", {"has no option '--bogus'", "known: --help"});
  expect_refused("run", {"'gearsweep run' needs study", "a built-in study"});
  expect_refused("plot map.nc", {"'gearsweep plot' needs --output", ".png"});
  expect_refused("run coarse-map more", {"does not know what to do with 'more'"});
  expect_refused("run coarse-map --devcie 1", {"'--devcie'", "did you mean '--device'?"});
  expect_refused("plot map.nc --cmap gray -o map.png", {"'--cmap'", "did you mean '--colormap'?"});
  expect_refused("plot map.nc --xlim 0:1 -o map.png", {"'--xlim'", "did you mean '--xrange'?"});
  expect_refused("run coarse-map --restart=maybe", {"--restart takes no value"});
  expect_refused("run coarse-map --set", {"--set takes one value, PATH=VALUE"});
  expect_refused("reproduce -o paper --preset papr", {"did you mean 'paper'?"});
  expect_refused("model gear6", {"unknown model 'gear6'"});
  expect_refused("studies nothing", {"no built-in study"});
}

TEST_F(BadCommandTest, AnAxisByItsNameAloneIsNoKey) {
  expect_refused("run coarse-map -o map.nc --set omega.count=10",
                 {"--set omega.count=10", "did you mean 'axes.omega.count'?"});
  expect_refused("run coarse-map -o map.nc --set 'observe.quantities=[]'", {"no map", "x1_rms"});
}

TEST_F(BadCommandTest, AKeyOfAnotherTableIsFoundByPartOfItsName) {
  expect_refused("run table1-gear -o map.nc --set speed_rpm=900",
                 {"unknown key 'speed_rpm'", "did you mean 'gear.pinion_speed_rpm'?"});
  expect_refused("run coarse-map -o map.nc --set axis=1", {"did you mean 'axes'?"});
  expect_refused("run coarse-map -o map.nc --set 'observe.quantities=[\"lyapunov\"]'",
                 {"'lyapunov_max'", "'lyapunov_spectrum'"});
}

TEST_F(BadCommandTest, NoCommandReplacesWhatItReads) {
  ASSERT_EQ(gearsweep(folder_,
                      "run coarse-map --quiet -o map.nc --set axes.omega.count=2 --set "
                      "axes.e0.count=2 --set integrate.settle=2 --set integrate.record=2")
                .status,
            0);
  const std::string map = read_all(folder_ / "map.nc");
  for (const char* command :
       {"trace map.nc --at omega=0.4,e0=0.05", "orders map.nc", "run map.nc"}) {
    expect_refused(std::string(command) + " -o ./map.nc", {"map.nc", "would replace its own"});
  }
  EXPECT_EQ(read_all(folder_ / "map.nc"), map);
}

// The message names what was given, and what would be right.
TEST_F(BadCommandTest, AFolderForTemporaryFilesMustBeOne) {
  ASSERT_EQ(gearsweep(folder_,
                      "run coarse-map --quiet -o map.nc --set axes.omega.count=2 --set "
                      "axes.e0.count=2 --set integrate.settle=2 --set integrate.record=2")
                .status,
            0);
  folder_.write("plain", "");
  const Outcome outcome =
      run_in(folder_, fmt::format("TMPDIR=plain '{}' plot map.nc -o map.png", GEARSWEEP_BINARY));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("TMPDIR=plain"), HasSubstr("TMPDIR=FOLDER")));
}

// No huge range, no -1 that becomes 18446744073709551615.
TEST_F(BadCommandTest, NumbersMustBeNumbersInRange) {
  const std::string no_device = "is no list of numbers";
  for (const char* device : {"first", "-1", "1.5", "1e0", "''", "99999999999999999999"}) {
    expect_refused(std::string("run coarse-map --device ") + device, {"--device: '", no_device});
  }
  expect_refused("run coarse-map --lanes -1", {"--lanes: '-1' is not a whole number from 1 to 16"});
  expect_refused("trace coarse-map -o t.nc --settle -3", {"--settle: '-3' is not"});
  expect_refused("floquet coarse-map --period 4097", {"from 1 to 4096"});
  for (const char* order : {"0", "-2", "nan", "inf", "many", "1x"}) {
    expect_refused(std::string("plot map.nc -o map.png --orders ") + order,
                   {"--orders: '", "is not a number greater than 0"});
  }
}

TEST_F(BadCommandTest, StylesOfPicturesSayWhatWouldBeRight) {
  const std::string plot = "plot map.nc -o map.png ";
  expect_refused(plot + "--size 85mm", {"--size: '85mm'", "as in 85x64mm"});
  expect_refused(plot + "--width wide", {"--width: 'wide'", "as in 85mm"});
  expect_refused(plot + "--font Sans,big", {"--font: 'Sans,big'", "Times New Roman,8"});
  expect_refused(plot + "--range 2:1", {"--range: '2:1'", "the smaller"});
  expect_refused(plot + "--xrange=-3", {"--xrange: '-3'", "MIN:MAX"});
  expect_refused(plot + "--colormap jet", {"--colormap: there is no colour map 'jet'", "viridis"});
  expect_refused(plot + "--contours few", {"--contours: 'few'", "as in 6"});
  expect_refused(plot + "--units miles", {"--units: 'miles'", "SI or model"});
  expect_refused(plot + "--style none.toml", {"none.toml"});
  folder_.write("thesis.toml", "width = '85mm'\nfnt = 'Sans,8'\n");
  expect_refused(plot + "--style thesis.toml", {"thesis.toml:2: ", "did you mean 'font'?"});
}

// What a style file says and does not concern a picture is left aside; what a command says must.
TEST_F(BadCommandTest, OptionsOfPicturesMustConcernThem) {
  ASSERT_EQ(gearsweep(folder_,
                      "run coarse-map --quiet -o map.nc --set axes.omega.count=3 --set "
                      "axes.e0.count=3 --set integrate.settle=5 --set integrate.record=2")
                .status,
            0);
  for (const char* option : {"--log", "--contours 3"}) {
    expect_refused(std::string("plot map.nc -q contact_class -o map.png ") + option,
                   {std::string(option).substr(0, 5), "'contact_class' is a map of classes"});
  }
  folder_.write("thesis.toml", "width = '85mm'\nlog = true\ncontours = 3\n");
  EXPECT_EQ(
      gearsweep(folder_, "plot map.nc -q contact_class -o map.png --style thesis.toml").status, 0);
  // 300 dots per inch: 11811 per metre.
  EXPECT_THAT(read_all(folder_ / "map.png"),
              HasSubstr(std::string("pHYs\0\0\x2e\x23\0\0\x2e\x23\x01", 13)));
  folder_.write("figure.pdf", "another picture");
  expect_refused("plot map.nc -o figure.tex", {"'figure.pdf'", "another name"});
}

TEST_F(BadCommandTest, PlotAndExportRefuseWhatIsNoResult) {
  folder_.write("text.nc", "not a map");
  expect_refused("plot text.nc -o map.png", {"text.nc"});
  expect_refused("plot missing.nc -o map.png", {"missing.nc"});
  expect_refused("plot text.nc missing.nc -q x1_rms -o map.png", {"text.nc"});
  expect_refused("export text.nc -q x1_rms -o map.csv", {"text.nc"});
}

// A pipe would be waited for and a device read for ever: the time is no part of the test.
TEST_F(BadCommandTest, WhatIsNoRegularFileIsRefusedByAllThatReadIt) {
  ASSERT_EQ(
      run_in(folder_, "mkfifo pipe pipe.nc.journal && ln -s loop loop && mkdir folder").status, 0);
  const std::vector<std::pair<std::string, std::string>> files = {
      {"pipe", "'pipe' is a pipe; "},
      {"/dev/zero", "'/dev/zero' is a device; "},
      {"folder", "'folder' is a folder; "},
      {"loop", "'loop' cannot be opened: Too many levels of symbolic links"}};
  for (const auto& [file, message] : files) {
    for (const std::string before_it :
         {"run -o out.nc ", "trace -o out.nc ", "floquet ", "model --study ", "plot -o out.png ",
          "export -q x1_rms -o out.csv ", "status ", "merge -o out.nc "}) {
      expect_refused(before_it + file, {message}, "timeout 600");
    }
  }
  folder_.write("study.toml", kGoodStudy);
  const std::string message = "'pipe.nc.journal' is a pipe; a journal must be a regular file";
  for (const char* command : {"run study.toml -o pipe.nc", "run study.toml -o pipe.nc --restart",
                              "status pipe.nc", "status pipe.nc.journal"}) {
    expect_refused(command, {message}, "timeout 600");
  }
}

TEST_F(BadCommandTest, OutputsThatAreNoRegularFilesAreRefused) {
  ASSERT_EQ(run_in(folder_, "mkfifo pipe.nc && ln -s loop.nc loop.nc").status, 0);
  folder_.write("study.toml", kGoodStudy);
  const std::string long_name = std::string(300, 'a') + ".nc";
  for (const std::string command :
       {"run study.toml -o ", "trace study.toml -o ", "merge none -o "}) {
    expect_refused(command + "pipe.nc", {"pipe.nc"}, "timeout 600");
    expect_refused(command + "loop.nc", {"'loop.nc': Too many levels of symbolic links"});
    expect_refused(command + long_name, {"File name too long"});
  }
}

TEST_F(BadCommandTest, AStatusIsOfARunOrOfAWholeResult) {
  folder_.write("study.toml", kGoodStudy);
  ASSERT_EQ(gearsweep(folder_, "run study.toml -o whole.nc --quiet").status, 0);
  EXPECT_EQ(gearsweep(folder_, "status whole.nc").out, "whole.nc: finished\n");
  const std::string whole = read_all(folder_ / "whole.nc");
  folder_.write("short.nc", whole.substr(0, whole.size() / 2));
  folder_.write("empty.nc", "");
  expect_refused("status short.nc", {"short.nc", "cut short"});
  expect_refused("status empty.nc", {"empty.nc", "give a result"});
  expect_refused("status study.toml", {"study.toml", "give a result"});
  expect_refused("status missing.nc", {"missing.nc", "neither"});
}

TEST_F(BadCommandTest, ADamagedResultIsRefusedByAllThatReadIt) {
  folder_.write("damaged.nc", "\x89HDF\r\n\x1a\n" + std::string(5000, 'x'));
  const std::vector<std::string> messages = {"damaged.nc", "otherwise damaged"};
  expect_refused("plot damaged.nc -o map.png", messages);
  expect_refused("export damaged.nc -q x1_rms -o map.csv", messages);
  expect_refused("run damaged.nc -o again.nc", messages);
  expect_refused("trace damaged.nc -o trace.nc", messages);
}

}  // namespace
}  // namespace gearsweep::testing
