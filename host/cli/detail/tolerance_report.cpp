#include "cli/detail/tolerance_report.hpp"

#include <fmt/format.h>

#include "study/draw_quantities.hpp"

namespace gearsweep {
namespace {

std::string describe_indices(const SweepResult& result, const std::string& quantity) {
  const std::vector<double>& first = map_of(result, quantity + "_sobol_first");
  const std::vector<double>& error = map_of(result, quantity + "_sobol_first_error");
  const std::vector<double>& total = map_of(result, quantity + "_sobol_total");
  std::string text = fmt::format("  {:<28}  {:>8}  {:>8}  {:>8}\n", "share of its variance by",
                                 "first", "+-", "total");
  for (std::size_t i = 0; i < first.size(); ++i) {
    text +=
        fmt::format("  {:<28}  {:>8.3f}  {:>8.3f}  {:>8.3f}\n",
                    result.study.uncertain.parameters[i].draws.name, first[i], error[i], total[i]);
  }
  return text;
}

}  // namespace

std::string describe_tolerances(const SweepResult& result) {
  const Study& study = result.study;
  if (study.uncertain.draws() == 0 || study.points() > 1) return "";
  std::string text;
  for (const DrawQuantity& quantity : draw_quantities(study)) {
    const std::string& source = study.selection.quantities[quantity.source].name;
    const auto value = [&] { return map_of(result, quantity.quantity.name).front(); };
    switch (quantity.statistic) {
      case DrawStatistic::mean:
        text += fmt::format("{} over {} draws: mean {:.6g}", source,
                            study.uncertain.independent_draws(), value());
        break;
      case DrawStatistic::standard_deviation:
        text += fmt::format(", standard deviation {:.3g}{}", value(),
                            study.uncertain.percentiles.empty() ? "\n" : "");
        break;
      case DrawStatistic::percentile:
        text += fmt::format(", {:g} % {:.6g}{}", quantity.percentile, value(),
                            quantity.percentile == study.uncertain.percentiles.back() ? "\n" : "");
        break;
      case DrawStatistic::share:
        if (value() > 0.0) text += fmt::format("{}: {:.3g}\n", quantity.quantity.name, value());
        break;
      case DrawStatistic::sobol_first:
      case DrawStatistic::sobol_first_error:
      case DrawStatistic::each_value:
        break;
      case DrawStatistic::sobol_total:
        text += describe_indices(result, source);
        break;
    }
  }
  return text;
}

}  // namespace gearsweep
