// What the commands' arguments share: names of the values that they take, options that several
// commands have, checks that say what would be right.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>
#include <vector>

#include "opencl/device.hpp"
#include "result/table_units.hpp"

namespace gearsweep {

// Type names of values. Help and the manual show them; the shells' completion goes by them.
constexpr const char* kStudyValue = "STUDY";     // a study file, a built-in study or a result file
constexpr const char* kBuiltinValue = "NAME";    // a built-in study
constexpr const char* kModelValue = "MODEL";     // a model
constexpr const char* kResultValue = "FILE.nc";  // a result file or a file of traces
constexpr const char* kFileValue = "FILE";       // a file to write
constexpr const char* kFolderValue = "FOLDER";   // a folder to write
constexpr const char* kNumberValue = "N";
constexpr const char* kShardValue = "K/N";
constexpr const char* kDevicesValue = "DEVICES";  // one or more
constexpr const char* kQuantityValue = "QUANTITY";
constexpr const char* kZoomValue = "AXIS=FROM:TO[:COUNT],...";
constexpr const char* kPointValue = "NAME=VALUE,...";

// Digits, and a value in the range.
CLI::Validator whole_number(std::size_t min, std::size_t max = 1000000000);

// Finite and greater than zero.
CLI::Validator positive_number();

// Both ends included.
CLI::Validator number_between(double min, double max);

// An option whose value is one of `choices`.
CLI::Option* add_choice(CLI::App* command, const std::string& name, std::string* value,
                        const std::vector<std::string>& choices, const std::string& description);

// The study that a command begins with; `more` goes on with the description.
void add_study_argument(CLI::App* command, std::string* study, const std::string& more = "");

// --at, as place.hpp reads it.
CLI::Option* add_point_option(CLI::App* command, std::vector<std::string>* at,
                              const std::string& description);

// --device, of a command that uses one or several.
void add_device_option(CLI::App* command, std::string* text, bool several);
// The same with a description of its own; value: kNumberValue or kDevicesValue.
void add_device_option(CLI::App* command, std::string* text, const char* value,
                       const std::string& description);

// What parse_devices() makes of it; nothing for an empty text. Throws InputError.
std::vector<DeviceChoice> chosen_devices(const std::string& text);

// --set
void add_set_option(CLI::App* command, std::vector<std::string>* overrides);

// --units, of a command that writes tables.
void add_units_option(CLI::App* command, TableUnits* units);

// Throws InputError where a result at `path` would replace a file that is none, or would bear the
// name of a table or a picture.
void require_result_path(const std::string& path);

// Throws InputError where both are one file: what is computed would replace what it is computed of.
void refuse_own_output(const std::string& input, const std::string& output);

// As a shell takes it back.
std::string shell_quoted(const std::string& text);

// What is wrong with the arguments, and what would be right.
std::string describe_parse_error(const CLI::App& app, const CLI::ParseError& error);

}  // namespace gearsweep
