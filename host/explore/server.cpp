#include "explore/server.hpp"

#include <fmt/format.h>
#include <httplib.h>

#include <charconv>
#include <chrono>
#include <mutex>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>
#include <utility>

#include "explore/messages.hpp"
#include "explore/page_files.hpp"
#include "explore/view_study.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

constexpr const char* kHost = "127.0.0.1";
constexpr std::size_t kMaxBody = 64 * 1024;  // bytes
constexpr std::size_t kMaxTiles = 512;       // of a request
constexpr std::size_t kMaxChanges = 256;     // of a scene
constexpr std::size_t kMaxPages = 64;        // whose streams are known
constexpr int kMaxAtOnce = 24;               // requests that compute
constexpr std::size_t kThreads = 64;         // a connection that is kept open has one

constexpr const char* kJson = "application/json";

// What a request asks for that there is not, or that it may not.
struct Refusal {
  int status;
  std::string text;
};

std::string random_token() {
  std::random_device device;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", device());
  return token;
}

std::string mime_type(const std::string& name) {
  if (name.ends_with(".html")) return "text/html; charset=utf-8";
  if (name.ends_with(".css")) return "text/css; charset=utf-8";
  if (name.ends_with(".svg")) return "image/svg+xml";
  return "text/javascript; charset=utf-8";
}

template <typename Number>
Number read_number(const std::string& name, const std::string& text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw Refusal{400, fmt::format("'{}' of {} is no such number as it takes", text, name)};
  }
  return value;
}

template <typename Number>
Number number_of(const httplib::Request& request, const std::string& name, Number fallback) {
  if (!request.has_param(name)) return fallback;
  return read_number<Number>(name, request.get_param_value(name));
}

// "mu=0.1"
NamedValue read_change(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) {
    throw Refusal{400, "set takes NAME=NUMBER, with %3D for the '='"};
  }
  const std::string name = text.substr(0, equals);
  return {name, read_number<double>(name, text.substr(equals + 1))};
}

std::vector<TilePlace> read_places(const nlohmann::json& list) {
  std::vector<TilePlace> places;
  if (list.size() > kMaxTiles) {
    throw Refusal{400, fmt::format("{} tiles; at most {} at once", list.size(), kMaxTiles)};
  }
  for (const nlohmann::json& one : list) {
    const TilePlace place = {one.at(0).get<std::size_t>(),
                             {one.at(1).get<std::uint64_t>(), one.at(2).get<std::uint64_t>()}};
    const bool is_there = place.depth <= TilePlace::kMaxDepth && place.at[0] >> place.depth == 0 &&
                          place.at[1] >> place.depth == 0;
    if (!is_there) throw Refusal{400, "a tile that is not there"};
    places.push_back(place);
  }
  return places;
}

}  // namespace

class ExploreServer::Impl {
 public:
  Impl(Explorer* explorer, int port) : explorer_(explorer), token_(random_token()) {
    // Another program of the same user must not be able to share the port.
    server_.set_socket_options([](socket_t) {});
    server_.set_tcp_nodelay(true);
    server_.set_payload_max_length(kMaxBody);
    server_.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
    port_ = port == 0 ? server_.bind_to_any_port(kHost) : port;
    if (port_ <= 0 || (port != 0 && !server_.bind_to_port(kHost, port))) {
      throw RunError(
          fmt::format("port {} of {} cannot be had; give another one, or none", port, kHost));
    }
    address_ = fmt::format("http://{}:{}/{}/", kHost, port_, token_);
    add_guards();
    add_page();
    add("Get", "scene", [this](const auto& request, auto* response) { scene(request, response); });
    add("Get", "motion",
        [this](const auto& request, auto* response) { motion(request, response); });
    add("Get", "study", [this](const auto& request, auto* response) { study(request, response); });
    add("Post", "tiles", [this](const auto& request, auto* response) { tiles(request, response); });
  }

  const std::string& address() const { return address_; }

  void serve(const std::atomic<bool>& stop) {
    constexpr std::chrono::milliseconds kNap(50);
    std::atomic<bool> has_ended = false;
    std::jthread listener([&] {
      server_.listen_after_bind();
      has_ended = true;
    });
    while (!stop && !has_ended) std::this_thread::sleep_for(kNap);
    {
      const std::lock_guard lock(mutex_);
      for (const auto& [page, its_stop] : pages_) *its_stop = true;
      is_closing_ = true;
    }
    // To be stopped it must have begun.
    while (!server_.is_running() && !has_ended) std::this_thread::yield();
    server_.stop();
  }

 private:
  using Handler = std::function<void(const httplib::Request&, httplib::Response*)>;

  // A page asks for tiles one list after the other; the last one counts.
  struct TileStream {
    std::shared_ptr<const Scene> scene;
    std::vector<TilePlace> places;
    std::shared_ptr<std::atomic<bool>> stop;
    std::shared_ptr<void> slot;
    std::size_t next = 0;
    bool has_told = false;  // why a tile is refused, once
  };

  void add_guards() {
    server_.set_default_headers({
        {"Cache-Control", "no-store"},
        {"Content-Security-Policy",
         "default-src 'self'; img-src 'self' data: blob:; object-src 'none'; base-uri 'none'; "
         "form-action 'none'; frame-ancestors 'self' http://localhost:* http://127.0.0.1:*"},
        {"Cross-Origin-Resource-Policy", "same-origin"},
        {"Referrer-Policy", "no-referrer"},
        {"X-Content-Type-Options", "nosniff"},
    });
    server_.set_pre_routing_handler([this](const auto& request, auto& response) {
      using Result = httplib::Server::HandlerResponse;
      if (is_own(request)) return Result::Unhandled;
      if (request.path == "/favicon.ico") {  // browsers ask for it on their own
        response.status = 204;
        return Result::Handled;
      }
      response.status = 403;
      response.set_content(error_message("the address lacks this explorer's token"), kJson);
      return Result::Handled;
    });
  }

  // A name that another page has made point here, and another page's script, are refused.
  bool is_own(const httplib::Request& request) const {
    const std::string host = request.get_header_value("Host");
    const bool is_here =
        host == fmt::format("{}:{}", kHost, port_) || host == fmt::format("localhost:{}", port_);
    const bool is_from_here =
        !request.has_header("Origin") || request.get_header_value("Origin") == "http://" + host;
    return is_here && is_from_here && request.path.starts_with("/" + token_ + "/");
  }

  void add_page() {
    for (const auto& [name, text] : page_files()) {
      const std::string path = fmt::format("/{}/{}", token_, name == "index.html" ? "" : name);
      server_.Get(path, [&name = name, &text = text](const auto&, auto& response) {
        response.set_content(text, mime_type(name));
      });
    }
  }

  void add(const std::string& method, const std::string& name, const Handler& handler) {
    const auto guarded = [handler](const httplib::Request& request, httplib::Response& response) {
      const auto refuse = [&](int status, const std::string& text) {
        response.status = status;
        response.set_content(error_message(text), kJson);
      };
      try {
        handler(request, &response);
      } catch (const Refusal& refusal) {
        refuse(refusal.status, refusal.text);
      } catch (const nlohmann::json::exception&) {
        refuse(400, "the body is no such JSON as 'tiles' takes");
      } catch (const InputError& error) {
        refuse(400, error.what());
      } catch (const std::exception& error) {
        refuse(500, error.what());
      }
    };
    const std::string path = fmt::format("/{}/{}", token_, name);
    if (method == "Post") {
      server_.Post(path, guarded);
    } else {
      server_.Get(path, guarded);
    }
  }

  // Held by what computes; too many are refused.
  std::shared_ptr<void> take_slot() {
    if (++at_once_ > kMaxAtOnce) {
      --at_once_;
      throw Refusal{429, "too many requests at once; ask again later"};
    }
    return {nullptr, [this](void*) { --at_once_; }};
  }

  std::shared_ptr<const Scene> scene_of(const std::string& key) const {
    auto scene = explorer_->find_scene(key);
    if (scene == nullptr) throw Refusal{404, "this scene is not known any more; ask for it again"};
    return scene;
  }

  void scene(const httplib::Request& request, httplib::Response* response) {
    const std::shared_ptr<void> slot = take_slot();
    SceneChanges changes = {{}, request.get_param_value("x"), request.get_param_value("y")};
    const std::size_t count = request.get_param_value_count("set");
    if (count > kMaxChanges) throw Refusal{400, "too many changes"};
    for (std::size_t i = 0; i < count; ++i) {
      changes.sets.push_back(read_change(request.get_param_value("set", i)));
    }
    response->set_content(scene_message(*explorer_, *explorer_->make_scene(changes)), kJson);
  }

  void motion(const httplib::Request& request, httplib::Response* response) {
    const std::shared_ptr<void> slot = take_slot();
    const auto scene = scene_of(request.get_param_value("scene"));
    const Cell cell = {
        number_of<std::size_t>(request, "depth", 0),
        {number_of<std::uint64_t>(request, "kx", 0), number_of<std::uint64_t>(request, "ky", 0)}};
    const bool is_there = cell.depth <= Cell::kMaxDepth &&
                          cell.k[0] <= std::uint64_t{1} << cell.depth &&
                          cell.k[1] <= std::uint64_t{1} << cell.depth;
    if (!is_there) throw Refusal{400, "a cell that is not there"};
    response->set_content(motion_message(*explorer_, explorer_->motion(*scene, cell)), kJson);
  }

  void study(const httplib::Request& request, httplib::Response* response) const {
    const auto scene = scene_of(request.get_param_value("scene"));
    const ViewRange view = {
        {number_of(request, "x0", 0.0), number_of(request, "y0", 0.0)},
        {number_of(request, "x1", 1.0), number_of(request, "y1", 1.0)},
        {number_of<std::size_t>(request, "nx", 200), number_of<std::size_t>(request, "ny", 150)}};
    response->set_content(view_study(*scene, view), "text/plain; charset=utf-8");
  }

  void tiles(const httplib::Request& request, httplib::Response* response) {
    const nlohmann::json body = nlohmann::json::parse(request.body);
    const auto stream = std::make_shared<TileStream>();
    stream->slot = take_slot();
    stream->scene = scene_of(body.at("scene").get<std::string>());
    stream->places = read_places(body.at("tiles"));
    stream->stop = begin_stream(body.at("page").get<std::string>());
    response->set_chunked_content_provider("application/octet-stream",
                                           [this, stream](std::size_t, httplib::DataSink& sink) {
                                             return send_next(stream.get(), &sink);
                                           });
  }

  // Ends the stream that the page had.
  std::shared_ptr<std::atomic<bool>> begin_stream(const std::string& page) {
    const std::lock_guard lock(mutex_);
    if (pages_.size() > kMaxPages) {
      for (const auto& [other, stop] : pages_) *stop = true;
      pages_.clear();
    }
    std::shared_ptr<std::atomic<bool>>& stop = pages_[page];
    if (stop != nullptr) *stop = true;
    stop = std::make_shared<std::atomic<bool>>(is_closing_);
    return stop;
  }

  // False when the connection is to be closed.
  bool send_next(TileStream* stream, httplib::DataSink* sink) {
    if (stream->next == stream->places.size() || *stream->stop) {
      sink->done();
      return true;
    }
    const TilePlace place = stream->places[stream->next++];
    std::string record;
    try {
      const auto maps = explorer_->tile(*stream->scene, place, *stream->stop);
      if (maps == nullptr) {
        sink->done();
        return true;
      }
      record = tile_record(place, *maps, explorer_->points_per_second());
      if (!maps->refusal.empty() && !stream->has_told) {
        stream->has_told = true;
        record += error_record(maps->refusal);
      }
      std::call_once(is_prepared_, [&] {
        preparer_ =
            std::jthread([this, scene = stream->scene] { explorer_->prepare_motions(*scene); });
      });
    } catch (const std::exception& error) {
      stream->next = stream->places.size();
      record = error_record(error.what());
    }
    return sink->write(record.data(), record.size());
  }

  Explorer* const explorer_;
  const std::string token_;
  httplib::Server server_;
  int port_ = 0;
  std::string address_;
  std::atomic<int> at_once_ = 0;
  std::mutex mutex_;
  // Guarded by the mutex: the page's last stream is to stop.
  std::map<std::string, std::shared_ptr<std::atomic<bool>>> pages_;
  bool is_closing_ = false;
  std::once_flag is_prepared_;
  std::jthread preparer_;  // of what a click takes, once the first picture is there
};

ExploreServer::ExploreServer(Explorer* explorer, int port)
    : impl_(std::make_unique<Impl>(explorer, port)) {}

ExploreServer::~ExploreServer() = default;

const std::string& ExploreServer::address() const { return impl_->address(); }

void ExploreServer::serve(const std::atomic<bool>& stop) { impl_->serve(stop); }

}  // namespace gearsweep
