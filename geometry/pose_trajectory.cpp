#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

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

PoseTrajectory::PoseTrajectory(std::vector<TimedPose> rows) : rows_(std::move(rows)) {
  if (rows_.empty()) throw std::invalid_argument("A trajectory needs at least one row.");
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    check_row(rows_, i);
    q_WB_.push_back(Eigen::Quaterniond(rows_[i].X_WB.linear()).normalized());
  }
}

std::size_t PoseTrajectory::piece_at(std::chrono::nanoseconds time) const noexcept {
  const auto next = std::upper_bound(rows_.begin(), rows_.end(), time,
                                     [](std::chrono::nanoseconds t, const TimedPose& row) { return t < row.time; });
  return static_cast<std::size_t>(next - rows_.begin()) - 1;
}

Eigen::Isometry3d PoseTrajectory::pose_at(std::chrono::nanoseconds time) const noexcept {
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  const auto set = [&X_WB](const Eigen::Vector3d& p_WB, const Eigen::Quaterniond& q_WB) {
    X_WB.translation() = p_WB;
    X_WB.linear() = q_WB.toRotationMatrix();
    return X_WB;
  };
  if (time <= first_time()) return set(rows_.front().X_WB.translation(), q_WB_.front());
  if (time >= last_time()) return set(rows_.back().X_WB.translation(), q_WB_.back());
  const std::size_t i = piece_at(time);
  const TimedPose& from = rows_[i];
  const TimedPose& to = rows_[i + 1];
  const double part = seconds(time - from.time) / seconds(to.time - from.time);
  return set(from.X_WB.translation() + part * (to.X_WB.translation() - from.X_WB.translation()),
             q_WB_[i].slerp(part, q_WB_[i + 1]));
}

FrameVelocity PoseTrajectory::velocity_at(std::chrono::nanoseconds time) const noexcept {
  if (time < first_time() || time >= last_time()) return {};
  const std::size_t i = piece_at(time);
  const double duration = seconds(rows_[i + 1].time - rows_[i].time);
  const Eigen::AngleAxisd turn_W(q_WB_[i + 1] * q_WB_[i].conjugate());
  return {(rows_[i + 1].X_WB.translation() - rows_[i].X_WB.translation()) / duration,
          turn_W.axis() * (turn_W.angle() / duration)};
}

PoseTrajectory PoseTrajectory::time_scaled(std::chrono::nanoseconds duration) const {
  if (duration <= std::chrono::nanoseconds::zero()) {
    throw std::invalid_argument("The duration of a trajectory must be positive.");
  }
  PoseTrajectory scaled = *this;
  const double factor = rows_.size() > 1 ? seconds(duration) / seconds(this->duration()) : 1.0;
  for (std::size_t i = 1; i < rows_.size(); ++i) {
    const double offset_ns = static_cast<double>((rows_[i].time - first_time()).count()) * factor;
    scaled.rows_[i].time = first_time() + std::chrono::nanoseconds(std::llround(offset_ns));
    if (scaled.rows_[i].time <= scaled.rows_[i - 1].time) {
      throw std::invalid_argument("The duration " + std::to_string(duration.count()) +
                                  " ns is too short for the rows of the trajectory.");
    }
  }
  if (rows_.size() > 1) scaled.rows_.back().time = first_time() + duration;
  return scaled;
}

}  // namespace glissade::geometry
