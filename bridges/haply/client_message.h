#pragma once

/// What a program says to Haply's Inverse Service. The service answers each message with one state.

#include <optional>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include "haply/service_message.h"

namespace glissade::bridges {

/// A force for one arm, which the service exerts until it has heard nothing for a while.
struct ClientMessage {
  ForceKey force_key = ForceKey::kVector;
  std::string arm;                                  ///< its id
  Eigen::Vector3d f_C_D = Eigen::Vector3d::Zero();  ///< on the hand, in the axes of the device, N
  /// The first message of a session, for a service from version 3.5 on: names the program, sets the device's own frame,
  /// and the damping that the service adds to the force.
  std::optional<double> damping_N_s_per_m;
};

std::string encode_client_message(const ClientMessage& message);

/// The other end, for the emulator. Throws std::invalid_argument, naming the key, for what is no such message.
ClientMessage decode_client_message(std::string_view text);

}  // namespace glissade::bridges
