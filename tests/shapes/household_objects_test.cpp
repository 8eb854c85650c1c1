/// Things to grasp: closed and outward, of their real size, the same at every fineness.

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_topology.h>
#include <glissade/shapes/household_objects.h>
#include <glissade/shapes/shape_catalog.h>

#include "enclosed_volume.h"

namespace glissade::shapes {
namespace {

using geometry::MeshReport;
using geometry::TriangleMesh;

TEST(HouseholdObjects, AreClosedAndFaceOutwardExceptTheSheetOfPaper) {
  EXPECT_GE(household_objects().size(), 14U);
  for (const HouseholdObject& object : household_objects()) {
    SCOPED_TRACE(object.name);
    for (const double edge : {2e-3, 6e-3, 15e-3}) {
      const TriangleMesh mesh = object.make(edge);
      const MeshReport r = geometry::report(mesh);
      EXPECT_EQ(r.is_watertight, object.name != "paper") << edge;
      EXPECT_EQ(r.inconsistent_edges, 0) << edge;
      EXPECT_EQ(r.degenerate, 0) << edge;
      EXPECT_TRUE(!r.is_watertight || test_support::enclosed_volume(mesh) > 0.0) << edge;
    }
  }
}

TEST(HouseholdObjects, KeepTheirSizeAtEveryFineness) {
  for (const HouseholdObject& object : household_objects()) {
    const Eigen::Vector3d fine = geometry::report(object.make(2e-3)).bounds.sizes();
    const Eigen::Vector3d coarse = geometry::report(object.make(10e-3)).bounds.sizes();
    EXPECT_LT((fine - coarse).cwiseAbs().maxCoeff(), 1.5e-3) << object.name;
  }
}

TEST(HouseholdObjects, EnclosesTheVolumeOfItsShape) {
  using std::numbers::pi;
  const auto volume_of = [](const char* name) {
    return test_support::enclosed_volume(make_shape(name, {{"edge_m", 1e-3}}));
  };
  const double ball = 4.0 / 3.0 * pi * std::pow(33e-3, 3);
  EXPECT_NEAR(volume_of("ball"), ball, 0.01 * ball);
  const double card = 85.6e-3 * 54e-3 * 0.8e-3;
  EXPECT_NEAR(volume_of("card"), card, 0.01 * card);
  const double shell = pi * (std::pow(41e-3, 2) - std::pow(37e-3, 2)) * 90e-3 + pi * std::pow(39e-3, 2) * 5e-3;
  EXPECT_NEAR(volume_of("mug"), shell, 0.25 * shell) << "wall and bottom, and a handle";
}

TEST(HouseholdObjects, RejectAnEdgeOutOfRange) {
  EXPECT_THROW(household_objects().front().make(0.0), std::invalid_argument);
  EXPECT_THROW(household_objects().front().make(0.03), std::invalid_argument);
}

}  // namespace
}  // namespace glissade::shapes
