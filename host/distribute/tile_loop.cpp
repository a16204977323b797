#include "distribute/tile_loop.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gearsweep {

TileLoop::TileLoop(const Plan& plan, const Shard& shard, const SweepOptions& options, Crew* crew,
                   Journal* journal, Assembly* assembly)
    : plan_(plan),
      shard_(shard),
      options_(options),
      tiles_(tiles_of(plan)),
      crew_(crew),
      journal_(journal),
      assembly_(assembly),
      progress_(plan, shard, options) {}

bool TileLoop::run() {
  std::size_t first = 0;
  for (const Stage& stage : plan_.stages()) {
    take_from_journal(first, stage.tiles.size());
    while (!waiting_.empty() || running_ > 0) {
      stop_if_asked();
      start_tiles();
      if (running_ == 0) break;
      if (std::optional<CrewReport> report = crew_->wait(std::chrono::milliseconds(100))) {
        handle(std::move(*report));
      }
    }
    if (is_stopping_) return false;
    if (!waiting_.empty()) std::rethrow_exception(failure_);
    first += stage.tiles.size();
  }
  return true;
}

void TileLoop::take_from_journal(std::size_t first, std::size_t count) {
  for (std::size_t number = first; number < first + count; ++number) {
    if (!shard_.has(number)) continue;
    std::optional<TileResult> result;
    if (journal_ != nullptr) result = journal_->find(number);
    if (result) {
      add(number, *result, true);
    } else {
      waiting_.push_back(number);
    }
  }
}

void TileLoop::stop_if_asked() {
  if (is_stopping_ || options_.stop == nullptr || !*options_.stop) return;
  is_stopping_ = true;
  crew_->stop();
  waiting_.clear();
}

void TileLoop::start_tiles() {
  while (!waiting_.empty() && crew_->idle() > 0) {
    const std::size_t number = waiting_.front();
    waiting_.pop_front();
    progress_.begin_tile(number, *tiles_[number]);
    std::vector<double> initial;
    if (plan_.study().is_chained()) initial = assembly_->initial_states(plan_, *tiles_[number]);
    crew_->start(number, std::move(initial));
    ++running_;
  }
}

void TileLoop::handle(CrewReport report) {
  switch (report.kind) {
    case CrewReport::Kind::progress:
      progress_.add_steps(report.tile, report.steps);
      return;
    case CrewReport::Kind::more_work:
      progress_.add_work(report.tile, report.steps);
      return;
    case CrewReport::Kind::finished:
      --running_;
      // While one thing at a time is computed, it takes all of the time.
      for (const std::size_t spent : {kSeconds, kKernelSeconds}) {
        report.result.effort[spent] /= static_cast<double>(std::max<std::size_t>(1, crew_->size()));
      }
      // Nobody need wait for the disk.
      if (!is_stopping_) start_tiles();
      if (journal_ != nullptr) journal_->store(report.tile, report.result);
      add(report.tile, report.result, false);
      return;
    case CrewReport::Kind::stopped:
      --running_;
      progress_.drop_tile(report.tile);
      return;
    case CrewReport::Kind::lost:
      --running_;
      hand_back(report);
      return;
  }
}

void TileLoop::hand_back(const CrewReport& report) {
  progress_.drop_tile(report.tile);
  failure_ = report.failure;
  if (!is_stopping_) waiting_.push_front(report.tile);
  if (crew_->size() == 0 || !options_.on_trouble) return;
  try {
    std::rethrow_exception(report.failure);
  } catch (const std::exception& error) {
    options_.on_trouble(fmt::format("{}\nthe others take over what it had", error.what()));
  }
}

void TileLoop::add(std::size_t number, const TileResult& result, bool resumed) {
  assembly_->add(*tiles_[number], result);
  progress_.tile_done(number, *tiles_[number], resumed);
}

}  // namespace gearsweep
