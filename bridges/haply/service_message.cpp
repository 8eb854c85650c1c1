#include "haply/service_message.h"

#include <cmath>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "haply/json_field.h"
#include "haply/json_vector.h"

namespace glissade::bridges {
namespace {

using nlohmann::json;

constexpr const char* kArms = "inverse3";
constexpr const char* kHandles = "verse_grip";
constexpr const char* kWirelessHandles = "wireless_verse_grip";

/// Single precision, and a slow sensor, leave this much.
constexpr double kNormTolerance = 0.02;

/// None for four zeros, which stand for no measurement.
std::optional<Eigen::Quaterniond> rotation_of(const JsonField& field) {
  const Eigen::Quaterniond q(field.at("w").number(), field.at("x").number(), field.at("y").number(),
                             field.at("z").number());
  const double norm = q.norm();
  if (norm == 0.0) return std::nullopt;
  if (!(std::abs(norm - 1.0) < kNormTolerance)) field.refuse("is no unit quaternion");
  return q.normalized();
}

int version_of(const JsonField& field) {
  constexpr double kMost = 1e6;
  const double number = field.number();
  if (!(number >= 0.0 && number <= kMost && number == std::floor(number))) field.refuse("is no number of a version");
  return static_cast<int>(number);
}

ArmConfig config_of(const JsonField& field) {
  ArmConfig config;
  config.type = field.at("type").text();
  if (const auto port = field.find("port")) config.port = port->text();
  if (const auto side = field.find("handedness")) config.handedness = side->text();
  if (const auto info = field.find("device_info")) {
    config.hardware = version_of(info->at("major_version"));
    config.firmware = version_of(info->at("minor_version"));
  }
  const auto filters = field.find("filters");
  if (!filters) return config;
  if (const auto gate = filters->find("force_gate")) config.force_gate = gate->at("gain").number();
  if (const auto damping = filters->find("damping")) {
    if (const auto scalar = damping->find("scalar")) config.damping_N_s_per_m = scalar->number();
  }
  return config;
}

ArmStatus status_of(const JsonField& field) {
  ArmStatus status;
  if (const auto flag = field.find("ready")) status.is_ready = flag->flag();
  if (const auto flag = field.find("calibrated")) status.is_calibrated = flag->flag();
  if (const auto flag = field.find("power_supply")) status.has_power = flag->flag();
  if (const auto flag = field.find("in_use")) status.is_in_use = flag->flag();
  return status;
}

HaplyArm arm_of(const JsonField& field) {
  HaplyArm arm;
  arm.id = field.at("device_id").text();
  if (const auto config = field.find("config")) arm.config = config_of(*config);
  if (const auto status = field.find("status")) arm.status = status_of(*status);
  const JsonField state = field.at("state");
  arm.p_DC = vector_of(state.at("cursor_position"));
  arm.v_DC = vector_of(state.at("cursor_velocity"));
  if (const auto force = state.find("current_cursor_force")) arm.f_C_D = vector_of(*force);
  return arm;
}

bool is_any_pressed(const JsonField& buttons) {
  bool is_pressed = false;
  for (const char* name : {"a", "b", "c"}) {
    if (const auto button = buttons.find(name)) is_pressed = button->flag() || is_pressed;
  }
  return is_pressed;
}

HaplyHandle handle_of(const JsonField& field, bool is_wireless) {
  HaplyHandle handle;
  handle.id = field.at("device_id").text();
  handle.is_wireless = is_wireless;
  const JsonField state = field.at("state");
  handle.R_DG = rotation_of(state.at("orientation"));
  handle.is_pressed = is_wireless ? is_any_pressed(state.at("buttons")) : state.at("button").flag();
  return handle;
}

template <typename Use>
void for_each_in(const JsonField& root, const char* key, const Use& use) {
  const std::optional<JsonField> list = root.find(key);
  if (!list) return;
  const std::size_t size = list->list_size();
  for (std::size_t i = 0; i < size; ++i)
    use(list->at(i));
}

json config_json(const ArmConfig& config) {
  json filters = json::object();
  if (config.force_gate) filters["force_gate"] = {{"gain", *config.force_gate}};
  if (config.damping_N_s_per_m) filters["damping"] = {{"scalar", *config.damping_N_s_per_m}};
  return {{"type", config.type},
          {"port", config.port},
          {"handedness", config.handedness},
          {"device_info", {{"major_version", config.hardware}, {"minor_version", config.firmware}}},
          {"filters", filters}};
}

json arm_json(const HaplyArm& arm) {
  json state{{"cursor_position", json_of(arm.p_DC)}, {"cursor_velocity", json_of(arm.v_DC)}};
  if (arm.f_C_D) state["current_cursor_force"] = json_of(*arm.f_C_D);
  json result{{"device_id", arm.id},
              {"state", state},
              {"status",
               {{"ready", arm.status.is_ready},
                {"calibrated", arm.status.is_calibrated},
                {"power_supply", arm.status.has_power},
                {"in_use", arm.status.is_in_use}}}};
  if (arm.config) result["config"] = config_json(*arm.config);
  return result;
}

json handle_json(const HaplyHandle& handle) {
  const Eigen::Quaterniond q = handle.R_DG.value_or(Eigen::Quaterniond(0.0, 0.0, 0.0, 0.0));
  json state{{"orientation", {{"w", q.w()}, {"x", q.x()}, {"y", q.y()}, {"z", q.z()}}}};
  if (handle.is_wireless) {
    state["buttons"] = {{"a", handle.is_pressed}, {"b", false}, {"c", false}};
  } else {
    state["button"] = handle.is_pressed;
  }
  return {{"device_id", handle.id}, {"state", state}};
}

}  // namespace

ServiceMessage decode_service_message(std::string_view text) {
  constexpr bool kThrows = false;
  const json document = json::parse(text, nullptr, kThrows);
  if (document.is_discarded()) throw std::invalid_argument("the message is no JSON");
  const JsonField root(document);
  ServiceMessage message;
  if (root.find("session_id")) message.force_key = ForceKey::kVector;  // both came with version 3.5
  if (const auto arms = document.find(kArms); arms != document.end() && arms->is_object())
    root.at(kArms).refuse("is an object, as before version 3.1 of the service");
  for_each_in(root, kArms, [&](const JsonField& field) { message.arms.push_back(arm_of(field)); });
  for_each_in(root, kHandles, [&](const JsonField& field) { message.handles.push_back(handle_of(field, false)); });
  for_each_in(root, kWirelessHandles,
              [&](const JsonField& field) { message.handles.push_back(handle_of(field, true)); });
  return message;
}

std::string encode_service_message(const ServiceMessage& message) {
  json document{{kArms, json::array()}, {kHandles, json::array()}, {kWirelessHandles, json::array()}};
  if (message.force_key == ForceKey::kVector) document["session_id"] = 1;
  for (const HaplyArm& arm : message.arms)
    document[kArms].push_back(arm_json(arm));
  for (const HaplyHandle& handle : message.handles)
    document[handle.is_wireless ? kWirelessHandles : kHandles].push_back(handle_json(handle));
  return document.dump();
}

}  // namespace glissade::bridges
