#pragma once

/// What the handles of the C interface stand for.

#include <atomic>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <glissade/devices/glove_device.h>
#include <glissade/devices/haptic_state.h>
#include <glissade/devices/lcm_bus.h>
#include <glissade/devices/lcm_glove.h>
#include <glissade/devices/relay_glove.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/devices/simulated_glove_service.h>
#include <glissade/haptics/haptic_server.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/triple_buffer.h>
#include <glissade/simulation/scene.h>
#include <glissade/simulation/simulation.h>

#include "call.h"
#include "handles.h"

namespace glissade::c {

/// In each object, `mutex` makes calls wait for each other.
struct SceneObject {
  std::mutex mutex;
  simulation::Scene scene;
};

/// Something that one server at a time may use. Thread-safe: the flag is atomic.
class Claim {
 public:
  /// Throws std::invalid_argument if it is in use. `noun` is for the message.
  Claim(std::atomic<bool>& in_use, const std::string& noun) : in_use_(&in_use) {
    if (in_use.exchange(true)) throw std::invalid_argument(noun + " is in use by a server");
  }
  Claim(Claim&& other) noexcept : in_use_(std::exchange(other.in_use_, nullptr)) {}
  Claim& operator=(Claim&&) = delete;
  ~Claim() {
    if (in_use_ != nullptr) in_use_->store(false);
  }

 private:
  std::atomic<bool>* in_use_;
};

struct SimulationObject {
  explicit SimulationObject(const simulation::Scene& scene) : simulation(scene) {}

  std::mutex mutex;
  std::atomic<bool> in_use{false};
  simulation::Simulation simulation;
};

/// A simulated glove with its link. Members are destroyed from the last to the first.
struct SimulatedGloveObject {
  explicit SimulatedGloveObject(const geometry::PoseTrajectory& script)
      : service(bus, devices::SimulatedGlove(script), clock, {},
                [this](const devices::GloveState&, const devices::SafeCommand& command) {
                  exerted.publish(command);
                  return true;
                }),
        glove(bus, devices::simulated_glove_descriptor()) {}

  std::shared_ptr<devices::LcmBus> bus = std::make_shared<devices::LcmBus>("memq://");
  realtime::SteadyClock clock;
  realtime::TripleBuffer<devices::SafeCommand> exerted;
  devices::SimulatedGloveService service;
  devices::LcmGlove glove;
};

struct GloveObject {
  std::mutex mutex;
  std::atomic<bool> in_use{false};
  std::unique_ptr<devices::RelayGlove> relay;       ///< null for a simulated glove
  std::unique_ptr<SimulatedGloveObject> simulated;  ///< null for a glove that the caller drives

  devices::GloveDevice& device() noexcept {
    return relay ? static_cast<devices::GloveDevice&>(*relay) : simulated->glove;
  }
};

struct ServerObject {
  std::mutex mutex;
  // A server keeps its simulation and its gloves, even if their handles are freed.
  std::shared_ptr<SimulationObject> simulation;
  std::vector<std::shared_ptr<GloveObject>> gloves;
  std::vector<Claim> claims;  ///< until the server stops
  std::mutex frame_mutex;     ///< of renderers among each other
  realtime::TripleBuffer<devices::HapticState> frames;
  std::unique_ptr<haptics::HapticServer> server;
};

// All objects. They are never destroyed: at the end of the program, threads may still use them.
Handles<SceneObject>& scenes();
Handles<SimulationObject>& simulations();
Handles<GloveObject>& gloves();
Handles<ServerObject>& servers();

/// Runs work(object) while no other call uses the object of this handle.
template <typename Object, typename Work>
GlissadeStatus call_with(Handles<Object>& all, std::uint64_t id, const Work& work) noexcept {
  return call([&] {
    const std::shared_ptr<Object> object = all.find(id);
    const std::lock_guard lock(object->mutex);
    work(*object);
  });
}

}  // namespace glissade::c
