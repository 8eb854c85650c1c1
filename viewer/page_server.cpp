#include <exception>
#include <thread>
#include <utility>

#include <boost/asio/io_context.hpp>

#include <glissade/realtime/periodic_thread.h>
#include <glissade/viewer/page_server.h>

#include "server/http_port.h"

namespace glissade::viewer {

namespace http = boost::beast::http;

class PageServer::Service {
 public:
  Service(std::uint16_t port, Find find)
      : find_(std::move(find)), http_port_(io_, port, [this](std::string_view path) { return answer(path); }) {
    serving_ = std::jthread([this] { serve(); });
  }
  ~Service() { io_.stop(); }

  std::uint16_t port() const noexcept { return http_port_.port(); }

 private:
  void serve() noexcept {
    realtime::name_this_thread("pages");
    try {
      io_.run();
    } catch (const std::exception&) {
      io_.stop();
    }
  }

  Content answer(std::string_view path) const {
    try {
      std::optional<ServedFile> file = find_(path);
      if (!file) return plain(http::status::not_found, "there is no such page\n");
      return {.type = file->type, .text = std::make_shared<const std::string>(std::move(file->text))};
    } catch (const std::exception& error) {
      return plain(http::status::internal_server_error, std::string(error.what()) + "\n");
    }
  }

  Find find_;
  boost::asio::io_context io_{1};
  HttpPort http_port_;
  std::jthread serving_;  // joined first
};

PageServer::PageServer(std::uint16_t port, Find find) : service_(std::make_unique<Service>(port, std::move(find))) {}

PageServer::~PageServer() = default;

std::string PageServer::url() const {
  return "http://127.0.0.1:" + std::to_string(service_->port()) + "/";
}

}  // namespace glissade::viewer
