#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <glissade/devices/hand_pose.h>

#include "envelope/clock_difference.h"
#include "lcm/checked_bus.h"
#include "lcm/hand_pose_message.h"
#include "lcm/link_monitor.h"

namespace glissade::devices {
namespace {

using std::chrono::nanoseconds;

constexpr nanoseconds kNever{std::numeric_limits<std::int64_t>::min()};
constexpr double kLatePeriods = 6.0;    // as for commands
constexpr double kLongestStep_s = 0.1;  // between two poses that give a velocity

double seconds_of(nanoseconds time) noexcept {
  return std::chrono::duration<double>(time).count();
}

nanoseconds patience_of(const HandPoseOptions& options) {
  if (!(options.rate_Hz >= 1.0 && options.rate_Hz <= 100e3))
    throw std::invalid_argument("The rate of a tracker must be 1 to 100000 Hz.");
  return nanoseconds(std::llround(kLatePeriods * 1e9 / options.rate_Hz));
}

/// From the last two poses, with a time between them on the sender's clock. Zero after a pause, in which the hand may
/// have gone any way.
void find_velocity(const TrackedPose& before, nanoseconds time_between, TrackedPose& pose) noexcept {
  const double dt = seconds_of(time_between);
  if (!(dt > 0.0 && dt <= kLongestStep_s)) return;
  pose.v_WT = (pose.X_WT.translation() - before.X_WT.translation()) / dt;
  const Eigen::AngleAxisd turn(pose.X_WT.linear() * before.X_WT.linear().transpose());
  pose.w_WT = turn.axis() * (turn.angle() / dt);
}

}  // namespace

HandPosePublisher::HandPosePublisher(std::shared_ptr<LcmBus> bus, std::int64_t device)
    : bus_(checked_bus(std::move(bus), "The sender of a hand's pose")), device_(device), session_(random_session()) {}

bool HandPosePublisher::publish(const TrackedPose& pose) {
  return bus_->publish(kHandPoseChannel, encode(PoseHeader{.device = device_, .session = session_}, pose));
}

HandPoseSource::HandPoseSource(std::shared_ptr<LcmBus> bus, const HandPoseOptions& options)
    : bus_(checked_bus(std::move(bus), "The receiver of a hand's pose")),
      options_(options),
      monitor_(std::make_unique<LinkMonitor>(options.lease)),
      difference_(std::make_unique<ClockDifference>(patience_of(options))),
      newest_(kNever) {
  subscription_ = bus_->subscribe(kHandPoseChannel, [this](std::span<const std::uint8_t> message) {
    PoseHeader header;
    TrackedPose pose;
    DecodeResult result = decode(message, header, pose);
    if (result == MessageError::kNone && header.device != options_.device) result = MessageError::kOtherReceiver;
    const nanoseconds now = clock_.now();
    if (monitor_->admit(result, {header.device, header.session, pose.sequence}, now)) take(pose, now);
  });
}

HandPoseSource::~HandPoseSource() = default;

void HandPoseSource::take(TrackedPose pose, nanoseconds now) noexcept {
  if (!pose.is_valid) return;
  const nanoseconds sent = pose.time;
  difference_->observe(sent, now);
  pose.time += difference_->value();
  if (last_) pose.time = std::max(pose.time, last_->time);  // a faster message makes the earlier ones older, not newer
  if (last_ && !pose.has_velocity) find_velocity(*last_, sent - last_sent_, pose);
  last_ = pose;
  last_sent_ = sent;
  newest_.store(pose.time, std::memory_order_relaxed);
  poses_.publish(pose);
}

bool HandPoseSource::join(GloveState& state) noexcept {
  has_pose_ = poses_.update() || has_pose_;
  if (!has_pose_) return false;
  const TrackedPose& pose = poses_.value();
  state.X_WH = pose.X_WT;
  state.v_WH = pose.v_WT;
  state.w_WH = pose.w_WT;
  state.time = std::min(state.time, pose.time);
  return true;
}

std::optional<nanoseconds> HandPoseSource::newest() const noexcept {
  const nanoseconds time = newest_.load(std::memory_order_relaxed);
  return time == kNever ? std::nullopt : std::optional(time);
}

LinkStatistics HandPoseSource::statistics() const noexcept {
  return monitor_->statistics();
}

}  // namespace glissade::devices
