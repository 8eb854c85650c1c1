#pragma once

/// A connection of a program to the emulated service.

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include <boost/asio/ip/tcp.hpp>

namespace glissade::bridges {

/// What the service says in a connection, and how.
struct SessionAnswers {
  std::function<std::string()> inventory;                 ///< the first message
  std::function<std::string(const std::string&)> answer;  ///< to a message
  std::function<void()> end;                              ///< the connection is over
  std::string version;                                    ///< for an HTTP GET of /version
  std::chrono::nanoseconds delay{0};                      ///< before each answer
};

class EmulatedSession : public std::enable_shared_from_this<EmulatedSession> {
 public:
  virtual ~EmulatedSession() = default;
  /// Ends the connection without a word.
  virtual void cut() = 0;
};

/// Serves this connection, in the thread that runs its context.
std::shared_ptr<EmulatedSession> serve(boost::asio::ip::tcp::socket socket, SessionAnswers answers);

}  // namespace glissade::bridges
