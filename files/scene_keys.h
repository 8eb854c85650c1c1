#pragma once

/// The keys of scene files, in one array for each kind of map. docs/scene_files.md describes each key. A shape has the
/// key `kShapeTypeKey` and the parameters of this shape in `shapes::shape_catalog`. A timed pose has `kTimeKey` and the
/// keys of a pose.

#include <array>
#include <string_view>

namespace glissade::files {

inline constexpr std::array<std::string_view, 3> kSceneKeys{"objects", "script", "goal"};
inline constexpr std::array<std::string_view, 12> kObjectKeys{
    "name",    "mesh",  "shape",        "scale",    "welded",    "pose",
    "movable", "moves", "grip_N_per_m", "margin_m", "gives_way", "compliance_point_m"};
inline constexpr std::string_view kShapeTypeKey = "type";
inline constexpr std::string_view kTimeKey = "t_s";
inline constexpr std::array<std::string_view, 4> kPoseKeys{"position_m", "orientation_wxyz", "orientation_rpy_deg",
                                                           "orientation_matrix"};
inline constexpr std::array<std::string_view, 2> kBoxKeys{"min_m", "max_m"};

}  // namespace glissade::files
