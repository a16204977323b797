#include "study/model_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <fstream>

#include "model/error.hpp"
#include "model/regular_file.hpp"
#include "study/detail/definition_reader.hpp"
#include "study/nesting.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kMaxBytes = 256 * 1024;

std::set<std::string> parameter_names(const ModelDefinition& definition) {
  std::set<std::string> names;
  for (const ParameterInfo& parameter : definition.parameters) names.insert(parameter.name);
  return names;
}

}  // namespace

std::string model_file_text(const std::string& path) {
  if (!has_regular_file(path, "a model")) {
    throw InputError(fmt::format("{}: there is no such file", path));
  }
  std::ifstream in(path, std::ios::binary);
  // One byte more tells that there are too many.
  std::string text(kMaxBytes + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) throw InputError(fmt::format("{}: cannot be read", path));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

std::shared_ptr<const Model> read_model_text(const std::string& text, const std::string& source,
                                             const std::optional<std::set<std::string>>& swept,
                                             const TablePoints& table_points) {
  if (text.size() > kMaxBytes) {
    throw InputError(
        fmt::format("{}: too large for a model; at most {} bytes are possible", source, kMaxBytes));
  }
  if (text.find('\0') != std::string::npos) {
    throw InputError(fmt::format("{}: not a text file; a model is TOML text", source));
  }
  refuse_deep_keys(text, source);
  try {
    const toml::table root = toml::parse(text, source);
    ModelDefinition definition = read_definition(root, text, source);
    definition.swept = swept ? *swept : parameter_names(definition);
    definition.table_points = table_points;
    return std::make_shared<const Model>(make_model(definition));
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: not valid TOML: {}", source, error.source().begin.line,
                                 error.description()));
  }
}

}  // namespace gearsweep
