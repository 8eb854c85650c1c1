#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include <glissade/viewer/page_server.h>

#include "page_client.h"

namespace glissade::viewer {
namespace {

namespace http = boost::beast::http;
using test_support::Browser;

std::optional<ServedFile> find(std::string_view path) {
  if (path == "/rows.csv") return ServedFile{"text/csv", "slide\n0\n"};
  if (path == "/broken") throw std::runtime_error("the disk is full");
  return std::nullopt;
}

std::uint16_t port_of(const PageServer& server) {
  const std::string url = server.url();
  return static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
}

TEST(PageServer, AnswersWithWhatIsThere) {
  const PageServer server(0, find);
  Browser browser(port_of(server));
  const auto answer = browser.ask(http::verb::get, "/rows.csv?now");
  EXPECT_EQ(answer.result(), http::status::ok);
  EXPECT_EQ(answer.body(), "slide\n0\n");
  EXPECT_EQ(answer["Content-Type"], "text/csv");
  EXPECT_EQ(browser.ask(http::verb::get, "/../etc/passwd").result(), http::status::not_found);
  EXPECT_EQ(browser.ask(http::verb::get, "/live").result(), http::status::not_found) << "there is no run to look at";
  EXPECT_EQ(browser.ask(http::verb::get, "/", "elsewhere.example").result(), http::status::forbidden);
}

TEST(PageServer, AFailureIsAnAnswer) {
  const PageServer server(0, find);
  Browser browser(port_of(server));
  const auto answer = browser.ask(http::verb::get, "/broken");
  EXPECT_EQ(answer.result(), http::status::internal_server_error);
  EXPECT_EQ(answer.body(), "the disk is full\n");
  EXPECT_EQ(browser.ask(http::verb::get, "/rows.csv").result(), http::status::ok) << "and it goes on";
}

TEST(PageServer, ATakenPortIsTold) {
  const PageServer server(0, find);
  EXPECT_THROW(PageServer(port_of(server), find), std::invalid_argument);
}

}  // namespace
}  // namespace glissade::viewer
