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
/// answers only requests that address this machine as 127.0.0.1 or localhost, so pages of other sites cannot read the
/// scene. The threads of the server never run in the real-time class.
class ViewServer {
 public:
  /// Opens `port` of 127.0.0.1, or any free port if `port` is 0. Makes the first model. A thread makes the model of all
  /// triangles. Pages load this model once it is complete. Throws std::invalid_argument, naming the port, if the port
  /// cannot be opened.
  explicit ViewServer(ViewScene scene, std::uint16_t port = 0);
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;
  /// Tells all pages that the server ends without a failure. Then ends all connections. Takes at most 0.3 s.
  ~ViewServer();

  std::uint16_t port() const noexcept;
  std::string url() const;

  /// Whether any page has connected so far. Any thread may call this function.
  bool has_had_client() const noexcept;

  /// Takes the state of a tick. If 1024 states are waiting, the state is dropped. Wait-free, no allocation. Only one
  /// thread may call this function.
  void push(const devices::HapticState& state) noexcept;

 private:
  class Service;
  std::unique_ptr<Service> service_;
};

}  // namespace glissade::viewer
