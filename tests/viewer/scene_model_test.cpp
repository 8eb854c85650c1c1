// The scene as binary glTF, read by the rules of the format.

#include <cstring>
#include <memory>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/mesh_import.h>
#include <glissade/geometry/mesh_topology.h>
#include <glissade/viewer/scene_model.h>

#include "temporary_folder.h"

namespace glissade::viewer {
namespace {

constexpr std::size_t kWhole = 10'000'000;

std::uint32_t word_at(const std::string& bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

struct Glb {
  nlohmann::json json;
  std::string binary;
};

Glb read_glb(const std::string& bytes) {
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(word_at(bytes, 4), 2u);
  EXPECT_EQ(word_at(bytes, 8), bytes.size());
  const std::size_t json_size = word_at(bytes, 12);
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  EXPECT_EQ(json_size % 4, 0u);
  const std::size_t second = 20 + json_size;
  EXPECT_EQ(bytes.substr(second + 4, 4), std::string("BIN\0", 4));
  EXPECT_EQ(second + 8 + word_at(bytes, second), bytes.size());
  return {nlohmann::json::parse(bytes.substr(20, json_size)), bytes.substr(second + 8)};
}

Eigen::Isometry3d pose_of(const nlohmann::json& node) {
  const auto& p = node["translation"];
  const auto& q = node["rotation"];
  return Eigen::Translation3d(p[0], p[1], p[2]) * Eigen::Quaterniond(q[3], q[0], q[1], q[2]);
}

/// The bounding box of a node's mesh, in the frame of the scene.
Eigen::AlignedBox3d bounds_of(const Glb& glb, const nlohmann::json& node) {
  const nlohmann::json& grid = glb.json["nodes"][node["children"][0].get<std::size_t>()];
  const nlohmann::json& primitive = glb.json["meshes"][grid["mesh"].get<std::size_t>()]["primitives"][0];
  const nlohmann::json& accessor = glb.json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
  const nlohmann::json& view = glb.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < accessor["count"]; ++i) {
    std::array<std::uint16_t, 3> p{};
    const std::size_t offset = view["byteOffset"].get<std::size_t>() + i * view["byteStride"].get<std::size_t>();
    std::memcpy(p.data(), glb.binary.data() + offset, sizeof p);
    const Eigen::Vector3d lower(grid["translation"][0], grid["translation"][1], grid["translation"][2]);
    box.extend(pose_of(node) * (lower + grid["scale"][0].get<double>() * Eigen::Vector3d(p[0], p[1], p[2])));
  }
  return box;
}

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

/// Other programs read the model, and so does our own importer. The grid of a mesh has 65535 steps.
TEST(SceneModel, IsAMeshFile) {
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

TEST(SceneModel, EqualMeshesAreSentOnce) {
  ViewScene scene = two_boxes(Eigen::Vector3d::Zero());
  scene.objects.push_back(scene.objects.front());
  EXPECT_EQ(read_glb(scene_model(scene, kWhole)).json["meshes"].size(), 2u);  // fixed ones and parts have other colors
}

TEST(SceneModel, AHandHasItsSegments) {
  ViewScene scene = two_boxes(Eigen::Vector3d::Zero());
  const auto model = std::make_shared<const grasping::HandModel>(grasping::make_hand());
  scene.hands = {{.device = 7, .model = model}};
  const Glb glb = read_glb(scene_model(scene, kWhole));
  EXPECT_EQ(glb.json["scenes"][0]["extras"]["hands"][0]["device"], 7);
  std::size_t segments = 0;
  for (const nlohmann::json& node : glb.json["nodes"]) {
    if (!node.contains("extras") || node["extras"]["kind"] != "segment") continue;
    ++segments;
    EXPECT_NE(model->chain.links()[node["extras"]["link"].get<std::size_t>()].mesh, nullptr);
  }
  EXPECT_EQ(segments, 18u);
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

}  // namespace
}  // namespace glissade::viewer
