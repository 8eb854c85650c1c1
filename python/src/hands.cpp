#include <string>
#include <vector>

#include <pybind11/stl.h>

#include <glissade/grasping/hand_model.h>
#include <glissade/grasping/kinematic_chain.h>
#include <glissade/hands/hand.h>

#include "arrays.h"
#include "module.h"

namespace glissade::python {

namespace {

using grasping::HandShape;
using grasping::Posture;
using hands::HandSide;

HandShape hand_shape(double length_m, double breadth_m, const std::string& side) {
  if (side != "right" && side != "left")
    throw std::invalid_argument("side must be 'right' or 'left', not '" + side + "'");
  return {length_m, breadth_m, side == "left" ? HandSide::kLeft : HandSide::kRight};
}

Posture posture(const py::object& X_WR, const py::object& angles) {
  Posture posture{.X_WR = pose_from(X_WR, "X_WR"), .values = std::vector<double>(hands::kJoints, 0.0)};
  if (angles.is_none()) return posture;
  const hands::JointValues values = joints_from(angles, "angles");
  posture.values.assign(values.begin(), values.end());
  return posture;
}

}  // namespace

void add_hands(py::module_& module) {
  py::tuple names(hands::kJoints);
  for (std::size_t joint = 0; joint < hands::kJointNames.size(); ++joint)
    names[joint] = std::string(hands::kJointNames[joint]);
  module.attr("JOINT_NAMES") = names;

  py::class_<HandShape>(module, "HandShape", "The size (metres) and side of a hand with fingers.")
      .def(py::init(&hand_shape), py::arg("length_m") = HandShape{}.length_m,
           py::arg("breadth_m") = HandShape{}.breadth_m, py::arg("side") = "right",
           "length_m: from the crease of the wrist to the tip of the middle finger. breadth_m: across the knuckles.")
      .def_readonly("length_m", &HandShape::length_m, "from the crease of the wrist to the tip of the middle finger")
      .def_readonly("breadth_m", &HandShape::breadth_m, "across the knuckles")
      .def_property_readonly(
          "side", [](const HandShape& shape) { return shape.side == HandSide::kLeft ? "left" : "right"; },
          "'right' or 'left'");

  py::class_<Posture>(module, "Posture", "The pose of a hand's root R (the wrist) and the angles of its joints.")
      .def(py::init(&posture), py::arg("X_WR"), py::arg("angles") = py::none(),
           "X_WR: (7,) or (4, 4). angles: (22,) rad, in the order of JOINT_NAMES; None: an open hand.")
      .def_property_readonly(
          "X_WR", [](const Posture& of) { return to_array(of.X_WR); }, "(4, 4)")
      .def_property_readonly(
          "angles",
          [](const Posture& of) {
            return py::array_t<double>(static_cast<py::ssize_t>(of.values.size()), of.values.data());
          },
          "(22,) rad");
}

}  // namespace glissade::python
