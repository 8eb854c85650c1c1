#include "server/live_client.h"

#include <utility>

#include <boost/asio/buffer.hpp>

#include <glissade/viewer/view_frame.h>

namespace glissade::viewer {

namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;

LiveClient::LiveClient(beast::tcp_stream&& stream, std::function<void()> on_open)
    : socket_(std::move(stream)), on_open_(std::move(on_open)) {
  constexpr std::size_t kLongestMessage = 64;
  beast::get_lowest_layer(socket_).expires_never();  // the WebSocket has its own time limits
  socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
  socket_.read_message_max(kLongestMessage);
  socket_.binary(true);
}

void LiveClient::start(const beast::http::request<beast::http::empty_body>& request, std::string first_frame) {
  first_frame_ = std::move(first_frame);
  socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
    if (error) {
      self->has_ended_ = true;
      return;
    }
    self->is_open_ = true;
    self->on_open_();
    self->wait_for_message();
    if (!self->first_frame_.empty()) self->offer(std::exchange(self->first_frame_, {}));
  });
}

void LiveClient::offer(const std::string& frame) {
  if (has_ended_) return;
  if (!is_open_) {
    first_frame_ = frame;
    return;
  }
  if (is_busy_ || is_writing_) {
    ++missed_;
    return;
  }
  is_busy_ = is_writing_ = true;
  frame_ = frame;
  set_missed(frame_, missed_);
  socket_.async_write(boost::asio::buffer(frame_), [self = shared_from_this()](beast::error_code error, std::size_t) {
    self->is_writing_ = false;
    if (error) self->has_ended_ = true;
  });
}

void LiveClient::end(std::function<void()> on_end) {
  if (!is_open_ || has_ended_) {
    on_end();
    return;
  }
  is_open_ = false;
  socket_.async_close(websocket::close_code::normal,
                      [self = shared_from_this(), on_end = std::move(on_end)](beast::error_code) {
                        self->has_ended_ = true;
                        on_end();
                      });
}

void LiveClient::wait_for_message() {
  socket_.async_read(received_, [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (error) {
      self->has_ended_ = true;
      return;
    }
    self->received_.clear();
    self->is_busy_ = false;
    self->wait_for_message();
  });
}

}  // namespace glissade::viewer
