// Default weights of morph targets in glTF, 3.7.2.2: those of the node, or else of the mesh, or else zeros.

#include <string>

#include "gltf_import_fixture.h"

namespace glissade::geometry {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

class GltfMorph : public GltfImport {
 protected:
  /// A triangle with a target that lifts point 1 by 2, and a sparse one that lifts point 2 by 8.
  static GltfWriter two_targets() {
    GltfWriter file = triangle();
    const std::size_t dense = file.add_accessor(bytes_of<float>({0, 0, 0, 0, 0, 2, 0, 0, 0}), 5126, "VEC3", 3);
    const std::size_t sparse = file.add_zeros(5126, "VEC3", 3);
    const std::size_t indices = file.add_view(bytes_of<std::uint16_t>({2}));
    const std::size_t values = file.add_view(bytes_of<float>({0, 0, 8}));
    file.root["accessors"][sparse]["sparse"] = {{"count", 1},
                                                {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                                {"values", {{"bufferView", values}}}};
    primitive_of(file)["targets"] = {{{"POSITION", dense}}, {{"POSITION", sparse}}};
    file.add_node({{"mesh", 0}});
    return file;
  }
};

TEST_F(GltfMorph, WeightsOfTheMeshAreTheDefault) {
  GltfWriter file = two_targets();
  EXPECT_THAT(vertices(file), ElementsAre(Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)));
  file.root["meshes"][0]["weights"] = {0.5, 0.25};
  EXPECT_THAT(vertices(file), ElementsAre(Point(0, 0, 0), Point(1, 0, 1), Point(0, 1, 2)));
}

TEST_F(GltfMorph, NodeWeightsOverrideMeshWeights) {
  GltfWriter file = two_targets();
  file.root["meshes"][0]["weights"] = {0.5, 0.25};
  file.root["nodes"][0]["weights"] = {-1, 0};
  file.add_node({{"mesh", 0}, {"weights", {0, 0}}, {"translation", {5, 0, 0}}});
  EXPECT_THAT(vertices(file), ElementsAre(Point(0, 0, 0), Point(1, 0, -2), Point(0, 1, 0), Point(5, 0, 0),
                                          Point(6, 0, 0), Point(5, 1, 0)));
}

/// Targets displace points before joints place them: (0, 0, 2) is scaled by 10.
TEST_F(GltfMorph, TargetsComeBeforeSkins) {
  GltfWriter file = two_targets();
  json& attributes = primitive_of(file)["attributes"];
  attributes["JOINTS_0"] = file.add_accessor(std::string(12, '\0'), 5121, "VEC4", 3);
  attributes["WEIGHTS_0"] = file.add_accessor(bytes_of<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}), 5126, "VEC4", 3);
  file.root["skins"] = {{{"joints", {1}}}};
  file.root["nodes"][0] = {{"mesh", 0}, {"skin", 0}, {"weights", {1, 0}}};
  file.add_node({{"scale", {10, 10, 10}}});
  EXPECT_THAT(vertices(file), ElementsAre(Point(0, 0, 0), Point(10, 0, 20), Point(0, 10, 0)));
}

/// A target of normals only leaves the points where they are. One of bytes is quantized.
TEST_F(GltfMorph, TargetsOfNormalsAndQuantizedPositions) {
  GltfWriter file = two_targets();
  json& targets = primitive_of(file)["targets"];
  targets[0] = {{"NORMAL", 0}};
  targets[1]["POSITION"] =
      file.add_accessor(bytes_of<std::int8_t>({0, 0, 0, 9, 0, 0, 0, 9, 0, 0, -127, 9}), 5120, "VEC3", 3, 4);
  file.root["accessors"].back()["normalized"] = true;
  file.root["extensionsUsed"] = {"KHR_mesh_quantization"};
  file.root["meshes"][0]["weights"] = {1, 3};
  EXPECT_THAT(vertices(file), ElementsAre(Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, -3)));
  file.root["accessors"].back()["count"] = 2;
  EXPECT_THAT(error(file), HasSubstr("it has 2 elements, but should have 3"));
}

TEST_F(GltfMorph, WrongNumberOfWeightsIsWarnedOf) {
  GltfWriter file = two_targets();
  file.root["meshes"][0]["weights"] = {0.5};
  const ImportedMesh imported = import(file);
  EXPECT_THAT(imported.mesh.vertices, ElementsAre(Point(0, 0, 0), Point(1, 0, 1), Point(0, 1, 0)));
  EXPECT_THAT(imported.warnings, ElementsAre(HasSubstr("meshes[0].primitives[0] with 1 weights for 2 targets")));
  file.root["meshes"][0]["weights"] = {0.5, "much"};
  EXPECT_THAT(error(file), HasSubstr("meshes[0].weights must be an array of numbers"));
}

}  // namespace
}  // namespace glissade::geometry
