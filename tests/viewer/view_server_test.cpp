// The server, asked over real sockets.

#include <chrono>
#include <cstring>
#include <memory>
#include <string>
#include <thread>

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/viewer/page.h>
#include <glissade/viewer/view_server.h>

#include "expect_bad_input.h"
#include "server/connection.h"

namespace glissade::viewer {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;

ViewScene small_scene() {
  ViewScene scene;
  scene.title = "a box";
  scene.objects.push_back(
      {"part", std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.1, 0.1, 0.1}, 12)), {}, 0});
  scene.objects.back().X_WB.setIdentity();
  return scene;
}

devices::HapticState state_of(std::int64_t sequence) {
  devices::HapticState state;
  state.sequence = sequence;
  state.time = std::chrono::milliseconds(sequence);
  return state;
}

class Browser {
 public:
  explicit Browser(const ViewServer& server) : host_("127.0.0.1:" + std::to_string(server.port())), stream_(io_) {
    stream_.connect({asio::ip::address_v4::loopback(), server.port()});
  }

  http::response<http::string_body> ask(http::verb verb, const std::string& target, const std::string& host = "") {
    http::request<http::empty_body> request(verb, target, 11);
    request.set(http::field::host, host.empty() ? host_ : host);
    http::write(stream_, request);
    http::response<http::string_body> answer;
    http::read(stream_, buffer_, answer);
    return answer;
  }

 private:
  std::string host_;
  asio::io_context io_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
};

class Viewer {
 public:
  explicit Viewer(const ViewServer& server) : socket_(io_) {
    beast::get_lowest_layer(socket_).connect(tcp::endpoint(asio::ip::address_v4::loopback(), server.port()));
    socket_.handshake("127.0.0.1:" + std::to_string(server.port()), "/live");
  }

  /// The number of the tick in the next frame, and how many frames were missed before it.
  std::pair<double, float> next() {
    beast::flat_buffer buffer;
    socket_.read(buffer);
    const auto* bytes = static_cast<const char*>(buffer.data().data());
    double sequence = 0.0;
    float missed = 0.0F;
    std::memcpy(&sequence, bytes + 8, sizeof sequence);
    std::memcpy(&missed, bytes + 32, sizeof missed);
    return {sequence, missed};
  }
  void acknowledge() { socket_.write(asio::buffer("shown", 5)); }

 private:
  asio::io_context io_;
  beast::websocket::stream<beast::tcp_stream> socket_;
};

TEST(ViewServer, ServesThePageAndTheModels) {
  const ViewServer server(small_scene());
  Browser browser(server);
  const auto page_answer = browser.ask(http::verb::get, "/");
  EXPECT_EQ(page_answer.result(), http::status::ok);
  EXPECT_EQ(page_answer.body(), page());
  EXPECT_EQ(page_answer["Content-Security-Policy"].substr(0, 18), "default-src 'none'");
  EXPECT_EQ(browser.ask(http::verb::get, "/model.glb").body().substr(0, 4), "glTF");
  for (http::status status = http::status::accepted; status != http::status::ok;)
    status = browser.ask(http::verb::get, "/whole_model.glb").result();  // it is being made
  EXPECT_EQ(browser.ask(http::verb::get, "/nothing").result(), http::status::not_found);
  EXPECT_EQ(browser.ask(http::verb::post, "/").result(), http::status::method_not_allowed);
}

TEST(ViewServer, RefusesPagesOfOtherSites) {
  EXPECT_TRUE(is_own_request("127.0.0.1:8421", ""));
  EXPECT_TRUE(is_own_request("localhost:8421", "http://localhost:8421"));
  EXPECT_FALSE(is_own_request("127.0.0.1:8421", "http://elsewhere.example"));
  EXPECT_FALSE(is_own_request("127.0.0.1:8421", "https://127.0.0.1:8421"));
  EXPECT_FALSE(is_own_request("elsewhere.example:8421", "http://elsewhere.example:8421"));
  EXPECT_FALSE(is_own_request("localhost.elsewhere.example", ""));
  EXPECT_FALSE(is_own_request("localhost:80.elsewhere.example", ""));
  EXPECT_FALSE(is_own_request("", ""));
  const ViewServer server(small_scene());
  Browser browser(server);
  EXPECT_EQ(browser.ask(http::verb::get, "/", "elsewhere.example").result(), http::status::forbidden);
}

TEST(ViewServer, AViewerGetsTheNextFrameOnlyAfterItHasShownTheLast) {
  ViewServer server(small_scene());
  server.push(state_of(1));
  Viewer viewer(server);
  EXPECT_EQ(viewer.next().first, 1.0);
  // Five frames pass by meanwhile.
  for (std::int64_t i = 2; i <= 6; ++i) {
    server.push(state_of(i));
    std::this_thread::sleep_for(std::chrono::milliseconds(40));
  }
  viewer.acknowledge();
  std::this_thread::sleep_for(std::chrono::milliseconds(40));
  server.push(state_of(7));
  const auto [sequence, missed] = viewer.next();
  EXPECT_EQ(sequence, 7.0);
  EXPECT_GE(missed, 3.0F);
}

TEST(ViewServer, WhoComesLaterSeesTheLastFrameAtOnce) {
  ViewServer server(small_scene());
  EXPECT_FALSE(server.has_had_client());
  server.push(state_of(3));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  Viewer viewer(server);
  EXPECT_EQ(viewer.next().first, 3.0);
  EXPECT_TRUE(server.has_had_client());
}

TEST(ViewServer, SaysThatAPortIsTaken) {
  const ViewServer first(small_scene());
  test_support::expect_bad_input([&] { const ViewServer second(small_scene(), {.port = first.port()}); },
                                 {"port " + std::to_string(first.port())});
}

TEST(ViewServer, EndsWhileViewersAreThere) {
  auto server = std::make_unique<ViewServer>(small_scene());
  server->push(state_of(1));
  Viewer viewer(*server);
  viewer.next();
  server.reset();
  EXPECT_THROW(viewer.next(), boost::system::system_error);
}

}  // namespace
}  // namespace glissade::viewer
