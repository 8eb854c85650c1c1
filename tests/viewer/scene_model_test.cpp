// The scene as binary glTF, read by the rules of the format.

#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/mesh_import.h>
#include <glissade/geometry/mesh_topology.h>
#include <glissade/viewer/page.h>
#include <glissade/viewer/scene_model.h>

#include "glb_file.h"
#include "temporary_folder.h"

namespace glissade::viewer {
namespace {

using test_support::bounds_of;
using test_support::Glb;
using test_support::pose_of;
using test_support::read_glb;

constexpr std::size_t kWhole = 10'000'000;

ViewScene two_boxes(const Eigen::Vector3d& at) {
  const auto box = std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.2, 0.2, 0.2}, 12));
  ViewScene scene;
  scene.title = "two boxes";
  scene.objects.push_back({"table", box, Eigen::Isometry3d(Eigen::Translation3d(at))});
  scene.objects.push_back(
      {"part", box, Eigen::Isometry3d(Eigen::Translation3d(at + Eigen::Vector3d(1.0, 0.0, 0.0))), 0});
  return scene;
}

TEST(SceneModel, ObjectsStandAtTheirPoses) {
  // Far from the origin of the world, too.
  for (const double far : {0.0, 1e6}) {
    const ViewScene scene = two_boxes({far, far, 0.0});
    const Glb glb = read_glb(scene_model(scene, kWhole));
    const nlohmann::json& extras = glb.json["scenes"][0]["extras"];
    EXPECT_EQ(extras["title"], "two boxes");
    EXPECT_EQ(extras["parts"], nlohmann::json({"part"}));
    EXPECT_EQ(extras["triangles"], 24);
    const Eigen::Vector3d origin(extras["origin_W_m"][0], extras["origin_W_m"][1], extras["origin_W_m"][2]);
    EXPECT_TRUE(origin.isApprox(scene.p_WO()));
    std::size_t found = 0;
    for (const nlohmann::json& root : glb.json["scenes"][0]["nodes"]) {
      const nlohmann::json& node = glb.json["nodes"][root.get<std::size_t>()];
      const ViewObject& object = scene.objects[found++];
      EXPECT_EQ(node["extras"]["name"], object.name);
      EXPECT_EQ(node["extras"]["kind"], object.part ? "part" : "fixed");
      const Eigen::Vector3d centre = object.X_WB.translation() - origin;
      const Eigen::AlignedBox3d bounds = bounds_of(glb, node);
      EXPECT_TRUE(bounds.center().isApprox(centre, 1e-5)) << bounds.center().transpose();
      EXPECT_TRUE(bounds.sizes().isApproxToConstant(0.2, 1e-4)) << bounds.sizes().transpose();
    }
    EXPECT_EQ(found, 2u);
  }
}

TEST(SceneModel, HasTheColorsOfThePageInLinearLight) {
  const Glb glb = read_glb(scene_model(two_boxes(Eigen::Vector3d::Zero()), kWhole));
  const auto encoded = [](double linear) {  // by the definition of sRGB
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
  };
  ASSERT_EQ(glb.json["materials"].size(), 2u);
  for (const auto& [material, name] : {std::pair(std::size_t{0}, "fixed"), std::pair(std::size_t{1}, "held")}) {
    const nlohmann::json& rgba = glb.json["materials"][material]["pbrMetallicRoughness"]["baseColorFactor"];
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(encoded(rgba[i]), color(name)[i], 1e-4) << name;
  }
}

TEST(Page, ColorsAreTheLightTheme) {
  EXPECT_THAT(color("card"), testing::Each(testing::Gt(0.9)));
  EXPECT_THAT(color("text"), testing::Each(testing::Lt(0.2)));
  EXPECT_GT(color("held")[2], 2.0 * color("held")[0]) << "blue";
  EXPECT_THROW(color("no such colour"), std::logic_error);
}

/// Other programs read the model, and so does our own importer. The grid of a mesh has 65535 steps.
TEST(SceneModel, CanBeImportedAsAMesh) {
  const ViewScene scene = two_boxes({3.0, 4.0, 5.0});
  const test_support::TemporaryFolder folder;
  const geometry::ImportedMesh imported = geometry::import_mesh(folder.write("model.glb", scene_model(scene, kWhole)));
  EXPECT_EQ(imported.mesh.triangles.size(), 24u);
  EXPECT_EQ(imported.mesh.vertices.size(), 16u);
  const geometry::MeshReport report = geometry::report(imported.mesh);
  EXPECT_TRUE(report.is_watertight);
  const Eigen::Vector3d corner = Eigen::Vector3d::Constant(0.1);
  const Eigen::Vector3d first = scene.objects[0].X_WB.translation() - scene.p_WO();
  const Eigen::Vector3d second = scene.objects[1].X_WB.translation() - scene.p_WO();
  EXPECT_TRUE(report.bounds.min().isApprox(first - corner, 1e-6)) << report.bounds.min().transpose();
  EXPECT_TRUE(report.bounds.max().isApprox(second + corner, 1e-6)) << report.bounds.max().transpose();
}

TEST(SceneModel, NamesMayBeNoUtf8) {
  ViewScene scene = two_boxes(Eigen::Vector3d::Zero());
  scene.title = "folder\xff/scene.yaml";
  const std::string title = read_glb(scene_model(scene, kWhole)).json["scenes"][0]["extras"]["title"];
  EXPECT_EQ(title.substr(0, 6), "folder");
}

TEST(SceneModel, EqualMeshesAreSentOnce) {
  ViewScene scene = two_boxes(Eigen::Vector3d::Zero());
  scene.objects.push_back(scene.objects.front());
  EXPECT_EQ(read_glb(scene_model(scene, kWhole)).json["meshes"].size(), 2u);  // fixed ones and parts have other colors
}

TEST(SceneModel, AHandHasItsSegments) {
  ViewScene scene = two_boxes(Eigen::Vector3d::Zero());
  const auto model = std::make_shared<const grasping::HandModel>(grasping::make_hand());
  scene.hands = {{.name = "glove 7", .model = model}};
  const Glb glb = read_glb(scene_model(scene, kWhole));
  EXPECT_EQ(glb.json["scenes"][0]["extras"]["hands"][0]["name"], "glove 7");
  std::size_t segments = 0;
  for (const nlohmann::json& node : glb.json["nodes"]) {
    if (!node.contains("extras") || node["extras"]["kind"] != "segment") continue;
    ++segments;
    EXPECT_NE(model->chain.links()[node["extras"]["link"].get<std::size_t>()].mesh, nullptr);
  }
  EXPECT_EQ(segments, 18u);
}

TEST(SceneModel, HasTheWordsForGraspsAndTellsWhetherThereIsALoop) {
  ViewScene scene = two_boxes(Eigen::Vector3d::Zero());
  const nlohmann::json extras = read_glb(scene_model(scene, 1000)).json["scenes"][0]["extras"];
  EXPECT_EQ(extras["has_loop"], true);
  const nlohmann::json& words = extras["grasp_words"];
  EXPECT_EQ(words["kinds"][3], "power");
  EXPECT_EQ(words["forms"][0], "");
  EXPECT_EQ(words["forms"][6], "gravity");
  ASSERT_EQ(words["segments"].size(), 24u);
  EXPECT_EQ(words["segments"][0], "the palm");
  EXPECT_EQ(words["segments"][1], "") << "no segment has this bit";
  EXPECT_EQ(words["segments"][4 * 2 + 2], "the middle segment of the index");
  ASSERT_EQ(words["lacks"].size(), 5u);
  EXPECT_EQ(words["lacks"][0], "") << "nothing is lacking";
  EXPECT_EQ(words["lacks"][2], "a grasp needs a finger as well, or the palm and a middle or outer segment");
  scene.has_loop = false;
  EXPECT_EQ(read_glb(scene_model(scene, 1000)).json["scenes"][0]["extras"]["has_loop"], false);
}

TEST(SceneModel, ASmallerModelTellsHowManyTrianglesTheSceneHas) {
  ViewScene scene = two_boxes(Eigen::Vector3d::Zero());
  scene.objects[0].mesh = std::make_shared<geometry::TriangleMesh>(geometry::make_sphere(0.1, 40'000));
  const Glb glb = read_glb(scene_model(scene, 4000));
  EXPECT_GT(glb.json["scenes"][0]["extras"]["triangles"], 30'000);
  std::size_t indices = 0;
  for (const nlohmann::json& accessor : glb.json["accessors"])
    if (accessor["type"] == "SCALAR") indices += accessor["count"].get<std::size_t>();
  EXPECT_LT(indices / 3, 5500u);
}

TEST(SceneModel, HandLinksStandAtTheirGivenPoses) {
  ViewScene scene = two_boxes({1.0, 2.0, 3.0});
  const auto model = std::make_shared<const grasping::HandModel>(grasping::make_hand());
  const Eigen::Isometry3d X_WL(Eigen::Translation3d(4.0, 5.0, 6.0));
  scene.hands = {{.model = model, .X_WL = {model->chain.links().size(), X_WL}}};
  scene.p_WO_chosen = Eigen::Vector3d(1.0, 0.0, 0.0);
  const Glb glb = read_glb(scene_model(scene, kWhole));
  for (const nlohmann::json& node : glb.json["nodes"]) {
    if (!node.contains("extras") || node["extras"]["kind"] != "segment") continue;
    EXPECT_TRUE(pose_of(node).translation().isApprox(Eigen::Vector3d(3.0, 5.0, 6.0)));
  }
}

TEST(SceneModel, MeshesAreSimplifiedByTheirSize) {
  ViewScene scene = two_boxes(Eigen::Vector3d::Zero());
  const auto ball = std::make_shared<geometry::TriangleMesh>(geometry::make_sphere(0.1, 40'000));
  scene.objects[0].mesh = ball;
  scene.objects.push_back(scene.objects[0]);
  EXPECT_EQ(simplified_meshes(scene, kWhole)[0], ball) << "no copy of what fits";

  const auto meshes = simplified_meshes(scene, 8000);
  ASSERT_EQ(meshes.size(), 3U);
  EXPECT_EQ(meshes[0], meshes[2]) << "of one mesh";
  EXPECT_EQ(meshes[1], scene.objects[1].mesh) << "twelve triangles stay";
  EXPECT_LT(meshes[0]->triangles.size(), 5500U);
  EXPECT_GT(meshes[0]->triangles.size(), 2500U);
  for (const Eigen::Vector3d& vertex : meshes[0]->vertices)
    EXPECT_NEAR(vertex.norm(), 0.1, 1e-3);
}

}  // namespace
}  // namespace glissade::viewer
