#include "sweep/tile_loop.hpp"

#include <fmt/format.h>

#include "tile/subset.hpp"

namespace gearsweep {

TileLoop::TileLoop(const Plan& plan, const SweepOptions& options, WorkerPool* workers,
                   Journal* journal, Assembly* assembly)
    : plan_(plan),
      options_(options),
      tiles_(tiles_of(plan)),
      workers_(workers),
      journal_(journal),
      assembly_(assembly),
      progress_(plan, options) {}

bool TileLoop::run() {
  std::size_t first = 0;
  for (const Stage& stage : plan_.stages()) {
    queue_tiles(first, stage.tiles.size());
    while (!waiting_.empty() || !running_.empty()) {
      stop_if_asked();
      start_tiles();
      if (running_.empty() && workers_->size() == 0 && !workers_->may_grow()) break;
      if (std::optional<WorkerReport> report = workers_->wait(std::chrono::milliseconds(100))) {
        share_time();
        handle(std::move(*report));
      }
    }
    if (is_stopping_) return false;
    if (!waiting_.empty()) std::rethrow_exception(failure_);
    first += stage.tiles.size();
  }
  return true;
}

void TileLoop::queue_tiles(std::size_t first, std::size_t count) {
  for (std::size_t number = first; number < first + count; ++number) {
    if (!options_.shard.has(number)) continue;
    std::optional<TileResult> result;
    if (journal_ != nullptr) result = journal_->find(number);
    if (result) {
      require_fit(plan_.study(), *tiles_[number], *result);
      add(number, *result, true);
    } else {
      waiting_.push_back(number);
    }
  }
}

void TileLoop::stop_if_asked() {
  if (is_stopping_ || options_.stop == nullptr || !*options_.stop) return;
  is_stopping_ = true;
  workers_->stop();
  waiting_.clear();
}

void TileLoop::start_tiles() {
  while (!waiting_.empty() && workers_->idle() > 0) {
    const std::size_t number = waiting_.front();
    waiting_.pop_front();
    progress_.begin_tile(number, *tiles_[number]);
    std::vector<double> initial;
    if (plan_.stages().size() > 1) initial = assembly_->initial_states(plan_, *tiles_[number]);
    share_time();
    running_[number] = 0.0;
    // A worker's thread calls run_tile() for it; handle() hears of it from wait().
    workers_->start(number, std::move(initial));
  }
}

void TileLoop::handle(WorkerReport report) {
  switch (report.kind) {
    case WorkerReport::Kind::progress:
      progress_.add_steps(report.tile, report.steps);
      return;
    case WorkerReport::Kind::more_work:
      progress_.add_work(report.tile, report.steps);
      return;
    case WorkerReport::Kind::finished:
      set_time(&report);
      // The worker gets its next tile before this one is written to the disk.
      if (!is_stopping_) start_tiles();
      if (journal_ != nullptr) journal_->store(report.tile, report.result);
      add(report.tile, report.result, false);
      return;
    case WorkerReport::Kind::stopped:
      running_.erase(report.tile);
      progress_.drop_tile(report.tile);
      return;
    case WorkerReport::Kind::lost:
      running_.erase(report.tile);
      hand_back(report);
      return;
  }
}

// Tiles that run at the same time share it equally, so that the times of all tiles add up to the
// time of the sweep.
void TileLoop::share_time() {
  const auto now = std::chrono::steady_clock::now();
  const double passed = std::chrono::duration<double>(now - last_share_).count();
  last_share_ = now;
  for (auto& [number, seconds] : running_) seconds += passed / static_cast<double>(running_.size());
}

// The worker measured how long the tile took and how much of that the kernels took. The tile keeps
// this ratio, but its time is its share of the sweep's.
void TileLoop::set_time(WorkerReport* report) {
  TileCost& cost = report->result.cost;
  const double seconds = running_.at(report->tile);
  running_.erase(report->tile);
  if (cost.seconds > 0.0) cost.kernel_seconds *= seconds / cost.seconds;
  cost.seconds = seconds;
}

void TileLoop::hand_back(const WorkerReport& report) {
  progress_.drop_tile(report.tile);
  failure_ = report.failure;
  if (!is_stopping_) waiting_.push_front(report.tile);
  if (is_stopping_ || workers_->size() == 0 || !options_.warn) return;
  try {
    std::rethrow_exception(report.failure);
  } catch (const std::exception& error) {
    options_.warn(fmt::format("{}\nthe others take over what it had", error.what()));
  }
}

void TileLoop::add(std::size_t number, const TileResult& result, bool resumed) {
  assembly_->add(plan_, *tiles_[number], result);
  progress_.tile_done(number, *tiles_[number], resumed);
}

}  // namespace gearsweep
