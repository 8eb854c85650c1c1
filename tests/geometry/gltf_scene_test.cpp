// What of a glTF document is in its mesh: the default scene, with all its triangles at their places.

#include <string>

#include "gltf_import_fixture.h"

namespace glissade::geometry {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

class GltfScene : public GltfImport {
 protected:
  /// Two triangles at z = 1 and 2, the second one below the first one, and one at z = 4.
  static GltfWriter three_nodes() {
    GltfWriter file = triangle();
    file.add_node({{"mesh", 0}, {"translation", {0, 0, 1}}, {"children", {1}}});
    file.add_node({{"mesh", 0}, {"translation", {0, 0, 1}}});
    file.add_node({{"mesh", 0}, {"translation", {0, 0, 4}}});
    return file;
  }
};

TEST_F(GltfScene, WithoutScenesAllRootNodesAreImported) {
  GltfWriter file = three_nodes();
  const auto expected = ElementsAre(Point(0, 0, 1), Point(1, 0, 1), Point(0, 1, 1), Point(0, 0, 2), Point(1, 0, 2),
                                    Point(0, 1, 2), Point(0, 0, 4), Point(1, 0, 4), Point(0, 1, 4));
  EXPECT_THAT(vertices(file), expected);
  file.root["scenes"] = json::array();
  EXPECT_THAT(vertices(file), expected);
}

TEST_F(GltfScene, OtherScenesAreToldOf) {
  GltfWriter file = three_nodes();
  file.root["scenes"] = {{{"nodes", {2}}}, {{"nodes", {0}}}, json::object()};
  const ImportedMesh first = import(file);
  EXPECT_THAT(first.mesh.vertices, ElementsAre(Point(0, 0, 4), Point(1, 0, 4), Point(0, 1, 4)));
  EXPECT_THAT(first.warnings, ElementsAre("2 scenes besides the default one are left out (the first: scenes[1])."));
  file.root["scene"] = 1;
  EXPECT_THAT(import(file).mesh.vertices, SizeIs(6));
}

TEST_F(GltfScene, NodeUsedTwiceIsAnError) {
  GltfWriter file = three_nodes();
  file.root["scenes"] = {{{"nodes", {0, 1}}}};
  EXPECT_THAT(error(file),
              HasSubstr("nodes[1]: the node is used twice, as a root of the scene and as a child of nodes[0]"));
  file.root["scenes"] = {{{"nodes", {0, 0}}}};
  EXPECT_THAT(error(file), HasSubstr("nodes[0]: the node is used twice in the scene"));
  file.root["nodes"][2]["children"] = {1};
  EXPECT_THAT(error(file), HasSubstr("nodes[1]: the node is used twice, as a child of nodes[0] and of nodes[2]"));
}

/// A mesh that no node has is no part of the scene. Nobody looks into it.
TEST_F(GltfScene, MeshesWithoutANodeAreToldOf) {
  GltfWriter file = three_nodes();
  file.root["scenes"] = {{{"nodes", {2}}}};
  file.root["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", 99}}}}}}});
  EXPECT_THAT(import(file).warnings, ElementsAre("1 mesh that no node of the scene has is left out (meshes[1])."));
}

TEST_F(GltfScene, PrimitivesWithoutTrianglesAreToldOf) {
  GltfWriter file = three_nodes();
  json& primitives = file.root["meshes"][0]["primitives"];
  for (const int mode : {0, 1, 3})
    primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"mode", mode}});
  primitives.push_back({{"attributes", {{"COLOR_0", 0}}}});
  primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"indices", file.add_zeros(5123, "SCALAR", 0)}});
  const ImportedMesh imported = import(file);
  EXPECT_THAT(imported.mesh.triangles, SizeIs(3));
  EXPECT_THAT(imported.warnings,
              ElementsAre("3 primitives of points or lines are left out (the first: meshes[0].primitives[1]).",
                          "1 primitive without the attribute POSITION is left out (meshes[0].primitives[4]).",
                          "1 primitive without corners is left out (meshes[0].primitives[5])."));
  primitives.erase(0);
  EXPECT_THAT(error(file), HasSubstr("the scene has no triangles. 3 primitives of points or lines are left out"));
}

TEST_F(GltfScene, AMirroredNodeKeepsTheFrontOfTriangles) {
  GltfWriter file = triangle();
  file.add_node({{"children", {1}}, {"scale", {1, -1, 1}}});
  file.add_node({{"mesh", 0}});
  EXPECT_THAT(vertices(file), ElementsAre(Point(0, 0, 0), Point(0, -1, 0), Point(1, 0, 0)))
      << "vertices are numbered by their first use";
  file.root["nodes"][1]["scale"] = {1, 1, -1};
  EXPECT_THAT(vertices(file), ElementsAre(Point(0, 0, 0), Point(1, 0, 0), Point(0, -1, 0))) << "mirrored twice";
}

TEST_F(GltfScene, TheLastRowOfAMatrixIsRounded) {
  GltfWriter file = triangle();
  file.add_node({{"mesh", 0}, {"matrix", {2, 0, 0, 1e-7, 0, 2, 0, 0, 0, 0, 2, -1e-7, 5, 0, 0, 1.000001}}});
  EXPECT_THAT(vertices(file), ElementsAre(Point(5, 0, 0), Point(7, 0, 0), Point(5, 2, 0)));
  file.root["nodes"][0]["matrix"][15] = 1.01;
  EXPECT_THAT(error(file), HasSubstr("nodes[0].matrix: its last row is"));
}

/// Nodes stand where the file places them, whatever an animation does with them at its start.
TEST_F(GltfScene, AnimationsAreNotPlayed) {
  GltfWriter file = three_nodes();
  const std::size_t times = file.add_accessor(bytes_of<float>({0, 1}), 5126, "SCALAR", 2);
  const std::size_t places = file.add_accessor(bytes_of<float>({9, 9, 9, 8, 8, 8}), 5126, "VEC3", 2);
  const json target{{"node", 0}, {"path", "translation"}};
  file.root["animations"] = {
      {{"channels", {{{"sampler", 0}, {"target", target}}}}, {"samplers", {{{"input", times}, {"output", places}}}}}};
  EXPECT_EQ(vertices(file).front(), Point(0, 0, 1));
}

}  // namespace
}  // namespace glissade::geometry
