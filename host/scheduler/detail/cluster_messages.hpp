// What the processes of a cluster tell each other.
#pragma once

#include "scheduler/detail/packing.hpp"
#include "scheduler/worker_pool.hpp"
#include "study/found_step.hpp"

namespace gearsweep {

enum ClusterMessageKind {
  kJob,      // from rank 0: a ClusterJob
  kTile,     // from rank 0: its number, its initial states (WorkerTask of WorkerPool::start)
  kStop,     // from rank 0: running tiles stop after their round
  kEnd,      // from rank 0: nothing more will come
  kWorkers,  // to rank 0: how many workers there are
  kReport    // to rank 0: a WorkerReport
};

struct ClusterJob {
  std::string study;  // TOML
  FoundStep step;
  std::size_t tile_points = 0;
};

std::vector<std::byte> pack(const ClusterJob& job);
ClusterJob unpack_job(const std::vector<std::byte>& bytes);

// A failure travels as its message.
std::vector<std::byte> pack(const WorkerReport& report);
WorkerReport unpack_report(const std::vector<std::byte>& bytes);

}  // namespace gearsweep
