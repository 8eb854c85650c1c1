// The haptic loop of the C interface.

#include <stdexcept>
#include <string>
#include <vector>

#include "call.h"
#include "convert.h"
#include "objects.h"

namespace glissade::c {

namespace {

/// What a renderer sees before the first tick.
devices::HapticState at_start(const simulation::Simulation& simulation, std::size_t hands) {
  const contact::MultiPartSliding& parts = simulation.engine().parts();
  devices::HapticState state;
  state.part_count = static_cast<std::int32_t>(parts.part_count());
  state.hand_count = static_cast<std::int32_t>(hands);
  for (std::size_t p = 0; p < parts.part_count(); ++p)
    state.parts[p].X_WV = state.parts[p].X_WG = parts.result(p).X_WV;
  return state;
}

GlissadeHandFrame frame_of(const devices::HapticHandState& hand) noexcept {
  GlissadeHandFrame frame{};
  frame.part = hand.part;
  frame.reasons = devices::to_bits(hand.reasons);
  frame.glove_reasons = devices::to_bits(hand.glove_reasons);
  copy(hand.force_W, frame.force_N);
  copy(hand.torque_V_W, frame.torque_Nm);
  frame.energy_J = devices::energy_left(hand);
  frame.X_WH = pose_of(hand.visible.X_WH);
  copy(hand.visible.angles, frame.joint_angles_rad);
  frame.activity = static_cast<std::int32_t>(hand.visible.activity);
  frame.grasp = static_cast<std::int32_t>(hand.visible.grasp);
  return frame;
}

void write(const devices::HapticState& state, GlissadeFrame& frame) noexcept {
  frame = {};
  frame.tick = state.sequence;
  frame.time_ns = state.time.count();
  frame.part_count = state.part_count;
  frame.hand_count = state.hand_count;
  frame.contact_count = state.contact_count;
  for (std::size_t p = 0; p < static_cast<std::size_t>(state.part_count); ++p) {
    const devices::HapticPartState& part = state.parts[p];
    frame.parts[p] = {pose_of(part.X_WV), pose_of(part.X_WG), static_cast<std::int32_t>(part.state),
                      part.contact_count};
  }
  for (std::size_t h = 0; h < static_cast<std::size_t>(state.hand_count); ++h)
    frame.hands[h] = frame_of(state.hands[h]);
  for (std::size_t c = 0; c < static_cast<std::size_t>(state.contact_count); ++c) {
    const devices::HapticContact& contact = state.contacts[c];
    const Eigen::Isometry3d& X_WV = state.parts[static_cast<std::size_t>(contact.part)].X_WV;
    frame.contacts[c].part = contact.part;
    copy(X_WV * contact.p_V.cast<double>(), frame.contacts[c].point_m);
    copy(contact.n_W.cast<double>(), frame.contacts[c].normal);
  }
}

/// The last frame, without the force that has faded since.
void show_end(ServerObject& object) {
  const std::lock_guard lock(object.frame_mutex);
  devices::HapticState last = object.frames.latest();
  for (devices::HapticHandState& hand : last.hands) {
    hand.force_W.setZero();
    hand.torque_V_W.setZero();
    hand.reasons.is_stopped = true;
  }
  object.frames.publish(last);
}

/// Claims the simulation and the gloves, and starts the loop. The mutex of the simulation is held.
void start(ServerObject& object) {
  static_assert(GLISSADE_MAX_PARTS == devices::kHapticParts && GLISSADE_MAX_HANDS == devices::kHapticHands);
  static_assert(GLISSADE_MAX_CONTACTS == devices::kHapticContacts && GLISSADE_JOINTS == hands::kJoints);
  object.claims.emplace_back(object.simulation->in_use, "the simulation");
  std::vector<haptics::HandInLoop<devices::GloveDevice>> hands;
  for (std::size_t g = 0; g < object.gloves.size(); ++g) {
    object.claims.emplace_back(object.gloves[g]->in_use, "gloves[" + std::to_string(g) + "]");
    hands.emplace_back(&object.gloves[g]->device());
  }
  object.frames.publish(at_start(object.simulation->simulation, hands.size()));
  realtime::TripleBuffer<devices::HapticState>& frames = object.frames;
  object.server = std::make_unique<haptics::HapticServer>(
      hands, object.simulation->simulation.engine(),
      haptics::HapticServerOptions{.sink = [&frames](const devices::HapticState& state) { frames.publish(state); }});
}

}  // namespace

}  // namespace glissade::c

using namespace glissade::c;
using namespace glissade;

GlissadeStatus glissade_server_start(GlissadeSimulation simulation, const GlissadeGlove* glove_handles,
                                     size_t glove_count, GlissadeServer* server) {
  return call([&] {
    at(server, "server");
    array(glove_handles, glove_count, "gloves");
    if (glove_count < 1 || glove_count > GLISSADE_MAX_HANDS)
      throw std::invalid_argument("glove_count must be from 1 to 4, but is " + std::to_string(glove_count));
    auto object = std::make_shared<ServerObject>();
    object->simulation = simulations().find(simulation.id);
    for (std::size_t g = 0; g < glove_count; ++g)
      object->gloves.push_back(gloves().find(glove_handles[g].id));
    const std::lock_guard lock(object->simulation->mutex);
    start(*object);
    server->id = servers().add(std::move(object));
  });
}

GlissadeStatus glissade_server_stop(GlissadeServer server) {
  return call_with(servers(), server.id, [](ServerObject& object) {
    object.server->stop();
    object.claims.clear();
    show_end(object);
  });
}

GlissadeStatus glissade_server_free(GlissadeServer server) {
  return call([&] {
    const std::shared_ptr<ServerObject> object = servers().remove(server.id);
    const std::lock_guard lock(object->mutex);
    object->server->stop();  // now, and not in the thread of the last one that uses it
    object->claims.clear();
  });
}

GlissadeStatus glissade_server_check(GlissadeServer server) {
  return call_with(servers(), server.id, [](const ServerObject& object) {
    if (object.server->has_failed()) throw std::runtime_error(object.server->failure());
  });
}

GlissadeStatus glissade_server_frame(GlissadeServer server, GlissadeFrame* frame) {
  return call([&] {
    at(frame, "frame");
    const std::shared_ptr<ServerObject> object = servers().find(server.id);
    const std::lock_guard lock(object->frame_mutex);
    write(object->frames.latest(), *frame);
  });
}

GlissadeStatus glissade_server_statistics(GlissadeServer server, GlissadeStatistics* statistics) {
  return call_with(servers(), server.id, [&](const ServerObject& object) {
    const realtime::ThreadScheduling& scheduling = object.server->scheduling();
    at(statistics, "statistics") = {.ticks = object.server->ticks(),
                                    .late_ticks = object.server->late_ticks(),
                                    .has_real_time_priority = scheduling.is_fifo ? 1 : 0,
                                    .has_locked_memory = scheduling.has_locked_memory ? 1 : 0};
  });
}

GlissadeStatus glissade_server_grasp(GlissadeServer server, size_t hand, size_t part) {
  return call_with(servers(), server.id, [&](ServerObject& object) {
    if (!object.server->grasp(hand, part))
      throw std::invalid_argument("hand " + std::to_string(hand) + " cannot take part " + std::to_string(part) +
                                  ": one of them does not exist, or the hand has fingers");
  });
}

GlissadeStatus glissade_server_release(GlissadeServer server, size_t hand) {
  return call_with(servers(), server.id, [&](ServerObject& object) {
    if (!object.server->release(hand)) throw std::invalid_argument("there is no hand " + std::to_string(hand));
  });
}

GlissadeStatus glissade_server_emergency_stop(GlissadeServer server) {
  return call([&] { servers().find(server.id)->server->emergency_stop(); });
}
