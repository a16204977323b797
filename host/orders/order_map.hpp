// The order map of a study: the spectrum of a channel at each value of an axis.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "orders/natural_modes.hpp"
#include "orders/spectrum.hpp"
#include "point/place.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

struct OrderRequest {
  std::string over;     // the axis; empty: the study's first
  Place place;          // values of the other axes, and of any parameter
  std::string channel;  // state or signal; empty: the force between the teeth, else the first state
  double orders = 10.0;  // the highest
  std::size_t samples_per_period = 256;
  SpectrumWindow window = SpectrumWindow::none;
};

struct OrderMap {
  Study study;  // of the points: it has the axis alone
  ChannelInfo channel;
  SpectrumWindow window = SpectrumWindow::none;
  std::size_t samples_per_period = 0;
  std::vector<double> orders;  // [order] in multiples of the mesh (or forcing) frequency, from 0 on
  std::vector<double> forcing;    // [point] rad per dimensionless time: the frequency of order 1
  std::vector<double> mean;       // [point] of the channel
  std::vector<double> amplitude;  // [point][order]; NaN where the point has diverged
  std::vector<std::vector<NaturalMode>> modes;  // [point]

  const Axis& axis() const { return study.axes.front(); }
};

// The record of a spectrum, in mesh periods, unless another is asked for: subharmonics of 2, 3, 4,
// 6 and 8 periods have whole bins.
inline constexpr std::size_t kOrderPeriods = 48;

// The same in periods of the study's forcing, at least one.
std::size_t usual_order_record(const Study& study);

// A study's points at one axis, the other axes at their places: where the place says nothing of a
// parameter, at its value in the study without axes. Throws InputError.
Study study_over(const Study& whole, const std::string& over, const Place& place);

// Settles the points as the study says, then takes the spectrum of the next `record` periods of
// each. The study's step is settled. Of `options`, the first device and stop are used; nothing when
// stopped. Throws InputError, and RunError when all points diverge.
std::optional<OrderMap> map_orders(const Study& whole, const OrderRequest& request,
                                   const SweepOptions& options);

}  // namespace gearsweep
