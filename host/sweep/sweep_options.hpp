// How a study is run: on which devices, with which journal, and who is told.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/device_choice.hpp"
#include "engine/result.hpp"
#include "engine/warn.hpp"
#include "scheduler/scheduler.hpp"
#include "scheduler/shard.hpp"
#include "sweep/resource_estimate.hpp"

namespace gearsweep {

class Cluster;

struct SweepProgress {
  double share = 0.0;          // of the work, 0 to 1
  double share_kept = 0.0;     // of the work, in finished tiles: what an interruption keeps
  double share_resumed = 0.0;  // of the work, what the journal gave
  std::size_t points_done = 0, points = 0;  // each trajectory of an ensemble counts
  std::size_t points_resumed = 0;           // of points_done, those that the journal gave
  double seconds = 0.0;                     // since the computation began
};

struct SweepOptions {
  std::vector<DeviceChoice> devices;  // that share the tiles; empty: the default one
  // Runs with copies of these options share the devices that they open, and what is built for them.
  std::shared_ptr<Scheduler> scheduler = std::make_shared<Scheduler>();
  int priority = 0;  // of the tasks of one scheduler that run at the same time (Task)
  Shard shard;       // the whole sweep, or one part of it
  // Where finished tiles are kept until the result is written; empty: nowhere. A journal of the
  // same sweep that is already there is continued.
  std::string journal_path;
  // The cluster of which this process is rank 0, and whose other processes share the tiles, too;
  // null: none.
  Cluster* cluster = nullptr;
  // The journal of a run on other devices, or with another driver, is refused, too.
  bool strict_device = false;
  bool keep_journal = false;  // beside the result
  // What the journal keeps beside it, for whoever asks for its status: names and values.
  std::map<std::string, std::string> notes;
  std::function<void(const SweepProgress&)> on_progress;
  std::function<void(std::size_t)> on_pilot;  // a pilot run of so many points begins
  Warn warn;
  const std::atomic<bool>* stop = nullptr;  // set it to stop after the running round
  // Puts the finished maps in a safe place; the journal is removed once it returns.
  std::function<void(const SweepResult&)> deliver;
  DeliveryEstimate delivery;  // what that will take; a study that does not fit is refused
};

}  // namespace gearsweep
