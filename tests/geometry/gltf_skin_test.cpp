// Skins of glTF, with places computed by hand from the specification, 3.7.3: joints place the mesh, each by its global
// transform times its inverse bind matrix, in shares of the weights.

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "gltf_import_fixture.h"

namespace glissade::geometry {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

class GltfSkin : public GltfImport {
 protected:
  /// Gives the triangle the joints and weights of set `n`, four of each for each of its points.
  static void add_set(GltfWriter& file, const std::string& n, const std::string& joints, const std::string& weights) {
    json& attributes = primitive_of(file)["attributes"];
    attributes["JOINTS_" + n] = file.add_accessor(joints, 5121, "VEC4", 3);
    attributes["WEIGHTS_" + n] = file.add_accessor(weights, 5126, "VEC4", 3);
  }

  /// A triangle with the skin of node 0, and nodes 1 and 2 for joints: the first point is all with joint 0, the second
  /// one with joint 1, and the third one half with each.
  static GltfWriter two_joints() {
    GltfWriter file = triangle();
    add_set(file, "0", bytes_of<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}),
            bytes_of<float>({1, 0, 0, 0, 1, 0, 0, 0, 0.5F, 0.5F, 0, 0}));
    file.root["skins"] = {{{"joints", {1, 2}}}};
    file.add_node({{"mesh", 0}, {"skin", 0}});
    return file;
  }
};

/// The example of the specification: the nodes above the mesh do not count, those above the joints do.
TEST_F(GltfSkin, JointsPlaceTheMeshAndItsNodeDoesNot) {
  GltfWriter file = triangle();
  add_set(file, "0", std::string(12, '\1'), bytes_of<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}));
  file.root["skins"] = {{{"joints", {1, 2}}, {"skeleton", 1}}};
  file.root["scenes"] = {{{"nodes", {0, 3}}}};
  file.add_node({{"children", {1}}, {"translation", {0, 1, 0}}});
  file.add_node({{"children", {2}}, {"scale", {0.5, 0.5, 0.5}}});
  file.add_node(json::object());
  file.add_node({{"children", {4}}, {"translation", {1, 0, 0}}});
  file.add_node({{"mesh", 0}, {"skin", 0}, {"rotation", {0, 1, 0, 0}}});
  EXPECT_THAT(vertices(file), ElementsAre(Point(0, 1, 0), Point(0.5, 1, 0), Point(0, 1.5, 0)));
}

/// Joint 0 moves the mesh by 7 - 5 along z, joint 1 scales it by 4 · 0.5.
TEST_F(GltfSkin, InverseBindMatricesComeBeforeTheJoints) {
  GltfWriter file = two_joints();
  file.add_node({{"translation", {0, 0, 7}}});
  file.add_node({{"scale", {4, 4, 4}}});
  const std::string matrices = bytes_of<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -5, 1}) +
                               bytes_of<float>({0.5F, 0, 0, 0, 0, 0.5F, 0, 0, 0, 0, 0.5F, 1e-7F, 0, 0, 0, 0.9999999F});
  file.root["skins"][0]["inverseBindMatrices"] = file.add_accessor(matrices, 5126, "MAT4", 2);
  EXPECT_THAT(vertices(file), ElementsAre(Point(0, 0, 2), Point(2, 0, 0), Point(0, 1.5, 1)));
  file.root["accessors"].back()["count"] = 1;
  EXPECT_THAT(error(file), HasSubstr("skins[0]: it has 2 joints, but only 1 inverse bind matrices"));
}

/// Joints may be out of the scene, and below nodes that are.
TEST_F(GltfSkin, JointsOutOfTheSceneHavePlacesToo) {
  GltfWriter file = two_joints();
  file.root["scenes"] = {{{"nodes", {0}}}};
  file.add_node({{"translation", {0, 0, 1}}});
  file.add_node(json::object());
  file.add_node({{"children", {2}}, {"translation", {0, 0, 3}}});
  EXPECT_THAT(vertices(file), ElementsAre(Point(0, 0, 1), Point(1, 0, 3), Point(0, 1, 2)));
  file.root["nodes"][2]["children"] = {3};
  EXPECT_THAT(error(file), HasSubstr("nodes[2]: it is above itself"));
}

/// All points are moved by 0.2 · (0, 0, 10) + 0.8 · (0, 0, 20) = (0, 0, 18).
TEST_F(GltfSkin, JointsAndWeightsOfEveryType) {
  struct Type {
    std::string bytes;
    int component;
  };
  const std::vector<Type> joints{{bytes_of<std::uint8_t>({0, 1, 0, 0}), 5121},
                                 {bytes_of<std::uint16_t>({0, 1, 0, 0}), 5123}};
  const std::vector<Type> weights{{bytes_of<float>({0.2F, 0.8F, 0, 0}), 5126},
                                  {bytes_of<std::uint8_t>({51, 204, 0, 0}), 5121},
                                  {bytes_of<std::uint16_t>({13107, 52428, 0, 0}), 5123}};
  const auto thrice = [](const std::string& text) { return text + text + text; };
  for (const Type& joint : joints) {
    for (const Type& weight : weights) {
      SCOPED_TRACE(std::to_string(joint.component) + " and " + std::to_string(weight.component));
      GltfWriter file = triangle();
      json& attributes = primitive_of(file)["attributes"];
      attributes["JOINTS_0"] = file.add_accessor(thrice(joint.bytes), joint.component, "VEC4", 3);
      attributes["WEIGHTS_0"] = file.add_accessor(thrice(weight.bytes), weight.component, "VEC4", 3);
      file.root["accessors"].back()["normalized"] = weight.component != 5126;
      file.root["skins"] = {{{"joints", {1, 2}}}};
      file.add_node({{"mesh", 0}, {"skin", 0}});
      file.add_node({{"translation", {0, 0, 10}}});
      file.add_node({{"translation", {0, 0, 20}}});
      const std::vector<Eigen::Vector3d> points = vertices(file);
      ASSERT_THAT(points, SizeIs(3));
      EXPECT_NEAR(points[1].z(), 18, 1e-6);  // 0.2 as a float
      EXPECT_NEAR(points[1].x(), 1, 1e-12);
    }
  }
}

/// Five joints, a fifth of the weight each, which takes two sets: (1 + 2 + 4 + 8 + 16) / 5 along z.
TEST_F(GltfSkin, MoreThanFourJointsOfAPoint) {
  GltfWriter file = triangle();
  add_set(file, "0", bytes_of<std::uint8_t>({0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3}),
          bytes_of<float>({0.2F, 0.2F, 0.2F, 0.2F, 0.2F, 0.2F, 0.2F, 0.2F, 0.2F, 0.2F, 0.2F, 0.2F}));
  add_set(file, "1", bytes_of<std::uint8_t>({4, 0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0}),
          bytes_of<float>({0.2F, 0, 0, 0, 0.2F, 0, 0, 0, 0.2F, 0, 0, 0}));
  file.root["skins"] = {{{"joints", {1, 2, 3, 4, 5}}}};
  file.add_node({{"mesh", 0}, {"skin", 0}});
  for (const int z : {1, 2, 4, 8, 16})
    file.add_node({{"translation", {0, 0, z}}});
  EXPECT_THAT(vertices(file), ElementsAre(Near(Point(0, 0, 6.2)), Near(Point(1, 0, 6.2)), Near(Point(0, 1, 6.2))));
  primitive_of(file)["attributes"].erase("JOINTS_1");
  EXPECT_THAT(error(file), HasSubstr("in pairs, but it has 1 and 2"));
}

/// Weights of half the sum give the same place, and a sentence; weights of 0 give no place.
TEST_F(GltfSkin, WeightsThatDoNotAddUpToOne) {
  const auto with_weights = [](const std::string& weights) {
    GltfWriter file = triangle();
    add_set(file, "0", bytes_of<std::uint8_t>({0, 1, 9, 9, 0, 1, 9, 9, 0, 1, 9, 9}), weights);
    file.root["skins"] = {{{"joints", {1, 2}}}};
    file.add_node({{"mesh", 0}, {"skin", 0}});
    file.add_node({{"translation", {0, 0, 10}}});
    file.add_node({{"translation", {0, 0, 20}}});
    return file;
  };
  const ImportedMesh halves = import(with_weights(bytes_of<float>({1, 0, 0, 0, 0.25F, 0.25F, 0, 0, 0, 0.5F, 0, 0})));
  EXPECT_THAT(halves.mesh.vertices, ElementsAre(Point(0, 0, 10), Point(1, 0, 15), Point(0, 1, 20)));
  EXPECT_THAT(halves.warnings, ElementsAre(AllOf(HasSubstr("2 points have weights of joints"),
                                                 HasSubstr("(the first: meshes[0].primitives[0], point 1)."))));
  EXPECT_THAT(error(with_weights(bytes_of<float>({1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}))),
              HasSubstr("point 1: the weights of its joints add up to 0.0, so its place is not known"));
  EXPECT_THAT(error(with_weights(bytes_of<float>({1, 0, 0, 0, 1, NAN, 0, 0, 1, 0, 0, 0}))),
              HasSubstr("point 1: a weight of its joints is not finite"));
  EXPECT_THAT(error(with_weights(bytes_of<float>({1, 0, 0, 0, 0.5F, 0, 0.5F, 0, 1, 0, 0, 0}))),
              HasSubstr("point 1: skins[0] has no joint 9.0, its joints are 2"));
}

/// Node 3 has another mesh with the skin; node 4 has what node 0 has, at the same place.
TEST_F(GltfSkin, ASharedSkinPlacesTheMeshesOfAllItsNodes) {
  GltfWriter file = two_joints();
  file.root["meshes"].push_back(file.root["meshes"][0]);
  file.root["meshes"][1]["primitives"][0]["attributes"]["POSITION"] =
      file.add_accessor(bytes_of<float>({0, 0, 8, 1, 0, 8, 0, 1, 8}), 5126, "VEC3", 3);
  file.add_node({{"translation", {0, 0, 1}}});
  file.add_node({{"translation", {0, 0, 1}}});
  file.add_node({{"mesh", 1}, {"skin", 0}, {"translation", {5, 5, 5}}});
  const auto expected =
      ElementsAre(Point(0, 0, 1), Point(1, 0, 1), Point(0, 1, 1), Point(0, 0, 9), Point(1, 0, 9), Point(0, 1, 9));
  EXPECT_THAT(vertices(file), expected);
  file.add_node({{"mesh", 0}, {"skin", 0}, {"scale", {2, 2, 2}}});
  const ImportedMesh imported = import(file);
  EXPECT_THAT(imported.mesh.vertices, expected);
  EXPECT_THAT(imported.mesh.triangles, SizeIs(2));
  EXPECT_THAT(imported.warnings,
              ElementsAre("1 node has a mesh with a skin that another node has at the same place, and is left out "
                          "(nodes[4])."));
}

TEST_F(GltfSkin, MirroredJointsKeepTheFrontOfTriangles) {
  GltfWriter file = two_joints();
  file.add_node({{"scale", {-1, 1, 1}}});
  file.add_node({{"scale", {-1, 1, 1}}});
  const ImportedMesh imported = import(file);  // vertices are numbered by their first use
  EXPECT_THAT(imported.mesh.vertices, ElementsAre(Point(0, 0, 0), Point(0, 1, 0), Point(-1, 0, 0)));
}

/// At a seam, points at one place may name their joints in another order. They must stay at one place to the bit.
TEST_F(GltfSkin, SeamsStayClosed) {
  GltfWriter file;
  file.add_accessor(bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}), 5126, "VEC3", 6);
  file.add_mesh({{{"attributes", {{"POSITION", 0}}}}});
  std::string joints;
  std::string weights;
  for (int point = 0; point < 6; ++point) {
    const bool turned = point == 3 || point == 4;
    joints += turned ? bytes_of<std::uint8_t>({2, 1, 0, 0}) : bytes_of<std::uint8_t>({0, 1, 2, 0});
    weights += turned ? bytes_of<float>({0.7F, 0.2F, 0.1F, 0}) : bytes_of<float>({0.1F, 0.2F, 0.7F, 0});
  }
  json& attributes = primitive_of(file)["attributes"];
  attributes["JOINTS_0"] = file.add_accessor(joints, 5121, "VEC4", 6);
  attributes["WEIGHTS_0"] = file.add_accessor(weights, 5126, "VEC4", 6);
  file.root["skins"] = {{{"joints", {1, 2, 3}}}};
  file.add_node({{"mesh", 0}, {"skin", 0}});
  for (const double turn : {0.1, 0.2, 0.3}) {
    file.add_node({{"rotation", {0, 0, std::sin(turn), std::cos(turn)}}, {"translation", {turn, 1 / turn, 0.7}}});
  }
  EXPECT_THAT(vertices(file), SizeIs(4));
}

TEST_F(GltfSkin, SkinnedMeshWithoutJointsIsAnError) {
  GltfWriter file = triangle();
  file.root["skins"] = {{{"joints", {0}}}};
  file.add_node({{"mesh", 0}, {"skin", 0}});
  EXPECT_THAT(error(file), AllOf(HasSubstr("meshes[0].primitives[0]"), HasSubstr("needs JOINTS_n and WEIGHTS_n")));
  file.root["nodes"][0]["skin"] = 1;
  EXPECT_THAT(error(file), HasSubstr("skins[1] is out of range"));
}

}  // namespace
}  // namespace glissade::geometry
