#pragma once

/// Shows a scene in browsers on this machine. One port serves the page over HTTP and the motion over WebSocket.

#include <cstdint>
#include <memory>
#include <string>

#include <glissade/devices/haptic_state.h>
#include <glissade/viewer/view_scene.h>

namespace glissade::viewer {

/// Sends at most 60 frames a second to each page, and each frame only after the page has shown the last one. So a slow
/// page misses frames and delays no other page. Each frame tells the page how many frames it has missed. The server
/// answers only requests that address this machine by its own name, so pages of other sites cannot read the scene. The
/// threads of the server never run in the real-time class.
class ViewServer {
 public:
  /// Opens `port` of 127.0.0.1; 0 opens any free port. Makes the first model. A thread makes the whole model, and pages
  /// load the whole model once it is complete. Throws std::invalid_argument, naming the port, if the port cannot be
  /// opened.
  explicit ViewServer(ViewScene scene, std::uint16_t port = 0);
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;
  /// Tells all pages that the end is no failure, which takes at most 0.3 s. Then ends all connections.
  ~ViewServer();

  std::uint16_t port() const noexcept;
  std::string url() const;

  /// Whether any page has connected so far. Any thread may call this.
  bool has_had_client() const noexcept;

  /// Takes the state of a tick. If the server lags behind by 1024 states, the state is dropped. Wait-free, no
  /// allocation. Only one thread may call this.
  void push(const devices::HapticState& state) noexcept;

 private:
  class Service;
  std::unique_ptr<Service> service_;
};

}  // namespace glissade::viewer
