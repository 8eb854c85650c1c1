/// Messages of Haply's Inverse Service, and what must not pass for one. The texts follow Haply's documentation.

#include "haply/service_message.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "expect_bad_input.h"
#include "haply/client_message.h"

namespace glissade::bridges {
namespace {

using Eigen::Vector3d;

constexpr const char* kInventory35 = R"({
  "session_id": 7,
  "inverse3": [{
    "device_id": "049D",
    "config": {
      "type": "inverse3", "port": "COM12", "handedness": "right",
      "device_info": {"major_version": 7, "minor_version": 4, "id": "049D", "device_type": 4, "uuid": "x"},
      "filters": {"force_gate": {"gain": 0.3}, "damping": {"scalar": 0.5}}
    },
    "state": {
      "cursor_position": {"x": 0.01, "y": -0.12, "z": 0.15}, "cursor_velocity": {"x": 1, "y": 2, "z": 3},
      "current_cursor_force": {"x": 0.5, "y": 0, "z": 0}, "control_mode": "idle"
    },
    "status": {"calibrated": false, "in_use": true, "power_supply": true, "ready": true, "started": true}
  }],
  "verse_grip": [],
  "wireless_verse_grip": [{
    "device_id": "61548",
    "state": {"orientation": {"w": 0, "x": 1, "y": 0, "z": 0}, "buttons": {"a": false, "b": true, "c": false},
              "hall": 0, "battery_level": 0.5}
  }]
})";

constexpr const char* kState31 = R"({
  "inverse3": [{
    "device_id": "04BA",
    "state": {"cursor_position": {"x": 0, "y": 0, "z": 0.1}, "cursor_velocity": {"x": 0, "y": 0, "z": 0},
              "mode": "idle"}
  }],
  "verse_grip": [{
    "device_id": "1",
    "state": {"button": true, "hall": 0,
              "orientation": {"x": -0.5019531, "y": 0.8632202, "z": -0.048095703, "w": -0.022338867}}
  }]
})";

TEST(ServiceMessage, HasTheDevicesOfTheFirstMessage) {
  const ServiceMessage message = decode_service_message(kInventory35);
  EXPECT_EQ(message.force_key, ForceKey::kVector);
  ASSERT_EQ(message.arms.size(), 1);
  const HaplyArm& arm = message.arms[0];
  EXPECT_EQ(arm.id, "049D");
  EXPECT_EQ(arm.p_DC, Vector3d(0.01, -0.12, 0.15));
  EXPECT_EQ(arm.v_DC, Vector3d(1, 2, 3));
  EXPECT_EQ(arm.f_C_D, Vector3d(0.5, 0, 0));
  ASSERT_TRUE(arm.config);
  EXPECT_EQ(arm.config->type, "inverse3");
  EXPECT_EQ(arm.config->hardware, 7);
  EXPECT_EQ(arm.config->firmware, 4);
  EXPECT_EQ(arm.config->force_gate, 0.3);
  EXPECT_EQ(arm.config->damping_N_s_per_m, 0.5);
  EXPECT_FALSE(arm.status.is_calibrated);
  EXPECT_TRUE(arm.status.is_in_use);
  ASSERT_EQ(message.handles.size(), 1);
  EXPECT_TRUE(message.handles[0].is_wireless);
  EXPECT_TRUE(message.handles[0].is_pressed);
  EXPECT_EQ(message.handles[0].R_DG->x(), 1.0);
}

TEST(ServiceMessage, OfAnOlderServiceHasNoForceAndAnotherKey) {
  const ServiceMessage message = decode_service_message(kState31);
  EXPECT_EQ(message.force_key, ForceKey::kValues);
  EXPECT_FALSE(message.arms.at(0).f_C_D);
  EXPECT_FALSE(message.arms.at(0).config);
  EXPECT_TRUE(message.arms.at(0).status.is_calibrated) << "what is not told is not wrong";
  EXPECT_FALSE(message.handles.at(0).is_wireless);
  EXPECT_TRUE(message.handles.at(0).is_pressed);
  EXPECT_NEAR(message.handles.at(0).R_DG->norm(), 1.0, 1e-12) << "single precision became a rotation";
}

TEST(ServiceMessage, MayHaveNoDevices) {
  EXPECT_TRUE(decode_service_message("{}").arms.empty());
}

TEST(ServiceMessage, OfAHandleThatHasNotMeasuredHasNoOrientation) {
  const ServiceMessage message = decode_service_message(
      R"({"verse_grip": [{"device_id": "1", "state": {"button": false,
          "orientation": {"w": 0, "x": 0, "y": 0, "z": 0}}}]})");
  EXPECT_FALSE(message.handles.at(0).R_DG);
}

/// The message with `text` in place of `old`.
std::string replaced(std::string message, const std::string& old, const std::string& text) {
  const std::size_t at = message.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return message.replace(at, old.size(), text);
}

void expect_names(const std::string& message, const std::vector<std::string>& parts) {
  test_support::expect_bad_input([&] { decode_service_message(message); }, parts);
}

TEST(ServiceMessage, IsRefusedByTheNameOfItsKey) {
  const std::string whole = kInventory35;
  expect_names(whole.substr(0, whole.size() / 2), {"no JSON"});
  expect_names("[]", {"the message", "no object"});
  expect_names(replaced(whole, "\"049D\"", "49"), {"inverse3[0].device_id", "no text"});
  expect_names(replaced(whole, "-0.12", "\"-0.12\""), {"inverse3[0].state.cursor_position.y", "no number"});
  expect_names(replaced(whole, "-0.12", "1e999"), {"no JSON"});
  expect_names(replaced(whole, "\"y\": -0.12, ", ""), {"inverse3[0].state.cursor_position", "no key 'y'"});
  expect_names(replaced(whole, "cursor_velocity", "velocity"), {"inverse3[0].state", "'cursor_velocity'"});
  expect_names(replaced(whole, "\"ready\": true", "\"ready\": 1"), {"inverse3[0].status.ready", "neither"});
  expect_names(replaced(whole, "\"b\": true", "\"b\": \"yes\""), {"wireless_verse_grip[0].state.buttons.b"});
  expect_names(replaced(whole, "\"w\": 0", "\"w\": 1"),
               {"wireless_verse_grip[0].state.orientation", "unit quaternion"});
  expect_names(replaced(whole, "\"w\": 0", "\"w\": 1e300"), {"orientation", "unit quaternion"});
  expect_names(replaced(whole, "\"minor_version\": 4", "\"minor_version\": -4"), {"minor_version", "version"});
  expect_names(R"({"inverse3": {"049D": {}}})", {"inverse3", "before version 3.1"});
  expect_names(R"({"inverse3": [3]})", {"inverse3[0]", "no object"});
}

TEST(ServiceMessage, OfTheEmulatorReadsAsItWasMeant) {
  const ServiceMessage meant = decode_service_message(kInventory35);
  const ServiceMessage read = decode_service_message(encode_service_message(meant));
  EXPECT_EQ(read.force_key, meant.force_key);
  ASSERT_EQ(read.arms.size(), 1);
  EXPECT_EQ(read.arms[0].p_DC, meant.arms[0].p_DC);
  EXPECT_EQ(read.arms[0].f_C_D, meant.arms[0].f_C_D);
  EXPECT_EQ(read.arms[0].config->firmware, 4);
  EXPECT_EQ(read.arms[0].status.is_calibrated, false);
  EXPECT_TRUE(read.handles.at(0).is_pressed);
}

TEST(ClientMessage, SendsTheForceUnderTheKeyOfTheService) {
  EXPECT_EQ(encode_client_message({.force_key = ForceKey::kVector, .arm = "049D", .f_C_D = {1, 0, -2}}),
            R"({"inverse3":[{"commands":{"set_cursor_force":{"vector":{"x":1.0,"y":0.0,"z":-2.0}}},)"
            R"("device_id":"049D"}]})");
  EXPECT_THAT(encode_client_message({.force_key = ForceKey::kValues, .arm = "049D"}),
              testing::HasSubstr(R"("set_cursor_force":{"values":)"));
}

TEST(ClientMessage, BeginsASessionInTheFrameOfTheDeviceWithoutDamping) {
  const std::string text = encode_client_message({.arm = "049D", .damping_N_s_per_m = 0.0});
  for (const char* part :
       {R"("profile":{"name":"glissade"})", R"("preset":{"preset":"defaults"})", R"("damping":{"scalar":0.0})"})
    EXPECT_THAT(text, testing::HasSubstr(part));
  EXPECT_EQ(decode_client_message(text).damping_N_s_per_m, 0.0);
}

}  // namespace
}  // namespace glissade::bridges
