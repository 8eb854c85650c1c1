// Extensions of glTF: read, ignored with a warning, or refused where the document has no other triangles.

#include <numbers>
#include <string>

#include "gltf_import_fixture.h"

namespace glissade::geometry {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

class GltfExtension : public GltfImport {
 protected:
  static GltfWriter placed_triangle() {
    GltfWriter file = triangle();
    file.add_node({{"mesh", 0}});
    return file;
  }
  static json& instance_attributes(GltfWriter& file) {
    return file.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  }
};

TEST_F(GltfExtension, RequiredOnesWithoutGeometryAreWarnedOf) {
  GltfWriter file = placed_triangle();
  file.root["extensionsRequired"] = {"KHR_xmp_json_ld", "EXT_texture_webp", "KHR_materials_unlit"};
  const ImportedMesh imported = import(file);
  EXPECT_THAT(imported.mesh.triangles, SizeIs(1));
  EXPECT_THAT(imported.warnings,
              ElementsAre("3 required extensions that hold no geometry are ignored (the first: 'KHR_xmp_json_ld')."));
}

TEST_F(GltfExtension, RequiredOnesThatMayHoldGeometryAreRefused) {
  for (const char* name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "CESIUM_RTC", "ACME_anything"}) {
    GltfWriter file = placed_triangle();
    file.root["extensionsRequired"] = {name};
    EXPECT_THAT(error(file), HasSubstr("the required extension '" + std::string(name) + "' is not supported"));
  }
}

/// What looks different does not matter; what may be elsewhere, or more, is told.
TEST_F(GltfExtension, IgnoredOnesThatMayChangeTheGeometryAreWarnedOf) {
  GltfWriter file = placed_triangle();
  file.add_node({{"extensions", {{"MSFT_lod", {{"ids", {0}}}}, {"KHR_lights_punctual", {{"light", 0}}}}}});
  file.add_node({{"extensions", {{"MSFT_lod", {{"ids", {0}}}}}}});
  primitive_of(file)["extensions"]["KHR_materials_variants"] = json::object();
  EXPECT_THAT(import(file).warnings,
              ElementsAre("2 uses of extensions are ignored (the first: 'MSFT_lod' of nodes[1])."));
}

TEST_F(GltfExtension, CompressedPrimitivesWithoutFallbackAreRefused) {
  GltfWriter file = placed_triangle();
  primitive_of(file)["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0},
                                                                    {"attributes", {{"POSITION", 0}}}};
  EXPECT_THAT(vertices(file), SizeIs(3)) << "the copy is read";
  GltfWriter without_points = file;
  without_points.root["accessors"][0].erase("bufferView");
  EXPECT_THAT(error(without_points), AllOf(HasSubstr("meshes[0].primitives[0]: accessors[0] has no values"),
                                           HasSubstr("'KHR_draco_mesh_compression'")));
  primitive_of(file)["indices"] = file.add_zeros(5123, "SCALAR", 3);
  EXPECT_THAT(error(file), AllOf(HasSubstr("accessors[1] has no values"), HasSubstr("'KHR_draco_mesh_compression'")));
  primitive_of(file)["attributes"] = json::object();
  EXPECT_THAT(error(file), AllOf(HasSubstr("no POSITION"), HasSubstr("'KHR_draco_mesh_compression'")));
}

/// The buffer of a compressed view is the place of its copy, and may be only a place.
TEST_F(GltfExtension, CompressedViewsWithoutFallbackAreRefused) {
  GltfWriter file = placed_triangle();
  file.root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
      {"buffer", 0}, {"byteLength", 36}, {"byteStride", 12}, {"count", 3}, {"mode", "ATTRIBUTES"}};
  EXPECT_THAT(vertices(file), SizeIs(3)) << "the copy is read";
  file.root["buffers"] = {json::object(), {{"byteLength", 36}}};
  file.root["bufferViews"][0]["buffer"] = 1;
  EXPECT_THAT(error(file), AllOf(HasSubstr("bufferViews[0]: its data is only in its extension"),
                                 HasSubstr("'EXT_meshopt_compression'"), HasSubstr("buffers[1] has no content")));
}

/// T · R · S of each copy, then the node: (1, 0, 0) is scaled to (2, 0, 0), turned to (0, 2, 0), moved to (0, 2, 3),
/// and scaled by the node to (0, 20, 30).
TEST_F(GltfExtension, InstancesArePlacedInTheirNode) {
  GltfWriter file = placed_triangle();
  file.root["nodes"][0]["scale"] = {10, 10, 10};
  const auto half = static_cast<float>(std::numbers::sqrt2 / 2);
  instance_attributes(file) = {
      {"TRANSLATION", file.add_accessor(bytes_of<float>({0, 0, 3, 0, 0, -3}), 5126, "VEC3", 2)},
      {"ROTATION", file.add_accessor(bytes_of<float>({0, 0, half, half, 0, 0, 0, 1}), 5126, "VEC4", 2)},
      {"SCALE", file.add_accessor(bytes_of<float>({2, 2, 2, 1, 1, 1}), 5126, "VEC3", 2)},
      {"_ID", 0}};
  EXPECT_THAT(vertices(file), ElementsAre(Near(Point(0, 0, 30)), Near(Point(0, 20, 30)), Near(Point(-20, 0, 30)),
                                          Near(Point(0, 0, -30)), Near(Point(10, 0, -30)), Near(Point(0, 10, -30))));
}

/// Quaternions of integers are fractions, and not quite of unit length: 90/127 twice is 1.002.
TEST_F(GltfExtension, InstancesTurnedByIntegers) {
  for (const int component : {5120, 5122}) {
    GltfWriter file = placed_triangle();
    const bool bytes = component == 5120;
    const std::string turn =
        bytes ? bytes_of<std::int8_t>({0, 0, 90, 90}) : bytes_of<std::int16_t>({0, 0, 23170, 23170});
    instance_attributes(file) = {{"ROTATION", file.add_accessor(turn, component, "VEC4", 1)}};
    file.root["accessors"].back()["normalized"] = true;
    file.root["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    EXPECT_THAT(vertices(file), ElementsAre(Near(Point(0, 0, 0)), Near(Point(0, 1, 0)), Near(Point(-1, 0, 0))));
  }
}

TEST_F(GltfExtension, AMirroredInstanceKeepsTheFrontOfTriangles) {
  GltfWriter file = placed_triangle();
  instance_attributes(file) = {{"SCALE", file.add_accessor(bytes_of<float>({1, 1, -1}), 5126, "VEC3", 1)}};
  EXPECT_THAT(vertices(file), ElementsAre(Point(0, 0, 0), Point(0, 1, 0), Point(1, 0, 0)))
      << "vertices are numbered by their first use";
  instance_attributes(file) = {{"_ID", 0}};
  EXPECT_THAT(vertices(file), ElementsAre(Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0))) << "copies at one place";
}

TEST_F(GltfExtension, BrokenInstances) {
  GltfWriter file = placed_triangle();
  const std::size_t two = file.add_accessor(bytes_of<float>({1, 1, 1, 2, 2, 2}), 5126, "VEC3", 2);
  const std::size_t turn = file.add_accessor(bytes_of<float>({0, 0, 0, 2}), 5126, "VEC4", 1);
  instance_attributes(file) = {{"TRANSLATION", 0}, {"SCALE", two}};
  EXPECT_THAT(error(file), HasSubstr("accessors[1]: it has 2 elements, but should have 3"));
  instance_attributes(file) = {{"ROTATION", turn}};
  EXPECT_THAT(error(file), AllOf(HasSubstr("accessors[2], element 0: the quaternion"), HasSubstr("the length 2.0")));
  instance_attributes(file) = {{"TRANSLATION", two}};
  file.root["nodes"][0]["skin"] = 0;
  EXPECT_THAT(error(file), HasSubstr("nodes[0]: it has both a skin and EXT_mesh_gpu_instancing"));
}

}  // namespace
}  // namespace glissade::geometry
