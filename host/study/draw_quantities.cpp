#include "study/draw_quantities.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/parse_number.hpp"

namespace gearsweep {
namespace {

std::string percentile_name(const std::string& quantity, double percentile) {
  std::string number = fmt::format("{}", percentile);  // all digits: no two have one name
  std::ranges::replace(number, '.', '_');
  return fmt::format("{}_p{}", quantity, number);
}

class List {
 public:
  explicit List(const Study& study) : study_(study) {}

  std::vector<DrawQuantity> make() {
    add_of_status();
    for (std::size_t i = 0; i < study_.selection.quantities.size(); ++i) {
      const Quantity& quantity = study_.selection.quantities[i];
      if (!has_draw_quantities(quantity)) continue;
      if (quantity.flags.empty()) {
        add_of_number(i, quantity);
      } else {
        add_of_class(i, quantity);
      }
      if (study_.uncertain.keep) add_each_value(i, quantity);
    }
    return std::move(list_);
  }

 private:
  Quantity& add(DrawStatistic statistic, std::size_t source, const std::string& name,
                const std::string& unit, const std::string& meaning) {
    DrawQuantity added;
    added.statistic = statistic;
    added.source = source;
    added.quantity.name = name;
    added.quantity.unit = unit;
    added.quantity.meaning = meaning;
    added.quantity.of_draws = true;
    list_.push_back(std::move(added));
    return list_.back().quantity;
  }

  void add_of_status() {
    add(DrawStatistic::share, 0, "diverged_share", "1", "share of the draws that diverged");
    list_.back().of_status = true;
  }

  void add_of_number(std::size_t source, const Quantity& quantity) {
    const std::string& name = quantity.name;
    const auto of_draws = [&](const std::string& what) {
      return fmt::format("{} over the draws of the uncertain parameters: {}", what,
                         quantity.meaning);
    };
    add(DrawStatistic::mean, source, name + "_sample_mean", quantity.unit, of_draws("mean"));
    add(DrawStatistic::standard_deviation, source, name + "_sample_std", quantity.unit,
        of_draws("standard deviation"));
    for (const double percentile : study_.uncertain.percentiles) {
      add(DrawStatistic::percentile, source, percentile_name(name, percentile), quantity.unit,
          of_draws(fmt::format("percentile {:g}", percentile)));
      list_.back().percentile = percentile;
    }
    if (!study_.uncertain.sobol) return;
    const auto add_index = [&](DrawStatistic statistic, const char* ending,
                               const std::string& meaning) {
      Quantity& added = add(statistic, source, name + ending, "1", of_draws(meaning));
      added.width = study_.uncertain.parameters.size();
      added.dimension = kUncertainDimension;
    };
    add_index(DrawStatistic::sobol_first, "_sobol_first", "Sobol index of first order");
    add_index(DrawStatistic::sobol_first_error, "_sobol_first_error",
              "standard error of the Sobol index of first order");
    add_index(DrawStatistic::sobol_total, "_sobol_total", "total Sobol index");
  }

  void add_of_class(std::size_t source, const Quantity& quantity) {
    for (std::size_t flag = 0; flag < quantity.flags.size(); ++flag) {
      add(DrawStatistic::share, source,
          fmt::format("{}_{}_share", quantity.name, quantity.flags[flag]), "1",
          fmt::format("share of the draws whose {} is {}", quantity.name, quantity.flags[flag]));
      list_.back().flag = static_cast<int>(flag);
    }
  }

  void add_each_value(std::size_t source, const Quantity& quantity) {
    Quantity& added = add(DrawStatistic::each_value, source, quantity.name + "_draws",
                          quantity.unit, "in each draw: " + quantity.meaning);
    added.flags = quantity.flags;
    added.width = study_.uncertain.independent_draws();
    added.dimension = kDrawDimension;
  }

  const Study& study_;
  std::vector<DrawQuantity> list_;
};

}  // namespace

std::optional<double> percentile_in(const std::string& name, const std::string& quantity) {
  const std::string before = quantity + "_p";
  if (!name.starts_with(before)) return std::nullopt;
  std::string number = name.substr(before.size());
  std::ranges::replace(number, '_', '.');
  const std::optional<double> percentile = parse_number<double>(number);
  const bool is_one = percentile && *percentile >= 0.0 && *percentile <= 100.0 &&
                      percentile_name(quantity, *percentile) == name;
  return is_one ? percentile : std::nullopt;
}

bool has_draw_quantities(const Quantity& quantity) {
  return !quantity.of_draws && !quantity.of_census && quantity.width == 1;
}

std::vector<DrawQuantity> draw_quantities(const Study& study) { return List(study).make(); }

void add_draw_quantities(Study* study) {
  for (DrawQuantity& added : draw_quantities(*study)) {
    study->selection.quantities.push_back(std::move(added.quantity));
  }
}

}  // namespace gearsweep
