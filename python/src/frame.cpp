#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include <pybind11/stl.h>

#include <glissade/devices/haptic_state.h>

#include "arrays.h"
#include "gloves.h"
#include "module.h"

namespace glissade::python {

namespace {

using devices::HapticContact;
using devices::HapticHandState;
using devices::HapticPartState;
using devices::HapticState;

std::span<const HapticPartState> parts_of(const HapticState& frame) {
  return std::span(frame.parts).first(static_cast<std::size_t>(frame.part_count));
}
std::span<const HapticHandState> hands_of(const HapticState& frame) {
  return std::span(frame.hands).first(static_cast<std::size_t>(frame.hand_count));
}
std::span<const HapticContact> contacts_of(const HapticState& frame) {
  return std::span(frame.contacts).first(static_cast<std::size_t>(frame.contact_count));
}

/// An array (n, 4, 4) with pose(item) of each item.
template <typename Item, typename Pose>
py::array_t<double> poses(std::span<const Item> items, const Pose& pose) {
  std::vector<Eigen::Isometry3d> X;
  for (const Item& item : items)
    X.push_back(pose(item));
  return to_array(X, {std::ssize(X)});
}

/// An array (n, width) with the numbers at values(item).data() of each item.
template <typename Item, typename Values>
py::array_t<double> rows(std::span<const Item> items, py::ssize_t width, const Values& values) {
  py::array_t<double> array = new_array<double>({std::ssize(items)}, {width});
  double* next = array.mutable_data();
  for (const Item& item : items)
    next = std::copy_n(values(item).data(), width, next);
  return array;
}

template <typename Item, typename Value>
py::tuple each(std::span<const Item> items, const Value& value) {
  py::list values;
  for (const Item& item : items)
    values.append(value(item));
  return py::tuple(values);
}

double seconds(std::chrono::nanoseconds time) {
  return std::chrono::duration<double>(time).count();
}

using FrameType = py::class_<HapticState>;

void add_parts(FrameType& type) {
  type.def_property_readonly(
      "X_WV", [](const HapticState& f) { return poses(parts_of(f), [](const auto& part) { return part.X_WV; }); },
      "(parts, 4, 4) the visible parts");
  type.def_property_readonly(
      "X_WG", [](const HapticState& f) { return poses(parts_of(f), [](const auto& part) { return part.X_WG; }); },
      "(parts, 4, 4) their ghosts");
  type.def_property_readonly(
      "states",
      [](const HapticState& f) {
        return each(parts_of(f), [](const auto& part) { return std::string(devices::name_of(part.state)); });
      },
      "for each part: 'unknown', 'released', 'free', 'sliding', 'resting' or 'catching-up'");
  type.def_property_readonly(
      "pushing",
      [](const HapticState& f) { return each(parts_of(f), [](const auto& part) { return part.contact_count; }); },
      "for each part: the number of contacts that push");
}

void add_hands(FrameType& type) {
  const auto vectors = [](Eigen::Vector3d HapticHandState::*member) {
    return [member](const HapticState& f) {
      return rows(hands_of(f), 3, [member](const HapticHandState& hand) { return hand.*member; });
    };
  };
  const auto reasons = [](devices::LimitReasons HapticHandState::*member) {
    return [member](const HapticState& f) {
      return each(hands_of(f), [member](const HapticHandState& hand) { return names_of(hand.*member); });
    };
  };
  type.def_property_readonly("f_W", vectors(&HapticHandState::force_W), "(hands, 3) newtons, as the device got them");
  type.def_property_readonly("t_W", vectors(&HapticHandState::torque_V_W),
                             "(hands, 3) newton metres about the origin of the held part, else of the hand root");
  type.def_property_readonly(
      "joint_torques",
      [](const HapticState& f) {
        return rows(hands_of(f), hands::kJoints, [](const auto& hand) { return hand.joint_torques; });
      },
      "(hands, 22) newton metres, as the device got them");
  type.def_property_readonly(
      "held_parts",
      [](const HapticState& f) {
        return each(hands_of(f), [](const auto& hand) -> py::object {
          return hand.part < 0 ? py::object(py::none()) : py::object(py::int_(hand.part));
        });
      },
      "for each hand: the number of the part that it holds, or None");
  type.def_property_readonly("reasons", reasons(&HapticHandState::reasons),
                             "for each hand: why it got less than the contacts demand, names of LIMIT_REASONS");
  type.def_property_readonly("glove_reasons", reasons(&HapticHandState::glove_reasons),
                             "for each hand: why its glove exerts less than it was sent");
  type.def_property_readonly(
      "energy_J",
      [](const HapticState& f) {
        return each(hands_of(f), [](const auto& hand) { return devices::energy_left(hand); });
      },
      "for each hand: what force and torque may still give to it");
  type.def_property_readonly(
      "X_WH",
      [](const HapticState& f) { return poses(hands_of(f), [](const auto& hand) { return hand.visible.X_WH; }); },
      "(hands, 4, 4) the visible hands, which enter nothing; only of hands with fingers");
  type.def_property_readonly(
      "angles",
      [](const HapticState& f) {
        return rows(hands_of(f), hands::kJoints, [](const auto& hand) { return hand.visible.angles; });
      },
      "(hands, 22) rad, joints of the visible hands; only of hands with fingers");
  type.def_property_readonly(
      "grasps",
      [](const HapticState& f) {
        return each(hands_of(f), [](const auto& hand) { return std::string(hands::name_of(hand.visible.grasp)); });
      },
      "for each hand: 'none', 'push', 'precision' or 'power'; only of hands with fingers");
}

void add_contacts(FrameType& type) {
  type.def_property_readonly(
      "contact_parts",
      [](const HapticState& f) { return each(contacts_of(f), [](const auto& contact) { return contact.part; }); },
      "for each contact that pushes: the number of the part");
  type.def_property_readonly(
      "contact_p_W",
      [](const HapticState& f) {
        return rows(contacts_of(f), 3, [&f](const HapticContact& contact) -> Eigen::Vector3d {
          return f.parts[static_cast<std::size_t>(contact.part)].X_WV * contact.p_V.cast<double>();
        });
      },
      "(contacts, 3) metres");
  type.def_property_readonly(
      "contact_n_W",
      [](const HapticState& f) {
        return rows(contacts_of(f), 3,
                    [](const HapticContact& contact) -> Eigen::Vector3d { return contact.n_W.cast<double>(); });
      },
      "(contacts, 3) unit normals, from the obstacle to the part");
}

}  // namespace

void add_frame(py::module_& module) {
  FrameType type(module, "Frame", "The haptic loop after one tick. All of it is of the same tick.");
  type.def_readonly("tick", &HapticState::sequence, "0 before the first tick");
  type.def_property_readonly(
      "time_s", [](const HapticState& f) { return seconds(f.time); }, "on the clock of time.monotonic()");
  type.def_property_readonly(
      "contact_set_age_s", [](const HapticState& f) { return seconds(f.contact_set_age); },
      "age of the ghosts for which the contacts were computed");
  add_parts(type);
  add_hands(type);
  add_contacts(type);
}

}  // namespace glissade::python
