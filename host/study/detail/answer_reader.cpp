#include "study/detail/answer_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "model/error.hpp"
#include "model/names.hpp"
#include "study/detail/definition_entries.hpp"
#include "study/detail/toml_access.hpp"
#include "study/selection.hpp"
#include "study/study_keys.hpp"

namespace gearsweep {
namespace {

constexpr double kMaxStarts = 10000.0;
constexpr std::array kIntegrateKeys = {"settle", "record",           "warm_up", "extend",
                                       "stop",   "steps_per_period", "max_step"};

class AnswerReader {
 public:
  AnswerReader(const toml::table& row, const Model& model)
      : row_(row), model_(model), reader_(&row, "an answer") {}

  KnownAnswer run() {
    for (const char* key : {"quantity", "value", "tolerance", "source", "at", "starts"}) {
      reader_.know(key);
    }
    for (const char* key : kIntegrateKeys) reader_.know(key);
    reader_.refuse_unknown();
    read_quantity();
    read_place();
    read_integrate_keys();
    read_starts();
    answer_.source = reader_.text("source", "");
    if (answer_.source.empty()) lacks("source", "source = \"Den Hartog 1931\"");
    return std::move(answer_);
  }

 private:
  [[noreturn]] void lacks(const std::string& what, const std::string& form) const {
    fail_at(row_, fmt::format("an answer needs its {}: {}", what, form));
  }

  void read_quantity() {
    answer_.quantity = reader_.text("quantity", "");
    if (answer_.quantity.empty()) lacks("quantity", "quantity = \"x_max\"");
    const Quantity quantity = find_quantity(*row_.get("quantity"));
    const toml::node* value = reader_.find("value");
    if (value == nullptr) lacks("value", "value = 1.25, or an expression of numbers, in quotes");
    if (!value->is_array()) {
      answer_.values = {number_of(expression_of(*value, "value"))};
    } else {
      for (const toml::node& one : *value->as_array()) {
        answer_.values.push_back(number_of(expression_of(one, "value")));
      }
    }
    if (answer_.values.empty() || answer_.values.size() > quantity.width) {
      fail_at(*value, fmt::format("{} has 1 to {} values, not {}", quantity.name, quantity.width,
                                  answer_.values.size()));
    }
    const auto tolerance =
        reader_.optional_number("tolerance", 0.0, std::numeric_limits<double>::max());
    if (!tolerance) lacks("tolerance", "tolerance = 1e-6, in the unit of the quantity");
    answer_.tolerance = *tolerance;
  }

  // One that a point has by itself.
  Quantity find_quantity(const toml::node& node) const {
    try {
      const Selection selection =
          select_quantities(model_, {answer_.quantity}, {model_.states.front().name});
      if (!selection.quantities.empty() && !selection.quantities.front().of_census) {
        return selection.quantities.front();
      }
    } catch (const InputError& error) {
      fail_at(node, error.what());
    }
    fail_at(node, fmt::format("'{}' is no number of one motion, as that of an answer must be",
                              answer_.quantity));
  }

  void read_place() {
    const std::string form = "at = { omega = 0.7 }, with parameters or states at the start";
    const toml::table* at = reader_.table("at");
    if (at == nullptr) lacks("place", form);
    TableReader known(at, "at");
    if (at->contains("preset")) {
      const std::vector<std::string> presets = names_of(model_.presets);
      answer_.choices["preset"] = presets[known.choice("preset", 0, presets)];
    }
    known.know("preset");
    for (const OptionInfo& option : model_.options) {
      known.know(option.name);
      if (!at->contains(option.name)) continue;
      answer_.choices[option.name] = option.choices[known.choice(option.name, 0, option.choices)];
    }
    for (const ParameterInfo& parameter : model_.parameters) known.know(parameter.name);
    for (const ChannelInfo& state : model_.states) known.know(state.name);
    known.refuse_unknown();
    for (const Entry& entry : entries_of(at)) {
      if (entry.name == "preset" || model_.find_option(entry.name) >= 0) continue;
      answer_.at.emplace_back(entry.name, read_setting(entry));
    }
    if (answer_.at.empty()) fail_at(*at, fmt::format("a place names a number: {}", form));
  }

  double read_setting(const Entry& entry) const {
    const double value = number_of(expression_of(*entry.node, entry.name));
    const int index = model_.find_parameter(entry.name);
    const ParameterInfo* parameter =
        index < 0 ? nullptr : &model_.parameters[static_cast<std::size_t>(index)];
    const double min = parameter == nullptr ? -kMaxState : parameter->min;
    const double max = parameter == nullptr ? kMaxState : parameter->max;
    if (value < min || value > max) {
      fail_at(*entry.node, fmt::format("{} = {} is out of range; from {} to {} is allowed",
                                       entry.name, value, min, max));
    }
    return value;
  }

  // They have the ranges that they have in a study.
  void read_integrate_keys() {
    const StudyTable& declared = study_table("integrate");
    TableReader integrate(&row_, declared);
    for (const std::string key : kIntegrateKeys) {
      if (!row_.contains(key)) continue;
      const StudyKey& info = *find_key(declared, key);
      answer_.integrate[key] =
          info.type == "whole number" ? fmt::format("{}", integrate.count(key, 0))
          : info.choices.empty()      ? fmt::format("{}", integrate.number(key, 0.0))
                                      : fmt::format("'{}'", info.choices[integrate.choice(key, 0)]);
    }
  }

  void read_starts() {
    const toml::node* starts = reader_.find("starts");
    if (starts == nullptr) return;
    const double count = read_number(*starts, "starts", 1.0, kMaxStarts);
    if (!starts->is_integer()) fail_at(*starts, "starts must be a whole number");
    if (std::ranges::none_of(answer_.at,
                             [&](const auto& one) { return model_.find_state(one.first) >= 0; })) {
      fail_at(*starts, "the starts differ in the first state that `at` names, and it names none");
    }
    answer_.starts = static_cast<std::size_t>(count);
  }

  const toml::table& row_;
  const Model& model_;
  TableReader reader_;
  KnownAnswer answer_;
};

}  // namespace

std::vector<KnownAnswer> read_answers(const toml::table& root, const Model& model) {
  const toml::node* node = root.get("answers");
  if (node == nullptr) return {};
  const toml::array* rows = node->as_array();
  if (rows == nullptr || !rows->is_homogeneous(toml::node_type::table)) {
    fail_at(*node, "answers must be tables, each under [[answers]]");
  }
  std::vector<KnownAnswer> answers;
  for (const toml::node& row : *rows) {
    answers.push_back(AnswerReader(*row.as_table(), model).run());
  }
  return answers;
}

}  // namespace gearsweep
