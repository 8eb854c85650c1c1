// Text of a WebSocket at the decoder of Haply's service. Whatever arrives, it is refused with the name of a key, or its
// numbers are finite and its rotations are rotations, and it reads the same after it was written.

#include <cmath>
#include <stdexcept>
#include <string>

#include "fuzz_target.h"
#include "haply/arm_choice.h"
#include "haply/client_message.h"
#include "haply/service_message.h"

namespace glissade::fuzz {
namespace {

using namespace bridges;

void require_that(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

void check(const ServiceMessage& message) {
  for (const HaplyArm& arm : message.arms) {
    require_that(arm.p_DC.allFinite() && arm.v_DC.allFinite(), "a number that is not finite");
    require_that(!arm.f_C_D || arm.f_C_D->allFinite(), "a force that is not finite");
    trouble_of(arm);
  }
  for (const HaplyHandle& handle : message.handles)
    require_that(!handle.R_DG || std::abs(handle.R_DG->norm() - 1.0) < 1e-9, "a rotation that is none");
  const ServiceMessage again = decode_service_message(encode_service_message(message));
  require_that(again.arms.size() == message.arms.size() && again.handles.size() == message.handles.size(),
               "devices are lost");
  for (std::size_t i = 0; i < message.arms.size(); ++i) {
    require_that(again.arms[i].id == message.arms[i].id, "an id reads otherwise");
    require_that(again.arms[i].p_DC == message.arms[i].p_DC, "a position reads otherwise");
  }
}

void check(const ClientMessage& message) {
  require_that(message.f_C_D.allFinite(), "a force that is not finite");
  require_that(decode_client_message(encode_client_message(message)).f_C_D == message.f_C_D, "a force reads otherwise");
}

/// Whether the decoder takes the text.
template <typename Decode>
bool takes(const Decode& decode, std::string_view bytes) {
  decltype(decode(bytes)) message;
  try {
    message = decode(bytes);
  } catch (const std::invalid_argument&) {
    return false;
  }
  check(message);
  return true;
}

}  // namespace

bool try_input(std::string_view bytes) {
  const bool is_of_service = takes(decode_service_message, bytes);
  const bool is_of_client = takes(decode_client_message, bytes);
  return is_of_service || is_of_client;
}

std::vector<Seed> seeds() {
  ServiceMessage message{.force_key = ForceKey::kVector};
  message.arms.push_back({.id = "049D", .config = ArmConfig{.type = "inverse3", .force_gate = 0.3}});
  message.arms[0].p_DC = {0.01, -0.12, 0.15};
  message.arms[0].f_C_D = Eigen::Vector3d(0.5, 0.0, -1.0);
  message.handles.push_back({.id = "1", .R_DG = Eigen::Quaterniond::Identity()});
  message.handles.push_back({.id = "2", .is_wireless = true, .is_pressed = true});
  return {{"inventory", encode_service_message(message)},
          {"nothing", "{}"},
          {"force", encode_client_message({.arm = "049D", .f_C_D = {1, 2, 3}, .damping_N_s_per_m = 0.0})}};
}

std::vector<std::string> dictionary() {
  return {"\"inverse3\":[",
          "\"wireless_verse_grip\":[",
          "\"device_id\":\"",
          "\"state\":{",
          "\"orientation\":{",
          "\"cursor_position\":{",
          "\"x\":",
          "\"buttons\":{",
          "1e308",
          "null",
          "true",
          "[[[[[[[[",
          "\\u0000",
          "}",
          "]"};
}

/// Nothing can be put right.
void repair(std::string& /*bytes*/) {}

}  // namespace glissade::fuzz
