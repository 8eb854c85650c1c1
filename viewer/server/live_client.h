#pragma once

/// One page that looks on.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

namespace glissade::viewer {

/// A WebSocket on which frames go out and each is acknowledged by a message, whatever its content. All calls in the
/// thread of the stream's io_context.
class LiveClient : public std::enable_shared_from_this<LiveClient> {
 public:
  /// `on_open` is called when the page listens.
  LiveClient(boost::beast::tcp_stream&& stream, std::function<void()> on_open);

  /// Answers the request for the WebSocket; then sends `first_frame` unless it is empty.
  void start(const boost::beast::http::request<boost::beast::http::empty_body>& request, std::string first_frame);

  /// Sends the frame, or counts it as missed if the last one has not been acknowledged. Until the connection is open,
  /// the newest frame waits.
  void offer(const std::string& frame);

  /// Tells the page that the run has ended, and sends nothing more. `on_end` is called when the page has answered, or
  /// at once if it does not listen.
  void end(std::function<void()> on_end);

  bool has_ended() const noexcept { return has_ended_; }

 private:
  /// Frames are small and stay on this machine; without its code the file compiles in less time.
  static constexpr bool kCompresses = false;

  void wait_for_message();

  boost::beast::websocket::stream<boost::beast::tcp_stream, kCompresses> socket_;
  std::function<void()> on_open_;
  boost::beast::flat_buffer received_;
  std::string first_frame_;  // the newest frame until the connection is open
  std::string frame_;        // in flight
  bool is_open_ = false;
  bool is_busy_ = false;     // a frame is not acknowledged yet
  bool is_writing_ = false;  // nor even sent
  bool has_ended_ = false;
  std::uint64_t missed_ = 0;
};

}  // namespace glissade::viewer
