#include "haply/client_message.h"

#include <stdexcept>

#include <nlohmann/json.hpp>

#include "haply/json_field.h"
#include "haply/json_vector.h"

namespace glissade::bridges {
namespace {

const char* name_of(ForceKey key) {
  return key == ForceKey::kVector ? "vector" : "values";
}

}  // namespace

std::string encode_client_message(const ClientMessage& message) {
  using nlohmann::json;
  json arm{{"device_id", message.arm},
           {"commands", {{"set_cursor_force", {{name_of(message.force_key), json_of(message.f_C_D)}}}}}};
  json document = json::object();
  if (message.damping_N_s_per_m) {
    document["session"] = {{"configure", {{"profile", {{"name", "glissade"}}}}}};
    arm["configure"] = {{"preset", {{"preset", "defaults"}}}, {"damping", {{"scalar", *message.damping_N_s_per_m}}}};
  }
  document["inverse3"] = json::array({arm});
  return document.dump();
}

ClientMessage decode_client_message(std::string_view text) {
  constexpr bool kThrows = false;
  const nlohmann::json document = nlohmann::json::parse(text, nullptr, kThrows);
  if (document.is_discarded()) throw std::invalid_argument("the message is no JSON");
  const JsonField arm = JsonField(document).at("inverse3").at(0);
  ClientMessage message;
  message.arm = arm.at("device_id").text();
  const JsonField command = arm.at("commands").at("set_cursor_force");
  message.force_key = command.find("vector") ? ForceKey::kVector : ForceKey::kValues;
  message.f_C_D = vector_of(command.at(name_of(message.force_key)));
  if (const auto configure = arm.find("configure"))
    message.damping_N_s_per_m = configure->at("damping").at("scalar").number();
  return message;
}

}  // namespace glissade::bridges
