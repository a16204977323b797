// What the explorer answers to each request (server.hpp lists them).
#pragma once

#include <httplib.h>

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "explore/explorer.hpp"

namespace gearsweep {

// Threads may share one. Its functions throw Refusal (detail/request_values.hpp), InputError,
// RunError, and json's exceptions for a body of another form.
class Answers {
 public:
  using Request = httplib::Request;
  using Response = httplib::Response;

  // The explorer outlives it.
  explicit Answers(Explorer* explorer) : explorer_(explorer) {}

  void scene(const Request& request, Response* response);
  void study(const Request& request, Response* response) const;
  void result(const Request& request, Response* response);
  void data(const Request& request, Response* response) const;
  void curves(const Request& request, Response* response) const;
  void border(const Request& request, Response* response);
  void motion(const Request& request, Response* response);
  void multipliers(const Request& request, Response* response);
  void attractors(const Request& request, Response* response);
  void preview(const Request& request, Response* response);
  void tiles(const Request& request, Response* response);
  void diagram(const Request& request, Response* response);

  // Ends all streams, and those that come.
  void close();

 private:
  using Stop = std::shared_ptr<std::atomic<bool>>;
  // The next record; nothing at the end, or when stopped.
  using NextRecord = std::function<std::optional<std::string>(const std::atomic<bool>& stop)>;

  std::shared_ptr<void> take_slot();
  std::shared_ptr<const Scene> scene_of(const std::string& key) const;
  Stop begin_stream(const std::string& page);
  void send_stream(const std::string& page, NextRecord next, Response* response);
  void prepare(const std::shared_ptr<const Scene>& scene);

  Explorer* const explorer_;
  std::atomic<int> at_once_ = 0;
  std::mutex mutex_;
  // Guarded by the mutex: the page's last stream is to stop.
  std::map<std::string, Stop> pages_;
  bool is_closing_ = false;
  std::once_flag is_prepared_;
  std::jthread preparer_;  // of what a click takes, once the first picture is there
};

}  // namespace gearsweep
