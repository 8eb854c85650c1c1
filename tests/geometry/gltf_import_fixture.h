#pragma once

/// The fixture of the tests of glTF: a document of one triangle, and what becomes of it.

#include <string>
#include <vector>

#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/geometry/mesh_import.h>

#include "gltf_writer.h"
#include "mesh_import_fixture.h"

namespace glissade::geometry {

using Point = Eigen::Vector3d;

MATCHER_P(Near, expected, "") {
  return (arg - expected).norm() < 1e-12;
}

class GltfImport : public MeshImport {
 protected:
  /// A mesh of one triangle (0, 0, 0), (1, 0, 0), (0, 1, 0), its points in accessor 0. No node has it yet.
  static GltfWriter triangle() {
    GltfWriter file;
    file.add_accessor(bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}), 5126, "VEC3", 3);
    file.add_mesh({{{"attributes", {{"POSITION", 0}}}}});
    return file;
  }
  static nlohmann::json& primitive_of(GltfWriter& file) { return file.root["meshes"][0]["primitives"][0]; }

  ImportedMesh import(const GltfWriter& file) const { return import_mesh(folder_.write("a.glb", file.glb())); }

  /// The vertices of a mesh of which nothing is to be told.
  std::vector<Eigen::Vector3d> vertices(const GltfWriter& file) const {
    const ImportedMesh imported = import(file);
    EXPECT_THAT(imported.warnings, testing::IsEmpty());
    return imported.mesh.vertices;
  }
  std::string error(const GltfWriter& file) const { return error_of("a.glb", file.glb()); }
};

}  // namespace glissade::geometry
