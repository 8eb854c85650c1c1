#include "haply/web_socket.h"

#include <charconv>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include <glissade/bridges/haply.h>
#include <glissade/bridges/wire.h>

namespace glissade::bridges {
namespace {

namespace asio_net = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using NetError = boost::system::error_code;
using asio_net::ip::tcp;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr milliseconds kForConnection{800};
constexpr milliseconds kForHandshake{1000};
constexpr milliseconds kForSending{100};
constexpr std::size_t kLongestMessage = 256 * 1024;  // an arm takes 2 KiB

/// An operation that was begun, until it ends.
class Operation {
 public:
  explicit Operation(asio_net::io_context& context) : context_(context) {}

  /// What the operation calls at its end.
  auto end() {
    is_over_ = false;
    return [this](const NetError& error, auto&&...) {
      is_over_ = true;
      error_ = error;
    };
  }
  bool is_over() const noexcept { return is_over_; }
  const NetError& error() const noexcept { return error_; }

  /// Lets it run, for at most `patience`; returns whether it is over.
  bool wait(nanoseconds patience) {
    const auto until = std::chrono::steady_clock::now() + patience;
    context_.restart();
    while (!is_over_ && context_.run_one_until(until) > 0) {
    }
    return is_over_;
  }

 private:
  asio_net::io_context& context_;
  bool is_over_ = true;
  NetError error_;
};

tcp::endpoint endpoint_of(const ServiceAddress& address) {
  return {asio_net::ip::make_address_v4(address.host), address.port};
}

}  // namespace

ServiceAddress parse_service_address(std::string_view text) {
  ServiceAddress address{.host = std::string(text), .port = kHaplyPort};
  if (const std::size_t colon = text.rfind(':'); colon != std::string_view::npos) {
    address.host = text.substr(0, colon);
    const std::string_view number = text.substr(colon + 1);
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), address.port);
    if (error != std::errc{} || end != number.data() + number.size() || address.port == 0)
      throw std::invalid_argument("service '" + std::string(text) + "': '" + std::string(number) +
                                  "' is not the number of a TCP port, from 1 to 65535");
  }
  if (address.host == "localhost") address.host = "127.0.0.1";
  NetError error;
  asio_net::ip::make_address_v4(address.host, error);
  if (error)
    throw std::invalid_argument("service '" + std::string(text) + "': '" + address.host +
                                "' is not 'localhost' or an address such as 192.168.1.5");
  return address;
}

struct WebSocket::Connection {
  explicit Connection(ServiceAddress where) : address(std::move(where)), name("service " + address.text()) {}

  [[noreturn]] void fail(const std::string& what) const { throw WireError(name + ": " + what); }
  [[noreturn]] void fail_connection(const NetError& error) const;
  void connect(beast::tcp_stream& stream);

  ServiceAddress address;
  std::string name;
  asio_net::io_context context{1};
  Operation reading{context};
  bool is_reading = false;  // a message that `receive` has not returned
  Operation other{context};
  beast::flat_buffer received;
  std::optional<websocket::stream<beast::tcp_stream>> socket;  // before its context
};

void WebSocket::Connection::fail_connection(const NetError& error) const {
  const bool is_end = error == websocket::error::closed || error == asio_net::error::eof ||
                      error == asio_net::error::connection_reset || error == asio_net::error::broken_pipe;
  fail(is_end ? "the connection is lost: the service has ended or was started again"
              : "the connection is lost: " + error.message());
}

void WebSocket::Connection::connect(beast::tcp_stream& stream) {
  stream.async_connect(endpoint_of(address), other.end());
  const bool is_over = other.wait(kForConnection);
  if (!is_over) fail("no answer");
  if (other.error() == asio_net::error::connection_refused)
    fail("nothing listens there; is Haply's Inverse Service running, and is this its port?");
  if (other.error()) fail("no connection: " + other.error().message());
  NetError ignored;
  stream.socket().set_option(tcp::no_delay(true), ignored);
}

WebSocket::WebSocket(ServiceAddress address) : connection_(std::make_unique<Connection>(std::move(address))) {}

WebSocket::~WebSocket() {
  close();
}

const std::string& WebSocket::name() const noexcept {
  return connection_->name;
}

bool WebSocket::is_open() const noexcept {
  return connection_->socket.has_value();
}

void WebSocket::open() {
  close();
  Connection& c = *connection_;
  auto& socket = c.socket.emplace(c.context);
  try {
    c.connect(beast::get_lowest_layer(socket));
    socket.read_message_max(kLongestMessage);
    socket.async_handshake(c.address.text(), "/", c.other.end());
    if (!c.other.wait(kForHandshake)) c.fail("the port is open, but nothing answers; is this the service's port?");
    if (c.other.error()) c.fail("this is no WebSocket: " + c.other.error().message());
  } catch (const WireError&) {
    close();
    throw;
  }
}

void WebSocket::close() noexcept {
  Connection& c = *connection_;
  if (!c.socket) return;
  try {
    if (c.socket->is_open() && c.other.is_over()) {
      c.socket->async_close(websocket::close_code::normal, c.other.end());
      c.other.wait(kForSending);
    }
    // Now all operations end.
    beast::get_lowest_layer(*c.socket).close();
    c.context.restart();
    c.context.run();
  } catch (const std::exception&) {  // then the connection ends with the socket
  }
  c.socket.reset();
  c.is_reading = false;
  c.received.clear();
}

std::optional<std::string> WebSocket::receive(nanoseconds patience) {
  Connection& c = *connection_;
  if (!c.socket) c.fail("the connection is not open");
  // Not `reading.is_over()`: a message may have arrived while another was sent.
  if (!std::exchange(c.is_reading, true)) c.socket->async_read(c.received, c.reading.end());
  if (!c.reading.wait(patience)) return std::nullopt;
  c.is_reading = false;
  if (c.reading.error()) c.fail_connection(c.reading.error());
  std::string message = beast::buffers_to_string(c.received.data());
  c.received.clear();
  return message;
}

void WebSocket::send(const std::string& message) {
  Connection& c = *connection_;
  if (!c.socket) c.fail("the connection is not open");
  c.socket->async_write(asio_net::buffer(message), c.other.end());
  if (!c.other.wait(kForSending)) {
    beast::get_lowest_layer(*c.socket).close();  // before the message is gone
    c.context.restart();
    c.context.run();
    c.fail("the service takes no messages");
  }
  if (c.other.error()) c.fail_connection(c.other.error());
}

std::optional<std::string> WebSocket::get(const ServiceAddress& address, const std::string& target) {
  Connection c(address);
  beast::tcp_stream stream(c.context);
  http::response<http::string_body> answer;
  try {
    c.connect(stream);
    http::request<http::empty_body> request(http::verb::get, target, 11);
    request.set(http::field::host, address.text());
    const auto until = std::chrono::steady_clock::now() + kForHandshake;
    http::async_write(stream, request, c.other.end());
    if (c.other.wait(kForSending) && !c.other.error()) {
      http::async_read(stream, c.received, answer, c.other.end());
      c.other.wait(until - std::chrono::steady_clock::now());
    }
  } catch (const WireError&) {
    return std::nullopt;
  }
  const bool is_whole = c.other.is_over() && !c.other.error() && answer.result() == http::status::ok;
  stream.close();
  c.context.restart();
  c.context.run();
  if (!is_whole) return std::nullopt;
  return answer.body();
}

}  // namespace glissade::bridges
