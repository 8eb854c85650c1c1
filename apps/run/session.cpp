#include <algorithm>
#include <cmath>
#include <numbers>

#include <glissade/apps/durations.h>
#include <glissade/apps/run/missed_grasp.h>
#include <glissade/apps/run/session.h>
#include <glissade/apps/run/session_check.h>
#include <glissade/files/hash.h>

namespace glissade::apps {

namespace {

constexpr double kGoalDistance_m = 2e-3;
constexpr double kGoalAngle_rad = 2.0 * std::numbers::pi / 180.0;

std::uint64_t hash_of(const SessionRecorder& samples) {
  files::Hash hash;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (std::size_t p = 0; p < samples.parts(); ++p)
      hash.add(samples.part(i, p).X_WV);
    for (std::size_t h = 0; h < samples.hands(); ++h) {
      hash.add(samples.hand(i, h).force_W);
      hash.add(samples.hand(i, h).torque_V_W);
    }
  }
  return hash.value();
}

PartSummary summarize_part(const SessionRecorder& samples, std::size_t p, const HapticScene& scene,
                           const SessionCheck& check) {
  PartSummary summary;
  summary.name = scene.body_names[scene.obstacles.size() + p];
  summary.colliding_poses = check.colliding_ticks_of_part(p);
  std::int64_t in_contact = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const devices::HapticPartState& part = samples.part(i, p);
    ++summary.state_ticks[static_cast<std::size_t>(part.state)];
    if (i > 0 && part.state != samples.part(i - 1, p).state) ++summary.state_changes;
    in_contact += part.is_in_contact() ? 1 : 0;
    summary.contacts_max = std::max(summary.contacts_max, part.contact_count);
  }
  if (samples.size() > 0) {
    summary.contact_fraction = static_cast<double>(in_contact) / static_cast<double>(samples.size());
  }
  return summary;
}

HandSummary summarize_hand(const Session& session, std::size_t h, const SessionCheck& check) {
  const SessionRecorder& samples = *session.samples;
  HandSummary summary;
  summary.device = session.devices[h];
  summary.has_fingers = session.hand_models[h] != nullptr;
  summary.colliding_postures = check.colliding_ticks_of_hand(h);
  MissedGrasp missed;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const devices::HapticHandState& hand = samples.hand(i, h);
    missed.note(in_seconds(samples.tick(i).time - samples.tick(0).time), grasping::grasp_of(hand.visible),
                hand.part >= 0);
    for (std::size_t k = 0; k < devices::kLimitReasons.size(); ++k)
      summary.limited_ticks[k] += hand.reasons.*devices::kLimitReasons[k].flag ? 1 : 0;
    summary.lagging_ticks += hand.contact_share < 0.5 ? 1 : 0;
    summary.unsolved_ticks += hand.are_contacts_unsolved ? 1 : 0;
    summary.force_max_N = std::max(summary.force_max_N, hand.force_W.norm());
    summary.holding_ticks += hand.part >= 0 ? 1 : 0;
    for (const double torque : hand.joint_torques)
      summary.joint_torque_max_Nm = std::max(summary.joint_torque_max_Nm, std::abs(torque));
    const std::int32_t before = i == 0 ? -1 : samples.hand(i - 1, h).part;
    summary.grasps += hand.part >= 0 && hand.part != before ? 1 : 0;
    if (i == 0) continue;
    const double step = (hand.force_W - samples.hand(i - 1, h).force_W).norm();
    summary.force_step_max_N = std::max(summary.force_step_max_N, step);
  }
  if (summary.has_fingers) summary.missed_grasp = missed.text();
  return summary;
}

}  // namespace

std::int64_t SessionSummary::colliding_poses() const {
  std::int64_t sum = 0;
  for (const PartSummary& part : parts)
    sum += part.colliding_poses;
  for (const HandSummary& hand : hands)
    sum += hand.colliding_postures;
  return sum;
}

SessionSummary summarize(const Session& session, const HapticScene& scene, const std::function<bool()>& should_end) {
  const SessionRecorder& samples = *session.samples;
  SessionSummary summary;
  summary.ticks = session.ticks;
  summary.samples = static_cast<std::int64_t>(samples.size());
  const SessionCheck check(samples, scene, session.hand_models, should_end);
  summary.checked = check.checked_ticks();
  for (std::size_t p = 0; p < samples.parts(); ++p)
    summary.parts.push_back(summarize_part(samples, p, scene, check));
  for (std::size_t h = 0; h < samples.hands(); ++h)
    summary.hands.push_back(summarize_hand(session, h, check));
  summary.hash = hash_of(samples);
  if (samples.size() > 0 && scene.X_WGoal) {
    const Eigen::Isometry3d& X_WV = samples.part(samples.size() - 1, 0).X_WV;
    summary.goal_distance_m = (X_WV.translation() - scene.X_WGoal->translation()).norm();
    const double angle = Eigen::AngleAxisd(X_WV.linear().transpose() * scene.X_WGoal->linear()).angle();
    summary.goal_reached = summary.goal_distance_m <= kGoalDistance_m && angle <= kGoalAngle_rad;
  }
  return summary;
}

std::string name_of_state(std::size_t number) {
  return std::string(devices::name_of(devices::part_state_from_number(static_cast<std::int32_t>(number))));
}

}  // namespace glissade::apps
