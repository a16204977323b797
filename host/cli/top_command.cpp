// gearsweep top: the most extreme points of a map, one for each peak.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/text_table.hpp"
#include "cli/standard_streams.hpp"
#include "model/error.hpp"
#include "result/broken_file.hpp"
#include "result/json_text.hpp"
#include "result/peaks.hpp"
#include "result/result_file.hpp"
#include "result/study_source.hpp"
#include "study/study.hpp"

namespace gearsweep {
namespace {

struct TopArguments {
  std::string result, quantity;
  PeakSearch search;
  bool as_json = false;
};

ResultMap read_map(const ResultFile& file, const std::string& quantity) {
  ResultMap map = file.read(quantity);
  if (map.is_poincare() || map.part_count() > 1) {
    const std::string first = fmt::format("{}:{}", map.name, map.parts.front().name);
    throw InputError(fmt::format("-q {}: has several numbers for each point{}", quantity,
                                 map.is_poincare()
                                     ? "; take the section_max or an rms, for example"
                                     : fmt::format("; take one of them, {} for example", first)));
  }
  return map;
}

// The axes as --at knows them; a file may have had to give them other names.
std::vector<std::string> names_of_axes(const ResultFile& file) {
  std::vector<std::string> names;
  for (const Axis& axis : read_result_study(file.path()).axes) {
    names.push_back(axis.name);
  }
  if (names.size() != file.axes().size()) {
    throw InputError(fmt::format("'{}': its study has not the axes of its maps", file.path()));
  }
  return names;
}

// "omega=0.7,b=1", as `trace --at` takes it.
std::string place_of(const ResultMap& map, const std::vector<std::string>& names,
                     const Peak& peak) {
  std::vector<std::string> values;
  for (std::size_t axis = 0; axis < map.axes.size(); ++axis) {
    values.push_back(
        fmt::format("{}={}", names.at(axis), map.axes[axis].values[peak.places[axis]]));
  }
  return fmt::format("{}", fmt::join(values, ","));
}

std::string value_of(const ResultMap& map, double value) {
  const bool is_class = value >= 0.0 && value < static_cast<double>(map.flags.size());
  return is_class ? map.flags[static_cast<std::size_t>(value)] : fmt::format("{:.6g}", value);
}

// "33 values of omega or 25 of b"
std::string describe_distance(const ResultMap& map, const std::vector<std::string>& names,
                              double apart) {
  std::vector<std::string> parts;
  for (std::size_t axis = 0; axis < map.axes.size(); ++axis) {
    parts.push_back(fmt::format("{} {}of {}", steps_apart(map.axes[axis], apart),
                                axis == 0 ? "values " : "", names.at(axis)));
  }
  return fmt::format("{}", fmt::join(parts, " or "));
}

std::string as_text(const TopArguments& arguments, const ResultMap& map,
                    const std::vector<std::string>& names, const std::vector<Peak>& peaks) {
  TextTable rows;
  for (const Peak& peak : peaks) {
    rows.add(
        {value_of(map, peak.value), place_of(map, names, peak), peak.at_edge ? "at the edge" : ""});
  }
  const std::string what = arguments.search.smallest ? "smallest" : "largest";
  return fmt::format("{} of {}, the {} {}, at least {} apart:\n{}", map.name, arguments.result,
                     what, peaks.size() == 1 ? "point" : fmt::format("{} peaks", peaks.size()),
                     describe_distance(map, names, arguments.search.apart), rows.text());
}

nlohmann::json as_json(const ResultMap& map, const std::vector<std::string>& names,
                       const std::vector<Peak>& peaks) {
  nlohmann::json list = nlohmann::json::array();
  for (const Peak& peak : peaks) {
    nlohmann::json place;
    for (std::size_t axis = 0; axis < map.axes.size(); ++axis) {
      place[names.at(axis)] = map.axes[axis].values[peak.places[axis]];
    }
    list.push_back({{"value", peak.value},
                    {"at", place},
                    {"argument", place_of(map, names, peak)},
                    {"at_edge", peak.at_edge}});
  }
  return {{"quantity", map.name}, {"unit", map.unit}, {"peaks", list}};
}

void run(const TopArguments& arguments) {
  ensure_not_broken(arguments.result);
  const ResultFile file(arguments.result);
  const ResultMap map = read_map(file, arguments.quantity);
  const std::vector<std::string> names = names_of_axes(file);
  const std::vector<Peak> peaks = find_peaks(map, arguments.search);
  if (arguments.as_json) {
    answer("{}", json_text(as_json(map, names, peaks)));
  } else if (peaks.empty()) {
    answer("{} of {} has no value at any point\n", map.name, arguments.result);
  } else {
    answer("{}", as_text(arguments, map, names, peaks));
  }
  if (!peaks.empty() && peaks.size() < arguments.search.count) {
    tell("gearsweep: only {} {} so far apart; a smaller --apart may find more\n", peaks.size(),
         peaks.size() == 1 ? "peak lies" : "peaks lie");
  }
}

}  // namespace

void add_top_command(CLI::App* app) {
  CLI::App* command =
      app->add_subcommand("top", "The largest or smallest points of a map, one for each peak");
  const auto arguments = std::make_shared<TopArguments>();
  command->add_option("result", arguments->result, "A result file")
      ->type_name(kResultValue)
      ->required();
  command->add_option("-q,--quantity", arguments->quantity, "Of which quantity")
      ->type_name(kQuantityValue)
      ->required();
  command->add_option("-n,--count", arguments->search.count, "At most so many (default: 5)")
      ->type_name(kNumberValue)
      ->check(whole_number(1, 1000));
  command->add_flag("--smallest", arguments->search.smallest,
                    "The smallest points, not the largest");
  command
      ->add_option(
          "--apart", arguments->search.apart,
          "Two peaks are further apart than this share of an axis's values, on one axis at "
          "smallest (default: 0.05)")
      ->type_name("SHARE")
      ->check(number_between(0.0, 1.0));
  command->add_flag("--json", arguments->as_json, "For scripts");
  command->footer(
      "Examples:\n"
      "  gearsweep top map.nc -q lyapunov_max -n 5\n"
      "  gearsweep top map.nc -q x1_rms --smallest --json\n"
      "  gearsweep trace map.nc --at omega=1.25,e0=0.6 -o trace.nc   with a place that top "
      "printed\n\n"
      "A peak is a point, or a plateau of equal points, that none of its neighbours on the grid\n"
      "exceeds. Of peaks that are not far enough apart only the most extreme is told.");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace gearsweep
