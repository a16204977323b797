#include "cli/detail/gear_new.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/detail/arguments.hpp"
#include "cli/standard_streams.hpp"
#include "model/error.hpp"
#include "model/names.hpp"
#include "model/parse_number.hpp"
#include "result/output_file.hpp"
#include "study/new_gear.hpp"
#include "study/new_unit.hpp"

namespace gearsweep {
namespace {

struct NewArguments {
  std::vector<std::string> teeth;
  std::string module, width, helix, output;
  std::optional<double> torque;
  bool is_planetary = false;
};

constexpr const char* kArrangements =
    "\n  19/61                  a pair, the pinion first"
    "\n  19/33/61               driver, idler and last gear"
    "\n  20/41 18/45            two stages: pinion and gear of each"
    "\n  28/35/98 --planetary   sun, planets and ring";

[[noreturn]] void refuse_teeth(const NewArguments& arguments, const std::string& why) {
  throw InputError(fmt::format("'{}{}': {}; numbers of teeth are given as in{}",
                               fmt::join(arguments.teeth, " "),
                               arguments.is_planetary ? " --planetary" : "", why, kArrangements));
}

// "19/61"
std::vector<int> read_teeth(const NewArguments& arguments, const std::string& text) {
  std::vector<int> teeth;
  for (const std::string& part : split(text, '/')) {
    const std::optional<int> number = parse_number<int>(part);
    if (!number) refuse_teeth(arguments, fmt::format("'{}' is no number of teeth", part));
    teeth.push_back(*number);
  }
  return teeth;
}

// A number of each mesh, "3" or "3,4": of meshes that have no choice of their own it is one.
std::array<std::optional<double>, 2> read_numbers(const std::string& option,
                                                  const std::string& text, double min, double max,
                                                  bool is_of_stages) {
  if (text.empty()) return {};
  std::vector<std::optional<double>> numbers;
  for (const std::string& part : split(text, ',')) {
    const auto number = parse_number<double>(part);
    if (!number || !(*number >= min && *number <= max)) {
      throw InputError(
          min > 0.0
              ? fmt::format("{}: '{}' is not a number greater than 0", option, part)
              : fmt::format("{}: '{}' is not a number from {} to {}", option, part, min, max));
    }
    numbers.push_back(number);
  }
  if (numbers.size() == 1) return {numbers[0], numbers[0]};
  if (numbers.size() == 2 && is_of_stages) return {numbers[0], numbers[1]};
  throw InputError(
      is_of_stages
          ? fmt::format("{} {}: two stages have two numbers, 2.5,4, or one for both", option, text)
          : fmt::format("{} {}: these gears have one number, such as 2.5", option, text));
}

// Three numbers of teeth are a row or a planetary set, and only the flag tells them apart.
std::string note_on_row(const std::vector<int>& teeth) {
  if (teeth[2] != teeth[0] + 2 * teeth[1]) return "";
  return fmt::format(
      "note: {0}/{1}/{2} is three gears in a row; as sun, planets and ring it is "
      "'{0}/{1}/{2} --planetary'\n",
      teeth[0], teeth[1], teeth[2]);
}

GearArrangement arrangement_of(const NewArguments& arguments, const std::vector<int>& teeth) {
  if (arguments.is_planetary) {
    if (arguments.teeth.size() == 1 && teeth.size() == 3) return GearArrangement::planetary;
    refuse_teeth(arguments, "a planetary set has a sun, planets and a ring");
  }
  if (arguments.teeth.size() == 1) {
    if (teeth.size() == 3) return GearArrangement::idler;
    refuse_teeth(arguments, teeth.size() > 3
                                ? "rows of more than three gears have no model in the zoo"
                                : "one number of teeth makes no mesh");
  }
  if (arguments.teeth.size() > 2) {
    refuse_teeth(arguments, "more than two stages have no model in the zoo");
  }
  for (const std::string& stage : arguments.teeth) {
    if (split(stage, '/').size() == 2) continue;
    refuse_teeth(arguments, fmt::format("a stage is a pair of gears, and '{}' is none", stage));
  }
  return GearArrangement::two_stages;
}

// What the options say of each mesh.
struct MeshNumbers {
  std::array<std::optional<double>, 2> modules, widths, helices;
};

MeshNumbers numbers_of(const NewArguments& arguments, bool is_of_stages) {
  constexpr double kLeast = 1e-300, kMost = 1e300;
  return {read_numbers("--module", arguments.module, kLeast, kMost, is_of_stages),
          read_numbers("--width", arguments.width, kLeast, kMost, is_of_stages),
          read_numbers("--helix", arguments.helix, 0.0, 45.0, is_of_stages)};
}

std::string study_of(const NewArguments& arguments) {
  std::vector<int> teeth;
  for (const std::string& stage : arguments.teeth) {
    const std::vector<int> own = read_teeth(arguments, stage);
    teeth.insert(teeth.end(), own.begin(), own.end());
  }
  const bool is_row = !arguments.is_planetary && arguments.teeth.size() == 1;
  if (is_row && teeth.size() == 2) {
    const MeshNumbers numbers = numbers_of(arguments, false);
    return new_gear_study({{teeth[0], teeth[1]},
                           *numbers.modules[0],
                           numbers.widths[0],
                           arguments.torque,
                           numbers.helices[0]});
  }
  const GearArrangement arrangement = arrangement_of(arguments, teeth);
  const MeshNumbers numbers = numbers_of(arguments, arrangement == GearArrangement::two_stages);
  if (arrangement == GearArrangement::idler) tell("{}", note_on_row(teeth));
  return new_unit_study({arrangement,
                         teeth,
                         {*numbers.modules[0], *numbers.modules[1]},
                         numbers.widths,
                         numbers.helices,
                         arguments.torque});
}

void begin(const NewArguments& arguments) {
  const std::string text = study_of(arguments);
  if (arguments.output.empty()) {
    answer("{}", text);
    return;
  }
  if (std::filesystem::exists(arguments.output)) {
    throw InputError(fmt::format("'{}' is there; give another name", arguments.output));
  }
  write_file(arguments.output, text);
  tell(
      "{} is a study: put your own numbers at ESTIMATE, then\n"
      "  gearsweep gear {}\n  gearsweep run {} -o result.nc --plot result.png\n",
      arguments.output, shell_quoted(arguments.output), shell_quoted(arguments.output));
}

}  // namespace

void add_gear_new_command(CLI::App* gear) {
  CLI::App* command = gear->add_subcommand(
      "new", "Begin the study of a gear pair, an idler, two stages or a planetary set");
  const auto arguments = std::make_shared<NewArguments>();
  command
      ->add_option("TEETH", arguments->teeth,
                   "Numbers of teeth: 19/61 (pinion/gear), 19/33/61 (driver/idler/last), 20/41 "
                   "18/45 (two stages), 28/35/98 with --planetary (sun/planet/ring)")
      ->required();
  command->add_flag("--planetary", arguments->is_planetary,
                    "Three numbers are those of sun, each of three planets, and ring");
  command->add_option("--module", arguments->module, "Module in mm; two stages may have two: 2.5,4")
      ->required()
      ->type_name("MM");
  command->add_option("--width", arguments->width, "Face width in mm; of two stages: 25,40")
      ->type_name("MM");
  command
      ->add_option("--torque", arguments->torque,
                   "Torque in N m on the pinion of the pair or the first stage, the driver or the "
                   "sun")
      ->type_name("NM")
      ->check(positive_number());
  command->add_option("--helix", arguments->helix, "Helix angle in degrees; of two stages: 15,10")
      ->type_name("DEG");
  command->add_option("-o,--output", arguments->output, "A file to write (default: to the screen)")
      ->type_name(kFileValue);
  command->footer(
      "The study runs as it is. What is not given is estimated, and marked as that.\n\n"
      "Examples:\n"
      "  gearsweep gear new 19/61 --module 2.5 --width 25 --torque 60 -o mine.toml\n"
      "  gearsweep gear new 19/33/61 --module 2.5 -o idler.toml\n"
      "  gearsweep gear new 20/41 18/45 --module 2.5,4 -o stages.toml\n"
      "  gearsweep gear new 28/35/98 --planetary --module 2 -o planets.toml");
  command->callback([arguments] { begin(*arguments); });
}

}  // namespace gearsweep
