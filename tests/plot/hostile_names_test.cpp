// Whatever files and folders are called, they are files: no name runs a command, in no kind of
// picture, and what it names is written and read.
#include <gmock/gmock.h>

#include <cstdlib>

#include "plot/detail/gnuplot.hpp"
#include "plot/plot.hpp"
#include "result/example_result.hpp"
#include "result/example_trace.hpp"
#include "result/trace_file.hpp"

namespace gearsweep {
namespace {

namespace fs = std::filesystem;
using gearsweep::testing::example_result;
using gearsweep::testing::kProvenance;
using gearsweep::testing::made_trace;
using gearsweep::testing::spectrum_result;
using ::testing::StartsWith;

// Each would make a file whose name begins with "pwned", if it were taken for more than a name.
const std::vector<std::string>& hostile_names() {
  static const std::vector<std::string> kNames = {"|touch pwned;",
                                                  "<touch pwned;",
                                                  "< touch pwned; cat x",
                                                  "`touch pwned`",
                                                  "$(touch pwned)",
                                                  "';system 'touch pwned';'",
                                                  "\";system \"touch pwned\";\"",
                                                  "'.system('touch pwned').'",
                                                  "line\n!touch pwned\n",
                                                  "@pwned",
                                                  "~",
                                                  "~root",
                                                  "-",
                                                  "-e system('touch pwned')",
                                                  "%s%n%1$s",
                                                  "back\\slash\\",
                                                  "# comment",
                                                  " blank",
                                                  "http:",
                                                  "file:#mode=zarr",
                                                  "[mode=zarr]x",
                                                  "*",
                                                  "\xff\xfe"};
  return kNames;
}

// A picture: of which file beside the tested name, and what.
struct Kind {
  std::string file;  // "map", "line", "spectrum" or "trace"
  std::string quantity;
  bool is_cut = false, has_layers = false;
};

const std::vector<Kind> kKinds = {{"map", "x1_rms"},
                                  {"map", "contact_class"},
                                  {"map", "x1_rms", true},
                                  {"uneven", "x1_rms"},
                                  {"line", "poincare"},
                                  {"line", "x1_rms"},
                                  {"line", "contact_class"},
                                  {"line", "poincare,x1_rms,contact_class"},
                                  {"line", "x1_rms", false, true},
                                  {"line", "poincare,contact_class", false, true},
                                  {"spectrum", "lyapunov_spectrum"},
                                  {"dense", "poincare"},
                                  {"trace", "time"},
                                  {"trace", "phase"},
                                  {"trace", "section"},
                                  {"trace", "spectrum"},
                                  {"trace", "force"},
                                  {"trace", "time", false, true},
                                  {"trace", "force", false, true},
                                  {"trace", "phase", false, true}};

// In a folder of its own, which is the current one, as names without a folder need.
class HostileNames : public gearsweep::testing::IoTest {
 protected:
  HostileNames() : before_(fs::current_path()) { fs::current_path(folder_); }
  ~HostileNames() override { fs::current_path(before_); }

  // Writes the file that a kind of picture is of.
  static void write_source(const std::string& file, const std::string& path) {
    if (file == "trace") {
      const Study study = read_study("[[axes]]\nname = 'omega'\nvalues = [0.5]\n", "test");
      write_traces({made_trace(study, 20, 16)}, {path}, {}, study, path, kProvenance);
      return;
    }
    SweepResult result = file == "spectrum" ? spectrum_result(7, 0)
                         : file == "line"   ? example_result(7, 0)
                         : file == "dense"  ? example_result(200, 0)
                                            : example_result();
    if (file == "uneven") result.study.axes[0].values = {0.1, 1.0, 10.0, 100.0};
    if (file == "dense") {
      result.study.integrate.record = 101;
      result.samples.assign(200 * 2 * 101, 0.5);
    }
    result.study.title = path;
    write_result(result, path, kProvenance);
  }

  // Draws with names of input, picture and script that begin so; then the kept script draws again.
  static void draw(const Kind& kind, const std::string& name) {
    PlotRequest request;
    request.paths = {name + ".nc"};
    write_source(kind.file, request.paths.front());
    if (kind.has_layers) {
      request.paths.push_back(name + " 2.nc");
      write_source(kind.file, request.paths.back());
    }
    request.quantity = kind.quantity;
    if (kind.is_cut) request.at = {"b", 1.0};
    request.output_path = name + ".svg";
    request.script_path = name + ".gp";
    plot_files(request);
    EXPECT_THAT(content(request.output_path), StartsWith("<?xml")) << name;
    fs::remove(request.output_path);
    run_gnuplot(request.script_path);
    EXPECT_THAT(content(request.output_path), StartsWith("<?xml")) << name;
  }

  // The names of all that lies in the current folder.
  static std::string pwned() {
    for (const auto& entry : fs::directory_iterator(".")) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with("pwned")) return name;
    }
    return "";
  }

  fs::path before_;
};

TEST_F(HostileNames, RunNothingInAnyPicture) {
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    const std::string name = i % 2 == 0 ? "|touch pwned;" : "<touch pwned;";
    draw(kKinds[i], name);
    EXPECT_EQ(pwned(), "") << kKinds[i].file << " " << kKinds[i].quantity << ": " << name;
  }
}

TEST_F(HostileNames, AreFilesForEveryCommand) {
  for (const std::string& name : hostile_names()) {
    draw({"line", "x1_rms", false, true}, name);
    EXPECT_EQ(pwned(), "") << name;
  }
}

TEST_F(HostileNames, OfFoldersAreFolders) {
  for (const std::string& name : hostile_names()) {
    fs::create_directory(name);
    draw({"trace", "time"}, name + "/picture");
    EXPECT_EQ(pwned(), "") << name;
  }
}

// Someone who keeps a script starts it as they like.
TEST_F(HostileNames, OfKeptScriptsAreFilesForGnuplotToo) {
  draw({"line", "x1_rms"}, "|touch pwned;");
  fs::remove("|touch pwned;.svg");
  EXPECT_EQ(std::system("gnuplot '|touch pwned;.gp'"), 0);
  EXPECT_TRUE(fs::exists("|touch pwned;.svg"));
  EXPECT_EQ(std::system("gnuplot -c '|touch pwned;.gp' '|touch pwned; .svg'"), 0);
  EXPECT_TRUE(fs::exists("|touch pwned; .svg"));
  EXPECT_EQ(pwned(), "");
}

}  // namespace
}  // namespace gearsweep
