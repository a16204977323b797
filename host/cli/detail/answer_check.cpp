#include "cli/detail/answer_check.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/standard_streams.hpp"
#include "model/error.hpp"
#include "result/json_text.hpp"
#include "verify/answers.hpp"

namespace gearsweep {
namespace {

constexpr const char* kColumns = "{:<4}  {:<20}  {:<22}  {:>14}  {:>14}  {:>10}  {:>9}  {}\n";

std::string verdict_on(const ComputedAnswer& one) { return one.number.holds() ? "ok" : "FAIL"; }

void print_answer(const std::string& model, const ComputedAnswer& one) {
  const Compared& number = one.number;
  answer(kColumns, verdict_on(one), model, number.what, fmt::format("{:.10g}", number.expected),
         fmt::format("{:.10g}", number.seen), fmt::format("{:.1e}", number.seen - number.expected),
         fmt::format("{:.2g}", number.tolerance), describe_place(*one.answer));
  flush_answers();
}

nlohmann::json as_json_of(const std::string& model, const ComputedAnswer& one) {
  nlohmann::json json = {{"model", model},
                         {"quantity", one.number.what},
                         {"published", one.number.expected},
                         {"computed", one.number.seen},
                         {"tolerance", one.number.tolerance},
                         {"source", one.answer->source},
                         {"starts", one.answer->starts},
                         {"verdict", verdict_on(one)}};
  json["at"] = one.answer->choices;
  for (const auto& [name, value] : one.answer->at) json["at"][name] = value;
  return json;
}

}  // namespace

int check_answers(const std::vector<NamedModel>& models, const Subject& subject,
                  const std::string& device, bool as_json, SignalWatch* signals) {
  if (!subject.fp64) throw RunError("known answers need fp64, which the device has not");
  nlohmann::json all = nlohmann::json::array();
  std::size_t numbers = 0, failed = 0;
  if (!as_json) {
    answer(kColumns, "", "model", "quantity", "published", "computed", "difference", "tolerance",
           "at");
  }
  for (const NamedModel& named : models) {
    const Model& model = *named.model;
    if (model.answers.empty()) {
      throw InputError(
          fmt::format("model '{}' has no known answers; its file would have them under [[answers]]",
                      model.name));
    }
    std::vector<ComputedAnswer> computed;
    try {
      computed = compute_answers(model, named.key, subject);
    } catch (const RunError&) {
      if (!signals->interrupted()) throw;
      return tell_interrupted();
    }
    for (const ComputedAnswer& one : computed) {
      ++numbers;
      if (!one.number.holds()) ++failed;
      if (as_json) all.push_back(as_json_of(model.name, one));
      if (!as_json) print_answer(model.name, one);
    }
  }
  const std::string verdict = failed > 0
                                  ? fmt::format("FAIL: {} of {} numbers are wrong", failed, numbers)
                                  : fmt::format("pass: {} numbers", numbers);
  if (as_json) {
    answer("{}", json_text({{"device", device}, {"verdict", verdict}, {"answers", all}}));
  } else {
    answer("{}\n", verdict);
  }
  return failed > 0 ? kFailed : kDone;
}

}  // namespace gearsweep
