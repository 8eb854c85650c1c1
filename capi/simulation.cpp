// Simulations of the C interface.

#include <algorithm>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "call.h"
#include "convert.h"
#include "objects.h"

namespace glissade::c {

namespace {

/// A call for which no server may use the simulation.
template <typename Work>
GlissadeStatus with_simulation(GlissadeSimulation handle, const Work& work) noexcept {
  return call_with(simulations(), handle.id, [&](SimulationObject& object) {
    if (object.in_use) throw std::invalid_argument("the simulation is in use by a server");
    work(object.simulation);
  });
}

void check_part(const simulation::Simulation& simulation, std::size_t part) {
  if (part < simulation.part_count()) return;
  throw std::invalid_argument("there is no part " + std::to_string(part) + ": the simulation has " +
                              std::to_string(simulation.part_count()));
}

std::int32_t state_of(contact::SlidingState state) {
  switch (state) {
    case contact::SlidingState::kReleased:
      return GLISSADE_PART_RELEASED;
    case contact::SlidingState::kFree:
      return GLISSADE_PART_FREE;
    case contact::SlidingState::kSliding:
      return GLISSADE_PART_SLIDING;
    case contact::SlidingState::kResting:
      return GLISSADE_PART_RESTING;
    case contact::SlidingState::kCatchingUp:
      return GLISSADE_PART_CATCHING_UP;
  }
  return GLISSADE_PART_UNKNOWN;
}

}  // namespace

}  // namespace glissade::c

using namespace glissade::c;
using namespace glissade;

GlissadeStatus glissade_simulation_new(GlissadeScene scene, GlissadeSimulation* simulation) {
  return call([&] {
    at(simulation, "simulation");
    const std::shared_ptr<SceneObject> object = scenes().find(scene.id);
    const std::lock_guard lock(object->mutex);
    simulation->id = simulations().add(std::make_shared<SimulationObject>(object->scene));
  });
}

GlissadeStatus glissade_simulation_free(GlissadeSimulation simulation) {
  return call([&] { simulations().remove(simulation.id); });
}

GlissadeStatus glissade_simulation_advance(GlissadeSimulation handle, const GlissadePose* ghosts, size_t ghost_count,
                                           double milliseconds) {
  return with_simulation(handle, [&](simulation::Simulation& simulation) {
    array(ghosts, ghost_count, "ghosts");
    std::vector<Eigen::Isometry3d> X_WG(std::min(ghost_count, simulation.part_count() + 1));  // the wrong count is told
    for (std::size_t i = 0; i < X_WG.size(); ++i)
      X_WG[i] = pose_of(ghosts[i], "ghosts");
    simulation.advance(X_WG, milliseconds);
  });
}

GlissadeStatus glissade_simulation_part_count(GlissadeSimulation handle, size_t* count) {
  return call([&] { at(count, "count") = simulations().find(handle.id)->simulation.part_count(); });
}

GlissadeStatus glissade_simulation_find_part(GlissadeSimulation handle, const char* name, size_t* part) {
  return call([&] {
    at(part, "part");
    const simulation::SceneBodies& bodies = simulations().find(handle.id)->simulation.bodies();
    const std::optional<std::size_t> number = bodies.part_number(&at(name, "name"));
    if (!number)
      throw std::invalid_argument(std::string("there is no part '") + name + "'; the parts are " + bodies.part_names());
    *part = *number;
  });
}

GlissadeStatus glissade_simulation_part(GlissadeSimulation handle, size_t part, GlissadePart* out) {
  return with_simulation(handle, [&](const simulation::Simulation& simulation) {
    at(out, "out");
    check_part(simulation, part);
    const contact::SlidingResult& result = simulation.result(part);
    const contact::Wrench wrench = simulation.wrench(part);
    *out = {.X_WV = pose_of(result.X_WV),
            .X_WG = pose_of(result.X_WG),
            .state = state_of(result.state),
            .contact_count = result.pushing,
            .force_N = {wrench.f.x(), wrench.f.y(), wrench.f.z()},
            .torque_Nm = {wrench.t.x(), wrench.t.y(), wrench.t.z()}};
  });
}

GlissadeStatus glissade_simulation_contacts(GlissadeSimulation handle, size_t part, GlissadeContact* contacts,
                                            size_t capacity, size_t* count) {
  return with_simulation(handle, [&](simulation::Simulation& simulation) {
    at(count, "count");
    array(contacts, capacity, "contacts");
    check_part(simulation, part);
    const std::span<const contact::TrackedContact> all = simulation.contacts(part);
    for (std::size_t i = 0; i < std::min(capacity, all.size()); ++i) {
      const contact::Contact& contact = all[i].contact;
      contacts[i] = {.id = all[i].id,
                     .body = contact.obstacle,
                     .padding = 0,
                     .point_m = {contact.p_W.x(), contact.p_W.y(), contact.p_W.z()},
                     .normal = {contact.n_W.x(), contact.n_W.y(), contact.n_W.z()},
                     .gap_m = contact.gap,
                     .force_N = contact.force};
    }
    *count = all.size();
  });
}

GlissadeStatus glissade_simulation_clearance(GlissadeSimulation handle, size_t part, double* clearance_m) {
  return with_simulation(handle, [&](simulation::Simulation& simulation) {
    at(clearance_m, "clearance_m");
    check_part(simulation, part);
    *clearance_m = simulation.clearance(part);
  });
}

GlissadeStatus glissade_simulation_body_name(GlissadeSimulation handle, int32_t body, const char** name) {
  return call([&] { at(name, "name") = simulations().find(handle.id)->simulation.name_of_body(body).c_str(); });
}
