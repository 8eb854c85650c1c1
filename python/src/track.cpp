#include "track.h"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include <glissade/contact/sliding_result.h>

#include "arrays.h"
#include "for_each.h"

namespace glissade::python {

namespace py = pybind11;

namespace {

using Simulation = ShownSimulation;

/// The rows while they are collected, without Python objects.
struct Rows {
  std::vector<Eigen::Isometry3d> X_WG;
  std::vector<Eigen::Isometry3d> X_WV;
  std::vector<contact::Wrench> wrenches;
  std::vector<std::uint8_t> states;
  std::vector<std::int32_t> pushing;
  std::vector<double> clearances;

  void note(Simulation& simulation) {
    for (std::size_t p = 0; p < simulation.part_count(); ++p) {
      const contact::SlidingResult& result = simulation.result(p);
      X_WG.push_back(result.X_WG);
      X_WV.push_back(result.X_WV);
      wrenches.push_back(simulation.wrench(p));
      states.push_back(static_cast<std::uint8_t>(result.state));
      pushing.push_back(result.pushing);
    }
  }
};

py::array_t<double> vectors(const std::vector<contact::Wrench>& wrenches, Eigen::Vector3d contact::Wrench::*member,
                            const std::vector<py::ssize_t>& shape) {
  py::array_t<double> array = new_array<double>(shape, {3});
  double* values = array.mutable_data();
  for (const contact::Wrench& wrench : wrenches)
    values = std::copy_n((wrench.*member).data(), 3, values);
  return array;
}

template <typename Number>
py::array_t<Number> numbers(const std::vector<Number>& values, const std::vector<py::ssize_t>& shape) {
  return py::array_t<Number>(shape, values.data());
}

py::tuple state_names() {
  py::list names;
  for (int state = 0; state <= static_cast<int>(contact::SlidingState::kCatchingUp); ++state)
    names.append(std::string(contact::name_of(static_cast<contact::SlidingState>(state))));
  return py::tuple(names);
}

Track table_of(const Rows& rows, py::ssize_t count, py::ssize_t parts, bool has_axis_of_parts, bool has_clearance) {
  const std::vector<py::ssize_t> shape =
      has_axis_of_parts ? std::vector<py::ssize_t>{count, parts} : std::vector<py::ssize_t>{count};
  Track track{.X_WG = to_array(rows.X_WG, shape),
              .X_WV = to_array(rows.X_WV, shape),
              .f_W = vectors(rows.wrenches, &contact::Wrench::f, shape),
              .t_W = vectors(rows.wrenches, &contact::Wrench::t, shape),
              .state = py::module_::import("numpy").attr("take")(state_names(), numbers(rows.states, shape)),
              .pushing = numbers(rows.pushing, shape),
              .clearance = std::nullopt};
  if (has_clearance) track.clearance = numbers(rows.clearances, {count});
  return track;
}

}  // namespace

Track follow(GuardedSimulation& guarded, const py::object& poses, double milliseconds, bool with_clearance) {
  const Poses X_WG(poses, "X_WG");
  if (X_WG.shape().size() != 1 && X_WG.shape().size() != 2)
    throw std::invalid_argument("X_WG must have the shape (n, 7), (n, 4, 4), (n, parts, 7) or (n, parts, 4, 4)");
  const py::ssize_t count = X_WG.shape()[0];
  const std::size_t each = X_WG.shape().size() == 2 ? static_cast<std::size_t>(X_WG.shape()[1]) : 1;
  const std::vector<Eigen::Isometry3d> path = X_WG.all();  // before the part moves: a bad pose moves nothing
  Rows rows;
  guarded.with([&](Simulation& simulation) {
    SignalCheck check;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      simulation.advance(std::span(path).subspan(i * each, each), milliseconds);
      rows.note(simulation);
      if (with_clearance) rows.clearances.push_back(simulation.clearance(0));
      check();
    }
  });
  return table_of(rows, count, static_cast<py::ssize_t>(each), X_WG.shape().size() == 2, with_clearance);
}

Track follow_hands(GuardedSimulation& guarded, const py::object& poses, const py::object& joint_angles,
                   double milliseconds) {
  const Poses X_WR(poses, "X_WR");
  const Numbers angles = numbers_from(joint_angles, "angles");
  const bool has_axis_of_hands = X_WR.shape().size() == 2;
  std::vector<py::ssize_t> wanted = X_WR.shape();
  wanted.push_back(hands::kJoints);
  if (X_WR.is_single() || X_WR.shape().size() > 2 ||
      !std::equal(wanted.begin(), wanted.end(), angles.shape(), angles.shape() + angles.ndim()))
    throw std::invalid_argument(
        "X_WR must have the shape (n, …) or (n, hands, …), and angles (n, 22) or (n, hands, 22)");
  const py::ssize_t count = X_WR.shape()[0];
  const std::size_t each = has_axis_of_hands ? static_cast<std::size_t>(X_WR.shape()[1]) : 1;
  check_finite(angles, "angles");
  const std::vector<Eigen::Isometry3d> roots = X_WR.all();
  Rows rows;
  const std::vector<double> all_angles(angles.data(), angles.data() + angles.size());  // threads may change the array
  const std::size_t parts = guarded.with([&](Simulation& simulation) {
    SignalCheck check;
    std::vector<std::optional<grasping::Posture>> postures(each);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      for (std::size_t hand = 0; hand < each; ++hand) {
        const std::size_t row = i * each + hand;
        const double* const values = all_angles.data() + row * hands::kJoints;
        postures[hand] = grasping::Posture{roots[row], std::vector<double>(values, values + hands::kJoints)};
      }
      simulation.advance(postures, milliseconds);
      rows.note(simulation);
      check();
    }
    return simulation.part_count();
  });
  return table_of(rows, count, static_cast<py::ssize_t>(parts), parts > 1, false);
}

void add_track(py::module_& module) {
  module.attr("SLIDING_STATES") = state_names();
  py::class_<Track>(module, "Track", "What happened along a path: arrays with one row for each of its n poses.")
      .def_readonly("X_WG", &Track::X_WG, "(n, 4, 4) the ghost")
      .def_readonly("X_WV", &Track::X_WV, "(n, 4, 4) the visible part")
      .def_readonly("f_W", &Track::f_W, "(n, 3) newtons on the hand")
      .def_readonly("t_W", &Track::t_W, "(n, 3) newton metres on the hand, about the part's compliance point")
      .def_readonly("state", &Track::state, "(n,) one of SLIDING_STATES")
      .def_readonly("pushing", &Track::pushing, "(n,) number of contacts that push")
      .def_readonly("clearance", &Track::clearance, "(n,) metres, or None")
      .def("__len__", [](const Track& track) { return track.X_WV.shape(0); });
}

}  // namespace glissade::python
