#pragma once

/// Serves pages to browsers on this machine.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace glissade::viewer {

struct ServedFile {
  std::string_view type;  ///< as in the header Content-Type
  std::string text;
};

/// Answers only requests that address this machine as 127.0.0.1 or localhost, in one thread, one after the other.
class PageServer {
 public:
  /// Gets the path that a browser asks for, such as "/". No value: there is no such file. An exception becomes an
  /// answer with its sentence.
  using Find = std::function<std::optional<ServedFile>(std::string_view path)>;

  /// Opens `port` of 127.0.0.1, or any free port if `port` is 0. Throws std::invalid_argument, naming the port, if it
  /// cannot be opened.
  PageServer(std::uint16_t port, Find find);
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;
  /// Ends all connections, after the answer that is being made.
  ~PageServer();

  std::string url() const;

 private:
  class Service;
  std::unique_ptr<Service> service_;
};

}  // namespace glissade::viewer
