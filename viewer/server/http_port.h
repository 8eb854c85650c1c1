#pragma once

/// A port of this machine at which browsers connect.

#include <cstdint>
#include <memory>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

#include "server/connection.h"

namespace glissade::viewer {

/// Accepts connections from the construction on. If there are too many, the one that has been idle for longest ends.
/// All calls in the thread of `io`.
class HttpPort {
 public:
  /// Opens `port` of 127.0.0.1, or any free port if `port` is 0. Throws std::invalid_argument, naming the port, if it
  /// cannot be opened.
  HttpPort(boost::asio::io_context& io, std::uint16_t port, Answer answer, Connection::Upgrade upgrade = {});

  std::uint16_t port() const noexcept { return port_; }
  /// No more connections from now on.
  void close();

 private:
  void accept();
  bool close_oldest_idle();

  Answer answer_;
  Connection::Upgrade upgrade_;
  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::steady_timer pause_;
  std::uint16_t port_;
  std::vector<std::weak_ptr<Connection>> connections_;  // the oldest first
};

}  // namespace glissade::viewer
