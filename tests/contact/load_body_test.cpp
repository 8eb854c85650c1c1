// Bodies of mesh files.

#include <gtest/gtest.h>

#include <glissade/contact/contact_body.h>

#include "expect_bad_input.h"
#include "temporary_folder.h"

namespace glissade::contact {
namespace {

TEST(LoadBody, ReadsAMeshInItsUnit) {
  const test_support::TemporaryFolder folder;
  const std::string file =
      folder.write("corner.obj", "v 0 0 0\nv 300 0 0\nv 0 200 0\nv 0 0 100\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  EXPECT_EQ(load_body(file, 1e-3)->tree.mesh().triangles.size(), 4U);
  EXPECT_TRUE(load_part(file, 1e-3)->p_Vref().isApprox(Eigen::Vector3d(0.15, 0.1, 0.05), 1e-15));
  EXPECT_TRUE(load_part(file)->p_Vref().isApprox(Eigen::Vector3d(150.0, 100.0, 50.0), 1e-15));
  for (const double scale : {0.0, -1.0})
    test_support::expect_bad_input([&] { load_body(file, scale); }, {"scale"});
  test_support::expect_bad_input([&] { load_part(folder.path("none.obj")); }, {"none.obj: there is no such file"});
}

}  // namespace
}  // namespace glissade::contact
