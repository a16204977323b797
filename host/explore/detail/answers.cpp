#include "explore/detail/answers.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "explore/curve_messages.hpp"
#include "explore/detail/answer_text.hpp"
#include "explore/detail/request_values.hpp"
#include "explore/messages.hpp"
#include "explore/view_study.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kMaxPages = 128;  // whose streams are known
constexpr int kMaxAtOnce = 24;          // requests that compute
constexpr std::size_t kMaxStarts = 256;

constexpr const char* kJson = "application/json";
constexpr const char* kRecords = "application/octet-stream";

}  // namespace

// Held by what computes; too many are refused.
std::shared_ptr<void> Answers::take_slot() {
  if (++at_once_ > kMaxAtOnce) {
    --at_once_;
    throw Refusal{429, "too many requests at once; ask again later"};
  }
  return {nullptr, [this](void*) { --at_once_; }};
}

std::shared_ptr<const Scene> Answers::scene_of(const std::string& key) const {
  auto scene = explorer_->find_scene(key);
  if (scene == nullptr) throw Refusal{404, "this scene is not known any more; ask for it again"};
  return scene;
}

// A page asks for one list after the other; the last one counts, and ends the stream that it had.
Answers::Stop Answers::begin_stream(const std::string& page) {
  const std::lock_guard lock(mutex_);
  if (pages_.size() > kMaxPages) {
    for (const auto& [other, stop] : pages_) *stop = true;
    pages_.clear();
  }
  Stop& stop = pages_[page];
  if (stop != nullptr) *stop = true;
  stop = std::make_shared<std::atomic<bool>>(is_closing_);
  return stop;
}

void Answers::close() {
  const std::lock_guard lock(mutex_);
  for (const auto& [page, stop] : pages_) *stop = true;
  is_closing_ = true;
}

void Answers::send_stream(const std::string& page, NextRecord next, Response* response) {
  struct Stream {
    std::shared_ptr<void> slot;
    Stop stop;
    NextRecord next;
    bool has_failed = false;
  };
  const auto stream = std::make_shared<Stream>();
  stream->slot = take_slot();
  stream->stop = begin_stream(page);
  stream->next = std::move(next);
  const auto send_next = [stream](std::size_t, httplib::DataSink& sink) {
    std::optional<std::string> record;
    if (!*stream->stop && !stream->has_failed) {
      try {
        record = stream->next(*stream->stop);
      } catch (const std::exception& error) {
        stream->has_failed = true;
        record = error_record(error.what());
      }
    }
    if (record) return sink.write(record->data(), record->size());
    sink.done();
    return true;
  };
  response->set_chunked_content_provider(kRecords, send_next);
}

void Answers::prepare(const std::shared_ptr<const Scene>& scene) {
  std::call_once(is_prepared_, [&] {
    preparer_ = std::jthread([this, scene] { explorer_->prepare_motions(*scene); });
  });
}

void Answers::scene(const Request& request, Response* response) {
  const std::shared_ptr<void> slot = take_slot();
  const auto scene = explorer_->make_scene(changes_of(request));
  answer_text(scene_message(*explorer_, *scene), kJson, response);
}

void Answers::result(const Request& request, Response* response) {
  const std::shared_ptr<void> slot = take_slot();
  const auto scene = scene_of(request.get_param_value("scene"));
  const auto depth = number_of<std::size_t>(request, "depth", 0);
  if (depth > TilePlace::kMaxDepth) throw Refusal{400, "a depth that is not there"};
  const Stop stop = begin_stream("the result files");
  answer_text(explorer_->result_file(*scene, shares_of(request), depth, *stop),
              "application/x-netcdf", response);
}

void Answers::study(const Request& request, Response* response) const {
  const auto scene = scene_of(request.get_param_value("scene"));
  const ViewRange view = {
      shares_of(request),
      {number_of<std::size_t>(request, "nx", 200), number_of<std::size_t>(request, "ny", 150)}};
  answer_text(view_study(*scene, view), "text/plain; charset=utf-8", response);
}

void Answers::data(const Request& request, Response* response) const {
  const auto scene = scene_of(request.get_param_value("scene"));
  const ResultData* data = explorer_->data(*scene);
  if (data == nullptr) throw Refusal{404, "no file has numbers of this scene"};
  answer_text(data_record(*scene, *data), kRecords, response);
}

void Answers::curves(const Request& /*request*/, Response* response) const {
  const ExploredCurves* curves = explorer_->curves();
  if (curves == nullptr) throw Refusal{404, "explore was started without curves"};
  answer_text(curves_message(*curves), kJson, response);
}

void Answers::border(const Request& request, Response* response) {
  const std::shared_ptr<void> slot = take_slot();
  const auto scene = scene_of(request.get_param_value("scene"));
  const ExploredCurves* curves = explorer_->curves();
  if (curves == nullptr || explorer_->difference_of_curves(*scene)) {
    throw Refusal{404, "there are no curves of this scene"};
  }
  const CurvePlace place = {number_of<std::size_t>(request, "curve", 0),
                            number_of<std::size_t>(request, "point", 0)};
  const std::vector<StoredCurve>& all = curves->stored.curves;
  if (place.curve >= all.size() || place.point >= all[place.curve].places.size()) {
    throw Refusal{400, "no such point of a curve"};
  }
  answer_text(border_message(*explorer_, *scene, explorer_->border(*scene, place)), kJson,
              response);
}

void Answers::motion(const Request& request, Response* response) {
  const std::shared_ptr<void> slot = take_slot();
  const auto scene = scene_of(request.get_param_value("scene"));
  const Motion motion = explorer_->motion(*scene, cell_of(request));
  answer_text(motion_message(*explorer_, *scene, motion), kJson, response);
}

void Answers::multipliers(const Request& request, Response* response) {
  const std::shared_ptr<void> slot = take_slot();
  const auto scene = scene_of(request.get_param_value("scene"));
  const Cell cell = cell_of(request);
  try {
    answer_text(orbit_message(explorer_->orbit(*scene, cell)), kJson, response);
  } catch (const RunError& error) {  // there is no orbit, which is no fault of the server
    throw Refusal{422, error.what()};
  }
}

void Answers::attractors(const Request& request, Response* response) {
  const std::shared_ptr<void> slot = take_slot();
  const auto scene = scene_of(request.get_param_value("scene"));
  const auto starts = number_of<std::size_t>(request, "starts", 16);
  if (starts < 2 || starts > kMaxStarts) throw Refusal{400, "starts takes 2 to 256"};
  const ReachedAttractors reached = explorer_->starts(*scene, cell_of(request), starts);
  answer_text(starts_message(*scene, reached, starts), kJson, response);
}

// One after the other, each of four times the points, for as long as the next is to come soon.
void Answers::preview(const Request& request, Response* response) {
  constexpr double kSeconds = 0.25;
  constexpr double kMin = 48.0, kMax = 4096.0;  // points
  const nlohmann::json body = nlohmann::json::parse(request.body);
  const auto scene = scene_of(body.at("scene").get<std::string>());
  const ShareRange view = read_view(body.at("view"));
  require_view(view);
  const double rate = explorer_->preview_rate();
  const auto next =
      [this, scene, view, points = std::clamp(kSeconds * rate, kMin, kMax), is_known = rate > 0.0,
       is_last = false](const std::atomic<bool>& stop) mutable -> std::optional<std::string> {
    if (is_last) return std::nullopt;
    const auto preview =
        explorer_->preview(*scene, cells_in(view, static_cast<std::size_t>(points)), stop);
    if (!preview) return std::nullopt;
    points *= 4.0;
    // How long the very first took tells of its kernels, which had to be compiled.
    is_last = points > kMax || (is_known && 4.0 * preview->seconds > kSeconds);
    is_known = true;
    return preview_record(*preview, explorer_->preview_rate());
  };
  send_stream(body.at("page").get<std::string>(), next, response);
}

void Answers::tiles(const Request& request, Response* response) {
  const nlohmann::json body = nlohmann::json::parse(request.body);
  const auto scene = scene_of(body.at("scene").get<std::string>());
  const auto next =
      [this, scene, places = read_places(body.at("tiles")), i = std::size_t{0},
       has_told = false](const std::atomic<bool>& stop) mutable -> std::optional<std::string> {
    if (i == places.size()) return std::nullopt;
    const TilePlace place = places[i++];
    const auto maps = explorer_->tile(*scene, place, stop);
    if (maps == nullptr) return std::nullopt;
    prepare(scene);
    std::string record = tile_record(place, *maps, explorer_->points_per_second());
    // Why points are refused is told once.
    if (!maps->refusal.empty() && !std::exchange(has_told, true)) {
      record += error_record(maps->refusal);
    }
    return record;
  };
  send_stream(body.at("page").get<std::string>(), next, response);
}

void Answers::diagram(const Request& request, Response* response) {
  const nlohmann::json body = nlohmann::json::parse(request.body);
  const auto scene = scene_of(body.at("scene").get<std::string>());
  const auto next =
      [this, scene, line = read_line(body), strips = read_strips(body.at("strips")),
       i = std::size_t{0}](const std::atomic<bool>& stop) mutable -> std::optional<std::string> {
    if (i == strips.size()) return std::nullopt;
    const Strip strip = strips[i++];
    const std::optional<StripMaps> maps = explorer_->strip(*scene, line, strip, stop);
    if (!maps) return std::nullopt;
    return strip_record(line, strip, *maps, explorer_->points_per_second());
  };
  // Beside the tiles of the same page.
  send_stream(body.at("page").get<std::string>() + "/diagram", next, response);
}

}  // namespace gearsweep
