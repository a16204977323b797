#include "explore/server.hpp"

#include <fmt/format.h>
#include <httplib.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>
#include <utility>

#include "explore/detail/answer_text.hpp"
#include "explore/detail/answers.hpp"
#include "explore/detail/request_values.hpp"
#include "explore/messages.hpp"
#include "explore/page_files.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

constexpr const char* kHost = "127.0.0.1";
constexpr std::size_t kMaxBody = 64 * 1024;  // bytes
constexpr std::size_t kThreads = 64;         // a connection that is kept open has one

constexpr const char* kJson = "application/json";

std::string random_token() {
  std::random_device device;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", device());
  return token;
}

const char* mime_type(const std::string& name) {
  if (name.ends_with(".html")) return "text/html; charset=utf-8";
  if (name.ends_with(".css")) return "text/css; charset=utf-8";
  if (name.ends_with(".svg")) return "image/svg+xml";
  return "text/javascript; charset=utf-8";
}

}  // namespace

class ExploreServer::Impl {
 public:
  Impl(Explorer* explorer, int port, const std::string& token)
      : answers_(explorer), token_(token.empty() ? random_token() : token) {
    // No other program may share the port (SO_REUSEPORT), but one that was stopped may have it
    // again.
    server_.set_socket_options([](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    });
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
    add("Get", "scene", &Answers::scene);
    add("Get", "study", &Answers::study);
    add("Get", "result", &Answers::result);
    add("Get", "data", &Answers::data);
    add("Get", "curves", &Answers::curves);
    add("Get", "border", &Answers::border);
    add("Get", "motion", &Answers::motion);
    add("Get", "multipliers", &Answers::multipliers);
    add("Get", "attractors", &Answers::attractors);
    add("Post", "preview", &Answers::preview);
    add("Post", "tiles", &Answers::tiles);
    add("Post", "diagram", &Answers::diagram);
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
    answers_.close();
    // To be stopped it must have begun.
    while (!server_.is_running() && !has_ended) std::this_thread::yield();
    server_.stop();
  }

 private:
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
      answer_text(error_message("the address lacks this explorer's token"), kJson, &response);
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
        answer_text(text, mime_type(name), &response);
      });
    }
  }

  template <typename Answer>
  void add(const std::string& method, const std::string& name, Answer answer) {
    const auto guarded = [this, answer](const httplib::Request& request,
                                        httplib::Response& response) {
      const auto refuse = [&](int status, const std::string& text) {
        response.status = status;
        answer_text(error_message(text), kJson, &response);
      };
      try {
        (answers_.*answer)(request, &response);
      } catch (const Refusal& refusal) {
        refuse(refusal.status, refusal.text);
      } catch (const nlohmann::json::exception&) {
        refuse(400, "the body is no such JSON as '" + request.path.substr(token_.size() + 2) +
                        "' takes");
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

  Answers answers_;
  const std::string token_;
  httplib::Server server_;
  int port_ = 0;
  std::string address_;
};

ExploreServer::ExploreServer(Explorer* explorer, int port, const std::string& token)
    : impl_(std::make_unique<Impl>(explorer, port, token)) {}

ExploreServer::~ExploreServer() = default;

const std::string& ExploreServer::address() const { return impl_->address(); }

void ExploreServer::serve(const std::atomic<bool>& stop) { impl_->serve(stop); }

}  // namespace gearsweep
