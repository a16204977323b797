// How several runs are made one after the other, for a report or a set of figures.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sweep/sweep_options.hpp"

namespace gearsweep {

struct SeveralRuns {
  std::vector<DeviceChoice> devices;  // empty: the default one
  std::shared_ptr<Scheduler> scheduler = std::make_shared<Scheduler>();
  const std::atomic<bool>* stop = nullptr;
  std::function<void(const std::string&)> on_step;  // what is done next

  // The options of each of them.
  SweepOptions sweep_options() const {
    SweepOptions options;
    options.devices = devices;
    options.scheduler = scheduler;
    options.stop = stop;
    return options;
  }
};

}  // namespace gearsweep
