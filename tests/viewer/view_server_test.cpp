// The server, asked over real sockets.

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/viewer/page.h>
#include <glissade/viewer/view_server.h>

#include "expect_bad_input.h"
#include "page_client.h"
#include "server/connection.h"

namespace glissade::viewer {
namespace {

namespace http = boost::beast::http;
using test_support::Browser;
using test_support::PageViewer;

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

TEST(ViewServer, ServesThePageAndTheModels) {
  const ViewServer server(small_scene());
  Browser browser(server.port());
  const auto page_answer = browser.ask(http::verb::get, "/");
  EXPECT_EQ(page_answer.result(), http::status::ok);
  EXPECT_EQ(page_answer.body(), page());
  EXPECT_EQ(page_answer["Content-Security-Policy"].substr(0, 18), "default-src 'none'");
  EXPECT_EQ(browser.ask(http::verb::get, "/model.glb").body().substr(0, 4), "glTF");
  for (http::status status = http::status::accepted; status != http::status::ok;)
    status = browser.ask(http::verb::get, "/whole_model.glb").result();  // it is being made
  EXPECT_EQ(browser.ask(http::verb::get, "/nothing").result(), http::status::not_found);
  EXPECT_EQ(browser.ask(http::verb::get, "/?from=a_bookmark").body(), page());
  const auto refused = browser.ask(http::verb::post, "/");
  EXPECT_EQ(refused.result(), http::status::method_not_allowed);
  EXPECT_FALSE(refused.keep_alive());
}

TEST(ViewServer, RequestWithABodyIsABadRequest) {
  const ViewServer server(small_scene());
  Browser browser(server.port());
  const auto answer = browser.ask(http::verb::post, "/", "", "a body");
  EXPECT_EQ(answer.result(), http::status::bad_request);
  EXPECT_FALSE(answer.keep_alive());
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
  Browser browser(server.port());
  EXPECT_EQ(browser.ask(http::verb::get, "/", "elsewhere.example").result(), http::status::forbidden);
}

TEST(ViewServer, AViewerGetsTheNextFrameOnlyAfterItHasShownTheLast) {
  ViewServer server(small_scene());
  server.push(state_of(1));
  PageViewer viewer(server.port());
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
  PageViewer viewer(server.port());
  EXPECT_EQ(viewer.next().first, 3.0);
  EXPECT_TRUE(server.has_had_client());
}

TEST(ViewServer, IsReachedBesideHundredsOfConnectionsThatAskForNothing) {
  const ViewServer server(small_scene());
  boost::asio::io_context io;
  std::vector<boost::asio::ip::tcp::socket> idle;
  for (int i = 0; i < 500; ++i) {
    idle.emplace_back(io);
    idle.back().connect(test_support::page_endpoint(server.port()));
  }
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(Browser(server.port()).ask(http::verb::get, "/nothing").result(), http::status::not_found) << i;
}

TEST(ViewServer, ClosesTheOldestIdleConnectionBeyond128) {
  constexpr std::size_t kMost = 128;
  const ViewServer server(small_scene());
  std::vector<std::unique_ptr<Browser>> browsers;
  const auto is_served = [](Browser& browser) {
    try {
      return browser.ask(http::verb::get, "/nothing").result() == http::status::not_found;
    } catch (const boost::system::system_error&) {
      return false;  // hung up
    }
  };
  for (std::size_t i = 0; i <= kMost; ++i) {
    browsers.push_back(std::make_unique<Browser>(server.port()));
    ASSERT_TRUE(is_served(*browsers.back())) << i;
  }
  EXPECT_FALSE(is_served(*browsers[0]));
  EXPECT_TRUE(is_served(*browsers[1]));
}

TEST(ViewServer, RefusesMoreThan64Viewers) {
  constexpr std::size_t kMost = 64;
  ViewServer server(small_scene());
  server.push(state_of(1));
  std::vector<std::unique_ptr<PageViewer>> viewers;
  for (std::size_t i = 0; i < kMost; ++i)
    viewers.push_back(std::make_unique<PageViewer>(server.port()));
  EXPECT_THROW(PageViewer(server.port()), boost::system::system_error);
  EXPECT_EQ(viewers.back()->next().first, 1.0);
}

TEST(ViewServer, SaysThatAPortIsTaken) {
  const ViewServer first(small_scene());
  test_support::expect_bad_input([&] { const ViewServer second(small_scene(), first.port()); },
                                 {"port " + std::to_string(first.port())});
}

TEST(ViewServer, EndsWhileViewersAreThere) {
  auto server = std::make_unique<ViewServer>(small_scene());
  server->push(state_of(1));
  PageViewer viewer(server->port());
  viewer.next();
  server.reset();
  EXPECT_THROW(viewer.next(), boost::system::system_error);
}

TEST(ViewServer, ViewersAreToldOfARegularEnd) {
  auto server = std::make_unique<ViewServer>(small_scene());
  server->push(state_of(1));
  PageViewer viewer(server->port());
  viewer.next();
  std::jthread ending([&] { server.reset(); });
  EXPECT_TRUE(viewer.is_told_of_the_end());
}

TEST(ViewServer, WaitsForNoPageThatDoesNotAnswer) {
  auto server = std::make_unique<ViewServer>(small_scene());
  server->push(state_of(1));
  PageViewer deaf(server->port());
  while (!server->has_had_client()) {
  }
  server.reset();  // comes back
}

}  // namespace
}  // namespace glissade::viewer
