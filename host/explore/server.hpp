// The explorer's service on this machine's loopback address, for browsers and for programs.
//
// Each address begins with a random token, so that nobody else on the machine, and no page that a
// browser has open, can ask for anything:
//   GET  TOKEN/                        the page
//   GET  TOKEN/scene?set=mu%3D0.1&x=omega&y=b    what a scene has (scene_message())
//   POST TOKEN/preview                 {"scene": KEY, "page": ID, "view": [x0, y0, x1, y1]}: a
//                                      coarse picture (preview_record())
//   POST TOKEN/tiles                   {"scene": KEY, "page": ID, "tiles": [[d, i, j]]}: a stream
//                                      of records (tile_record())
//   POST TOKEN/diagram                 {"scene": KEY, "page": ID, "axis": 0, "at": [depth, k],
//                                      "strips": [[d, i]]}: a stream of records (strip_record())
//   GET  TOKEN/data?scene=KEY          the numbers of the result file (data_record())
//   GET  TOKEN/motion?scene=KEY&depth=12&kx=100&ky=7   the motion at a cell (motion_message())
//   GET  TOKEN/multipliers?...         of the orbit at a cell (orbit_message())
//   GET  TOKEN/attractors?...&starts=16   that other starts come to (starts_message())
//   GET  TOKEN/study?scene=KEY&x0=0.2&x1=0.4&y0=0&y1=1&nx=200&ny=150   the view as a study
//   GET  TOKEN/result?...&depth=6       the points of a view at a depth of tiles as a result file
// What is wrong is told as {"error": TEXT} with a status of 400, too much at once with one of 429.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "explore/explorer.hpp"

namespace gearsweep {

class ExploreServer {
 public:
  // port 0: any that is free; token: of letters and digits, empty: a random one. The explorer
  // outlives it. Throws RunError when the port is taken.
  ExploreServer(Explorer* explorer, int port, const std::string& token = "");
  ~ExploreServer();
  ExploreServer(const ExploreServer&) = delete;
  ExploreServer& operator=(const ExploreServer&) = delete;

  // "http://127.0.0.1:41231/TOKEN/"
  const std::string& address() const;
  // Serves until `stop` is set.
  void serve(const std::atomic<bool>& stop);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gearsweep
