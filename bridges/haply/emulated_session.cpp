#include "haply/emulated_session.h"

#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

namespace glissade::bridges {
namespace {

namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using SessionError = boost::system::error_code;

class WebSocketSession final : public EmulatedSession {
 public:
  WebSocketSession(boost::asio::ip::tcp::socket socket, SessionAnswers answers)
      : socket_(std::move(socket)), timer_(socket_.get_executor()), answers_(std::move(answers)) {}

  void begin() {
    http::async_read(socket_.next_layer(), buffer_, request_, [self = self()](const SessionError& error, std::size_t) {
      if (error) return self->answers_.end();
      websocket::is_upgrade(self->request_) ? self->accept() : self->say_version();
    });
  }

  void cut() override {
    timer_.cancel();
    beast::get_lowest_layer(socket_).close();
  }

 private:
  std::shared_ptr<WebSocketSession> self() { return std::static_pointer_cast<WebSocketSession>(shared_from_this()); }

  void accept() {
    socket_.async_accept(request_, [self = self()](const SessionError& error) {
      if (error) return self->answers_.end();
      self->say(self->answers_.inventory());
    });
  }

  void say_version() {
    const bool is_known = request_.target() == "/version";
    page_.result(is_known ? http::status::ok : http::status::not_found);
    page_.body() = answers_.version;
    page_.prepare_payload();
    http::async_write(socket_.next_layer(), page_, [self = self()](const SessionError&, std::size_t) {
      self->answers_.end();
      self->cut();
    });
  }

  void say(std::string message) {
    message_ = std::move(message);
    socket_.async_write(boost::asio::buffer(message_), [self = self()](const SessionError& error, std::size_t) {
      error ? self->answers_.end() : self->hear();
    });
  }

  void hear() {
    buffer_.clear();
    socket_.async_read(buffer_, [self = self()](const SessionError& error, std::size_t) {
      if (error) return self->answers_.end();
      self->answer(self->answers_.answer(beast::buffers_to_string(self->buffer_.data())));
    });
  }

  void answer(std::string message) {
    if (answers_.delay.count() == 0) return say(std::move(message));
    timer_.expires_after(answers_.delay);
    timer_.async_wait([self = self(), text = std::move(message)](const SessionError& error) {
      error ? self->answers_.end() : self->say(text);
    });
  }

  websocket::stream<beast::tcp_stream> socket_;
  boost::asio::steady_timer timer_;
  SessionAnswers answers_;
  beast::flat_buffer buffer_;
  http::request<http::empty_body> request_;
  http::response<http::string_body> page_;
  std::string message_;
};

}  // namespace

std::shared_ptr<EmulatedSession> serve(boost::asio::ip::tcp::socket socket, SessionAnswers answers) {
  const auto session = std::make_shared<WebSocketSession>(std::move(socket), std::move(answers));
  session->begin();
  return session;
}

}  // namespace glissade::bridges
