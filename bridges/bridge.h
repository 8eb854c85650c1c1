#pragma once

/// Connects a wire (`wire.h`) to the link of gloves. States go to the server, and safe commands go to the device.

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <Eigen/Geometry>

#include <glissade/bridges/wire.h>
#include <glissade/devices/lcm_bus.h>
#include <glissade/devices/lcm_glove.h>

namespace glissade::bridges {

struct BridgeOptions {
  devices::LcmGloveHostOptions link;
  /// The pose of the hand, if the device does not measure it.
  Eigen::Isometry3d X_WH = Eigen::Isometry3d::Identity();
  std::chrono::nanoseconds reopen_after{std::chrono::milliseconds(500)};  ///< pause after an error of the wire
};

/// What a bridge has done so far.
struct BridgeStatistics {
  std::uint64_t states = 0;  ///< measurements sent to the server
  std::uint64_t errors = 0;  ///< errors of the wire; after each error, the wire was opened anew
};

/// Runs until `goes_on`, which is called once a period, returns false. A wire that fails is released, and opened anew
/// after a pause, as often as needed. `say` receives a sentence at the first state, at a failure, at every twentieth
/// failure in a row, and at the first state after a failure. At the end, the wire is released. Throws what
/// `LcmGloveHost` throws.
BridgeStatistics run_bridge(Wire& wire, const std::shared_ptr<devices::LcmBus>& bus, const BridgeOptions& options,
                            const std::function<bool()>& goes_on, const std::function<void(const std::string&)>& say);

}  // namespace glissade::bridges
