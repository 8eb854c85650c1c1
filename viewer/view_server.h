#pragma once

/// Shows a scene in browsers on this machine: a page over HTTP, and the motion over WebSocket, on one port.

#include <cstdint>
#include <memory>
#include <string>

#include <glissade/devices/haptic_state.h>
#include <glissade/viewer/view_scene.h>

namespace glissade::viewer {

/// Serves at most 60 frames a second to each page, the next one only after the page has shown the last: a slow page
/// misses frames, which it is told, and delays nobody. Answers only requests to this machine by its own name, so that
/// no page of another site can look on. Its threads never run in the real-time class.
class ViewServer {
 public:
  /// On this port of 127.0.0.1; 0: any that is free. Makes the first model; the whole one is made meanwhile, and pages
  /// load it when it is there. Throws std::invalid_argument, naming the port, when it cannot be opened.
  explicit ViewServer(ViewScene scene, std::uint16_t port = 0);
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;
  /// Ends all connections. Pages are told that this is no failure, which takes at most 0.3 s.
  ~ViewServer();

  std::uint16_t port() const noexcept;
  std::string url() const;

  /// Whether any page has looked on so far. Any thread.
  bool has_had_client() const noexcept;

  /// Takes the state of a tick. When the server lags behind by 1024 states, it misses the state. Wait-free,
  /// no allocation; one thread.
  void push(const devices::HapticState& state) noexcept;

 private:
  class Service;
  std::unique_ptr<Service> service_;
};

}  // namespace glissade::viewer
