// The commands, as a user runs them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "journal/journal.hpp"
#include "study/builtin_models.hpp"
#include "study/selection.hpp"
#include "support/each_model.hpp"
#include "support/process.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const char* const kSmall =
    " --set axes.omega.count=6 --set axes.e0.count=4 --set integrate.settle=5 --set "
    "integrate.record=3";

TEST(Commands, RunPlotAndExportGoFromAStudyToPicturesAndTables) {
  const Folder folder;
  const Outcome run =
      gearsweep(folder, std::string("run coarse-map -o map.nc --plot map.png") + kSmall);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("24 points: ok 24"));
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(gearsweep(folder, "plot map.nc -q contact_class -o class.svg --script class.gp").status,
            0);
  EXPECT_EQ(gearsweep(folder, "plot map.nc -q x1_rms --at e0=0.3 -o cut.pdf").status, 0);
  folder.write("thesis.toml", "width = '85mm'\ntitle = 'from the file'\ncolormap = 'cividis'\n");
  const Outcome figure = gearsweep(folder,
                                   "plot map.nc -q x1_rms --style thesis.toml --title '' --range "
                                   "-1:2 -o figure.tex --script figure.gp");
  EXPECT_EQ(figure.status, 0) << figure.err;
  EXPECT_THAT(read_all(folder / "figure.gp"),
              AllOf(HasSubstr("#00224e"), HasSubstr("size 3.3465in"), HasSubstr("[-1:2]"),
                    Not(HasSubstr("from the file"))));
  EXPECT_THAT(read_all(folder / "figure.pdf"), StartsWith("%PDF"));
  const Outcome untitled = gearsweep(folder, "plot map.nc --title='' -o no.svg");
  EXPECT_EQ(untitled.status, 0) << untitled.err;
  EXPECT_EQ(gearsweep(folder, "export map.nc -q dmf_max -o dmf.csv").status, 0);
  EXPECT_EQ(gearsweep(folder, "export map.nc -q dmf_max -o dmf.npy").status, 0);
  EXPECT_THAT(read_all(folder / "map.png"), HasSubstr("PNG"));
  EXPECT_THAT(read_all(folder / "class.svg"), HasSubstr("<svg"));
  EXPECT_THAT(read_all(folder / "cut.pdf"), StartsWith("%PDF"));
  EXPECT_THAT(read_all(folder / "dmf.csv"),
              StartsWith("omega [varpi],e0 [b_n],dmf_max [k0 b_n]\n"));
  EXPECT_THAT(read_all(folder / "dmf.npy"), StartsWith("\x93NUMPY"));
}

// As far as the study has a quantity that tells.
TEST(Commands, TheSummaryTellsHowManyPointsAreWedged) {
  const Folder folder;
  folder.write("wedged.toml",
               "[model]\npreset = 'coarse'\nbacklash = 'dynamic'\n[parameters]\nomega = 0.5021\n"
               "[[axes]]\nname = 'b'\nvalues = [0.1, 0.2553, 5.0]\n[integrate]\nsettle = 40\n"
               "record = 4\n");
  for (const std::string quantity : {"contact_class", "backlash_min"}) {
    const std::string run = "run wedged.toml --set observe.quantities='[\"" + quantity + "\"]' ";
    EXPECT_THAT(gearsweep(folder, run + "-o " + quantity + ".nc").err,
                HasSubstr("2 of 3 points are wedged"));
    EXPECT_THAT(
        gearsweep(folder, run + "--set model.backlash=constant -o never_" + quantity + ".nc").err,
        Not(HasSubstr("are wedged")));
  }
}

TEST(Commands, AResultFileRunsAgainToTheSameMaps) {
  const Folder folder;
  ASSERT_EQ(gearsweep(folder, std::string("run coarse-map -o map.nc --quiet") + kSmall).status, 0);
  const Outcome again = gearsweep(folder, "run map.nc -o again.nc");
  EXPECT_EQ(again.status, 0) << again.err;
  gearsweep(folder, "export map.nc -q dmf_max -o map.csv");
  gearsweep(folder, "export again.nc -q dmf_max -o again.csv");
  EXPECT_EQ(read_all(folder / "map.csv"), read_all(folder / "again.csv"));
  EXPECT_EQ(gearsweep(folder, "run map.nc").status, 2) << "it would replace its own study";
}

TEST(Commands, ATableIsExportedAndNeverTheNameOfAResult) {
  for (const char* name : {"map.csv", "map.npy"}) {
    const Folder folder;
    const Outcome outcome = gearsweep(folder, std::string("run coarse-map -o ") + name + kSmall);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, HasSubstr(std::string("-o ") + name));
    EXPECT_THAT(outcome.err, HasSubstr("gearsweep export"));
    EXPECT_TRUE(folder.files().empty());
  }
}

// Before its tiles are planned it finds a step and builds kernels.
TEST(Commands, StatusKnowsARunThatHasJustBegun) {
  const Folder folder;
  {
    const JournalHold held((folder / "map.nc.journal").string());
    EXPECT_THAT(gearsweep(folder, "status map.nc").out,
                StartsWith("map.nc: running, nothing is done yet"));
    EXPECT_THAT(gearsweep(folder, "status map.nc --json").out, HasSubstr("\"running\""));
    EXPECT_THAT(gearsweep(folder, "run coarse-map -o map.nc").err,
                HasSubstr("in use by another run"));
  }
  folder.write("map.nc.journal", "");
  EXPECT_EQ(gearsweep(folder, "status map.nc").out,
            "map.nc: interrupted before anything was done; run it again\n");
}

TEST(Commands, ATraceIsDrawnInEveryWayAndOverAnother) {
  const Folder folder;
  const std::string trace =
      "trace coarse-map --at omega=0.65,e0=0.6 --settle 20 --record 12 --samples-per-period 64 ";
  ASSERT_EQ(gearsweep(folder, trace + "-o trace.nc").status, 0);
  ASSERT_EQ(gearsweep(folder, trace + "--set parameters.mu=0 -o frictionless.nc").status, 0);
  for (const std::string picture : {"time:v3", "phase", "section", "spectrum:dmf", "force"}) {
    const Outcome one = gearsweep(folder, "plot trace.nc -o one.png -q " + picture);
    EXPECT_EQ(one.status, 0) << one.err;
    const Outcome two =
        gearsweep(folder, "plot trace.nc frictionless.nc --periods 4 -o two.svg -q " + picture);
    EXPECT_EQ(two.status, 0) << two.err;
    EXPECT_THAT(read_all(folder / "one.png"), HasSubstr("PNG"));
    EXPECT_THAT(read_all(folder / "two.svg"), HasSubstr(" = 0.05"));
  }
}

TEST(Commands, StudiesOverOneAxisAreStackedAndLaidOverOneAnother) {
  const Folder folder;
  const std::string run =
      "run coarse-bifurcation --set axes.omega.count=12 --set integrate.settle=5 --quiet --set "
      "integrate.record=3 --set 'observe.quantities=[\"poincare\",\"x1_rms\",\"dmf_max\"]' ";
  ASSERT_EQ(gearsweep(folder, run + "-o line.nc").status, 0);
  ASSERT_EQ(gearsweep(folder, run + "--set parameters.mu=0 -o frictionless.nc").status, 0);
  const Outcome stack = gearsweep(folder, "plot line.nc -q poincare,x1_rms,dmf_max -o stack.pdf");
  EXPECT_EQ(stack.status, 0) << stack.err;
  EXPECT_THAT(read_all(folder / "stack.pdf"), StartsWith("%PDF"));
  const Outcome both = gearsweep(folder, "plot line.nc frictionless.nc -q x1_rms -o both.svg");
  EXPECT_EQ(both.status, 0) << both.err;
  EXPECT_THAT(read_all(folder / "both.svg"), AllOf(HasSubstr("μ"), HasSubstr(" = 0.05")));
}

TEST(Commands, WithoutOutputTheFileBearsTheNameOfTheStudy) {
  const Folder folder;
  EXPECT_EQ(gearsweep(folder, std::string("run coarse-map --quiet") + kSmall).status, 0);
  EXPECT_EQ(folder.files(), std::set<std::string>{"coarse-map.nc"});
}

TEST(Commands, ScriptsReadJson) {
  const Folder folder;
  const Outcome run =
      gearsweep(folder, std::string("run coarse-map --quiet --json -o map.nc") + kSmall);
  EXPECT_THAT(run.out, HasSubstr("\"points\": 24"));
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(gearsweep(folder, "devices --json").out, HasSubstr("\"number\": 0"));
  EXPECT_THAT(gearsweep(folder, "studies --json").out, HasSubstr("\"coarse-map\""));
  EXPECT_THAT(gearsweep(folder, "model gear5 --json").out, HasSubstr("\"omega\""));
  EXPECT_THAT(gearsweep(folder, "model gear5").out,
              HasSubstr("shares a range with v1, v2, v3, v4; diverged above 1e+06"));
}

TEST(Commands, AModelIsShownWithTheOriginOfEachValue) {
  const Folder folder;
  const Outcome preset = gearsweep(folder, "model gear5 --preset paper");
  EXPECT_THAT(preset.out, HasSubstr("0.173386"));
  EXPECT_THAT(preset.out, HasSubstr("preset paper"));
  const Outcome gear = gearsweep(folder, "model --study table1-gear");
  EXPECT_THAT(gear.out, HasSubstr("me/mp = 0.350752 kg / 1 kg"));
}

// A name or the place of a channel in one, in the list of a model.
std::set<std::string> listed_quantities(const std::string& text, const nlohmann::json& model) {
  std::set<std::string> names;
  std::istringstream lines(text.substr(text.find("\nquantities\n") + 12));
  for (std::string line; std::getline(lines, line) && line.rfind("  ", 0) == 0;) {
    const std::string name = line.substr(2, line.find(' ', 2) - 2);
    if (name.rfind("CHANNEL", 0) != 0) {
      names.insert(name);
      continue;
    }
    for (const char* kind : {"states", "signals"}) {
      if (!model.contains(kind)) continue;
      for (const std::string channel : model.at(kind)) names.insert(channel + name.substr(7));
    }
  }
  return names;
}

class ListedModel : public OfEachModel {};

TEST_P(ListedModel, HasEveryQuantityThatAStudyMayAskForAndNoOther) {
  const Folder folder;
  const std::string show = "model " + its_model().name;
  const nlohmann::json json = nlohmann::json::parse(gearsweep(folder, show + " --json").out);
  std::set<std::string> offered;
  for (const Quantity& quantity : offered_quantities(its_model())) offered.insert(quantity.name);
  EXPECT_EQ(listed_quantities(gearsweep(folder, show).out, json), offered);
}

INSTANTIATE_TEST_SUITE_P(Few, ListedModel, ::testing::ValuesIn(few_models()), name_of_model);
INSTANTIATE_TEST_SUITE_P(Others, ListedModel, ::testing::ValuesIn(other_models()), name_of_model);

TEST(Commands, ColumnsOfAListStandUnderEachOther) {
  const Folder folder;
  const std::string text = gearsweep(folder, "model gear5").out;
  // Where the second word of a row begins.
  const auto column = [&](const std::string& first) {
    const std::size_t at = text.find("\n  " + first + " ") + 3 + first.size();
    return text.find_first_not_of(' ', at) - (at - first.size());
  };
  EXPECT_EQ(column("contact_class"), column("lyapunov_max_per_period"));
  EXPECT_EQ(column("x1"), column("v5"));
  EXPECT_EQ(column("dmf"), column("friction_lever"));
}

TEST(Commands, EveryBuiltInStudyPrintsAsTomlThatReads) {
  const Folder folder;
  const Outcome list = gearsweep(folder, "studies");
  std::istringstream lines(list.out);
  int studies = 0;
  for (std::string line; std::getline(lines, line); ++studies) {
    const std::string name = line.substr(0, line.find(' '));
    folder.write("copy.toml", gearsweep(folder, "studies " + name).out);
    EXPECT_EQ(gearsweep(folder, "model --study copy.toml").status, 0) << name;
  }
  EXPECT_GE(studies, 1);
}

TEST(Commands, KernelsPrintsTheProgramOfTheStudy) {
  const Folder folder;
  const Outcome sweep =
      gearsweep(folder,
                "kernels coarse-map --set 'observe.quantities=[\"dmf_max\"]' --set "
                "integrate.precision=fp32 --set integrate.lanes=8");
  EXPECT_EQ(sweep.status, 0) << sweep.err;
  EXPECT_THAT(sweep.out, AllOf(HasSubstr("-DREAL_BITS=32 -DLANES=8"), HasSubstr("extrema_step("),
                               HasSubstr("__kernel void record("), Not(HasSubstr("#include \""))));
  EXPECT_THAT(gearsweep(folder, "kernels coarse-map --program orbit").out,
              HasSubstr("__kernel void follow("));
  const Outcome wrong = gearsweep(folder, "kernels coarse-map --program sweeep");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("did you mean 'sweep'?"));
}

TEST(Commands, EveryCommandHasHelpWithExamples) {
  const Folder folder;
  EXPECT_THAT(gearsweep(folder, "--version").out, StartsWith("gearsweep "));
  for (const char* command :
       {"", "run", "trace", "plot", "export", "floquet", "reproduce", "studies", "model", "devices",
        "kernels", "verify", "bench", "completion", "manual", "top", "help"}) {
    const Outcome help = gearsweep(folder, std::string(command) + " --help");
    EXPECT_EQ(help.status, 0);
    EXPECT_THAT(help.out, HasSubstr("gearsweep ")) << command;
  }
}

}  // namespace
}  // namespace gearsweep::testing
