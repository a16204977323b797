#include "cli/detail/arguments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "model/error.hpp"
#include "model/names.hpp"
#include "model/parse_number.hpp"
#include "result/result_file.hpp"

namespace gearsweep {
namespace {

// The command that the arguments name, which may be one of another; the whole tool when there is
// none.
const CLI::App& parsed_command(const CLI::App& app) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  return parsed.empty() ? app : parsed_command(*parsed.front());
}

// "gearsweep gear new"
std::string call_of(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return parent == nullptr ? command.get_name() : call_of(*parent) + " " + command.get_name();
}

// What an option is called here whose name is known from other programs; empty for all others.
std::string own_name(const std::string& option) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 14> kNames = {{
      {"--cmap", "--colormap"},
      {"--palette", "--colormap"},
      {"--colors", "--colormap"},
      {"--xlim", "--xrange"},
      {"--ylim", "--yrange"},
      {"--clim", "--range"},
      {"--vmin", "--range"},
      {"--vmax", "--range"},
      {"--figsize", "--size"},
      {"--levels", "--contours"},
      {"--out", "--output"},
      {"--gpu", "--device"},
      {"--variable", "--quantity"},
      {"--param", "--set"},
  }};
  for (const auto& [known, own] : kNames) {
    if (known == option) return std::string(own);
  }
  return "";
}

std::string describe_extra(const CLI::App& command) {
  const std::string extra = command.remaining().front();
  if (extra[0] != '-') {
    return fmt::format("'{}' does not know what to do with '{}'", call_of(command), extra);
  }
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    for (const std::string& name : option->get_snames()) known.push_back("-" + name);
  }
  const std::string name = extra.substr(0, extra.find('='));
  const std::string own = own_name(name);
  if (!own.empty() && std::ranges::find(known, own) != known.end()) {
    return fmt::format("'{}' has no option '{}'; did you mean '{}'?", call_of(command), name, own);
  }
  return fmt::format("'{}' has no option '{}'{}", call_of(command), name,
                     suggest_name(name, known));
}

std::string describe_missing(const CLI::App& app, const CLI::App& command) {
  if (&app == &command) {
    std::vector<std::string> names;
    for (const CLI::App* one : app.get_subcommands({})) names.push_back(one->get_name());
    return fmt::format("no command is given; there are {}", fmt::join(names, ", "));
  }
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_required() || option->count() > 0) continue;
    return fmt::format("'{}' needs {} {}: {}", call_of(command), option->get_name(),
                       option->get_type_name(), option->get_description());
  }
  return "something is missing";
}

// The option that the parser's message is about.
const CLI::Option* option_of(const CLI::App& command, const std::string& message) {
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (message.rfind(name + ":", 0) == 0 || message.find(" " + name + " ") != std::string::npos) {
      return option;
    }
  }
  return nullptr;
}

std::string describe_mismatch(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) {
    return fmt::format("{} takes no value", option.get_name());
  }
  return fmt::format("{} takes one value, {}: {}", option.get_name(), option.get_type_name(),
                     option.get_description());
}

std::string describe(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = parsed_command(app);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) return describe_extra(command);
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    return &app == &command && !app.remaining().empty() ? describe_extra(command)
                                                        : describe_missing(app, command);
  }
  const CLI::Option* option = option_of(command, error.what());
  const bool mismatch = dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr ||
                        dynamic_cast<const CLI::ConversionError*>(&error) != nullptr;
  if (mismatch && option != nullptr) return describe_mismatch(*option);
  return error.what();
}

CLI::Validator one_of(const std::vector<std::string>& choices) {
  const auto check = [choices](const std::string& text) {
    const bool right = std::find(choices.begin(), choices.end(), text) != choices.end();
    return right ? std::string() : fmt::format("unknown '{}'{}", text, suggest_name(text, choices));
  };
  return {check, ""};
}

}  // namespace

CLI::Validator whole_number(std::size_t min, std::size_t max) {
  return CLI::Validator(
      [min, max](const std::string& text) {
        const auto value = parse_number<std::size_t>(text);
        const bool right = value && *value >= min && *value <= max;
        return right ? std::string()
                     : fmt::format("'{}' is not a whole number from {} to {}", text, min, max);
      },
      "");
}

CLI::Validator positive_number() {
  return CLI::Validator(
      [](const std::string& text) {
        const auto value = parse_number<double>(text);
        const bool right = value && std::isfinite(*value) && *value > 0.0;
        return right ? std::string() : fmt::format("'{}' is not a number greater than 0", text);
      },
      "");
}

CLI::Validator number_between(double min, double max) {
  return CLI::Validator(
      [min, max](const std::string& text) {
        const auto value = parse_number<double>(text);
        const bool right = value && *value >= min && *value <= max;
        return right ? std::string()
                     : fmt::format("'{}' is not a number from {} to {}", text, min, max);
      },
      "");
}

CLI::Option* add_choice(CLI::App* command, const std::string& name, std::string* value,
                        const std::vector<std::string>& choices, const std::string& description) {
  return command->add_option(name, *value, description)
      ->type_name(fmt::format("{}", fmt::join(choices, "|")))
      ->check(one_of(choices));
}

void add_device_option(CLI::App* command, std::string* text, bool several) {
  add_device_option(command, text, several ? kDevicesValue : kNumberValue,
                    several ? "Numbers of 'gearsweep devices' that share the work: 0,1 or all "
                              "('0/2': the halves of device 0)"
                            : "A number of 'gearsweep devices'");
}

void add_device_option(CLI::App* command, std::string* text, const char* value,
                       const std::string& description) {
  command->add_option("--device", *text, description)
      ->type_name(value)
      ->check([](const std::string& given) {
        return given.empty() ? std::string("'' is no list of numbers of 'gearsweep devices'")
                             : std::string();
      });
}

std::vector<DeviceChoice> chosen_devices(const std::string& text) {
  if (text.empty()) return {};
  return parse_devices(text, list_devices());
}

void add_study_argument(CLI::App* command, std::string* study, const std::string& more) {
  command->add_option("study", *study, "A study file, a built-in study or a result file" + more)
      ->type_name(kStudyValue)
      ->required();
}

CLI::Option* add_point_option(CLI::App* command, std::vector<std::string>* at,
                              const std::string& description) {
  return command->add_option("--at", *at, description)
      ->type_name(kPointValue)
      ->allow_extra_args(false);
}

void add_set_option(CLI::App* command, std::vector<std::string>* overrides) {
  command
      ->add_option("--set", *overrides, "Override a key of the study; may be given several times")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
}

void add_units_option(CLI::App* command, TableUnits* units) {
  command
      ->add_option_function<std::string>(
          "--units",
          [units](const std::string& text) {
            *units = text == "SI" ? TableUnits::si : TableUnits::model;
          },
          "SI: rpm, N, um, s in a table, of a study with a [gear] table (default: model)")
      ->type_name("SI|model")
      ->check(one_of({"SI", "model"}));
}

void require_result_path(const std::string& path) {
  for (const char* ending : {".csv", ".npy"}) {
    if (!path.ends_with(ending)) continue;
    throw InputError(
        fmt::format("{}: a result is a NetCDF file; give -o OUT.nc, then: gearsweep export OUT.nc "
                    "-q QUANTITY -o {}",
                    path, path));
  }
  for (const char* ending : {".png", ".svg", ".pdf", ".tex", ".gp", ".toml"}) {
    if (!path.ends_with(ending)) continue;
    throw InputError(
        fmt::format("{}: a result is a NetCDF file, not a '{}'; give -o OUT.nc", path, ending));
  }
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error) && !is_netcdf(path)) {
    throw InputError(fmt::format(
        "{}: exists and is no result file; it would be lost: give another output, -o OUT.nc",
        path));
  }
}

void refuse_own_output(const std::string& input, const std::string& output) {
  std::error_code error;
  if (!std::filesystem::equivalent(input, output, error)) return;
  throw InputError(fmt::format(
      "{}: the result would replace its own study; give another output: -o OUT.nc", input));
}

std::string shell_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char letter : text) {
    quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  }
  return quoted + "'";
}

std::string describe_parse_error(const CLI::App& app, const CLI::ParseError& error) {
  return fmt::format("{}\n'{} --help' shows examples", describe(app, error),
                     call_of(parsed_command(app)));
}

}  // namespace gearsweep
