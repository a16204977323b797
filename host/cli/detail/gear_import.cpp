#include "cli/detail/gear_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "cli/detail/arguments.hpp"
#include "cli/standard_streams.hpp"
#include "model/error.hpp"
#include "result/json_text.hpp"
#include "result/output_file.hpp"
#include "rexs/stage_choice.hpp"
#include "rexs/stage_drawing.hpp"
#include "rexs/unit_drawing.hpp"
#include "study/imported_gear.hpp"

namespace gearsweep {
namespace {

using Json = nlohmann::json;

struct ImportArguments {
  std::string file, stage, load_case, output;
  bool as_json = false, as_list = false, is_whole = false, as_spectrum = false;
};

Json json_of(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json json_of(const UnitGear& gear) {
  return {{"id", gear.id},
          {"name", gear.name},
          {"ring", gear.is_ring},
          {"shaft", gear.shaft ? Json(*gear.shaft + 1) : Json()},
          {"teeth", json_of(gear.teeth)},
          {"module_mm", json_of(gear.module)},
          {"helix_angle_deg", json_of(gear.helix)},
          {"pressure_angle_deg", json_of(gear.pressure_angle)},
          {"profile_shift", json_of(gear.shift)},
          {"face_width_mm", json_of(gear.face_width)},
          {"tip_diameter_mm", json_of(gear.tip_diameter)}};
}

const char* word_of(StageKind kind) {
  constexpr std::array kWords = {"external", "internal", "bevel", "worm", "other"};
  return kWords[static_cast<std::size_t>(kind)];
}

Json json_of(const GearUnit& unit, const UnitStage& stage) {
  Json gears = Json::array();
  for (const auto& gear : stage.gears) {
    if (gear) gears.push_back(json_of(unit.gears[*gear]));
  }
  return {{"id", stage.id},
          {"name", stage.name},
          {"kind", word_of(stage.kind)},
          {"gears", gears},
          {"centre_distance_mm", json_of(stage.centre_distance)},
          {"face_width_mm", json_of(stage.face_width)},
          {"contact_ratio", json_of(stage.contact_ratio)},
          {"planetary_stage", stage.planetary.empty() ? Json() : Json(stage.planetary)},
          {"no_study", stage.refusal.empty() ? Json() : Json(stage.refusal)}};
}

Json json_of(const GearUnit& unit) {
  Json told = {{"file", unit.source},
               {"rexs_version", unit.version},
               {"application", unit.application},
               {"stages", Json::array()},
               {"shafts", Json::array()},
               {"bearings", Json::array()},
               {"load_cases", Json::array()},
               {"notes", unit.notes}};
  for (const UnitStage& stage : unit.stages) told["stages"].push_back(json_of(unit, stage));
  for (const UnitShaft& shaft : unit.shafts) {
    told["shafts"].push_back({{"id", shaft.id},
                              {"name", shaft.name},
                              {"estimated_mass_kg", shaft.mass},
                              {"estimated_inertia_kg_mm2", shaft.inertia},
                              {"bodies", shaft.bodies},
                              {"speed_rpm", json_of(shaft.speed)}});
  }
  for (const UnitBearing& one : unit.bearings) {
    Json shafts = Json::array();
    for (const std::size_t shaft : one.shafts) shafts.push_back(shaft + 1);
    told["bearings"].push_back({{"id", one.id},
                                {"name", one.name},
                                {"kind", one.kind},
                                {"designation", one.designation},
                                {"shafts", shafts},
                                {"radial_stiffness_N_per_mm", json_of(one.radial_stiffness)}});
  }
  for (const UnitCase& one : unit.cases) {
    Json torques = Json::array(), speeds = Json::array();
    for (const auto& torque : one.torques) torques.push_back(json_of(torque));
    for (const auto& speed : one.speeds) speeds.push_back(json_of(speed));
    told["load_cases"].push_back({{"id", one.id},
                                  {"share", json_of(one.share)},
                                  {"first_gear_torque_N_m", torques},
                                  {"first_gear_speed_rpm", speeds}});
  }
  return told;
}

void list(const GearUnit& unit) {
  answer("{}, REXS {}, by {}\nstages\n{}", unit.source, unit.version, unit.application,
         list_of_stages(unit));
  answer("shafts, with estimated masses\n");
  for (const UnitShaft& shaft : unit.shafts) {
    answer("  {}: {:.4g} kg, {:.4g} kg mm^2\n", shaft.name, shaft.mass, shaft.inertia);
    for (const std::string& body : shaft.bodies) answer("    {}\n", body);
  }
  answer("bearings\n");
  for (const UnitBearing& one : unit.bearings) {
    answer("  {} ({}): {}\n", one.name, one.kind,
           one.radial_stiffness ? fmt::format("{:.4g} N/mm", *one.radial_stiffness)
                                : "no stiffness that can be used");
  }
  answer("loads, on the first gear of each stage\n");
  for (const UnitCase& one : unit.cases) {
    answer("  {}{}\n", one.id.empty() ? "of all the time" : "load case " + one.id,
           one.share ? fmt::format(", {:.4g} % of the time", 100.0 * *one.share) : "");
    for (std::size_t i = 0; i < unit.stages.size(); ++i) {
      if (!one.torques[i] && !one.speeds[i]) continue;
      answer("    stage {}:{}{}\n", i + 1,
             one.torques[i] ? fmt::format(" {:.5g} N m", *one.torques[i]) : "",
             one.speeds[i] ? fmt::format(" at {:.5g} rpm", *one.speeds[i]) : "");
    }
  }
  for (const std::string& note : unit.notes) answer("note: {}\n", note);
}

bool has_shares(const GearUnit& unit) {
  return unit.cases.size() > 1 &&
         std::ranges::all_of(unit.cases, [](const UnitCase& one) { return one.share.has_value(); });
}

// The study, and in words what it is of.
std::pair<ImportedGear, std::string> study_of(const ImportArguments& arguments,
                                              const GearUnit& unit) {
  const std::string name = std::filesystem::path(arguments.file).filename().string();
  const ImportedPoints points =
      arguments.as_spectrum ? ImportedPoints::load_spectrum : ImportedPoints::speeds;
  if (arguments.is_whole) {
    return {imported_unit_study(unit_drawing(unit, arguments.load_case), name, points),
            "the whole unit"};
  }
  const std::size_t stage = chosen_stage(unit, arguments.stage);
  const std::size_t load_case = chosen_case(unit, stage, arguments.load_case);
  return {imported_gear_study(stage_drawing(unit, stage, load_case), name, points),
          fmt::format("stage {}", stage + 1)};
}

void write_study(const ImportArguments& arguments, const GearUnit& unit) {
  const auto [study, what] = study_of(arguments, unit);
  for (const std::string& note : unit.notes) tell("note: {}\n", note);
  for (const std::string& note : study.notes) tell("note: {}\n", note);
  if (!arguments.as_spectrum && has_shares(unit)) {
    tell(
        "note: the file has {} load cases with their shares of the time: --spectrum makes a study "
        "of them all\n",
        unit.cases.size());
  }
  if (arguments.output.empty()) {
    answer("{}", study.toml);
    return;
  }
  write_file(arguments.output, study.toml);
  tell(
      "{} is a study of {}: put your own numbers at ESTIMATE, then\n"
      "  gearsweep gear {}\n  gearsweep run {} -o result.nc --plot result.png\n",
      arguments.output, what, shell_quoted(arguments.output), shell_quoted(arguments.output));
}

void import(const ImportArguments& arguments) {
  if (!arguments.output.empty() && std::filesystem::exists(arguments.output)) {
    throw InputError(fmt::format("'{}' is there; give another name", arguments.output));
  }
  const GearUnit unit = gear_unit_of(read_rexs_file(arguments.file));
  if (arguments.as_json) {
    answer("{}", json_text(json_of(unit)));
  } else if (arguments.as_list) {
    list(unit);
  } else {
    write_study(arguments, unit);
  }
}

}  // namespace

void add_gear_import_command(CLI::App* gear) {
  CLI::App* command =
      gear->add_subcommand("import", "Begin the study of a gear unit in REXS, or of a stage");
  const auto arguments = std::make_shared<ImportArguments>();
  command->add_option("FILE", arguments->file, "A gear unit in REXS 1.0 to 1.7, XML or JSON")
      ->required()
      ->type_name(kFileValue);
  CLI::Option* stage = command
                           ->add_option("--stage", arguments->stage,
                                        "Number or name of the stage (default: the only one)")
                           ->type_name("STAGE");
  command
      ->add_flag("--all", arguments->is_whole,
                 "The whole unit: two stages, or a planetary stage, as a model with a drawing each")
      ->excludes(stage);
  CLI::Option* load_case = command
                               ->add_option("--case", arguments->load_case,
                                            "Load case (default: the one of the highest torque)")
                               ->type_name("CASE");
  command
      ->add_flag("--spectrum", arguments->as_spectrum,
                 "All load cases, as a load spectrum, in place of a range of speeds")
      ->excludes(load_case);
  command->add_flag("--list", arguments->as_list, "Print what was read, and write no study");
  command->add_flag("--json", arguments->as_json, "The same as JSON");
  command->add_option("-o,--output", arguments->output, "A file to write (default: to the screen)")
      ->type_name(kFileValue);
  command->footer(
      "The study runs as it is. Comments say which numbers are from the file, computed from it or\n"
      "estimated; masses are estimates of shaft sections and gear discs.\n\n"
      "Examples:\n  gearsweep gear import unit.rexs --list\n"
      "  gearsweep gear import unit.rexs --stage 1 -o stage1.toml\n"
      "  gearsweep gear import unit.rexs --stage 1 --spectrum -o loads.toml\n"
      "  gearsweep gear import unit.rexs --all -o unit.toml");
  command->callback([arguments] { import(*arguments); });
}

}  // namespace gearsweep
