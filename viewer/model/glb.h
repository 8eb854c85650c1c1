#pragma once

/// A writer of binary glTF 2.0 (GLB), as far as the viewer needs it: meshes on quantized grids, nodes, one scene.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "model/display_mesh.h"

namespace glissade::viewer {

class GlbWriter {
 public:
  /// Adds a mesh and returns its number.
  std::size_t add_mesh(const DisplayMesh& mesh, const std::array<double, 4>& color_rgba);

  /// Adds a node of the scene, at this pose, with a mesh or without.
  void add_node(const std::string& name, const Eigen::Isometry3d& X, std::optional<std::size_t> mesh,
                const nlohmann::json& extras);

  /// The whole file. Throws std::invalid_argument if it would be beyond 4 GiB.
  std::string finish(const nlohmann::json& scene_extras) const;

 private:
  struct Grid {
    Eigen::Vector3d lower;
    double step;
  };

  /// Appends a view of the binary chunk; returns its number. `target` is that of glTF: vertices or indices.
  template <typename Value>
  std::size_t add_view(const std::vector<Value>& values, int target, std::size_t stride);

  /// An accessor of positions on a grid; returns its number.
  std::size_t add_positions(const std::vector<std::array<std::uint16_t, 4>>& positions);

  nlohmann::json nodes_ = nlohmann::json::array();
  nlohmann::json roots_ = nlohmann::json::array();
  nlohmann::json meshes_ = nlohmann::json::array();
  nlohmann::json materials_ = nlohmann::json::array();
  nlohmann::json accessors_ = nlohmann::json::array();
  nlohmann::json views_ = nlohmann::json::array();
  std::vector<Grid> grids_;  // of the meshes
  std::string binary_;
};

}  // namespace glissade::viewer
