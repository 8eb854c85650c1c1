#pragma once

/// The text of a URDF file, parsed by liburdfdom.

#include <filesystem>

#include <Eigen/Geometry>
#include <urdf_model/model.h>
#include <urdf_world/types.h>

namespace glissade::grasping {

/// Throws std::invalid_argument, naming the file, if it cannot be read or parsed, or if its links do not form one tree.
urdf::ModelInterfaceSharedPtr read_urdf_document(const std::filesystem::path& path);

/// A vector of the file.
inline Eigen::Vector3d to_vector(const urdf::Vector3& v) {
  return {v.x, v.y, v.z};
}

inline Eigen::Isometry3d to_pose(const urdf::Pose& pose) {
  const urdf::Rotation& q = pose.rotation;
  return Eigen::Translation3d(to_vector(pose.position)) * Eigen::Quaterniond(q.w, q.x, q.y, q.z);
}

}  // namespace glissade::grasping
