// What a process of a cluster does that does not plan and write.
#pragma once

#include <functional>
#include <vector>

#include "engine/device_choice.hpp"
#include "engine/warn.hpp"
#include "scheduler/cluster.hpp"

namespace gearsweep {

// The share of a process: several devices are dealt out among the processes of a machine, each of
// which gets one at least.
std::vector<DeviceChoice> share_of_devices(const std::vector<DeviceChoice>& devices,
                                           const Cluster& cluster);

// Computes what rank 0 asks for (SweepOptions::cluster of its run_sweep()) until it is dismissed.
// Without any device that works it only tells so: neither `devices` nor what it gives need be
// right.
void serve_cluster(Cluster* cluster, const std::function<std::vector<DeviceChoice>()>& devices,
                   const Warn& warn);

// Rank 0 tells all others that nothing more will come.
void dismiss_cluster(Cluster* cluster);

}  // namespace gearsweep
