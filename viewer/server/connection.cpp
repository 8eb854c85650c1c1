#include "server/connection.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

#include <boost/beast/websocket.hpp>

namespace glissade::viewer {

namespace beast = boost::beast;
namespace http = boost::beast::http;

namespace {

constexpr std::chrono::seconds kPatienceForRequest{5};
constexpr std::chrono::seconds kPatienceForReader{60};  // of an answer, which may be a large model
constexpr std::size_t kLongestHeader = 16'384;

/// The page is one file and talks to its own server only: `host` is its name with the port. Pages of this machine, such
/// as notebooks, may frame it.
std::string policy_for(std::string_view host) {
  return "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; "
         "connect-src 'self' ws://" +
         std::string(host) +
         " blob: data:; frame-ancestors http://localhost:* http://127.0.0.1:*; base-uri 'none'; form-action 'none'";
}

std::string_view view_of(beast::string_view text) {
  return {text.data(), text.size()};
}

}  // namespace

Content plain(http::status status, std::string_view text) {
  return {status, "text/plain", std::make_shared<const std::string>(text)};
}

bool is_own_request(std::string_view host, std::string_view origin) {
  constexpr std::string_view kScheme = "http://";
  if (!origin.empty() && (!origin.starts_with(kScheme) || origin.substr(kScheme.size()) != host)) return false;
  const std::size_t colon = host.find(':');
  const std::string_view name = host.substr(0, colon);
  const std::string_view port = colon == std::string_view::npos ? "" : host.substr(colon + 1);
  const bool is_number = std::all_of(port.begin(), port.end(), [](char c) { return c >= '0' && c <= '9'; });
  return is_number && (name == "127.0.0.1" || name == "localhost");
}

Connection::Connection(beast::tcp_stream&& stream, const Answer& answer, Upgrade upgrade)
    : stream_(std::move(stream)), answer_(answer), upgrade_(std::move(upgrade)) {}

void Connection::read() {
  parser_.emplace();
  parser_->header_limit(kLongestHeader);
  stream_.expires_after(kPatienceForRequest);
  is_idle_ = true;
  http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
    self->is_idle_ = false;
    if (!error) return self->answer();
    const beast::error_code end = http::error::end_of_stream;
    if (error == end || error.category() != end.category()) return;  // nobody waits for an answer
    self->send(plain(http::status::bad_request, "only GET without a body is known\n"));
  });
}

void Connection::answer() {
  const HttpRequest& request = parser_->get();
  const std::string_view whole_target = view_of(request.target());
  const std::string_view target = whole_target.substr(0, whole_target.find('?'));
  if (!is_own_request(view_of(request[http::field::host]), view_of(request[http::field::origin])))
    return send(plain(http::status::forbidden, "only pages of this machine are served\n"));
  if (upgrade_ && target == "/live" && beast::websocket::is_upgrade(request))
    return upgrade_(std::move(stream_), request);
  if (request.method() != http::verb::get) return send(plain(http::status::method_not_allowed, "only GET is known\n"));
  send(answer_(target));
}

void Connection::send(const Content& content) {
  using Response = http::response<http::span_body<const char>>;
  const auto response = std::make_shared<Response>(content.status, parser_->get().version());
  const auto put = [&](http::field field, std::string_view value) {
    response->set(field, beast::string_view(value.data(), value.size()));
  };
  put(http::field::content_type, content.type);
  put(http::field::cache_control, "no-store");
  const std::string_view host = view_of(parser_->get()[http::field::host]);
  if (is_own_request(host, "")) response->set("Content-Security-Policy", policy_for(host));
  response->set("Referrer-Policy", "no-referrer");
  response->set("X-Content-Type-Options", "nosniff");
  // After anything but a GET, what follows in the stream is unclear.
  response->keep_alive(parser_->get().keep_alive() && parser_->get().method() == http::verb::get &&
                       content.status != http::status::bad_request);
  response->body() = beast::span<const char>(content.text->data(), content.text->size());
  response->prepare_payload();
  stream_.expires_after(kPatienceForReader);
  http::async_write(stream_, *response,
                    [self = shared_from_this(), response, owner = content.text](beast::error_code error, std::size_t) {
                      if (error || !response->keep_alive()) return;
                      self->read();
                    });
}

}  // namespace glissade::viewer
