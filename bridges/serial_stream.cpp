#include <array>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/serial_port.hpp>
#include <boost/asio/write.hpp>
#include <linux/serial.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <glissade/bridges/serial_ports.h>
#include <glissade/bridges/serial_stream.h>
#include <glissade/bridges/wire.h>

#include "stream/baud_rate.h"
#include "stream/time_limit.h"

namespace glissade::bridges {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

constexpr std::chrono::milliseconds kLookUpPatience{800};
constexpr std::chrono::milliseconds kConnectPatience{800};
constexpr std::chrono::milliseconds kWritePatience{100};

struct TcpAddress {
  std::string host;
  std::string port;
};

std::optional<TcpAddress> tcp_address(std::string_view port, unsigned short default_tcp_port) {
  constexpr std::string_view kPrefix = "tcp:";
  if (!port.starts_with(kPrefix)) return std::nullopt;
  const std::string_view address = port.substr(kPrefix.size());
  const std::size_t colon = address.rfind(':');
  if (colon == std::string_view::npos && default_tcp_port > 0)
    return TcpAddress{std::string(address), std::to_string(default_tcp_port)};
  if (colon == std::string_view::npos)
    throw std::invalid_argument("port '" + std::string(port) +
                                "': the number of the TCP port is missing: tcp:HOST:PORT");
  const std::string_view number = address.substr(colon + 1);
  unsigned value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc{} || end != number.data() + number.size() || value < 1 || value > 65535) {
    throw std::invalid_argument("port '" + std::string(port) + "': '" + std::string(number) +
                                "' is not the number of a TCP port, from 1 to 65535");
  }
  return TcpAddress{std::string(address.substr(0, colon)), std::string(number)};
}

/// Another program may lock the port, or, if it does not run as root, have it for itself.
void take_for_this_program(int descriptor, const std::string& port) {
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw WireError(port_trouble(port, std::errc::device_or_resource_busy));
  ioctl(descriptor, TIOCEXCL);
}

/// A board that restarts when a program closes its port would move its servos.
void keep_board_running(int descriptor) {
  termios settings{};
  if (tcgetattr(descriptor, &settings) != 0) return;
  settings.c_cflag &= ~static_cast<tcflag_t>(HUPCL);
  tcsetattr(descriptor, TCSANOW, &settings);
}

/// A USB adapter may collect bytes for 16 ms. The driver need not know this wish.
void ask_for_short_latency(int descriptor) {
  serial_struct settings{};
  if (ioctl(descriptor, TIOCGSERIAL, &settings) != 0) return;
  settings.flags |= ASYNC_LOW_LATENCY;
  ioctl(descriptor, TIOCSSERIAL, &settings);
}

/// The addresses of a host, or why there are none.
struct Found {
  std::vector<tcp::endpoint> endpoints;
  error_code error;
};

Found look_up(const TcpAddress& address) {
  asio::io_context context;
  Found found;
  for (const auto& entry : tcp::resolver(context).resolve(address.host, address.port, found.error))
    found.endpoints.push_back(entry.endpoint());
  return found;
}

}  // namespace

struct SerialStream::Connection {
  std::string port;
  unsigned baud_rate;
  std::optional<TcpAddress> address;
  asio::io_context context{1};
  std::variant<std::monostate, asio::serial_port, tcp::socket> handle;

  /// Calls `use` with the handle that is open.
  template <typename Use>
  void with_handle(const Use& use) {
    if (auto* serial = std::get_if<asio::serial_port>(&handle)) return use(*serial);
    if (auto* socket = std::get_if<tcp::socket>(&handle)) return use(*socket);
    throw WireError(port + ": the port is not open");
  }

  /// Lets the operation that was begun run, for at most `patience`, and ends it.
  template <typename Handle>
  void wait(Handle& used, std::chrono::nanoseconds patience) {
    context.restart();
    context.poll();  // also without patience, takes what has arrived
    if (!context.stopped()) context.run_for(patience);
    if (context.stopped()) return;
    error_code ignored;
    used.cancel(ignored);
    context.restart();
    context.run();
  }

  [[noreturn]] void fail(const error_code& error) {
    const bool is_gone = error == asio::error::eof || error.value() == EIO || error.value() == ENXIO;
    throw WireError(
        port + ": the connection is lost: " + (is_gone ? "the device was unplugged or switched off" : error.message()));
  }

  void open_serial();
  void open_tcp();
};

void SerialStream::Connection::open_serial() {
  asio::serial_port serial(context);
  error_code error;
  serial.open(port, error);
  if (error) throw WireError(port_trouble(port, static_cast<std::errc>(error.value())));
  take_for_this_program(serial.native_handle(), port);
  using asio::serial_port_base;
  const auto set = [&](const auto& option) {
    if (!error) serial.set_option(option, error);
  };
  set(serial_port_base::character_size(8));
  set(serial_port_base::parity(serial_port_base::parity::none));
  set(serial_port_base::stop_bits(serial_port_base::stop_bits::one));
  set(serial_port_base::flow_control(serial_port_base::flow_control::none));
  if (error) throw WireError(port + ": the port refuses its settings: " + error.message());
  keep_board_running(serial.native_handle());
  ask_for_short_latency(serial.native_handle());
  if (!set_baud_rate(serial.native_handle(), baud_rate))
    throw WireError(port + ": the port refuses " + std::to_string(baud_rate) + " baud; its adapter may be too slow");
  tcflush(serial.native_handle(), TCIFLUSH);
  handle.emplace<asio::serial_port>(std::move(serial));
}

void SerialStream::Connection::open_tcp() {
  tcp::socket socket(context);
  const std::optional<Found> found = within(kLookUpPatience, [address = *address] { return look_up(address); });
  if (!found) throw WireError(port + ": no answer to the question where the machine '" + address->host + "' is");
  if (found->error) throw WireError(port + ": there is no machine '" + address->host + "': " + found->error.message());
  error_code error = asio::error::would_block;
  asio::async_connect(socket, found->endpoints,
                      [&error](const error_code& outcome, const tcp::endpoint&) { error = outcome; });
  wait(socket, kConnectPatience);
  if (error == asio::error::connection_refused)
    throw WireError(port + ": nothing listens there; is the device on, and is this its port?");
  if (error)
    throw WireError(port +
                    ": no connection: " + (error == asio::error::operation_aborted ? "no answer" : error.message()));
  socket.set_option(tcp::no_delay(true), error);
  handle.emplace<tcp::socket>(std::move(socket));
}

SerialStream::SerialStream(std::string port, unsigned baud_rate, unsigned short default_tcp_port)
    : connection_(std::make_unique<Connection>()) {
  connection_->address = tcp_address(port, default_tcp_port);
  connection_->port = std::move(port);
  connection_->baud_rate = baud_rate;
}

SerialStream::~SerialStream() = default;

std::string SerialStream::name() const {
  return connection_->port;
}

void SerialStream::open() {
  close();
  connection_->address ? connection_->open_tcp() : connection_->open_serial();
}

void SerialStream::close() noexcept {
  // A second process may still have the port for a moment.
  const int port = descriptor();
  if (port >= 0 && !connection_->address) {
    flock(port, LOCK_UN);
    ioctl(port, TIOCNXCL);
  }
  connection_->handle.emplace<std::monostate>();
}

bool SerialStream::is_open() const noexcept {
  return !std::holds_alternative<std::monostate>(connection_->handle);
}

std::string SerialStream::read(std::chrono::nanoseconds patience) {
  std::array<char, 4096> bytes;
  std::size_t count = 0;
  error_code error;
  connection_->with_handle([&](auto& handle) {
    handle.async_read_some(asio::buffer(bytes), [&](const error_code& outcome, std::size_t size) {
      error = outcome;
      count = size;
    });
    connection_->wait(handle, patience);
  });
  if (error && error != asio::error::operation_aborted) connection_->fail(error);
  return {bytes.data(), count};
}

void SerialStream::write(std::string_view bytes) {
  error_code error;
  connection_->with_handle([&](auto& handle) {
    asio::async_write(handle, asio::buffer(bytes.data(), bytes.size()),
                      [&](const error_code& outcome, std::size_t) { error = outcome; });
    connection_->wait(handle, kWritePatience);
  });
  if (error == asio::error::operation_aborted) {
    tcflush(descriptor(), TCOFLUSH);  // so that the next bytes have room
    throw WireError(connection_->port + ": the device does not take what is sent");
  }
  if (error) connection_->fail(error);
}

int SerialStream::descriptor() const noexcept {
  if (auto* serial = std::get_if<asio::serial_port>(&connection_->handle)) return serial->native_handle();
  if (auto* socket = std::get_if<tcp::socket>(&connection_->handle)) return socket->native_handle();
  return -1;
}

}  // namespace glissade::bridges
