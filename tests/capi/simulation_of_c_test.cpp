// The simulation in C gives what it gives in C++.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "c_scene.h"
#include "temporary_folder.h"

namespace glissade {
namespace {

TEST_F(BoxOnPlate, ABoxPressedOnAPlateLiesOnItAndPushesBack) {
  const GlissadePose ghost = at_height(0.017);  // 3 mm too deep
  for (int ms = 0; ms < 500; ++ms)
    ASSERT_C(glissade_simulation_advance(simulation, &ghost, 1, 1.0));
  GlissadePart part;
  ASSERT_C(glissade_simulation_part(simulation, 0, &part));
  EXPECT_NEAR(part.X_WV.z, 0.02, 20e-6);
  EXPECT_EQ(part.X_WG.z, 0.017);
  EXPECT_EQ(part.state, GLISSADE_PART_RESTING);
  EXPECT_NEAR(part.force_N[2], 3.0, 0.05) << "1000 N/m over 3 mm";
  EXPECT_GT(part.contact_count, 0);

  GlissadeContact contacts[8];
  std::size_t count = 0;
  ASSERT_C(glissade_simulation_contacts(simulation, 0, contacts, 8, &count));
  ASSERT_EQ(count, 4U) << "the corners";
  double force = 0.0;
  for (const GlissadeContact& contact : {contacts[0], contacts[1], contacts[2], contacts[3]}) {
    const char* name = nullptr;
    ASSERT_C(glissade_simulation_body_name(simulation, contact.body, &name));
    EXPECT_STREQ(name, "plate");
    EXPECT_NEAR(contact.normal[2], 1.0, 1e-9);
    EXPECT_NEAR(std::abs(contact.point_m[0]), 0.02, 1e-6);
    force += contact.force_N;
  }
  EXPECT_NEAR(force, part.force_N[2], 1e-6);
  ASSERT_C(glissade_simulation_contacts(simulation, 0, nullptr, 0, &count));
  EXPECT_EQ(count, 4U) << "a caller may ask for the number first";
  double clearance_m = 1.0;
  ASSERT_C(glissade_simulation_clearance(simulation, 0, &clearance_m));
  EXPECT_NEAR(clearance_m, part.X_WV.z - 0.02, 1e-9);
}

TEST_F(BoxOnPlate, PartsAndObjectsAreFoundByNameAndNumber) {
  std::size_t number = 9;
  ASSERT_C(glissade_simulation_find_part(simulation, "box", &number));
  EXPECT_EQ(number, 0U);
  ASSERT_C(glissade_simulation_part_count(simulation, &number));
  EXPECT_EQ(number, 1U);
  ASSERT_C(glissade_scene_object_count(scene, &number));
  EXPECT_EQ(number, 2U);
  GlissadeObject box;
  ASSERT_C(glissade_scene_object(scene, 1, &box));
  EXPECT_STREQ(box.name, "box");
  EXPECT_EQ(box.is_movable, 1);
  EXPECT_EQ(box.X_WB.z, 0.022);
  EXPECT_EQ(box.triangle_count, 12U);
  for (std::size_t i = 0; i < 3 * box.vertex_count; ++i)
    EXPECT_NEAR(std::abs(box.vertices[i]), 0.02, 1e-12);
  for (std::size_t i = 0; i < 3 * box.triangle_count; ++i)
    EXPECT_LT(static_cast<std::size_t>(box.triangles[i]), box.vertex_count);
}

/// A tetrahedron as arrays, as a file, and in a scene file.
TEST(SceneOfC, MeshesComeFromArraysAndFiles) {
  const test_support::TemporaryFolder folder;
  const std::string mesh = folder.write("t.obj",
                                        "v 0 0 0\nv 1000 0 0\nv 0 1000 0\nv 0 0 1000\n"
                                        "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const std::string file =
      folder.write("s.yaml", "objects:\n  - {name: t, mesh: t.obj, scale: 0.001, movable: true}\n");
  const std::vector<double> vertices{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::vector<std::int32_t> triangles{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  GlissadeScene scene{};
  ASSERT_C(glissade_scene_read(file.c_str(), &scene));
  const GlissadePose apart = at_height(2.0);
  ASSERT_C(glissade_scene_add_file(scene, "from file", mesh.c_str(), 1e-3, &apart));
  ASSERT_C(glissade_scene_add_mesh(scene, "from arrays", vertices.data(), 4, triangles.data(), 4, &apart));
  ASSERT_C(glissade_scene_set_margin(scene, "from arrays", 1e-5));
  ASSERT_C(glissade_scene_set_friction(scene, 0.3, 0.2));
  ASSERT_C(glissade_scene_set_stiffness(scene, 500.0));
  for (std::size_t object = 0; object < 3; ++object) {
    GlissadeObject found;
    ASSERT_C(glissade_scene_object(scene, object, &found));
    EXPECT_EQ(found.vertex_count, 4U) << found.name;
    double sum = 0.0;
    for (std::size_t i = 0; i < 12; ++i)
      sum += found.vertices[i];
    EXPECT_DOUBLE_EQ(sum, 3.0) << found.name;
  }
  GlissadeSimulation simulation{};
  ASSERT_C(glissade_simulation_new(scene, &simulation));
  double clearance_m = 0.0;
  ASSERT_C(glissade_simulation_clearance(simulation, 0, &clearance_m));
  EXPECT_NEAR(clearance_m, 1.0, 1e-9) << "from the tip at z = 1 m to the bases at 2 m";
  glissade_simulation_free(simulation);
  glissade_scene_free(scene);
}

TEST(Library, TellsItsVersion) {
  EXPECT_STREQ(glissade_version(), "0.1.0");
  EXPECT_GT(glissade_now_ns(), 0);
}

}  // namespace
}  // namespace glissade
