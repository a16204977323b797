#include "scheduler/cluster_service.hpp"

#include <fmt/format.h>

#include <limits>
#include <thread>

#include "model/error.hpp"
#include "plan/passive_states.hpp"
#include "scheduler/detail/cluster_messages.hpp"
#include "scheduler/make_engine.hpp"
#include "scheduler/thread_workers.hpp"

namespace gearsweep {
namespace {

// One study at work on this process's devices.
class Job {
 public:
  Job(const ClusterJob& job, const std::vector<DeviceChoice>& devices, const Warn& warn)
      : study_(study_of(job)),
        plan_(study_, job.tile_points),
        workers_(plan_, make_engines(study_, devices, scheduler_.get(), warn), &task_) {}

  ThreadWorkers& workers() { return workers_; }

 private:
  static Study study_of(const ClusterJob& job) {
    Study study = read_study(job.study, "the study of rank 0", {}, {}, {}, NamedFiles::refused);
    job.step.give_to(&study);
    return without_passive_states(study);
  }

  const Study study_;
  const Plan plan_;
  const std::shared_ptr<Scheduler> scheduler_ = std::make_shared<Scheduler>();
  Task task_{scheduler_, 0};
  ThreadWorkers workers_;
};

// Nothing when this process has no device that works.
std::unique_ptr<Job> begin_job(const ClusterJob& job,
                               const std::function<std::vector<DeviceChoice>()>& devices,
                               const Warn& warn) {
  try {
    return std::make_unique<Job>(job, devices(), warn);
  } catch (const std::runtime_error& error) {
    warn(error.what());
    return nullptr;
  }
}

// MPI counts bytes by int.
std::vector<std::byte> pack_to_fit(const WorkerReport& report) {
  std::vector<std::byte> bytes = pack(report);
  if (bytes.size() <= std::numeric_limits<int>::max()) return bytes;
  const RunError error("the answers of a tile take more than 2 GB; give a smaller integrate.tile");
  return pack({WorkerReport::Kind::lost, report.tile, 0.0, {}, std::make_exception_ptr(error)});
}

}  // namespace

std::vector<DeviceChoice> share_of_devices(const std::vector<DeviceChoice>& devices,
                                           const Cluster& cluster) {
  std::vector<DeviceChoice> share;
  const auto rank = static_cast<std::size_t>(cluster.local_rank());
  const auto processes = static_cast<std::size_t>(cluster.local_size());
  for (std::size_t i = rank; i < devices.size(); i += processes) share.push_back(devices[i]);
  if (share.empty() && !devices.empty()) share.push_back(devices[rank % devices.size()]);
  return share;
}

void serve_cluster(Cluster* cluster, const std::function<std::vector<DeviceChoice>()>& devices,
                   const Warn& warn) {
  constexpr std::chrono::milliseconds kNap(1);
  const Warn tell = [&](const std::string& what) {
    warn(fmt::format("rank {}: {}", cluster->rank(), what));
  };
  std::unique_ptr<Job> job;
  while (true) {
    while (const std::optional<ClusterMessage> message = cluster->receive()) {
      if (message->kind == kEnd) return;
      if (message->kind == kJob) {
        job = begin_job(unpack_job(message->bytes), devices, tell);
        const std::uint64_t workers = job ? job->workers().size() : 0;
        cluster->send(0, kWorkers, Packer().add(workers).take());
      } else if (message->kind == kTile) {
        Unpacker in(message->bytes);
        const std::size_t tile = in.integer();
        job->workers().start(tile, in.sequence<std::vector<double>>());
      } else if (message->kind == kStop && job) {
        job->workers().stop();
      }
    }
    if (!job) {
      std::this_thread::sleep_for(kNap);
    } else if (const std::optional<WorkerReport> report = job->workers().wait(kNap)) {
      cluster->send(0, kReport, pack_to_fit(*report));
    }
  }
}

void dismiss_cluster(Cluster* cluster) {
  for (int rank = 1; rank < cluster->size(); ++rank) cluster->send(rank, kEnd, {});
}

}  // namespace gearsweep
