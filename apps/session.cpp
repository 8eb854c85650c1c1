#include <algorithm>
#include <numbers>

#include <glissade/apps/hash.h>
#include <glissade/apps/progress.h>
#include <glissade/apps/session.h>

namespace glissade::apps {

namespace {

constexpr double kSeatDistance_m = 2e-3;
constexpr double kSeatAngle_rad = 2.0 * std::numbers::pi / 180.0;

std::uint64_t hash_of(const SessionRecorder& samples) {
  Hash hash;
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

/// The parts of a scene and their poses over the kept ticks. A part at rest repeats its pose, which is checked once.
class PoseCheck {
 public:
  PoseCheck(const SessionRecorder& samples, const HapticScene& scene) : samples_(samples), scene_(scene) {
    for (const ScenePart& part : scene.parts)
      meshes_.emplace_back(part.part_V, &part.part_V->tree.mesh());
    for (const haptics::ScriptedPart& part : scene.moving)
      meshes_.emplace_back(part.part_B, &part.part_B->tree.mesh());
  }

  /// Marks the ticks in which the part collides with an obstacle or with a part of lower number. Returns their number.
  std::int64_t colliding_ticks(std::size_t part) const {
    std::vector<char> collides(samples_.size(), 0);
    const auto X_WV = [&](std::size_t i) { return samples_.part(i, part).X_WV; };
    check(scene_.placed_obstacles, part, X_WV, collides);
    for (std::size_t other = 0; other < part; ++other) {
      const auto X_OV = [&](std::size_t i) -> Eigen::Isometry3d {
        return samples_.part(i, other).X_WV.inverse(Eigen::Isometry) * samples_.part(i, part).X_WV;
      };
      check({{meshes_[other]}}, part, X_OV, collides);
    }
    return std::count(collides.begin(), collides.end(), 1);
  }

 private:
  template <typename PoseAt>
  void check(const std::vector<reference::PlacedMesh>& obstacles, std::size_t part, const PoseAt& pose_at,
             std::vector<char>& collides) const {
    std::vector<Eigen::Isometry3d> poses;
    std::vector<std::size_t> pose_of_tick(samples_.size());
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const Eigen::Isometry3d X = pose_at(i);
      if (poses.empty() || poses.back().matrix() != X.matrix()) poses.push_back(X);
      pose_of_tick[i] = poses.size() - 1;
    }
    if (poses.empty() || obstacles.empty()) return;
    ProgressBar progress("checking poses", static_cast<std::int64_t>(poses.size()));
    const std::vector<char> of_pose = reference::GridCheck(obstacles).collisions(
        *meshes_[part], poses, [&](std::size_t done) { progress.update(static_cast<std::int64_t>(done)); });
    for (std::size_t i = 0; i < samples_.size(); ++i)
      collides[i] = static_cast<char>(collides[i] | of_pose[pose_of_tick[i]]);
  }

  const SessionRecorder& samples_;
  const HapticScene& scene_;
  std::vector<std::shared_ptr<const geometry::TriangleMesh>> meshes_;
};

PartSummary summarize_part(const SessionRecorder& samples, std::size_t p, const HapticScene& scene,
                           const PoseCheck& check) {
  PartSummary summary;
  summary.name = scene.body_names[scene.obstacles.size() + p];
  summary.colliding_poses = check.colliding_ticks(p);
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

HandSummary summarize_hand(const SessionRecorder& samples, std::size_t h, std::int64_t device) {
  HandSummary summary;
  summary.device = device;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const devices::HapticHandState& hand = samples.hand(i, h);
    for (std::size_t k = 0; k < devices::kLimitReasons.size(); ++k)
      summary.limited_ticks[k] += hand.reasons.*devices::kLimitReasons[k].flag ? 1 : 0;
    summary.lagging_ticks += hand.contact_share < 0.5 ? 1 : 0;
    summary.unsolved_ticks += hand.are_contacts_unsolved ? 1 : 0;
    summary.force_max_N = std::max(summary.force_max_N, hand.force_W.norm());
    if (i == 0) continue;
    const double step = (hand.force_W - samples.hand(i - 1, h).force_W).norm();
    summary.force_step_max_N = std::max(summary.force_step_max_N, step);
  }
  return summary;
}

}  // namespace

SessionRecorder::SessionRecorder(std::size_t capacity, std::size_t parts, std::size_t hands)
    : parts_(parts), hands_(hands), ticks_(capacity), part_states_(capacity * parts), hand_states_(capacity * hands) {}

void SessionRecorder::record(const devices::HapticState& sample) noexcept {
  const std::size_t slot = static_cast<std::size_t>(total_) % ticks_.size();
  ticks_[slot] = {sample.time, sample.contact_set_age};
  std::copy_n(sample.parts.begin(), parts_, part_states_.begin() + static_cast<std::ptrdiff_t>(slot * parts_));
  std::copy_n(sample.hands.begin(), hands_, hand_states_.begin() + static_cast<std::ptrdiff_t>(slot * hands_));
  ++total_;
}

std::size_t SessionRecorder::size() const {
  return std::min(static_cast<std::size_t>(total_), ticks_.size());
}

std::size_t SessionRecorder::slot(std::size_t i) const {
  return (static_cast<std::size_t>(total_) - size() + i) % ticks_.size();
}

std::int64_t SessionSummary::colliding_poses() const {
  std::int64_t sum = 0;
  for (const PartSummary& part : parts)
    sum += part.colliding_poses;
  return sum;
}

SessionSummary summarize(const Session& session, const HapticScene& scene) {
  const SessionRecorder& samples = *session.samples;
  SessionSummary summary;
  summary.ticks = session.ticks;
  summary.samples = static_cast<std::int64_t>(samples.size());
  const PoseCheck check(samples, scene);
  for (std::size_t p = 0; p < samples.parts(); ++p)
    summary.parts.push_back(summarize_part(samples, p, scene, check));
  for (std::size_t h = 0; h < samples.hands(); ++h)
    summary.hands.push_back(summarize_hand(samples, h, session.devices[h]));
  summary.hash = hash_of(samples);
  if (samples.size() > 0 && scene.X_WGoal) {
    const Eigen::Isometry3d& X_WV = samples.part(samples.size() - 1, 0).X_WV;
    summary.seat_distance_m = (X_WV.translation() - scene.X_WGoal->translation()).norm();
    const double angle = Eigen::AngleAxisd(X_WV.linear().transpose() * scene.X_WGoal->linear()).angle();
    summary.seat_reached = summary.seat_distance_m <= kSeatDistance_m && angle <= kSeatAngle_rad;
  }
  return summary;
}

}  // namespace glissade::apps
