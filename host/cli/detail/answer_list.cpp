#include "cli/detail/answer_list.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gearsweep {
namespace {

// A bar would end the cell.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char letter : text) {
    if (letter == '|') escaped += '\\';
    escaped += letter;
  }
  return escaped;
}

// before: the row above it, nullptr of the first.
std::string row_of(const KnownAnswer& answer, const KnownAnswer* before) {
  std::vector<std::string> values;
  for (const double value : answer.values) values.push_back(fmt::format("{:.10g}", value));
  const bool is_same = before != nullptr && before->source == answer.source;
  return fmt::format("| | `{}` at {} | {} | {:g} | {} |\n", answer.quantity,
                     cell(describe_place(answer)), fmt::join(values, ", "), answer.tolerance,
                     is_same ? "the same" : cell(answer.source));
}

}  // namespace

std::string answer_list(const std::vector<const Model*>& models) {
  std::string text =
      "| model | system, and what is known of it | value | tolerance | by |\n"
      "| --- | --- | --- | --- | --- |\n";
  for (const Model* model : models) {
    text += fmt::format("| `{}` | {} | | | |\n", model->name, cell(model->summary));
    const KnownAnswer* before = nullptr;
    for (const KnownAnswer& answer : model->answers) {
      text += row_of(answer, before);
      before = &answer;
    }
  }
  return text;
}

}  // namespace gearsweep
