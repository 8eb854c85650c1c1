// The patches of a contact set: their places follow from the shapes.

#include "loop/patch_maker.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/contact/multi_part_sliding.h>

#include "held_part.h"
#include "poses.h"

namespace glissade::haptics {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::cube;
using test_support::pose;
using test_support::wall;

constexpr double kPatchEdge = 0.04;

/// The patches after the ghosts of cubes of 4 cm have stood at these places.
ContactSet pressed(contact::MultiPartSliding& sliding, const std::vector<Vector3d>& ghosts) {
  std::vector<Isometry3d> X_WG;
  for (const Vector3d& ghost : ghosts)
    X_WG.push_back(pose(ghost));
  for (int i = 0; i < 200; ++i)
    sliding.advance(X_WG);
  ContactSet set;
  PatchMaker(sliding).tell(set);
  return set;
}

TEST(PatchMaker, AFaceOnAWallIsOnePatch) {
  contact::MultiPartSliding sliding({wall(0.1)}, {{.part_V = cube(kPatchEdge), .X_WV_start = pose({0.07, 0.0, 0.0})}});
  const ContactSet set = pressed(sliding, {{0.085, 0.0, 0.0}});
  ASSERT_EQ(set.patch_count, 1);
  EXPECT_EQ(set.patches_left_out, 0);
  const devices::HapticPatch& patch = set.patches[0];
  EXPECT_EQ(patch.part, 0);
  EXPECT_EQ(patch.contact_count, sliding.result(0).pushing);
  EXPECT_TRUE(patch.n_W.isApprox(-Eigen::Vector3f::UnitX(), 1e-5F)) << "from the wall to the part";
  EXPECT_NEAR(patch.p_V.x(), kPatchEdge / 2, 1e-6) << "on the face of the part";
  EXPECT_LT(patch.p_V.tail<2>().norm(), kPatchEdge / 2);
  EXPECT_LE(patch.extent, kPatchEdge * std::sqrt(2.0) + 1e-6);
}

TEST(PatchMaker, NothingPushesAPartThatIsFree) {
  contact::MultiPartSliding sliding({wall(0.1)}, {{.part_V = cube(kPatchEdge), .X_WV_start = pose({0.0, 0.0, 0.0})}});
  EXPECT_EQ(pressed(sliding, {{0.01, 0.0, 0.0}}).patch_count, 0);
}

TEST(PatchMaker, PartsThatPressEachOtherHaveOnePatchBetweenThem) {
  contact::MultiPartSliding sliding({wall(1.0)}, {{.part_V = cube(kPatchEdge), .X_WV_start = pose({-0.025, 0.0, 0.0})},
                                                  {.part_V = cube(kPatchEdge), .X_WV_start = pose({0.025, 0.0, 0.0})}});
  const ContactSet set = pressed(sliding, {{-0.015, 0.0, 0.0}, {0.015, 0.0, 0.0}});
  ASSERT_EQ(set.patch_count, 1);
  EXPECT_EQ(set.patches[0].part, 0);
  EXPECT_TRUE(set.patches[0].n_W.isApprox(-Eigen::Vector3f::UnitX(), 1e-5F));
  sliding.release(0);  // then the contact is the other one's
  const ContactSet alone = pressed(sliding, {{-0.015, 0.0, 0.0}, {0.015, 0.0, 0.0}});
  ASSERT_EQ(alone.patch_count, 1);
  EXPECT_EQ(alone.patches[0].part, 1);
}

TEST(PatchMaker, PatchesBeyondCapacityAreCounted) {
  // Four cubes, each in a corner of three blocks.
  std::vector<contact::Obstacle> niches;
  std::vector<contact::HeldPart> parts;
  std::vector<Vector3d> ghosts;
  for (int i = 0; i < 4; ++i) {
    const Vector3d place(0.0, 0.0, 0.3 * i);
    for (int axis = 0; axis < 3; ++axis) {
      const geometry::TriangleMesh block = geometry::make_box({kPatchEdge, kPatchEdge, kPatchEdge}, 12);
      niches.push_back(test_support::obstacle_of(block, pose(place + (kPatchEdge + 1e-3) * Vector3d::Unit(axis))));
    }
    parts.push_back({.part_V = cube(kPatchEdge), .X_WV_start = pose(place)});
    ghosts.push_back(place + Vector3d(3e-3, 3e-3, 3e-3));
  }
  contact::MultiPartSliding sliding(niches, parts);
  const ContactSet set = pressed(sliding, ghosts);
  EXPECT_EQ(set.patch_count, 8);
  EXPECT_EQ(set.patches_left_out, 4);
}

}  // namespace
}  // namespace glissade::haptics
