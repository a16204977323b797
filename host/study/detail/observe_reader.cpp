#include "study/detail/observe_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/error.hpp"
#include "study/detail/spectrum_reader.hpp"
#include "study/detail/toml_access.hpp"

namespace gearsweep {
namespace {

// The orders whose amplitudes and phases are asked for.
std::vector<double> read_orders(TableReader* reader) {
  constexpr std::size_t kMost = 32;
  const toml::node* node = reader->find("orders");
  if (node == nullptr) return kDefaultOrders;
  const StudyKey& key = *find_key(study_table("observe"), "orders");
  const std::vector<double> orders = reader->numbers("orders", key.min, key.max);
  if (orders.empty() || orders.size() > kMost) {
    fail_at(*node, fmt::format("observe.orders has {} numbers; from 1 to {} are possible",
                               orders.size(), kMost));
  }
  for (std::size_t i = 0; i < orders.size(); ++i) {
    if (std::find(orders.begin(), orders.begin() + static_cast<std::ptrdiff_t>(i), orders[i]) !=
        orders.begin() + static_cast<std::ptrdiff_t>(i)) {
      fail_at(*node, fmt::format("observe.orders lists {} twice", orders[i]));
    }
  }
  return orders;
}

}  // namespace

void read_observe(const toml::table* table, const toml::table& root, Study* study) {
  TableReader reader(table, study_table("observe"));
  const std::string first_state = study->model->states.front().name;
  std::vector<std::string> quantities = reader.texts("quantities");
  std::vector<std::string> states = reader.texts("poincare");
  if (reader.find("quantities") == nullptr) {
    quantities = {first_state + "_rms"};
    if (study->axes.size() == 1 && !study->axes.front().is_list) quantities.push_back("poincare");
    if (study->spectrum) quantities = spectrum_quantities(*study->model);
  }
  if (reader.find("poincare") == nullptr) states = {first_state};
  // What rounding leaves of a stable orbit's recurrence, with some room.
  const double rounding = study->integrate.fp64 ? 1e-6 : 1e-4;
  const double tolerance = reader.number("period_tolerance", rounding);
  const std::vector<double> orders = read_orders(&reader);
  const Model& model = *study->model;
  // Where there is no clock there is no phase 0.
  const bool has_own = model.is_clockless && !model.sections.empty();
  const std::string section = reader.text("section", has_own ? model.sections.front().name : "");
  reader.refuse_unknown();
  if (std::ranges::find(quantities, "poincare") == quantities.end()) {
    for (const char* key : {"poincare", "section"}) {
      // Without a clock the section is that by which motions are judged, too.
      const bool judges = model.is_clockless && key == std::string("section");
      if (reader.find(key) == nullptr || judges) continue;
      study->notices.push_back(fmt::format(
          "observe.{} says how 'poincare' is sampled, which is not among observe.quantities", key));
    }
  }
  const toml::node* place = table == nullptr ? static_cast<const toml::node*>(&root) : table;
  if (const toml::node* node = reader.find("quantities")) place = node;
  if (quantities.empty()) {
    fail_at(*place,
            fmt::format("observe.quantities is empty, so there would be no map; name at least "
                        "one, such as '{}_rms'",
                        first_state));
  }
  try {
    study->selection = select_quantities(*study->model, quantities, states, orders, section);
    study->selection.period_tolerance = tolerance;
  } catch (const InputError& error) {
    fail_at(*place, error.what());
  }
}

}  // namespace gearsweep
