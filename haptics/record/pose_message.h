#pragma once

/// Fields that several messages of a recording share.

#include <algorithm>
#include <chrono>
#include <cstddef>

#include <Eigen/Geometry>

#include <glissade/haptics/contact_set.h>
#include <glissade/lcmtypes/ghost_t.hpp>
#include <glissade/lcmtypes/rigid_pose_t.hpp>

namespace glissade::haptics {

template <std::size_t N>
void put(const double* from, double (&to)[N]) {
  std::copy_n(from, N, to);
}

inline Eigen::Vector3d vector_of(const double (&values)[3]) {
  return Eigen::Vector3d(values);
}

inline rigid_pose_t pose_message(const Eigen::Isometry3d& X) {
  rigid_pose_t message;
  const Eigen::Vector3d p = X.translation();
  const Eigen::Matrix3d R = X.linear();
  put(p.data(), message.position_m);
  put(R.data(), message.rotation);
  return message;
}

inline Eigen::Isometry3d pose_of(const rigid_pose_t& message) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = Eigen::Vector3d(message.position_m);
  X.linear() = Eigen::Matrix3d(message.rotation);
  return X;
}

inline ghost_t ghost_message(const GhostOfPart& ghost) {
  ghost_t message;
  message.X_WG = pose_message(ghost.X_WG);
  message.held = ghost.is_held ? 1 : 0;
  message.hold = ghost.hold;
  message.release = ghost.release;
  return message;
}

inline GhostOfPart ghost_of(const ghost_t& message) {
  return {
      .X_WG = pose_of(message.X_WG), .is_held = message.held != 0, .hold = message.hold, .release = message.release};
}

}  // namespace glissade::haptics
