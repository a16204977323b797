#include "study/detail/drawing_axis.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <exception>
#include <functional>

#include "model/error.hpp"
#include "model/on_all_cores.hpp"
#include "study/detail/toml_access.hpp"

namespace gearsweep {
namespace {

// The parameters that follow from a drawing, at one value after the other.
class FollowingParameters {
 public:
  // Throws InputError, without its place, where the units of the result would change.
  void add(const GearConversion& conversion) {
    if (values_.empty()) {
      first_ = conversion;
      values_.resize(conversion.parameters.size());
    }
    if (conversion.scales != first_.scales) {
      throw InputError(
          "what the result is measured in would change: its lengths are in half backlashes, its "
          "forces in k0 b_n, its times in 1/varpi; make a study for each value, or vary "
          "stiffness_factor, which multiplies the stiffness in the same units");
    }
    for (std::size_t i = 0; i < values_.size(); ++i) {
      values_[i].push_back(value_of(conversion, i));
    }
  }

  // Those that differ, or that come from one of these keys alone.
  std::vector<Swept> take(const Model& model, const std::vector<std::string_view>& keys) {
    std::vector<Swept> columns;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const GearParameter& parameter = first_.parameters[i];
      const bool differs = std::ranges::any_of(
          values_[i], [&](double value) { return value != values_[i].front(); });
      if (!differs && std::ranges::find(keys, parameter.key) == keys.end()) continue;
      Swept column;
      column.name = parameter.name;
      column.index = static_cast<std::size_t>(model.find_parameter(parameter.name));
      column.unit = model.parameters[column.index].unit;
      column.meaning = model.parameters[column.index].meaning;
      column.values = std::move(values_[i]);
      columns.push_back(std::move(column));
    }
    return columns;
  }

 private:
  // The value of a parameter of the first. Which parameters a drawing gives does not depend on the
  // values of its keys, and their order hardly does.
  double value_of(const GearConversion& conversion, std::size_t i) const {
    const std::string& name = first_.parameters[i].name;
    const std::vector<GearParameter>& given = conversion.parameters;
    if (i < given.size() && given[i].name == name) return given[i].value;
    return std::ranges::find(given, name, &GearParameter::name)->value;
  }

  GearConversion first_;
  std::vector<std::vector<double>> values_;  // [parameter of the first][value]
};

// Takes what follows from `count` drawings, in their order. A study may draw some ten thousand
// gears, so they are converted on all cores, and few are held at a time. fail: is given the number
// of the first that is wrong, and why.
void follow_all(std::size_t count, const std::function<GearConversion(std::size_t)>& convert,
                const std::function<void(std::size_t, const std::string&)>& fail,
                FollowingParameters* following) {
  constexpr std::size_t kHeld = 1024;
  for (std::size_t first = 0; first < count; first += kHeld) {
    const std::size_t size = std::min(kHeld, count - first);
    std::vector<GearConversion> conversions(size);
    std::vector<std::exception_ptr> failures(size);
    for_each_on_all_cores(size, [&](std::size_t i) {
      try {
        conversions[i] = convert(first + i);
      } catch (...) {
        failures[i] = std::current_exception();
      }
    });
    for (std::size_t i = 0; i < size; ++i) {
      try {
        if (failures[i]) std::rethrow_exception(failures[i]);
        following->add(conversions[i]);
      } catch (const InputError& error) {
        fail(first + i, error.what());
      }
    }
  }
}

}  // namespace

std::vector<SweptKey> swept_keys(const toml::table& study, const Model& model) {
  std::vector<SweptKey> keys;
  for (const DrawingTable& from : drawing_tables(study, model)) {
    for (const GearKey& key : kGearKeys) {
      std::vector<std::optional<std::size_t>> members = {std::nullopt};
      if (key.form == KeyForm::pair) members.insert(members.end(), {0, 1});
      for (const std::optional<std::size_t>& member : members) {
        const SweptKey swept{&key, from, member};
        const bool is_of_model =
            model.find_parameter(swept.name()) >= 0 || model.find_state(swept.name()) >= 0;
        if (key.can_vary() && !is_of_model) keys.push_back(swept);
      }
    }
  }
  return keys;
}

std::optional<SweptKey> find_swept_key(const toml::table& study, const Model& model,
                                       const std::string& name) {
  for (const SweptKey& swept : swept_keys(study, model)) {
    if (swept.name() == name) return swept;
  }
  return std::nullopt;
}

std::vector<std::string> names_of_keys(const toml::table& study, const Model& model) {
  std::vector<std::string> names;
  for (const SweptKey& swept : swept_keys(study, model)) {
    if (swept.from.table != nullptr) names.push_back(swept.name());
  }
  return names;
}

std::pair<double, double> bind_key(const GearKey& key, Swept* swept) {
  swept->unit = key.unit();
  swept->meaning = std::string(key.meaning);
  return {key.min, key.max};
}

void add_parameters(const SweptKey& swept, const GearValues& others, const Model& model,
                    const toml::node& place, Axis* axis) {
  FollowingParameters following;
  GearDrawing drawing = read_drawing(swept.from, others);
  const auto fail = [&](std::size_t i, const std::string& wrong) {
    fail_at(place, fmt::format("{} = {}: {}", axis->name, axis->values[i], wrong));
  };
  try {
    drawing.vary(*swept.key, axis->values.front(),
                 swept.member);  // what it was before is remembered
  } catch (const InputError& error) {
    fail(0, error.what());
  }
  const auto convert = [&](std::size_t i) {
    GearDrawing own = drawing;
    own.vary(*swept.key, axis->values[i], swept.member);
    return convert_gear(own, model, swept.from, GearTexts::none);
  };
  follow_all(axis->values.size(), convert, fail, &following);
  axis->columns = following.take(model, {swept.key->name});
  if (swept.member) {
    // What the other one of the pair gives stays.
    const std::string other = std::string(swept.key->gives[1 - *swept.member]) + swept.from.suffix;
    std::erase_if(axis->columns, [&](const Swept& column) { return column.name == other; });
  }
  if (axis->columns.empty()) {
    fail_at(place, fmt::format("{} changes nothing in the equations of this study ({})", axis->name,
                               swept.key->meaning));
  }
}

void join_parameters(const std::vector<std::pair<SweptKey, Axis*>>& keys, const GearValues& others,
                     const Model& model, const toml::node& place) {
  const DrawingTable& from = keys.front().first.from;
  const GearDrawing drawing = read_drawing(from, others);
  const auto convert = [&](std::size_t draw) {
    GearDrawing own = drawing;
    for (const auto& [key, axis] : keys) own.vary(*key.key, axis->values[draw], key.member);
    return convert_gear(own, model, from, GearTexts::none);
  };
  const auto fail = [&](std::size_t draw, const std::string& wrong) {
    fail_at(place, fmt::format("draw {}: {}", draw + 1, wrong));
  };
  FollowingParameters following;
  following.add(convert_gear(drawing, model, from, GearTexts::none));  // what the study has
  follow_all(keys.front().second->values.size(), convert, fail, &following);
  std::vector<std::string_view> names;
  for (const auto& [key, axis] : keys) names.push_back(key.key->name);
  std::vector<Swept> all = following.take(model, names);
  for (Swept& column : all) column.values.erase(column.values.begin());
  // What differs where a key varies alone, and not where all do, is what the study has.
  for (const auto& [key, axis] : keys) {
    std::erase_if(axis->columns, [&](const Swept& one) {
      return std::ranges::find(all, one.index, &Swept::index) == all.end();
    });
  }
  for (Swept& column : all) {
    std::vector<Axis*> owners;
    for (const auto& [key, axis] : keys) {
      const auto own = std::ranges::find(axis->columns, column.index, &Swept::index);
      if (own != axis->columns.end()) owners.push_back(axis);
    }
    // An axis must keep a column.
    const auto fewest =
        std::ranges::min_element(owners, {}, [](const Axis* axis) { return axis->columns.size(); });
    Axis* const owner = owners.empty() ? keys.front().second : *fewest;
    for (Axis* axis : owners) {
      std::erase_if(axis->columns, [&](const Swept& one) { return one.index == column.index; });
    }
    owner->columns.push_back(std::move(column));
  }
  for (const auto& [key, axis] : keys) {
    if (!axis->columns.empty()) continue;
    fail_at(place, fmt::format("{} gives only what other entries give, too: take one of them away",
                               axis->name));
  }
}

void add_parameters_of_list(const toml::table& study, const std::vector<Axis>& axes,
                            const Model& model, const toml::node& place, Axis* list) {
  for (const DrawingTable& from : drawing_tables(study, model)) {
    std::vector<std::pair<SweptKey, const Swept*>> given;
    std::vector<std::string_view> names;
    for (const Swept& other : list->others) {
      const std::optional<SweptKey> swept = find_swept_key(study, model, other.name);
      if (!swept || swept->from.suffix != from.suffix) continue;
      given.emplace_back(*swept, &other);
      names.push_back(swept->key->name);
    }
    if (given.empty()) continue;
    FollowingParameters following;
    GearDrawing drawing = read_drawing(from, first_values(study, model, from, axes));
    for (std::size_t point = 0; point < list->values.size(); ++point) {
      try {
        for (const auto& [key, column] : given) {
          drawing.vary(*key.key, column->values[point], key.member);
        }
        following.add(convert_gear(drawing, model, from, GearTexts::none));
      } catch (const InputError& error) {
        fail_at(place, fmt::format("point {}: {}", point + 1, error.what()));
      }
    }
    for (Swept& column : following.take(model, names)) {
      column.follows = fmt::format("{}", fmt::join(names, " "));
      list->columns.push_back(std::move(column));
    }
  }
}

GearValues first_values(const toml::table& study, const Model& model, const DrawingTable& from,
                        const std::vector<Axis>& axes) {
  GearValues values;
  const auto take = [&](const Swept& given) {
    const std::optional<SweptKey> swept = find_swept_key(study, model, given.name);
    if (!swept || swept->from.suffix != from.suffix) return;
    values[swept->own_name()] = given.values.front();
  };
  for (const Axis& axis : axes) {
    take(axis);
    for (const Swept& other : axis.others) take(other);
  }
  return values;
}

}  // namespace gearsweep
