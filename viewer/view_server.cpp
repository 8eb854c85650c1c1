#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

#include <glissade/realtime/periodic_thread.h>
#include <glissade/realtime/spsc_ring.h>
#include <glissade/viewer/page.h>
#include <glissade/viewer/scene_model.h>
#include <glissade/viewer/view_frame.h>
#include <glissade/viewer/view_server.h>

#include "server/connection.h"
#include "server/live_client.h"

namespace glissade::viewer {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::ip::tcp;

namespace {

constexpr std::size_t kRingStates = 1024;  // a second of the usual loop
constexpr std::size_t kMostConnections = 128;
constexpr std::chrono::milliseconds kAcceptPause{100};
constexpr std::chrono::microseconds kFramePeriod{16'667};
constexpr std::size_t kMostClients = 64;
constexpr std::chrono::milliseconds kLongestGoodbye{300};  // a page that reads answers in a few

tcp::acceptor listening(asio::io_context& io, std::uint16_t port) {
  try {
    return {io, tcp::endpoint(asio::ip::address_v4::loopback(), port)};
  } catch (const boost::system::system_error& error) {
    throw std::invalid_argument("port " + std::to_string(port) + " cannot be opened: " + error.code().message());
  }
}

}  // namespace

/// Everything but `push` runs in the thread of `io_`, and the whole model is made in one of its own.
class ViewServer::Service {
 public:
  Service(ViewScene scene, std::uint16_t port)
      : scene_(std::move(scene)),
        frames_(scene_),
        acceptor_(listening(io_, port)),
        timer_(io_),
        pause_(io_),
        goodbye_(io_),
        port_(acceptor_.local_endpoint().port()) {
    answers_.page = page();
    answers_.first_model = std::make_shared<const std::string>(scene_model(scene_, kFirstTriangles));
    accept();
    next_frame();
    serving_ = std::jthread([this] { serve(); });
    making_ = std::jthread([this] { make_whole_model(); });
  }

  ~Service() {
    asio::post(io_, [this] { end(); });
  }

  std::uint16_t port() const noexcept { return port_; }
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

  void accept() {
    acceptor_.async_accept([this](beast::error_code error, tcp::socket socket) {
      std::erase_if(connections_, [](const auto& connection) { return connection.expired(); });
      if (error || (connections_.size() >= kMostConnections && !close_oldest_idle())) {
        pause_.expires_after(kAcceptPause);  // without descriptors, the next one fails at once
        pause_.async_wait([this](beast::error_code) { accept(); });
        return;
      }
      socket.set_option(tcp::no_delay(true), error);
      const auto connection = std::make_shared<Connection>(
          beast::tcp_stream(std::move(socket)), answers_,
          [this](beast::tcp_stream&& stream, const HttpRequest& request) { add_client(std::move(stream), request); });
      connections_.push_back(connection);
      connection->start();
      accept();
    });
  }

  /// Makes room for a new connection: many that ask for nothing keep no page out. Returns whether there was an idle
  /// one.
  bool close_oldest_idle() {
    for (auto place = connections_.begin(); place != connections_.end(); ++place) {
      const std::shared_ptr<Connection> connection = place->lock();
      if (!connection || !connection->is_idle()) continue;
      connection->close();
      connections_.erase(place);
      return true;
    }
    return false;
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
    beast::error_code ignored;
    acceptor_.close(ignored);  // or a page might come back too soon
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
      asio::post(io_, [this, model = std::move(model)] { answers_.whole_model = model; });
    } catch (const std::exception&) {
    }
  }

  ViewScene scene_;
  FrameMaker frames_;
  std::string frame_;  // the last one
  asio::io_context io_{1};
  tcp::acceptor acceptor_;
  asio::steady_timer timer_;
  asio::steady_timer pause_;
  asio::steady_timer goodbye_;
  std::uint16_t port_;
  Answers answers_;
  std::vector<std::shared_ptr<LiveClient>> clients_;
  realtime::SpscRing<devices::HapticState> states_{kRingStates};
  std::atomic<bool> has_had_client_{false};
  std::vector<std::weak_ptr<Connection>> connections_;  // the oldest first
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
