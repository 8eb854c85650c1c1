#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include <pybind11/stl.h>

#include <glissade/devices/relay_glove.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/realtime/clock.h>

#include "arrays.h"
#include "gloves.h"
#include "module.h"

namespace glissade::python {

namespace {

using devices::DeviceDescriptor;

/// A glove whose driver is written in Python. All calls of the driver hold the interpreter lock: they never wait.
class RelayGlove final : public Glove {
 public:
  explicit RelayGlove(const DeviceDescriptor& descriptor) : relay(descriptor) {}

  devices::GloveDevice& device() override { return relay; }
  void end() noexcept override { relay.stop(); }
  void abandon() noexcept override {}

  devices::RelayGlove relay;
};

struct Limit {
  const char* name;
  double DeviceDescriptor::*member;
};

constexpr std::array kLimits{
    Limit{"max_force_N", &DeviceDescriptor::max_force},
    Limit{"max_torque_Nm", &DeviceDescriptor::max_torque},
    Limit{"max_joint_torque_Nm", &DeviceDescriptor::max_joint_torque},
    Limit{"max_stiffness_N_per_m", &DeviceDescriptor::max_stiffness},
    Limit{"max_rotational_stiffness_Nm_per_rad", &DeviceDescriptor::max_rotational_stiffness},
    Limit{"max_damping_Ns_per_m", &DeviceDescriptor::max_damping},
    Limit{"damping_Ns_per_m", &DeviceDescriptor::damping},
    Limit{"rotational_damping_Nms_per_rad", &DeviceDescriptor::rotational_damping},
    Limit{"joint_damping_Nms_per_rad", &DeviceDescriptor::joint_damping},
    Limit{"friction_N", &DeviceDescriptor::friction},
    Limit{"joint_friction_Nm", &DeviceDescriptor::joint_friction},
    Limit{"resolution_m", &DeviceDescriptor::resolution},
    Limit{"joint_resolution_rad", &DeviceDescriptor::joint_resolution},
    Limit{"max_force_rate_N_per_s", &DeviceDescriptor::max_force_rate},
    Limit{"max_torque_rate_Nm_per_s", &DeviceDescriptor::max_torque_rate},
    Limit{"max_joint_torque_rate_Nm_per_s", &DeviceDescriptor::max_joint_torque_rate},
    Limit{"max_power_W", &DeviceDescriptor::max_power},
    Limit{"max_mean_force_N", &DeviceDescriptor::max_mean_force},
    Limit{"max_speed_m_per_s", &DeviceDescriptor::max_speed},
    Limit{"max_turn_rate_rad_per_s", &DeviceDescriptor::max_turn_rate},
    Limit{"workspace_radius_m", &DeviceDescriptor::workspace_radius},
    Limit{"update_rate_Hz", &DeviceDescriptor::update_rate},
};

double number_from(const py::handle& value, const std::string& name) {
  try {
    return value.cast<double>();
  } catch (const py::cast_error&) {
    throw py::type_error(name + " is no number");
  }
}

void set_limit(DeviceDescriptor& descriptor, const std::string& name, const py::handle& value) {
  for (const Limit& limit : kLimits) {
    if (name == limit.name) {
      descriptor.*limit.member = number_from(value, name);
      return;
    }
  }
  if (name == "delay_s" || name == "frozen_s") {
    (name == "delay_s" ? descriptor.delay : descriptor.frozen) = nanoseconds_from(number_from(value, name), name);
    return;
  }
  std::string known;
  for (const Limit& limit : kLimits)
    known += std::string(limit.name) + ", ";
  throw py::type_error("a RelayGlove has no '" + name + "'; it has " + known +
                       "delay_s, frozen_s, joint_lower_rad, joint_upper_rad");
}

std::shared_ptr<RelayGlove> make(const std::string& name, const py::object& joint_lower_rad,
                                 const py::object& joint_upper_rad, const py::kwargs& limits) {
  DeviceDescriptor descriptor;
  descriptor.name = name;
  if (!joint_lower_rad.is_none()) descriptor.joint_lower = joints_from(joint_lower_rad, "joint_lower_rad");
  if (!joint_upper_rad.is_none()) descriptor.joint_upper = joints_from(joint_upper_rad, "joint_upper_rad");
  for (const auto& [key, value] : limits)
    set_limit(descriptor, key.cast<std::string>(), value);
  return make_running<RelayGlove>(descriptor);
}

/// A vector of the state; None: zero.
Eigen::Vector3d rate_from(const py::object& argument, const std::string& name) {
  if (argument.is_none()) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d vector = vector_from(argument, name);
  if (!vector.allFinite()) throw std::invalid_argument(name + " has a number that is not finite");
  return vector;
}

void put(RelayGlove& glove, const py::object& X_WH, const py::object& v_WH, const py::object& w_WH,
         const py::object& angles, std::optional<double> time_s, std::int64_t grip, bool is_enabled) {
  devices::GloveState state;
  state.time = time_s ? nanoseconds_from(*time_s, "time_s") : realtime::SteadyClock().now();
  state.X_WH = pose_from(X_WH, "X_WH");
  state.v_WH = rate_from(v_WH, "v_WH");
  state.w_WH = rate_from(w_WH, "w_WH");
  if (!angles.is_none()) state.joint_angles = joints_from(angles, "angles");
  state.grip = grip;
  state.is_enabled = is_enabled;
  glove.relay.publish(state);
}

void add_command(py::module_& module) {
  using devices::SafeCommand;
  py::class_<SafeCommand>(module, "GloveCommand", "What the device must exert now, within all limits.")
      .def_property_readonly(
          "f_H_W", [](const SafeCommand& command) { return to_array(command.values().f_H_W); },
          "(3,) newtons on the hand at the hand root, in world axes")
      .def_property_readonly(
          "t_H_W", [](const SafeCommand& command) { return to_array(command.values().t_H_W); },
          "(3,) newton metres on the hand about the hand root, in world axes")
      .def_property_readonly(
          "joint_torques",
          [](const SafeCommand& command) {
            return py::array_t<double>(hands::kJoints, command.values().joint_torques.data());
          },
          "(22,) newton metres, in the order of JOINT_NAMES")
      .def_property_readonly(
          "reasons", [](const SafeCommand& command) { return names_of(command.reasons()); },
          "why it is less than wanted: names of LIMIT_REASONS, the most serious first")
      .def_property_readonly(
          "reason", [](const SafeCommand& command) { return devices::to_text(command); },
          "the most serious reason in a sentence; empty without a reason")
      .def_property_readonly(
          "age_s", [](const SafeCommand& command) { return std::chrono::duration<double>(command.age()).count(); },
          "time since the measurement of the state that it answers, seconds");
}

}  // namespace

void add_relay_glove(py::module_& module) {
  add_command(module);
  py::class_<RelayGlove, Glove, std::shared_ptr<RelayGlove>>(
      module, "RelayGlove", "A glove whose driver is a loop of this program: it puts states and takes commands.")
      .def(py::init(&make), py::arg("name"), py::kw_only(), py::arg("joint_lower_rad") = py::none(),
           py::arg("joint_upper_rad") = py::none(),
           R"(Describes the device.

limits: what it can do, in SI units: max_force_N, max_torque_Nm, max_joint_torque_Nm, max_stiffness_N_per_m,
max_rotational_stiffness_Nm_per_rad, update_rate_Hz, ... A server refuses a glove without stiffness. See docs/devices.md.
joint_lower_rad, joint_upper_rad: (22,), both 0 for a joint that is not there. Raises ValueError for a wrong value,
TypeError for an unknown name.)")
      .def("put", &put, py::arg("X_WH"), py::kw_only(), py::arg("v_WH") = py::none(), py::arg("w_WH") = py::none(),
           py::arg("angles") = py::none(), py::arg("time_s") = py::none(), py::arg("grip") = 1,
           py::arg("is_enabled") = true,
           R"(Driver: the newest state. Call it once for each measurement.

X_WH: the pose of the hand root, (7,) or (4, 4). v_WH, w_WH: its velocity (3,) in m/s and rad/s, in world axes; None: 0.
angles: (22,) rad. time_s: of the measurement, on any monotonic clock; None: now, on time.monotonic(). grip: how often the
hand has closed or opened, odd while it is closed. is_enabled: the wearer holds the enable switch.)")
      .def(
          "command", [](RelayGlove& glove) { return glove.relay.newest_command(); },
          R"(Driver: what the device must exert now, a GloveCommand. Call it once a period, after `put`.

The force fades if states stop, or if the server is late, stops or ends. It cannot fade if the driver itself halts: then
only the watchdog of the device lets go.)")
      .def(
          "stop", [](RelayGlove& glove) { glove.relay.stop(); },
          "Emergency stop: the force fades to zero and stays there.");
}

}  // namespace glissade::python
