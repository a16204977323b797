#include "orders/order_map.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/error.hpp"
#include "model/names.hpp"
#include "plan/plan.hpp"
#include "sweep/trace_sweep.hpp"

namespace gearsweep {
namespace {

std::size_t find_axis(const Study& study, const std::string& name) {
  if (study.axes.empty()) {
    throw InputError(
        "an order map goes over an axis, and this study has none: add [[axes]] with name = "
        "\"omega\", from, to and count");
  }
  if (name.empty()) return 0;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < study.axes.size(); ++i) {
    names.push_back(study.axes[i].name);
    if (names.back() == name) return i;
  }
  throw InputError(fmt::format("the study has no axis '{}'; it has {}{}", name,
                               fmt::join(names, " and "), suggest_name(name, names)));
}

void refuse_states(const Place& place) {
  const auto is_state = [](const Placed& placed) { return placed.is_state; };
  if (std::none_of(place.values.begin(), place.values.end(), is_state)) return;
  throw InputError(told_of(
      place.origin, "an initial state does not fit here: [initial] says where points start"));
}

// With the study's own value of each axis, where the place has none.
Place completed(const Study& study, const std::vector<Axis>& axes, Place place) {
  for (const Axis& axis : axes) {
    const std::optional<double> own = own_value(study, axis);
    const bool is_given = place.named.contains(axis.name) || axis.values.size() == 1 ||
                          std::any_of(place.values.begin(), place.values.end(),
                                      [&](const Placed& placed) { return is_swept(axis, placed); });
    if (is_given || !own) continue;
    if (axis.columns.empty()) {
      place.values.push_back({false, axis.index, *own});
    } else {
      place.named[axis.name] = *own;
    }
  }
  return place;
}

ChannelInfo find_channel(const Model& model, const std::string& name) {
  if (name.empty()) return model.contact_force() ? *model.contact_force() : model.states.front();
  std::vector<std::string> names;
  for (const std::vector<ChannelInfo>& channels : {model.states, model.signals}) {
    for (const ChannelInfo& channel : channels) {
      if (channel.name == name) return channel;
      names.push_back(channel.name);
    }
  }
  throw InputError(fmt::format("model '{}' has no state or signal '{}'{}", model.name, name,
                               suggest_name(name, names)));
}

std::size_t index_of(const Trace& trace, const std::string& channel) {
  const auto found = std::find_if(trace.channels.begin(), trace.channels.end(),
                                  [&](const ChannelInfo& own) { return own.name == channel; });
  return static_cast<std::size_t>(found - trace.channels.begin());
}

}  // namespace

std::size_t usual_order_record(const Study& study) {
  const double of_forcing = study.model->mesh_periods(study.setting);
  return static_cast<std::size_t>(
      std::max(1.0, std::round(static_cast<double>(kOrderPeriods) / of_forcing)));
}

Study study_over(const Study& whole, const std::string& over, const Place& place) {
  const std::size_t kept = find_axis(whole, over);
  refuse_states(place);
  const Axis axis = whole.axes[kept];
  for (const Placed& placed : place.values) {
    if (!is_swept(axis, placed)) continue;
    throw InputError(told_of(place.origin, fmt::format("the map goes over '{}'", axis.name)));
  }
  if (whole.is_chained() && whole.initial.along != kept) {
    throw InputError(fmt::format(
        "the study's points go on from their neighbours along '{}', and the map goes over '{}': "
        "--set initial.along={}",
        whole.axes[whole.initial.along].name, axis.name, axis.name));
  }
  Study study = whole;
  study.axes.erase(study.axes.begin() + static_cast<std::ptrdiff_t>(kept));
  place_parameters(completed(whole, study.axes, place), &study);
  study.axes = {axis};
  study.initial.along = 0;
  study.initial.ensemble = 1;
  return study;
}

std::optional<OrderMap> map_orders(const Study& whole, const OrderRequest& request,
                                   const SweepOptions& options) {
  OrderMap map;
  map.study = study_over(whole, request.over, request.place);
  const Model& model = *map.study.model;
  if (model.is_clockless) {
    throw InputError(fmt::format(
        "orders are multiples of a forcing's frequency, and nothing drives model '{}': 'gearsweep "
        "trace STUDY --samples-per-period 256 -o trace.nc' and 'plot trace.nc -q spectrum' show "
        "its "
        "frequencies",
        model.name));
  }
  map.channel = find_channel(model, request.channel);
  map.window = request.window;
  map.samples_per_period = request.samples_per_period;
  const Plan plan(map.study, map.study.points());
  const ModelSetting first = plan.setting_of(0);
  const double of_forcing = model.mesh_periods(first);
  const std::size_t record = map.study.integrate.record;
  const double step = 1.0 / (static_cast<double>(record) * of_forcing);
  if (2.0 * request.orders > static_cast<double>(request.samples_per_period)) {
    throw InputError(fmt::format(
        "order {:g} takes more than {:g} samples in a period: give {:.0f} samples per period",
        request.orders, 2.0 * request.orders, 4.0 * request.orders));
  }
  const auto bins = static_cast<std::size_t>(std::floor(request.orders / step + 1e-9)) + 1;
  for (std::size_t bin = 0; bin < bins; ++bin) {
    map.orders.push_back(static_cast<double>(bin) * step);
  }
  for (std::size_t point = 0; point < map.study.points(); ++point) {
    const ModelSetting setting = plan.setting_of(point);
    map.forcing.push_back(2.0 * std::numbers::pi * of_forcing / model.period(setting));
    map.modes.push_back(natural_modes(model, setting));
  }
  bool has_any = false;
  const auto samples =
      static_cast<std::size_t>(of_forcing) * request.samples_per_period;  // of a forcing period
  const bool is_done =
      sweep_traces(map.study, samples, options, [&](std::size_t, const Trace* trace) {
        if (trace == nullptr) {
          map.mean.push_back(std::numeric_limits<double>::quiet_NaN());
          map.amplitude.resize(map.amplitude.size() + bins, map.mean.back());
          return;
        }
        has_any = true;
        const std::vector<double>& values = trace->values[index_of(*trace, map.channel.name)];
        const Spectrum spectrum = amplitude_spectrum(values, record, request.window);
        map.mean.push_back(spectrum.mean);
        map.amplitude.insert(map.amplitude.end(), spectrum.amplitude.begin(),
                             spectrum.amplitude.begin() + static_cast<std::ptrdiff_t>(bins));
      });
  if (!is_done) return std::nullopt;
  if (!has_any) throw RunError("all points of the order map diverge");
  return map;
}

}  // namespace gearsweep
