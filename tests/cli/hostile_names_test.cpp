// Names of files that gnuplot, the shell or the NetCDF library would take for more than a name, in
// each command that reads, writes or draws.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/process.hpp"
#include "support/study_text.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

// As the shell takes it literally.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char letter : text) out += letter == '\'' ? "'\\''" : std::string(1, letter);
  return out + "'";
}

const char* const kHostileNamesStudy =
    "[[axes]]\nname = 'omega'\nvalues = [0.5, 0.6, 0.7]\n[integrate]\nsettle = 2\nrecord = 2\n";

TEST(HostileNames, RunNothingInAnyCommand) {
  const Folder folder;
  for (const std::string name :
       {"|touch pwned;", "<touch pwned;", "`touch pwned`$(touch pwned)a\\b",
        "';system('touch pwned');'", "line\n!touch pwned\n"}) {
    SCOPED_TRACE(name);
    folder.write(name + ".toml", kHostileNamesStudy);
    const auto file = [&](const std::string& ending) { return quoted(name + ending); };
    const auto expect_done = [&](const std::string& arguments, const std::string& written) {
      const Outcome done = gearsweep(folder, arguments);
      EXPECT_EQ(done.status, 0) << arguments << "\n" << done.err;
      EXPECT_EQ(folder.files().count(name + written), 1U) << arguments;
      EXPECT_EQ(folder.files().count("pwned"), 0U) << arguments;
    };
    expect_done("run " + file(".toml") + " -o " + file(".nc") + " --plot " + file("run.png"),
                "run.png");
    expect_done("run " + file(".nc") + " -o " + file("again.nc"), "again.nc");
    expect_done("trace " + file(".nc") + " --at omega=0.6 -o " + file("trace.nc"), "trace.nc");
    expect_done("plot " + file(".nc") + " -o " + file("map.svg") + " --script " + file(".gp"),
                "map.svg");
    expect_done("plot " + file("trace.nc") + " -o " + file("trace.pdf"), "trace.pdf");
    expect_done("export " + file(".nc") + " -q x1_rms -o " + file(".csv"), ".csv");
  }
}

// The name goes into the text of a study.
TEST(Names, OfAModelMayHaveQuotes) {
  const Folder folder;
  for (const std::string name : {"it's.toml", "a \"model\".toml", "back\\slash.toml"}) {
    folder.write(name, gearsweep(folder, "model duffing --text").out);
    const Outcome shown = gearsweep(folder, "model " + quoted("./" + name));
    EXPECT_EQ(shown.status, 0) << shown.err;
    EXPECT_THAT(shown.out, HasSubstr("start"));
  }
}

// It computed everything and then failed to write it, at each try.
TEST(Names, OfAnAxisAndAQuantityMayBeTheSame) {
  const Folder folder;
  folder.write("study.toml",
               kPushed + std::string("[[axes]]\nname = 'period'\nvalues = [1, 2]\n"
                                     "[integrate]\nsettle = 2\nrecord = 4\n[observe]\n"
                                     "quantities = ['period', 'poincare']\n"));
  const Outcome run = gearsweep(folder, "run study.toml -o out.nc --plot map.png -q period");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(gearsweep(folder, "export out.nc -q period -o out.csv").status, 0);
  EXPECT_THAT(read_all(folder / "out.csv"), HasSubstr("parameter_period [1],period [1]\n1,"));
  const Outcome trace = gearsweep(folder, "trace out.nc --at period=2 -o trace.nc");
  EXPECT_EQ(trace.status, 0) << trace.err;
  EXPECT_EQ(gearsweep(folder, "plot trace.nc -o trace.png").status, 0);
}

}  // namespace
}  // namespace gearsweep::testing
