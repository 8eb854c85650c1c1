#pragma once

/// Vectors in the messages of Haply's service: objects with the keys x, y and z.

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "haply/json_field.h"

namespace glissade::bridges {

/// Throws as `JsonField`.
inline Eigen::Vector3d vector_of(const JsonField& field) {
  return {field.at("x").number(), field.at("y").number(), field.at("z").number()};
}

inline nlohmann::json json_of(const Eigen::Vector3d& vector) {
  return {{"x", vector.x()}, {"y", vector.y()}, {"z", vector.z()}};
}

}  // namespace glissade::bridges
