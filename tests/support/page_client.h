#pragma once

/// What a page of the viewer does: asks over HTTP, and gets frames over WebSocket.

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

namespace glissade::test_support {

inline boost::asio::ip::tcp::endpoint page_endpoint(std::uint16_t port) {
  return {boost::asio::ip::address_v4::loopback(), port};
}

class Browser {
 public:
  explicit Browser(std::uint16_t port) : host_("127.0.0.1:" + std::to_string(port)), stream_(io_) {
    stream_.connect(page_endpoint(port));
  }

  /// The answer to a request with this body; `host` in place of the server's own name.
  boost::beast::http::response<boost::beast::http::string_body> ask(boost::beast::http::verb verb,
                                                                    const std::string& target,
                                                                    const std::string& host = "",
                                                                    const std::string& body = "") {
    boost::beast::http::request<boost::beast::http::string_body> request(verb, target, 11, body);
    if (!body.empty()) request.prepare_payload();
    request.set(boost::beast::http::field::host, host.empty() ? host_ : host);
    boost::beast::http::write(stream_, request);
    boost::beast::http::response<boost::beast::http::string_body> answer;
    boost::beast::http::read(stream_, buffer_, answer);
    return answer;
  }

 private:
  std::string host_;
  boost::asio::io_context io_;
  boost::beast::tcp_stream stream_;
  boost::beast::flat_buffer buffer_;
};

class PageViewer {
 public:
  explicit PageViewer(std::uint16_t port) : socket_(io_) {
    boost::beast::get_lowest_layer(socket_).connect(page_endpoint(port));
    socket_.handshake("127.0.0.1:" + std::to_string(port), "/live");
  }

  /// The number of the tick in the next frame, and how many frames were missed before it.
  std::pair<double, float> next() {
    boost::beast::flat_buffer buffer;
    socket_.read(buffer);
    const auto* bytes = static_cast<const char*>(buffer.data().data());
    double sequence = 0.0;
    float missed = 0.0F;
    std::memcpy(&sequence, bytes + 8, sizeof sequence);
    std::memcpy(&missed, bytes + 32, sizeof missed);
    return {sequence, missed};
  }
  /// Reads until the server ends the connection; whether it said that this is no failure.
  bool is_told_of_the_end() {
    boost::beast::error_code error;
    for (boost::beast::flat_buffer buffer; !error; buffer.clear())
      socket_.read(buffer, error);
    return error == boost::beast::websocket::error::closed &&
           socket_.reason().code == boost::beast::websocket::close_code::normal;
  }
  void acknowledge() { socket_.write(boost::asio::buffer("shown", 5)); }

 private:
  boost::asio::io_context io_;
  boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
};

}  // namespace glissade::test_support
