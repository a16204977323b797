// gearsweep devices, gearsweep studies.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/study_source.hpp"
#include "cli/detail/text_table.hpp"
#include "cli/standard_streams.hpp"
#include "opencl/device.hpp"
#include "result/json_text.hpp"

namespace gearsweep {
namespace {

void print_devices_as_json(const std::vector<DeviceInfo>& devices) {
  nlohmann::json list = nlohmann::json::array();
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const DeviceInfo& device = devices[i];
    list.push_back({{"number", i},
                    {"name", device.name},
                    {"platform", device.platform},
                    {"driver", device.driver},
                    {"type", device.is_cpu ? "cpu" : "gpu"},
                    {"compute_units", device.compute_units},
                    {"fp64", device.fp64},
                    {"lanes_fp64", device.lanes_fp64},
                    {"lanes_fp32", device.lanes_fp32}});
  }
  answer("{}", json_text(list));
}

void print_devices(const std::vector<DeviceInfo>& devices) {
  const std::size_t chosen = default_device(devices);
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const DeviceInfo& device = devices[i];
    answer("{}{} {}\n    {}, {}, driver {}, {} compute units, {}, lanes {} (fp64) {} (fp32)\n", i,
           i == chosen ? "*" : " ", device.name, device.platform, device.is_cpu ? "CPU" : "GPU",
           device.driver, device.compute_units, device.fp64 ? "fp64" : "no fp64", device.lanes_fp64,
           device.lanes_fp32);
  }
  answer("* is used unless --device says otherwise\n");
}

void print_studies(bool as_json) {
  nlohmann::json list = nlohmann::json::array();
  TextTable rows;
  for (const std::string& name : builtin_study_names()) {
    const Study study = load_study(name, {});
    if (as_json) {
      list.push_back({{"name", name}, {"title", study.title}, {"points", study.points()}});
    } else {
      rows.add({name, fmt::format("{} ({} points)", study.title, study.points())});
    }
  }
  answer("{}", as_json ? json_text(list) : rows.text(0));
}

}  // namespace

void add_devices_command(CLI::App* app) {
  CLI::App* command = app->add_subcommand("devices", "List the OpenCL devices");
  const auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "For scripts");
  command->footer("Example: gearsweep run coarse-map --device 1");
  command->callback([as_json] {
    const std::vector<DeviceInfo> devices = list_devices();
    if (*as_json) {
      print_devices_as_json(devices);
    } else {
      print_devices(devices);
    }
  });
}

void add_studies_command(CLI::App* app) {
  CLI::App* command =
      app->add_subcommand("studies", "List the built-in studies, or print one as TOML");
  const auto name = std::make_shared<std::string>();
  const auto as_json = std::make_shared<bool>(false);
  command->add_option("name", *name, "The study to print")->type_name(kBuiltinValue);
  command->add_flag("--json", *as_json, "The list for scripts");
  command->footer(
      "To start a study of your own:\n"
      "  gearsweep studies coarse-map > mine.toml\n"
      "  gearsweep run mine.toml -o mine.nc --plot mine.png");
  command->callback([name, as_json] {
    if (name->empty()) {
      print_studies(*as_json);
    } else {
      answer("{}", builtin_study_text(*name));
    }
  });
}

}  // namespace gearsweep
