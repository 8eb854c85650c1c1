#include <stdexcept>
#include <vector>

#include <glissade/apps/files/followed_trajectory.h>
#include <glissade/apps/files/hand_script.h>
#include <glissade/files/pose_files.h>

namespace glissade::apps {

FollowedTrajectory::Rows::Rows(const std::string& path) : csv_(path, trajectory_columns()) {}

std::optional<geometry::TimedPose> FollowedTrajectory::Rows::next() {
  if (!csv_.next()) return std::nullopt;
  const geometry::TimedPose row = timed_pose(csv_.row(), csv_.where(), before_);
  before_ = row.time;
  return row;
}

FollowedTrajectory::FollowedTrajectory(const std::string& path)
    : path_(path), rows_(path), first_(rows_.next().value()), last_(first_), next_(first_), piece_({first_}) {
  for (std::optional<geometry::TimedPose> row = first_; row; row = rows_.next()) {
    last_ = *row;
    positions_.extend(Eigen::Vector3d(row->X_WB.translation()));
  }
  check_duration(duration(), path);
  rows_ = Rows(path);
  next_ = rows_.next().value();
}

Eigen::Isometry3d FollowedTrajectory::pose_at(std::chrono::nanoseconds time) {
  while (next_.time <= time && next_.time < last_.time) {
    const std::optional<geometry::TimedPose> row = rows_.next();
    if (!row) throw std::invalid_argument(path_ + ": has become shorter while it was read");
    piece_ = geometry::PoseTrajectory({next_, *row});
    next_ = *row;
  }
  return piece_.pose_at(time);
}

}  // namespace glissade::apps
