#pragma once

/// A trajectory that stays in its file: of a motion of hours, only two rows at a time are in memory.

#include <chrono>
#include <optional>
#include <string>

#include <Eigen/Geometry>

#include <glissade/apps/text.h>
#include <glissade/files/csv.h>
#include <glissade/geometry/pose_trajectory.h>

namespace glissade::apps {

/// Follows the rows of a file once, from the first to the last. Not thread-safe.
class FollowedTrajectory {
 public:
  /// Reads the file once to check all of it. Throws as `read_trajectory` and `check_duration`.
  explicit FollowedTrajectory(const std::string& path);

  std::chrono::nanoseconds first_time() const { return first_.time; }
  std::chrono::nanoseconds duration() const { return last_.time - first_.time; }
  const Eigen::Isometry3d& first_pose() const { return first_.X_WB; }
  const Eigen::Isometry3d& last_pose() const { return last_.X_WB; }

  /// Holds all positions, metres.
  const Eigen::AlignedBox3d& positions() const { return positions_; }

  /// The pose at a time that is not before that of the last call, as `geometry::PoseTrajectory` gives it. Throws
  /// std::invalid_argument if the file has become shorter meanwhile, and as the constructor.
  Eigen::Isometry3d pose_at(std::chrono::nanoseconds time);

 private:
  /// The rows of the file, each checked.
  class Rows {
   public:
    explicit Rows(const std::string& path);
    std::optional<geometry::TimedPose> next();

   private:
    CsvReader csv_;
    std::optional<std::chrono::nanoseconds> before_;
  };

  std::string path_;
  Rows rows_;
  geometry::TimedPose first_;
  geometry::TimedPose last_;
  geometry::TimedPose next_;        // the end of the present piece
  geometry::PoseTrajectory piece_;  // from the row before
  Eigen::AlignedBox3d positions_;
};

}  // namespace glissade::apps
