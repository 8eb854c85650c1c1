#pragma once

/// The meshes of a glTF document, before anything places or deforms them.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <glissade/geometry/triangle_mesh.h>

#include "io/gltf_accessors.h"
#include "io/gltf_document.h"

namespace glissade::geometry {

/// The triangles of a primitive, in the frame of its mesh.
struct GltfPrimitive {
  const nlohmann::json& entry;
  std::string where;  // its name in messages
  std::vector<Eigen::Vector3d> positions;
  std::vector<Triangle> triangles;

  /// The number of points and corners.
  std::uint64_t size() const { return positions.size() + 3 * triangles.size(); }
};

/// The meshes of a document, each read when it is needed first. `document` and `accessors` must outlive this.
class GltfMeshes {
 public:
  GltfMeshes(GltfDocument& document, GltfAccessors& accessors)
      : document_(document), accessors_(accessors), meshes_(document.size("meshes")) {}

  /// The primitives of mesh `index` that have triangles. Warns of the others.
  const std::vector<GltfPrimitive>& primitives(std::size_t index);

  /// Warns of meshes that nothing has asked for.
  void warn_of_unread() const;

 private:
  void read(const nlohmann::json& entry, const std::string& where, std::vector<GltfPrimitive>& primitives);
  std::vector<Eigen::Vector3d> positions(const nlohmann::json& accessor, const std::string& where);
  std::vector<std::int32_t> corners(const nlohmann::json& entry, std::size_t points, const std::string& where);

  GltfDocument& document_;
  GltfAccessors& accessors_;
  std::vector<std::optional<std::vector<GltfPrimitive>>> meshes_;  // those read so far
};

/// Rejects an accessor of a primitive whose values only an extension of the primitive may have, such as compressed
/// ones.
void check_has_values(const GltfDocument& document, const GltfAccessors& accessors, const nlohmann::json& accessor,
                      const nlohmann::json& primitive, const std::string& where);

}  // namespace glissade::geometry
