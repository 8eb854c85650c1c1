#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <glissade/geometry/pose_trajectory.h>

namespace glissade::geometry {
namespace {

double seconds(std::chrono::nanoseconds time) {
  return std::chrono::duration<double>(time).count();
}

bool is_rotation(const Eigen::Matrix3d& R) {
  constexpr double kTolerance = 1e-3;
  return (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= kTolerance && R.determinant() > 0.0;
}

void check_row(const std::vector<TimedPose>& rows, std::size_t i) {
  const std::string row = "Row " + std::to_string(i) + " of the trajectory";
  if (i > 0 && rows[i].time <= rows[i - 1].time) {
    throw std::invalid_argument(row + ": its time " + std::to_string(seconds(rows[i].time)) +
                                " s does not rise above that of the row before.");
  }
  if (!rows[i].X_WB.matrix().allFinite()) throw std::invalid_argument(row + ": its pose is not finite.");
  if (!is_rotation(rows[i].X_WB.linear())) throw std::invalid_argument(row + ": its orientation is not a rotation.");
}

}  // namespace

PoseTrajectory::PoseTrajectory(const std::vector<TimedPose>& rows) {
  if (rows.empty()) throw std::invalid_argument("A trajectory needs at least one row.");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    check_row(rows, i);
    times_.push_back(rows[i].time);
    p_WB_.push_back(rows[i].X_WB.translation());
    q_WB_.push_back(Eigen::Quaterniond(rows[i].X_WB.linear()).normalized());
  }
}

std::size_t PoseTrajectory::piece_at(std::chrono::nanoseconds time) const noexcept {
  return static_cast<std::size_t>(std::upper_bound(times_.begin(), times_.end(), time) - times_.begin()) - 1;
}

Eigen::Isometry3d PoseTrajectory::pose_at(std::chrono::nanoseconds time) const noexcept {
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  const auto set = [&X_WB](const Eigen::Vector3d& p_WB, const Eigen::Quaterniond& q_WB) {
    X_WB.translation() = p_WB;
    X_WB.linear() = q_WB.toRotationMatrix();
    return X_WB;
  };
  if (time <= first_time()) return set(p_WB_.front(), q_WB_.front());
  if (time >= last_time()) return set(p_WB_.back(), q_WB_.back());
  const std::size_t i = piece_at(time);
  const double part = seconds(time - times_[i]) / seconds(times_[i + 1] - times_[i]);
  return set(p_WB_[i] + part * (p_WB_[i + 1] - p_WB_[i]), q_WB_[i].slerp(part, q_WB_[i + 1]));
}

FrameVelocity PoseTrajectory::velocity_at(std::chrono::nanoseconds time) const noexcept {
  if (time < first_time() || time >= last_time()) return {};
  const std::size_t i = piece_at(time);
  const double duration = seconds(times_[i + 1] - times_[i]);
  const Eigen::AngleAxisd turn_W(q_WB_[i + 1] * q_WB_[i].conjugate());
  return {(p_WB_[i + 1] - p_WB_[i]) / duration, turn_W.axis() * (turn_W.angle() / duration)};
}

PoseTrajectory PoseTrajectory::time_scaled(std::chrono::nanoseconds duration) const {
  if (duration <= std::chrono::nanoseconds::zero()) {
    throw std::invalid_argument("The duration of a trajectory must be positive.");
  }
  PoseTrajectory scaled = *this;
  const double factor = times_.size() > 1 ? seconds(duration) / seconds(this->duration()) : 1.0;
  for (std::size_t i = 1; i < times_.size(); ++i) {
    const double offset_ns = static_cast<double>((times_[i] - first_time()).count()) * factor;
    scaled.times_[i] = first_time() + std::chrono::nanoseconds(std::llround(offset_ns));
    if (scaled.times_[i] <= scaled.times_[i - 1]) {
      throw std::invalid_argument("The duration " + std::to_string(duration.count()) +
                                  " ns is too short for the rows of the trajectory.");
    }
  }
  if (times_.size() > 1) scaled.times_.back() = first_time() + duration;
  return scaled;
}

}  // namespace glissade::geometry
