#pragma once

/// Scenes from text, with meshes that are in memory already.

#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include <glissade/simulation/scene.h>

namespace glissade::simulation {

/// Longer files are refused.
inline constexpr std::uintmax_t kLargestSceneFile = std::uintmax_t{1} << 26U;

/// Meshes that need not be read or made, by what a scene file says of them.
struct KnownMeshes {
  std::map<std::tuple<std::string, double, bool>, SceneMesh> files{};                   // path, scale, welded
  std::map<std::pair<std::string, std::map<std::string, double>>, SceneMesh> shapes{};  // type, parameters
};

/// As the public `parse_scene`.
Scene parse_scene(const std::string& text, const std::string& source, const std::filesystem::path& base_folder,
                  KnownMeshes known);

}  // namespace glissade::simulation
