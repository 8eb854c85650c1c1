#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

#include <glissade/realtime/periodic_thread.h>
#include <glissade/realtime/spsc_ring.h>
#include <glissade/viewer/page.h>
#include <glissade/viewer/scene_model.h>
#include <glissade/viewer/view_frame.h>
#include <glissade/viewer/view_server.h>

#include "server/http_port.h"
#include "server/live_client.h"

namespace glissade::viewer {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;

namespace {

constexpr std::size_t kRingStates = 1024;  // a second of the usual loop
constexpr std::chrono::microseconds kFramePeriod{16'667};
constexpr std::size_t kMostClients = 64;
constexpr std::chrono::milliseconds kLongestGoodbye{300};  // a page that reads answers in a few

}  // namespace

/// Everything but `push` runs in the thread of `io_`, and the whole model is made in one of its own.
class ViewServer::Service {
 public:
  Service(ViewScene scene, std::uint16_t port)
      : scene_(std::move(scene)),
        frames_(scene_),
        page_(std::make_shared<const std::string>(page())),
        first_model_(std::make_shared<const std::string>(scene_model(scene_, kFirstTriangles))),
        http_port_(
            io_, port, [this](std::string_view target) { return answer(target); },
            [this](beast::tcp_stream&& stream, const HttpRequest& request) { add_client(std::move(stream), request); }),
        timer_(io_),
        goodbye_(io_) {
    next_frame();
    serving_ = std::jthread([this] { serve(); });
    making_ = std::jthread([this] { make_whole_model(); });
  }

  ~Service() {
    asio::post(io_, [this] { end(); });
  }

  std::uint16_t port() const noexcept { return http_port_.port(); }
  bool has_had_client() const noexcept { return has_had_client_.load(std::memory_order_relaxed); }
  void push(const devices::HapticState& state) noexcept { states_.push(state); }

 private:
  /// What a page makes fail ends its own connection; what else fails ends the viewing, never the run.
  void serve() noexcept {
    realtime::name_this_thread("viewer");
    try {
      io_.run();
    } catch (const std::exception&) {
      io_.stop();
    }
  }

  Content answer(std::string_view target) const {
    constexpr std::string_view kModel = "model/gltf-binary";
    if (target == "/") return {.type = "text/html; charset=utf-8", .text = page_};
    if (target == "/model.glb") return {.type = kModel, .text = first_model_};
    if (target == "/whole_model.glb" && whole_model_) return {.type = kModel, .text = whole_model_};
    if (target == "/whole_model.glb") return plain(http::status::accepted, "the model is being made\n");
    return plain(http::status::not_found, "there is no such page\n");
  }

  void add_client(beast::tcp_stream&& stream, const HttpRequest& request) {
    std::erase_if(clients_, [](const auto& client) { return client->has_ended(); });
    if (clients_.size() >= kMostClients) return;  // the stream closes
    clients_.push_back(std::make_shared<LiveClient>(
        std::move(stream), [this] { has_had_client_.store(true, std::memory_order_relaxed); }));
    clients_.back()->start(request, frame_);
  }

  void next_frame() {
    timer_.expires_after(kFramePeriod);
    timer_.async_wait([this](beast::error_code) {
      states_.pop_waiting([this](const devices::HapticState& state) { frames_.add(state); });
      if (frames_.has_news()) {
        frame_ = frames_.make();
        for (const std::shared_ptr<LiveClient>& client : clients_)
          client->offer(frame_);
        std::erase_if(clients_, [](const auto& client) { return client->has_ended(); });
      }
      next_frame();
    });
  }

  /// Without a goodbye, pages would take the end for a failure.
  void end() {
    http_port_.close();  // or a page might come back too soon
    goodbye_.expires_after(kLongestGoodbye);
    goodbye_.async_wait([this](beast::error_code) { io_.stop(); });
    const auto open_clients = std::make_shared<std::size_t>(clients_.size() + 1);
    const auto count_down = [this, open_clients] {
      if (--*open_clients == 0) io_.stop();
    };
    for (const std::shared_ptr<LiveClient>& client : clients_)
      client->end(count_down);
    count_down();  // there may be none
  }

  /// A scene without one, because it is too large, stays as it was loaded first.
  void make_whole_model() noexcept {
    realtime::name_this_thread("viewer-model");
    try {
      auto model = std::make_shared<const std::string>(scene_model(scene_, std::numeric_limits<std::size_t>::max()));
      asio::post(io_, [this, model = std::move(model)] { whole_model_ = model; });
    } catch (const std::exception&) {
    }
  }

  ViewScene scene_;
  FrameMaker frames_;
  std::string frame_;  // the last one
  asio::io_context io_{1};
  std::shared_ptr<const std::string> page_;
  std::shared_ptr<const std::string> first_model_;
  std::shared_ptr<const std::string> whole_model_;  // null until it has been made
  HttpPort http_port_;
  asio::steady_timer timer_;
  asio::steady_timer goodbye_;
  std::vector<std::shared_ptr<LiveClient>> clients_;
  realtime::SpscRing<devices::HapticState> states_{kRingStates};
  std::atomic<bool> has_had_client_{false};
  std::jthread making_;
  std::jthread serving_;  // joined first
};

ViewServer::ViewServer(ViewScene scene, std::uint16_t port)
    : service_(std::make_unique<Service>(std::move(scene), port)) {}

ViewServer::~ViewServer() = default;

std::uint16_t ViewServer::port() const noexcept {
  return service_->port();
}

std::string ViewServer::url() const {
  return "http://127.0.0.1:" + std::to_string(service_->port()) + "/";
}

bool ViewServer::has_had_client() const noexcept {
  return service_->has_had_client();
}

void ViewServer::push(const devices::HapticState& state) noexcept {
  service_->push(state);
}

}  // namespace glissade::viewer
