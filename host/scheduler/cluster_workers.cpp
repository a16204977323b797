#include "scheduler/cluster_workers.hpp"

#include <algorithm>

#include "model/error.hpp"
#include "scheduler/detail/cluster_messages.hpp"

namespace gearsweep {

ClusterWorkers::ClusterWorkers(const Plan& plan, std::vector<std::unique_ptr<Engine>> own,
                               Task* task, Cluster* cluster)
    : cluster_(cluster),
      own_(plan, std::move(own), task),
      others_(static_cast<std::size_t>(cluster->size())) {
  const ClusterJob job = {plan.study().toml, FoundStep::of(plan.study()), plan.tile_points()};
  for (int rank = 1; rank < cluster->size(); ++rank) cluster->send(rank, kJob, pack(job));
}

std::size_t ClusterWorkers::size() const {
  std::size_t size = own_.size();
  for (const Others& others : others_) size += others.workers;
  return size;
}

std::size_t ClusterWorkers::idle() const {
  std::size_t idle = own_.idle();
  for (const Others& others : others_) idle += others.workers - others.busy;
  return idle;
}

void ClusterWorkers::start(std::size_t tile, std::vector<double> initial) {
  const auto idle = std::find_if(others_.begin(), others_.end(),
                                 [](const Others& others) { return others.busy < others.workers; });
  if (idle == others_.end()) {
    own_.start(tile, std::move(initial));
    return;
  }
  ++idle->busy;
  cluster_->send(static_cast<int>(idle - others_.begin()), kTile,
                 Packer().add(std::uint64_t{tile}).add(initial).take());
}

std::optional<WorkerReport> ClusterWorkers::wait(std::chrono::milliseconds patience) {
  constexpr std::chrono::milliseconds kNap(1);
  const auto end = std::chrono::steady_clock::now() + patience;
  do {
    if (std::optional<WorkerReport> report = own_.wait(std::chrono::milliseconds(0))) return report;
    // A message that is no report has brought new workers, who wait for tiles.
    if (const std::optional<ClusterMessage> message = cluster_->receive()) return take(*message);
    if (std::optional<WorkerReport> report = own_.wait(kNap)) return report;
  } while (std::chrono::steady_clock::now() < end);
  return std::nullopt;
}

void ClusterWorkers::stop() {
  own_.stop();
  for (int rank = 1; rank < cluster_->size(); ++rank) cluster_->send(rank, kStop, {});
}

std::optional<WorkerReport> ClusterWorkers::take(const ClusterMessage& message) {
  Others& others = others_.at(static_cast<std::size_t>(message.from));
  if (message.kind == kWorkers) {
    ++answers_;
    others.workers = Unpacker(message.bytes).integer();
    return std::nullopt;
  }
  WorkerReport report = unpack_report(message.bytes);
  const bool goes_on =
      report.kind == WorkerReport::Kind::progress || report.kind == WorkerReport::Kind::more_work;
  if (!goes_on) --others.busy;
  if (report.kind == WorkerReport::Kind::lost) --others.workers;
  return report;
}

}  // namespace gearsweep
