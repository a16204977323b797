// What the pages of one explorer share: the study that it was started with, scenes, tiles and
// devices.
#pragma once

#include <atomic>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "engine/device_choice.hpp"
#include "explore/diagram.hpp"
#include "explore/explored_curves.hpp"
#include "explore/motion.hpp"
#include "explore/preview.hpp"
#include "explore/result_data.hpp"
#include "explore/scene.hpp"
#include "explore/starts.hpp"
#include "explore/tile_cache.hpp"
#include "result/border_plane.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

struct ExplorerOptions {
  std::string source;     // what the user called the study, for commands that he can give
  bool is_model = false;  // that is a model, of which no command makes a map
  std::vector<DeviceChoice> devices = {};
  std::size_t max_bytes = std::size_t{512} << 20U;  // of tiles that are kept
  std::optional<ResultData> data = {};              // of the study as it is
  std::optional<ExploredCurves> curves = {};
};

// Threads may share one.
class Explorer {
 public:
  // base: explorable().
  Explorer(ExploredStudy base, ExplorerOptions options);

  const std::string& source() const { return options_.source; }
  bool is_model() const { return options_.is_model; }
  const Study& study() const { return base_.study; }
  bool has_one_axis() const { return base_.has_one_axis; }

  // Throws InputError.
  std::shared_ptr<const Scene> make_scene(const SceneChanges& changes);
  // Null where it was never made, or too many were since.
  std::shared_ptr<const Scene> find_scene(const std::string& key) const;

  // Kept from before, or computed: nothing when stopped. Throws as compute_tile() does.
  std::shared_ptr<const TileMaps> tile(const Scene& scene, const TilePlace& place,
                                       const std::atomic<bool>& stop);
  // Nothing when stopped. Throws as compute_preview() does.
  std::optional<Preview> preview(const Scene& scene, const CellBlock& cells,
                                 const std::atomic<bool>& stop);
  // Points a second that previews had, or tiles; 0: there was none yet.
  double preview_rate() const;
  // The numbers of the file that explore was started with; null for other scenes.
  const ResultData* data(const Scene& scene) const;
  // The curves that explore was started with, or null; and why they are not those of a scene,
  // whose parameters or axes are others.
  const ExploredCurves* curves() const { return options_.curves ? &*options_.curves : nullptr; }
  std::optional<PlaneDifference> difference_of_curves(const Scene& scene) const;
  // Nothing when stopped. Throws as compute_strip() does.
  std::optional<StripMaps> strip(const Scene& scene, const Line& line, const Strip& strip,
                                 const std::atomic<bool>& stop);
  // view_result() of these tiles. Throws as that does.
  std::string result_file(const Scene& scene, const ShareRange& view, std::size_t depth,
                          const std::atomic<bool>& stop);
  // The points of all tiles by the time that they took; 0: there is none yet.
  double points_per_second() const;
  // Tiles wait for these four between their rounds. They throw InputError and RunError.
  Motion motion(const Scene& scene, const Cell& cell);
  MotionOrbit orbit(const Scene& scene, const Cell& cell);
  ReachedAttractors starts(const Scene& scene, const Cell& cell, std::size_t count);
  // The orbit at a point of the curves, in a scene of their plane.
  BorderMotion border(const Scene& scene, const CurvePlace& place);
  // Compiles what a motion takes and finds how far states go, beside the tiles; whatever is wrong
  // is left for motion() to say.
  void prepare_motions(const Scene& scene);

  // The memory of all tiles that are kept.
  std::size_t bytes() const { return cache_.bytes(); }
  Scheduler* scheduler() { return scheduler_.get(); }

 private:
  SweepOptions sweep_options(int priority, const std::atomic<bool>* stop = nullptr) const;

  const ExploredStudy base_;
  const ExplorerOptions options_;
  const std::shared_ptr<Scheduler> scheduler_ = std::make_shared<Scheduler>();
  TileCache cache_;
  mutable std::mutex mutex_;
  std::deque<std::shared_ptr<const Scene>> scenes_;  // the last made last
  double points_ = 0.0, seconds_ = 0.0;              // of tiles
  double preview_rate_ = 0.0;                        // points a second of the last preview
  std::string data_key_;                             // of the scene that options_.data is of
  std::mutex one_spectrum_;                          // add_spectrum()
  std::mutex one_file_;                              // view_result()
};

}  // namespace gearsweep
