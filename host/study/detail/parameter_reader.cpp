#include "study/detail/parameter_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "model/names.hpp"
#include "study/detail/definition_entries.hpp"
#include "study/study_keys.hpp"

namespace gearsweep {
namespace {

constexpr double kLargest = 1e12;  // of a parameter that names no range

class ParameterReader {
 public:
  ParameterReader(ModelNames* names, ModelDefinition* definition)
      : names_(names), definition_(definition) {}

  void read(const toml::table* table) {
    for (const Entry& entry : entries_of(table)) {
      const toml::array* list = list_of(entry);
      if (list == nullptr) {
        read_parameter(entry, entry.name, nullptr);
        continue;
      }
      for (std::size_t i = 0; i < list->size(); ++i) {
        read_parameter(entry, name_in_list(entry.name, i), &(*list)[i]);
      }
    }
  }

  // One of which nothing is known but what it is by default.
  void add_plain_parameter(const toml::node& value, const std::string& name, double largest) {
    names_->take(value, name);
    ParameterInfo info;
    info.name = info.meaning = name;
    info.unit = "1";
    info.min = -largest;
    info.max = largest;
    read_default(value, &info);
    definition_->symbols.push_back(place_text(name, value, 0));
    definition_->parameters.push_back(std::move(info));
  }

 private:
  // value: of a list, whose entry says the rest.
  void read_parameter(const Entry& entry, const std::string& name, const toml::node* value) {
    ParameterInfo info;
    info.name = name;
    if (entry.node->is_table()) {
      read_parameter_table(entry, value, &info);
      definition_->parameters.push_back(std::move(info));
    } else {
      add_plain_parameter(value == nullptr ? *entry.node : *value, name, kLargest);
    }
  }

  // A number, or what derives it from others.
  void read_default(const toml::node& value, ParameterInfo* info) {
    if (const std::optional<ExpressionText> derivation = derivation_in(value)) {
      definition_->expressions[info->name] = *derivation;
    } else if (value.is_number()) {
      info->default_value = read_number(value, info->name, info->min, info->max);
    } else {
      fail_at(value, fmt::format("'{0}' must be a number, an expression of other parameters in "
                                 "quotes, or a table: {0} = {{ value = 1.0, min = 0.0 }}",
                                 info->name));
    }
  }

  void read_parameter_table(const Entry& entry, const toml::node* value, ParameterInfo* info) {
    const toml::table& row = table_of(entry, "value = 1.0, min = 0.0, max = 10.0");
    TableReader reader(&row, fmt::format("parameter '{}'", entry.name));
    std::string symbol = info->name;
    if (const toml::node* as = reader.find("as")) {
      symbol = reader.text("as", "") + info->name.substr(entry.name.size());
      names_->take_outside(row, info->name);
      names_->take(*as, symbol);
    } else {
      names_->take(*entry.node, info->name);
    }
    definition_->symbols.push_back(place_text(symbol, row, 0));
    info->unit = reader.text("unit", "1");
    info->min = reader.number("min", -kLargest, -kLargest, kLargest);
    info->max = reader.number("max", kLargest, info->min, kLargest);
    const toml::node* const own = reader.find("value");
    if (own == nullptr) fail_at(row, fmt::format("parameter '{}' has no value", entry.name));
    read_default(value != nullptr ? *value : *own, info);
    info->meaning = reader.text("meaning", entry.name);
    if (value != nullptr) info->meaning += fmt::format(" ({})", info->name);
    info->role = read_role(&reader, roles_of_parameters());
    const auto is_same = [&](const ParameterInfo& other) { return other.role == info->role; };
    if (info->role != Role::none && std::ranges::any_of(definition_->parameters, is_same)) {
      fail_at(*row.get("role"), fmt::format("a model has one parameter of the role '{}'; '{}' is a "
                                            "second one",
                                            name_of(info->role), info->name));
    }
    reader.refuse_unknown();
  }

  ModelNames* names_;
  ModelDefinition* definition_;
};

}  // namespace

void read_parameters(const toml::table* table, ModelNames* names, ModelDefinition* definition) {
  ParameterReader(names, definition).read(table);
}

void add_constant_parameter(const toml::node& number, const std::string& name, ModelNames* names,
                            ModelDefinition* definition) {
  const double size = std::abs(plain_number(number).value_or(0.0));
  ParameterReader(names, definition).add_plain_parameter(number, name, std::max(kLargest, size));
}

Role read_role(TableReader* reader, const std::vector<Role>& known) {
  std::vector<std::string> names;
  for (const Role role : known) names.push_back(name_of(role));
  if (reader->find("role") == nullptr) return Role::none;
  return known[reader->choice("role", 0, names)];
}

}  // namespace gearsweep
