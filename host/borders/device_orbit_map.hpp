// The orbit map of an engine: a batch is a tile.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

#include "borders/orbit_map.hpp"
#include "engine/engine.hpp"
#include "study/study.hpp"

namespace gearsweep {

class DeviceOrbitMap final : public OrbitMap {
 public:
  // study: whose model and steps it takes; its axes are the map's parameters, and their values say
  // how far queries may reach. The engine must be one for this study, and outlive the map. stop:
  // set it to end what is computed; null: nobody will.
  DeviceOrbitMap(std::shared_ptr<const Study> study, Engine* engine,
                 const std::atomic<bool>* stop = nullptr);

  std::vector<std::optional<OrbitAnswer>> answer(const std::vector<OrbitQuery>& queries) override;

 private:
  const std::shared_ptr<const Study> study_;
  Engine* const engine_;
  const std::atomic<bool>* const stop_;
  std::mutex mutex_;  // one batch at a time
};

}  // namespace gearsweep
