// gearsweep gear: what follows from the drawings of a study.
#include <fmt/format.h>

#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/gear_import.hpp"
#include "cli/detail/gear_new.hpp"
#include "cli/detail/study_source.hpp"
#include "cli/detail/text_table.hpp"
#include "cli/standard_streams.hpp"
#include "model/error.hpp"
#include "model/exciting_meshes.hpp"
#include "model/names.hpp"
#include "orders/natural_modes.hpp"
#include "result/json_text.hpp"
#include "result/study_source.hpp"

namespace gearsweep {
namespace {

constexpr std::array kOrders = {1, 2, 3};  // of the mesh frequency

struct GearArguments {
  std::string study;
  std::vector<std::string> overrides;
  bool as_json = false;
};

std::vector<ExcitingMesh> meshes_of(const Study& study) {
  return exciting_meshes(*study.model, study.setting);
}

// A speed of the pinion at which an order of the mesh meets a natural frequency.
double critical_rpm(const NaturalMode& mode, int order, const ExcitingMesh& mesh,
                    const Scales& scales) {
  return mode.frequency / (order * mesh.order) * scales.rpm_per_omega;
}

double hertz(const NaturalMode& mode, const Scales& scales) {
  return mode.frequency * scales.varpi / (2.0 * std::numbers::pi);
}

void print(const std::string& name, const Study& study, const std::vector<NaturalMode>& modes) {
  answer("from the drawing\n");
  for (const std::string& note : study.gear_notes) answer("  {}\n", note);
  answer(
      "\nnatural frequencies of small motions with all teeth in contact, and the pinion's speed "
      "(rpm) at\nwhich an order of the mesh frequency meets them\n");
  TextTable rows;
  const std::vector<ExcitingMesh> meshes = meshes_of(study);
  std::vector<std::string> head = {"Hz", "damping"};
  for (const ExcitingMesh& mesh : meshes) {
    for (const int order : kOrders) {
      head.push_back(mesh.name.empty() ? fmt::format("order {}", order)
                                       : fmt::format("{} of {}", order, mesh.name));
    }
  }
  rows.add(std::move(head));
  for (const NaturalMode& mode : modes) {
    std::vector<std::string> row = {fmt::format("{:.5g}", hertz(mode, study.scales)),
                                    fmt::format("{:.3g} %", 100.0 * mode.damping)};
    for (const ExcitingMesh& mesh : meshes) {
      for (const int order : kOrders) {
        row.push_back(fmt::format("{:.5g}", critical_rpm(mode, order, mesh, study.scales)));
      }
    }
    rows.add(std::move(row));
  }
  answer("{}", rows.text());
  answer("\nEach parameter of the model, and how it came about:\n  gearsweep model --study {}\n",
         shell_quoted(name));
}

void print_json(const Study& study, const std::vector<NaturalMode>& modes) {
  nlohmann::json told = {{"notes", study.gear_notes},
                         {"varpi_rad_per_s", study.scales.varpi},
                         {"b_n_m", study.scales.b_n},
                         {"k0_N_per_m", study.scales.k0},
                         {"rpm_per_omega", study.scales.rpm_per_omega},
                         {"modes", nlohmann::json::array()}};
  for (const NaturalMode& mode : modes) {
    nlohmann::json& one = told["modes"].emplace_back();
    one = {{"frequency_Hz", hertz(mode, study.scales)}, {"damping", mode.damping}};
    for (const ExcitingMesh& mesh : meshes_of(study)) {
      const bool is_first = mesh.name == study.model->unit_drawing || mesh.name.empty();
      nlohmann::json& critical = one[is_first ? "critical_rpm" : "critical_rpm_" + mesh.name];
      for (const int order : kOrders) {
        critical.push_back(critical_rpm(mode, order, mesh, study.scales));
      }
    }
  }
  answer("{}", json_text(told));
}

void show(const GearArguments& arguments) {
  const Study study = find_draft(arguments.study, arguments.overrides);
  if (!study.scales.known()) {
    throw InputError(
        fmt::format("'{}' has no [gear] table; 'gearsweep gear new 19/61 --module 2.5' begins one",
                    arguments.study));
  }
  tell_notices(study);
  const std::vector<NaturalMode> modes = natural_modes(*study.model, study.setting);
  if (arguments.as_json) {
    print_json(study, modes);
  } else {
    print(arguments.study, study, modes);
  }
}

}  // namespace

void add_gear_command(CLI::App* app) {
  CLI::App* command =
      app->add_subcommand("gear", "Show what follows from a drawing, or begin a study of one");
  const auto arguments = std::make_shared<GearArguments>();
  add_gear_new_command(command);
  add_gear_import_command(command);
  command
      ->add_option("STUDY", arguments->study,
                   "A study with a [gear] table, or that table alone; its axes may be missing")
      ->type_name(kStudyValue);
  command->add_flag("--json", arguments->as_json, "Print JSON");
  add_set_option(command, &arguments->overrides);
  command->footer(
      "Examples:\n"
      "  gearsweep gear new 19/61 --module 2.5 -o mine.toml    a study, whose estimates are "
      "marked\n"
      "  gearsweep gear import unit.rexs --stage 1 -o mine.toml    a stage of a gear unit in REXS\n"
      "  gearsweep gear mine.toml                              contact ratio, stiffness, critical "
      "speeds\n"
      "  gearsweep gear mine.toml --set gear.torque_N_m=80");
  command->callback([command, arguments] {
    if (!command->get_subcommands().empty()) return;
    if (arguments->study.empty()) {
      throw InputError(
          "give a study with a [gear] table, or begin one: gearsweep gear new 19/61 "
          "--module 2.5");
    }
    show(*arguments);
  });
}

}  // namespace gearsweep
