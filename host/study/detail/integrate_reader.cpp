#include "study/detail/integrate_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "study/detail/toml_access.hpp"

namespace gearsweep {
namespace {

// Mesh periods in a period of the study: the fewest of its points.
double mesh_periods_of(const Study& study) {
  std::optional<double> fewest;
  ModelSetting setting = study.setting;
  for (const std::size_t parameter : study.model->cycle_parameters) {
    const Swept* swept = study.find_swept(false, parameter);
    if (swept == nullptr) continue;
    for (const double value : swept->values) {
      setting.parameters[parameter] = value;
      const double periods = study.model->mesh_periods(setting);
      if (!fewest || periods < *fewest) fewest = periods;
    }
    setting.parameters[parameter] = study.setting.parameters[parameter];
  }
  return fewest.value_or(study.model->mesh_periods(study.setting));
}

// A study that does not say how long takes about as many mesh periods, whatever its periods have.
void set_default_windows(const TableReader& reader, Study* study) {
  const double cycle = mesh_periods_of(*study);
  if (cycle <= 1.0) return;
  Integrate& integrate = study->integrate;
  const auto share = [](double whole, double part) {
    return static_cast<std::size_t>(std::ceil(whole / part));
  };
  const auto longest = static_cast<double>(integrate.extend * integrate.record);
  integrate.settle = share(static_cast<double>(integrate.settle), cycle);
  integrate.record = share(static_cast<double>(integrate.record), cycle);
  integrate.warm_up = share(static_cast<double>(integrate.warm_up), cycle);
  integrate.extend = share(longest, cycle * static_cast<double>(integrate.record));
  if (reader.has("settle") && reader.has("record")) return;
  study->notices.push_back(fmt::format(
      "a period of this study is {} mesh periods: unless given, settle = {}, record = {}, "
      "warm_up = {} and extend = {}",
      cycle, integrate.settle, integrate.record, integrate.warm_up, integrate.extend));
}

}  // namespace

void read_integrate(const toml::table* table, Study* study) {
  TableReader reader(table, study_table("integrate"));
  Integrate& integrate = study->integrate;
  integrate.fp64 = reader.choice("precision", 1) == 1;
  integrate.max_step = reader.number("max_step", study->model->max_step);
  integrate.steps_per_period = reader.count("steps_per_period", 0);
  if (reader.find("max_step") != nullptr && integrate.steps_per_period > 0) {
    fail_at(*reader.find("steps_per_period"), "give max_step or steps_per_period, not both");
  }
  constexpr double kTolerance = 1e-3;
  const bool has_step = reader.find("max_step") != nullptr || integrate.steps_per_period > 0;
  integrate.tolerance = reader.number("tolerance", has_step ? 0.0 : kTolerance);
  if (integrate.tolerance > 0.0 && integrate.tolerance < kMinTolerance) {
    fail_at(*reader.find("tolerance"),
            fmt::format("tolerance = {} is out of range; 0, or from {} to {} is allowed",
                        integrate.tolerance, kMinTolerance,
                        find_key(study_table("integrate"), "tolerance")->max));
  }
  integrate.exponent_tolerance = reader.number("exponent_tolerance", integrate.tolerance);
  const toml::node* exponents = reader.find("exponent_tolerance");
  integrate.is_map_tolerance_given = reader.find("tolerance") != nullptr;
  integrate.is_tolerance_asked = integrate.is_map_tolerance_given || exponents != nullptr;
  if (integrate.tolerance > 0.0 && has_step) {
    fail_at(*reader.find("tolerance"),
            "give tolerance, from which the step follows, or the step, not both");
  }
  if (exponents != nullptr && reader.find("tolerance") == nullptr && has_step) {
    fail_at(*exponents,
            "give exponent_tolerance, from which the step follows, or the step, not both");
  }
  integrate.orbit_steps = reader.count("orbit_steps", integrate.orbit_steps);
  integrate.events = reader.boolean("events", integrate.events);
  reader.know("diverged_above");
  set_default_windows(reader, study);
  integrate.settle = reader.count("settle", integrate.settle);
  integrate.record = reader.count("record", integrate.record);
  integrate.warm_up = reader.count("warm_up", integrate.warm_up);
  integrate.extend = reader.count("extend", integrate.extend);
  integrate.stop = reader.choice("stop", 0) == 0 ? Stop::orbit : Stop::never;
  integrate.states = reader.choice("states", 0) == 0 ? States::driving : States::all;
  integrate.engine = reader.choice("engine", 0) == 0 ? EngineKind::opencl : EngineKind::reference;
  integrate.lanes = reader.count("lanes", 0);
  if ((integrate.lanes & (integrate.lanes - 1)) != 0) {
    fail_at(*reader.find("lanes"), "lanes must be 1, 2, 4, 8 or 16 (0: the engine chooses)");
  }
  integrate.tile = reader.count("tile", 0);
  integrate.local_size = reader.count("local_size", 0);
  integrate.round = reader.count("round", 0);
  integrate.contract = reader.boolean("contract", true);
  reader.refuse_unknown();
}

}  // namespace gearsweep
