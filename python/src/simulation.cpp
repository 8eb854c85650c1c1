#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include <glissade/contact/sliding_result.h>
#include <glissade/grasping/grasp_analysis.h>

#include "arrays.h"
#include "guarded_simulation.h"
#include "module.h"
#include "track.h"

namespace glissade::python {

namespace {

using contact::TrackedContact;
using simulation::Scene;
using Simulation = ShownSimulation;

/// A contact for Python, with the name of the other body.
struct NamedContact {
  TrackedContact tracked;
  std::string body;
};

std::size_t checked(std::size_t number, std::size_t count, const char* noun) {
  if (number < count) return number;
  throw py::index_error("there is no " + std::string(noun) + " " + std::to_string(number) + ": there are " +
                        std::to_string(count));
}

/// The result of read(simulation, part) for a part that exists.
template <typename Read>
auto of_part(GuardedSimulation& guarded, std::size_t part, const Read& read) {
  return guarded.with(
      [&](Simulation& simulation) { return read(simulation, checked(part, simulation.part_count(), "part")); });
}

template <typename Read>
auto of_hand(GuardedSimulation& guarded, std::size_t hand, const Read& read) {
  return guarded.with([&](Simulation& simulation) {
    return read(simulation, checked(hand, simulation.engine().hand_count(), "hand"));
  });
}

std::unique_ptr<GuardedSimulation> make(const Scene& scene) {
  const Scene own = scene;  // other threads may change the scene meanwhile
  const Unlocked unlocked;
  return std::make_unique<GuardedSimulation>(own);
}

void advance(GuardedSimulation& guarded, const py::object& poses, double milliseconds) {
  const std::vector<Eigen::Isometry3d> X_WG = Poses(poses, "X_WG").all();
  guarded.with([&](Simulation& simulation) { simulation.advance(X_WG, milliseconds); });
}

void advance_hands(GuardedSimulation& guarded, const std::vector<std::optional<grasping::Posture>>& postures,
                   double milliseconds) {
  guarded.with([&](Simulation& simulation) { simulation.advance(postures, milliseconds); });
}

std::vector<NamedContact> contacts(GuardedSimulation& guarded, std::size_t part) {
  return of_part(guarded, part, [](Simulation& simulation, std::size_t p) {
    std::vector<NamedContact> contacts;
    for (const TrackedContact& tracked : simulation.contacts(p))
      contacts.push_back({tracked, simulation.name_of_body(tracked.contact.obstacle)});
    return contacts;
  });
}

py::tuple wrench(GuardedSimulation& guarded, std::size_t part) {
  const contact::Wrench wrench =
      of_part(guarded, part, [](Simulation& simulation, std::size_t p) { return simulation.wrench(p); });
  return py::make_tuple(to_array(wrench.f), to_array(wrench.t));
}

py::tuple lag(GuardedSimulation& guarded, std::size_t part) {
  const geometry::Displacement lag =
      of_part(guarded, part, [](Simulation& simulation, std::size_t p) { return simulation.lag(p); });
  return py::make_tuple(to_array(lag.v), to_array(lag.w));
}

std::vector<std::string> part_names(GuardedSimulation& guarded) {
  return guarded.with([](Simulation& simulation) {
    std::vector<std::string> names;
    for (const simulation::ScenePart& part : simulation.bodies().parts)
      names.push_back(part.name);
    return names;
  });
}

void add_contact(py::module_& module) {
  const auto of = [](auto member) {
    return [member](const NamedContact& contact) { return contact.tracked.contact.*member; };
  };
  const auto vector_of = [](Eigen::Vector3d contact::Contact::*member) {
    return [member](const NamedContact& contact) { return to_array(contact.tracked.contact.*member); };
  };
  py::class_<NamedContact>(module, "Contact", "A place where a part touches another body.")
      .def_property_readonly(
          "id", [](const NamedContact& contact) { return contact.tracked.id; },
          "keeps its value while the contact lasts")
      .def_property_readonly(
          "age", [](const NamedContact& contact) { return contact.tracked.age; },
          "calls of `contacts` since the contact began")
      .def_readonly("body", &NamedContact::body, "the name of the other body")
      .def_property_readonly(
          "kind",
          [](const NamedContact& contact) { return std::string(contact::name_of(contact.tracked.contact.kind)); },
          "the features that touch, that of the part first, such as 'vertex-face'")
      .def_property_readonly("p_W", vector_of(&contact::Contact::p_W), "(3,) the point on the part, metres")
      .def_property_readonly("n_W", vector_of(&contact::Contact::n_W), "(3,) unit normal, from the body to the part")
      .def_property_readonly("gap", of(&contact::Contact::gap), "metres")
      .def_property_readonly("force", of(&contact::Contact::force), "newtons along n_W; 0 if the contact does not push")
      .def_property_readonly("friction_W", vector_of(&contact::Contact::friction_W), "(3,) newtons on the part")
      .def_property_readonly("part_triangle", of(&contact::Contact::part_triangle),
                             "number of the triangle of the part")
      .def_property_readonly("body_triangle", of(&contact::Contact::obstacle_triangle), "number of that of the body")
      .def("__repr__", [](const NamedContact& contact) {
        return "<glissade.Contact " + std::to_string(contact.tracked.id) + " with '" + contact.body + "'>";
      });
}

using SimulationType = py::class_<GuardedSimulation>;

void add_motion(SimulationType& type) {
  const auto milliseconds = py::arg("milliseconds") = 1.0;
  type.def(
      py::init(&make), py::arg("scene"),
      "Builds the trees of the scene. Raises ValueError, naming the object, for a scene that cannot be simulated.");
  type.def("advance", &advance, py::arg("X_WG"), milliseconds,
           R"(Moves each part towards its ghost; call it once a millisecond of motion.

X_WG: one pose for each part, (7,) or (4, 4) for a scene with one part, else (parts, 7) or (parts, 4, 4). milliseconds: the
time since the call before. A caller that is late passes all of it, so that the part catches up.)");
  type.def(
      "advance_hands", &advance_hands, py::arg("postures"), milliseconds,
      "Moves each hand towards its Posture, and the parts with the hands. None: the tracking of this hand is lost.");
  type.def("follow", &follow, py::arg("X_WG"), milliseconds, py::kw_only(), py::arg("clearance") = false,
           R"(Advances along a path in one call, and returns a Track of all poses and forces.

X_WG: (n, 7) or (n, 4, 4) for a scene with one part, else (n, parts, 7) or (n, parts, 4, 4). milliseconds: the time from one
pose to the next. clearance: also the distance from the first part to the nearest other body, which costs several queries a
pose; 0 only where it touches or overlaps a body from the start. A part begins at the pose of its object, X_WB. For one pose, it moves by
up to 3 mm in each of max_cycles cycles. What a jump of the path leaves, it closes by 0.2 mm in a millisecond (metaphor 'force-feedback'), without a
force. Other Python threads run meanwhile. Ctrl-C ends the path early; the simulation stays where it is.)");
  type.def("follow_hands", &follow_hands, py::arg("X_WR"), py::arg("angles"), milliseconds,
           R"(Like `follow`, for a scene with hands.

X_WR: poses of the wrists, (n, 7) or (n, 4, 4) for one hand, else (n, hands, …). angles: (n, 22) or (n, hands, 22) rad.)");
}

void add_parts(SimulationType& type) {
  const auto part = py::arg("part") = 0;
  const auto pose = [](GuardedSimulation& of, std::size_t p, Eigen::Isometry3d contact::SlidingResult::*member) {
    return to_array(
        of_part(of, p, [&](Simulation& simulation, std::size_t i) { return simulation.result(i).*member; }));
  };
  const auto X_WV = [pose](GuardedSimulation& of, std::size_t p) { return pose(of, p, &contact::SlidingResult::X_WV); };
  const auto X_WG = [pose](GuardedSimulation& of, std::size_t p) { return pose(of, p, &contact::SlidingResult::X_WG); };
  const auto state = [](GuardedSimulation& of, std::size_t p) {
    return of_part(of, p, [](Simulation& simulation, std::size_t i) {
      return std::string(contact::name_of(simulation.result(i).state));
    });
  };
  const auto clearance = [](GuardedSimulation& of, std::size_t p, double farthest) {
    return of_part(of, p, [&](Simulation& simulation, std::size_t i) { return simulation.clearance(i, farthest); });
  };
  type.def_property_readonly("part_names", &part_names, "the names of the parts, in the order of their numbers");
  type.def("X_WV", X_WV, part, "(4, 4) the pose of the visible part");
  type.def("X_WG", X_WG, part, "(4, 4) the pose of its ghost");
  type.def("state", state, part, "one of SLIDING_STATES");
  type.def(
      "wrench", &wrench, part,
      "The force (3,) in N and the torque (3,) in Nm of the contacts on the hands that hold the part, in world axes, "
      "about its compliance point. Exactly zero while no contact pushes.");
  type.def("lag", &lag, part,
           "The displacement from the visible part to its target: translation (3,) in metres, rotation vector (3,).");
  type.def("contacts", &contacts, part, "The touching contacts, a list of Contact.");
  type.def("clearance", clearance, part, py::arg("farthest") = std::numeric_limits<double>::infinity(),
           "Metres from the part to the nearest other body; `farthest` if none is nearer.");
}

void add_hands_of_simulation(SimulationType& type) {
  const auto hand = py::arg("hand") = 0;
  const auto grasp = [](GuardedSimulation& of, std::size_t h) {
    return of_hand(
        of, h, [](Simulation& simulation, std::size_t i) { return grasping::reason_of(simulation.engine().grasp(i)); });
  };
  const auto held_part = [](GuardedSimulation& of, std::size_t h) {
    return of_hand(of, h, [](Simulation& simulation, std::size_t i) { return simulation.engine().held_part(i); });
  };
  const auto posture = [](GuardedSimulation& of, std::size_t h) {
    return of_hand(of, h, [](Simulation& simulation, std::size_t i) { return simulation.engine().posture(i); });
  };
  type.def("grasp", grasp, hand, "A sentence that says what the hand holds or touches, or what a grasp lacks.");
  type.def("held_part", held_part, hand, "The number of the part that the hand holds, or None.");
  type.def("posture", posture, hand, "The Posture of the visible hand, which enters nothing.");
}

}  // namespace

void add_simulation(py::module_& module) {
  add_contact(module);
  add_track(module);
  SimulationType type(module, "Simulation", R"(A scene in motion. Deterministic.

Without hands, the caller leads the parts: each follows its ghost, the pose it would have if nothing were in the way, and
never enters another body. Hands with fingers grasp parts by touch. Several Python threads may use a simulation: each call
waits for the one before.)");
  add_motion(type);
  add_parts(type);
  add_hands_of_simulation(type);
}

}  // namespace glissade::python
