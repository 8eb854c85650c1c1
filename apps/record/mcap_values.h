#pragma once

/// The values of which Foxglove's messages consist, as JSON, and the names of frames.

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

namespace glissade::apps {

/// The frame in which all others have their poses.
inline constexpr const char* kWorldFrame = "world";

/// Such as "part_0".
std::string numbered(const std::string& name, std::size_t number);

nlohmann::json time_json(std::chrono::nanoseconds time);
nlohmann::json vector_json(const Eigen::Vector3d& v);
/// A colour of the page, by its name.
nlohmann::json color_json(std::string_view name, double opacity = 1.0);
/// The orientation has w ≥ 0, here and below.
nlohmann::json pose_json(const Eigen::Isometry3d& X);
/// The pose of the frame `child` in the world.
nlohmann::json transform_json(std::chrono::nanoseconds time, const std::string& child, const Eigen::Isometry3d& X_WC);

}  // namespace glissade::apps
