#include <algorithm>
#include <bit>
#include <numbers>

#include <glissade/apps/progress.h>
#include <glissade/apps/session.h>

namespace glissade::apps {

namespace {

constexpr double kSeatDistance_m = 2e-3;
constexpr double kSeatAngle_rad = 2.0 * std::numbers::pi / 180.0;

/// FNV-1a over the bits of numbers.
class Hash {
 public:
  void add(double value) {
    for (auto bits = std::bit_cast<std::uint64_t>(value), i = std::uint64_t{0}; i < 8; ++i) {
      state_ = (state_ ^ ((bits >> (8 * i)) & 0xffU)) * 0x100000001b3U;
    }
  }
  void add(const Eigen::Vector3d& v) {
    for (int i = 0; i < 3; ++i)
      add(v[i]);
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325U;
};

std::uint64_t hash_of(const std::vector<devices::HapticState>& samples) {
  Hash hash;
  for (const devices::HapticState& sample : samples) {
    for (int column = 0; column < 3; ++column)
      hash.add(Eigen::Vector3d(sample.X_WV.linear().col(column)));
    hash.add(Eigen::Vector3d(sample.X_WV.translation()));
    hash.add(sample.force_on_hand_W);
    hash.add(sample.torque_on_hand_V_W);
  }
  return hash.value();
}

std::int64_t count_colliding(const std::vector<devices::HapticState>& samples, const HapticScene& scene) {
  // A part at rest repeats its pose, which is checked once.
  std::vector<Eigen::Isometry3d> poses;
  std::vector<std::int64_t> repetitions;
  for (const devices::HapticState& sample : samples) {
    if (!poses.empty() && poses.back().matrix() == sample.X_WV.matrix()) {
      ++repetitions.back();
    } else {
      poses.push_back(sample.X_WV);
      repetitions.push_back(1);
    }
  }
  if (poses.empty()) return 0;
  ProgressBar progress("checking poses", static_cast<std::int64_t>(poses.size()));
  const std::vector<char> colliding =
      reference::GridCheck(scene.placed_obstacles).collisions(scene.part_V->tree.mesh(), poses, [&](std::size_t done) {
        progress.update(static_cast<std::int64_t>(done));
      });
  std::int64_t count = 0;
  for (std::size_t i = 0; i < poses.size(); ++i)
    count += colliding[i] != 0 ? repetitions[i] : 0;
  return count;
}

void count_states(const std::vector<devices::HapticState>& samples, SessionSummary& summary) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    ++summary.state_ticks[static_cast<std::size_t>(samples[i].part_state)];
    if (i > 0 && samples[i].part_state != samples[i - 1].part_state) ++summary.state_changes;
  }
}

void count_limits(const std::vector<devices::HapticState>& samples, SessionSummary& summary) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (std::size_t k = 0; k < devices::kLimitReasons.size(); ++k)
      summary.limited_ticks[k] += samples[i].reasons.*devices::kLimitReasons[k].flag ? 1 : 0;
    summary.lagging_ticks += samples[i].contact_share < 0.5 ? 1 : 0;
    summary.unsolved_ticks += samples[i].are_contacts_unsolved ? 1 : 0;
    if (i == 0) continue;
    const double step = (samples[i].force_on_hand_W - samples[i - 1].force_on_hand_W).norm();
    summary.force_step_max_N = std::max(summary.force_step_max_N, step);
  }
}

}  // namespace

std::vector<devices::HapticState> SessionRecorder::samples() const {
  const auto kept = std::min(static_cast<std::size_t>(total_), samples_.size());
  const std::size_t first = static_cast<std::size_t>(total_) - kept;
  std::vector<devices::HapticState> result;
  result.reserve(kept);
  for (std::size_t i = 0; i < kept; ++i)
    result.push_back(samples_[(first + i) % samples_.size()]);
  return result;
}

SessionSummary summarize(const Session& session, const HapticScene& scene) {
  SessionSummary summary;
  summary.ticks = session.ticks;
  summary.samples = static_cast<std::int64_t>(session.samples.size());
  summary.colliding_poses = count_colliding(session.samples, scene);
  summary.hash = hash_of(session.samples);
  count_states(session.samples, summary);
  count_limits(session.samples, summary);
  std::int64_t in_contact = 0;
  for (const devices::HapticState& sample : session.samples) {
    in_contact += sample.is_in_contact ? 1 : 0;
    summary.contacts_max = std::max(summary.contacts_max, sample.contact_count);
    summary.force_max_N = std::max(summary.force_max_N, sample.force_on_hand_W.norm());
  }
  if (session.samples.empty()) return summary;
  summary.contact_fraction = static_cast<double>(in_contact) / static_cast<double>(summary.samples);
  if (scene.X_WGoal) {
    const Eigen::Isometry3d& X_WV = session.samples.back().X_WV;
    summary.seat_distance_m = (X_WV.translation() - scene.X_WGoal->translation()).norm();
    const double angle = Eigen::AngleAxisd(X_WV.linear().transpose() * scene.X_WGoal->linear()).angle();
    summary.seat_reached = summary.seat_distance_m <= kSeatDistance_m && angle <= kSeatAngle_rad;
  }
  return summary;
}

}  // namespace glissade::apps
