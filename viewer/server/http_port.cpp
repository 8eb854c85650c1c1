#include "server/http_port.h"

#include <chrono>
#include <stdexcept>
#include <string>
#include <utility>

#include <fcntl.h>

namespace glissade::viewer {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::ip::tcp;

namespace {

constexpr std::size_t kMostConnections = 128;
constexpr std::chrono::milliseconds kAcceptPause{100};

/// Not for programs that this one starts: they would keep port and connections open.
void keep_from_children(int socket) {
  fcntl(socket, F_SETFD, FD_CLOEXEC);
}

tcp::acceptor listening(asio::io_context& io, std::uint16_t port) {
  try {
    tcp::acceptor acceptor(io, tcp::endpoint(asio::ip::address_v4::loopback(), port));
    keep_from_children(acceptor.native_handle());
    return acceptor;
  } catch (const boost::system::system_error& error) {
    throw std::invalid_argument("port " + std::to_string(port) + " cannot be opened: " + error.code().message());
  }
}

}  // namespace

HttpPort::HttpPort(asio::io_context& io, std::uint16_t port, Answer answer, Connection::Upgrade upgrade)
    : answer_(std::move(answer)),
      upgrade_(std::move(upgrade)),
      acceptor_(listening(io, port)),
      pause_(io),
      port_(acceptor_.local_endpoint().port()) {
  accept();
}

void HttpPort::close() {
  beast::error_code ignored;
  acceptor_.close(ignored);
}

void HttpPort::accept() {
  acceptor_.async_accept([this](beast::error_code error, tcp::socket socket) {
    std::erase_if(connections_, [](const auto& connection) { return connection.expired(); });
    if (error || (connections_.size() >= kMostConnections && !close_oldest_idle())) {
      pause_.expires_after(kAcceptPause);  // without descriptors, the next one fails at once
      pause_.async_wait([this](beast::error_code) { accept(); });
      return;
    }
    keep_from_children(socket.native_handle());
    socket.set_option(tcp::no_delay(true), error);
    const auto connection = std::make_shared<Connection>(beast::tcp_stream(std::move(socket)), answer_, upgrade_);
    connections_.push_back(connection);
    connection->start();
    accept();
  });
}

/// Makes room for a new connection: many that ask for nothing keep no page out. Returns whether there was an idle one.
bool HttpPort::close_oldest_idle() {
  for (auto place = connections_.begin(); place != connections_.end(); ++place) {
    const std::shared_ptr<Connection> connection = place->lock();
    if (!connection || !connection->is_idle()) continue;
    connection->close();
    connections_.erase(place);
    return true;
  }
  return false;
}

}  // namespace glissade::viewer
