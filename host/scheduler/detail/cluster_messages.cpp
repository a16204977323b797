#include "scheduler/detail/cluster_messages.hpp"

#include "model/error.hpp"

namespace gearsweep {
namespace {

std::string message_of(const std::exception_ptr& failure) {
  if (!failure) return "";
  try {
    std::rethrow_exception(failure);
  } catch (const std::exception& error) {
    return *error.what() == '\0' ? "unknown failure" : error.what();
  }
}

}  // namespace

std::vector<std::byte> pack(const ClusterJob& job) {
  return Packer()
      .add(job.study)
      .add(job.step.max_step)
      .add(std::uint64_t{job.step.orbit_steps})
      .add(std::uint64_t{job.tile_points})
      .take();
}

ClusterJob unpack_job(const std::vector<std::byte>& bytes) {
  Unpacker in(bytes);
  ClusterJob job;
  job.study = in.sequence<std::string>();
  job.step.max_step = in.number();
  job.step.orbit_steps = in.integer();
  job.tile_points = in.integer();
  return job;
}

std::vector<std::byte> pack(const WorkerReport& report) {
  const TileResult& result = report.result;
  return Packer()
      .add(static_cast<std::uint64_t>(report.kind))
      .add(std::uint64_t{report.tile})
      .add(report.steps)
      .add(message_of(report.failure))
      .add(result.status)
      .add(result.outputs)
      .add(result.samples)
      .add(result.final_states)
      .add(result.cost.steps)
      .add(result.cost.seconds)
      .add(result.cost.stopped)
      .add(result.cost.kernel_seconds)
      .add(result.device)
      .take();
}

WorkerReport unpack_report(const std::vector<std::byte>& bytes) {
  Unpacker in(bytes);
  WorkerReport report;
  report.kind = static_cast<WorkerReport::Kind>(in.integer());
  report.tile = in.integer();
  report.steps = in.number();
  const auto message = in.sequence<std::string>();
  if (!message.empty()) report.failure = std::make_exception_ptr(RunError(message));
  report.result.status = in.sequence<std::vector<std::uint8_t>>();
  report.result.outputs = in.sequence<std::vector<double>>();
  report.result.samples = in.sequence<std::vector<double>>();
  report.result.final_states = in.sequence<std::vector<double>>();
  report.result.cost = {in.number(), in.number(), in.number(), in.number()};
  report.result.device = in.sequence<std::string>();
  return report;
}

}  // namespace gearsweep
