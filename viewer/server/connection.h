#pragma once

/// One connection of a browser: answers its requests, or hands it over as a page that looks on.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>

namespace glissade::viewer {

/// What a server says to a GET.
struct Content {
  boost::beast::http::status status = boost::beast::http::status::ok;
  std::string_view type;  ///< as in the header Content-Type
  std::shared_ptr<const std::string> text;
};

/// A sentence for people.
Content plain(boost::beast::http::status status, std::string_view text);

/// Gets what a GET asks for, without its query.
using Answer = std::function<Content(std::string_view target)>;

using HttpRequest = boost::beast::http::request<boost::beast::http::empty_body>;

/// All calls in the thread of the stream's io_context; `answer` must outlive the connection.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  /// Gets the stream after a request for the WebSocket `/live`. Empty: the server has none.
  using Upgrade = std::function<void(boost::beast::tcp_stream&&, const HttpRequest&)>;

  Connection(boost::beast::tcp_stream&& stream, const Answer& answer, Upgrade upgrade);

  void start() { read(); }
  /// Whether it waits for a request, the first one or another.
  bool is_idle() const noexcept { return is_idle_; }
  void close() { stream_.close(); }

 private:
  void read();
  void answer();
  void send(const Content& content);

  boost::beast::tcp_stream stream_;
  const Answer& answer_;
  Upgrade upgrade_;
  bool is_idle_ = true;
  boost::beast::flat_buffer buffer_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> parser_;
};

/// Whether a request with this Host, and this Origin if it has one, is one of a page of ours: a page of another site
/// that resolves its name to this machine has another Host.
bool is_own_request(std::string_view host, std::string_view origin);

}  // namespace glissade::viewer
