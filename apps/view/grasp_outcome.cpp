#include <algorithm>
#include <utility>

#include <glissade/apps/text.h>
#include <glissade/apps/view/grasp_outcome.h>
#include <glissade/apps/view/waiting_hand.h>

namespace glissade::apps {

namespace {

std::string seconds_text(std::int64_t milliseconds) {
  return fixed_text(1e-3 * static_cast<double>(milliseconds), 3) + " s";
}

}  // namespace

GraspOutcome::GraspOutcome(const HapticScene& scene, const grasping::GraspSimulation& simulation,
                           std::vector<std::shared_ptr<const grasping::HandModel>> hands)
    : scene_(scene), simulation_(simulation), models_(std::move(hands)) {
  std::vector<bool> can_be_held(scene.body_names.size(), false);
  for (std::size_t p = 0; p < scene.parts.size(); ++p)
    can_be_held[scene.obstacles.size() + p] = true;
  for (std::size_t h = 0; h < simulation.hand_count(); ++h)
    hands_.push_back({.missed = MissedGrasp(scene.body_names, can_be_held)});
}

void GraspOutcome::add(double time_s, const std::vector<std::optional<grasping::Posture>>& targets) {
  ++ticks_;
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    Hand& hand = hands_[h];
    const auto held = simulation_.held_part(h);
    const std::int32_t part = held ? static_cast<std::int32_t>(*held) : -1;
    hand.grasps += part >= 0 && part != hand.part ? 1 : 0;
    hand.holding_ms += part >= 0 ? 1 : 0;
    hand.missed.note(time_s, simulation_.grasp(h), part >= 0);
    if (simulation_.activity(h) == hands::HandActivity::kWaiting && targets[h]) {
      if (hand.waiting_ms++ == 0) {
        hand.waits_first = "first at " + fixed_text(time_s, 3) + " s: its target is inside an object, there " +
                           nearest_object(scene_, simulation_, *models_[h], *targets[h]);
      }
    }
    hand.part = part;
  }
}

std::vector<std::pair<std::string, std::string>> GraspOutcome::rows() const {
  std::vector<std::pair<std::string, std::string>> rows{
      {"duration", seconds_text(std::max<std::int64_t>(1, ticks_) - 1)}};
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    const Hand& hand = hands_[h];
    std::string text = hand.grasps == 0 ? "holds nothing: " + hand.missed.text()
                       : hand.grasps == 1
                           ? "1 grasp, holds for " + seconds_text(hand.holding_ms)
                           : std::to_string(hand.grasps) + " grasps, holds for " + seconds_text(hand.holding_ms);
    // Nothing else tells that a trajectory begins inside an object: the hand then neither touches nor moves.
    if (hand.waiting_ms > 0) text += "; " + waiting(h);
    rows.emplace_back("hand " + std::to_string(h), text);
  }
  for (std::size_t p = 0; p < scene_.parts.size(); ++p) {
    const Eigen::Vector3d way =
        simulation_.parts().result(p).X_WV.translation() - scene_.parts[p].X_WV_start.translation();
    rows.emplace_back(scene_.body_names[scene_.obstacles.size() + p],
                      "ends " + fixed_text(1e3 * way.norm(), 1) + " mm from where it started");
  }
  return rows;
}

std::string GraspOutcome::waiting(std::size_t hand) const {
  const Hand& waiting = hands_[hand];
  return waiting.waiting_ms == 0 ? "" : "waits for " + seconds_text(waiting.waiting_ms) + ", " + waiting.waits_first;
}

}  // namespace glissade::apps
