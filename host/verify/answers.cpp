#include "verify/answers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace gearsweep {
namespace {

// From one start to the next, when an answer is a mean over several.
constexpr double kBetweenStarts = 0.001;

// A study without its points and quantities, and the names of what its points have.
using StudyHead = std::pair<std::string, std::vector<std::string>>;

StudyHead head_of(const KnownAnswer& answer, const std::string& model_key) {
  StudyHead head;
  head.first = fmt::format("[model]\n{}\n", model_key);
  for (const auto& [name, choice] : answer.choices) {
    head.first += fmt::format("{} = '{}'\n", name, choice);
  }
  head.first += "[integrate]\n";
  for (const auto& [key, value] : answer.integrate) {
    head.first += fmt::format("{} = {}\n", key, value);
  }
  for (const auto& [name, value] : answer.at) head.second.push_back(name);
  return head;
}

void add_starts(const KnownAnswer& answer, const Model& model, PointTable* points) {
  const auto moved = std::ranges::find_if(
      answer.at, [&](const auto& one) { return model.find_state(one.first) >= 0; });
  const auto column = static_cast<std::size_t>(moved - answer.at.begin());
  for (std::size_t start = 0; start < answer.starts; ++start) {
    for (std::size_t i = 0; i < answer.at.size(); ++i) {
      const double shift = i == column ? kBetweenStarts * static_cast<double>(start) : 0.0;
      points->columns[i].push_back(answer.at[i].second + shift);
    }
  }
}

// The answer as it came out of the points from `first` on.
std::vector<double> mean_of(const KnownAnswer& answer, const SweepResult& result,
                            std::size_t first) {
  const std::vector<double>& map = map_of(result, answer.quantity);
  const std::size_t width = map.size() / result.status.size();
  std::vector<double> mean(answer.values.size(), 0.0);
  for (std::size_t start = 0; start < answer.starts; ++start) {
    for (std::size_t i = 0; i < mean.size(); ++i) {
      mean[i] += map[(first + start) * width + i] / static_cast<double>(answer.starts);
    }
  }
  return mean;
}

// What the study that the answers share gives for each of them.
std::vector<std::vector<double>> compute_together(const std::vector<const KnownAnswer*>& answers,
                                                  const StudyHead& head, const Model& model,
                                                  const Subject& subject) {
  PointTable points = {head.second, std::vector<std::vector<double>>(head.second.size())};
  std::set<std::string> quantities;
  for (const KnownAnswer* answer : answers) {
    add_starts(*answer, model, &points);
    quantities.insert(answer->quantity);
  }
  const std::string observe =
      fmt::format("[observe]\nquantities = ['{}']\n", fmt::join(quantities, "', '"));
  const SweepResult result =
      subject.compute(read_study(head.first + observe, "known answers", {}, {}, points));
  std::vector<std::vector<double>> found;
  std::size_t first = 0;
  for (const KnownAnswer* answer : answers) {
    found.push_back(mean_of(*answer, result, first));
    first += answer->starts;
  }
  return found;
}

}  // namespace

std::vector<ComputedAnswer> compute_answers(const Model& model, const std::string& model_key,
                                            const Subject& subject) {
  std::map<StudyHead, std::vector<const KnownAnswer*>> studies;
  for (const KnownAnswer& answer : model.answers) {
    studies[head_of(answer, model_key)].push_back(&answer);
  }
  std::map<const KnownAnswer*, std::vector<double>> found;
  for (const auto& [head, answers] : studies) {
    const std::vector<std::vector<double>> values = compute_together(answers, head, model, subject);
    for (std::size_t i = 0; i < answers.size(); ++i) found[answers[i]] = values[i];
  }
  std::vector<ComputedAnswer> computed;
  for (const KnownAnswer& answer : model.answers) {
    for (std::size_t i = 0; i < answer.values.size(); ++i) {
      const std::string what = answer.values.size() == 1
                                   ? answer.quantity
                                   : fmt::format("{}[{}]", answer.quantity, i + 1);
      computed.push_back({&answer, {what, answer.values[i], found[&answer][i], answer.tolerance}});
    }
  }
  return computed;
}

}  // namespace gearsweep
