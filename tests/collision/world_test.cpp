#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <unordered_set>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/collision/world.h>
#include <glissade/geometry/mesh_generators.h>

#include "allocation_counter.h"
#include "poses.h"
#include "trees.h"

namespace glissade::collision {
namespace {

using test_support::at;
using test_support::cube_tree;
using testing::ElementsAre;
using testing::IsEmpty;

double x_of(const World& world, ObjectId id) {
  return world.objects()[id.index].X_WO.translation().x();
}

TEST(World, TakesAddedObjects) {
  World world(8);
  const auto tree = cube_tree();
  const ObjectId first = world.add({.tree = tree, .X_WO = at(1.0)});
  const ObjectId second = world.add({.tree = tree, .X_WO = at(2.0), .group = 3});
  EXPECT_EQ(world.objects()[first.index].id, ObjectId{}) << "before the take";

  const WorldChanges& changes = world.take_changes();
  EXPECT_THAT(changes.added, ElementsAre(first.index, second.index));
  EXPECT_THAT(changes.removed, IsEmpty());
  EXPECT_THAT(changes.moved, IsEmpty());
  ASSERT_EQ(world.objects().size(), 8U);
  EXPECT_EQ(world.objects()[first.index].id, first);
  EXPECT_EQ(world.objects()[second.index].group, 3);
  EXPECT_EQ(world.objects()[second.index].tree, tree);
  EXPECT_EQ(x_of(world, second), 2.0);

  EXPECT_THAT(world.take_changes().added, IsEmpty());
}

TEST(World, TakesTheNewestPoseOfEachObjectThatMoved) {
  World world(200);
  std::vector<ObjectId> ids;
  for (int i = 0; i < 200; ++i)
    ids.push_back(world.add({.tree = cube_tree()}));
  world.take_changes();

  for (const double x : {1.0, 2.0, 3.0})
    EXPECT_TRUE(world.move(ids[130], at(x)));
  EXPECT_TRUE(world.move(ids[2], at(4.0)));
  EXPECT_EQ(x_of(world, ids[130]), 0.0) << "before the take";

  EXPECT_THAT(world.take_changes().moved, ElementsAre(ids[2].index, ids[130].index));
  EXPECT_EQ(x_of(world, ids[130]), 3.0);
  EXPECT_EQ(x_of(world, ids[2]), 4.0);
  EXPECT_THAT(world.take_changes().moved, IsEmpty());
}

TEST(World, AnObjectMovedBeforeItIsTakenIsAddedWhereItIs) {
  World world;
  const ObjectId id = world.add({.tree = cube_tree()});
  world.move(id, at(5.0));
  const WorldChanges& changes = world.take_changes();
  EXPECT_THAT(changes.added, ElementsAre(id.index));
  EXPECT_THAT(changes.moved, IsEmpty());
  EXPECT_EQ(x_of(world, id), 5.0);
}

TEST(World, RefusesHandlesOfObjectsThatAreGone) {
  World world(1);
  const ObjectId old = world.add({.tree = cube_tree()});
  world.remove(old);
  EXPECT_FALSE(world.move(old, at(1.0)));
  EXPECT_THROW(world.remove(old), std::invalid_argument);

  const ObjectId next = world.add({.tree = cube_tree()});
  EXPECT_EQ(next.index, old.index);
  EXPECT_NE(next, old);
  EXPECT_FALSE(world.move(old, at(1.0)));
  EXPECT_THROW(world.remove(old), std::invalid_argument);
  EXPECT_THROW(world.disable_pair(old, next), std::invalid_argument);
  EXPECT_THROW(world.enable_pair(next, old), std::invalid_argument);
  world.take_changes();
  EXPECT_EQ(x_of(world, next), 0.0);

  EXPECT_FALSE(world.move(ObjectId{}, at(1.0)));
  EXPECT_FALSE(world.move(ObjectId{.index = 1, .generation = 1}, at(1.0)));
  EXPECT_THROW(world.remove(ObjectId{}), std::invalid_argument);
  EXPECT_THROW(world.remove(ObjectId{.index = 1, .generation = 1}), std::invalid_argument);
}

TEST(World, RefusesASelectionOfTrianglesOfAnotherTree) {
  World world(1);
  const DopTree plate(std::make_shared<geometry::TriangleMesh>(geometry::make_plate({1.0, 1.0}, 200)));
  const auto all = [](std::int32_t) { return true; };
  EXPECT_THROW(world.add({.tree = cube_tree(), .selection = std::make_shared<TriangleSelection>(plate, all)}),
               std::invalid_argument);
  EXPECT_NO_THROW(
      world.add({.tree = cube_tree(), .selection = std::make_shared<TriangleSelection>(*cube_tree(), all)}));
}

TEST(World, ASlotThatGotAnotherObjectIsRemovedAndAdded) {
  World world(1);
  const ObjectId old = world.add({.tree = cube_tree()});
  world.take_changes();
  world.move(old, at(7.0));
  world.remove(old);
  const ObjectId next = world.add({.tree = cube_tree(), .X_WO = at(2.0)});
  const WorldChanges& changes = world.take_changes();
  EXPECT_THAT(changes.removed, ElementsAre(0U));
  EXPECT_THAT(changes.added, ElementsAre(0U));
  EXPECT_THAT(changes.moved, IsEmpty());
  EXPECT_EQ(world.objects()[0].id, next);
  EXPECT_EQ(x_of(world, next), 2.0) << "the pose of the former object moved its successor";
}

TEST(World, AnObjectThatCameAndWentBetweenTwoTakesIsNoChange) {
  World world;
  const ObjectId id = world.add({.tree = cube_tree()});
  world.move(id, at(1.0));
  world.remove(id);
  const WorldChanges& changes = world.take_changes();
  EXPECT_THAT(changes.added, IsEmpty());
  EXPECT_THAT(changes.removed, IsEmpty());
  EXPECT_THAT(changes.moved, IsEmpty());
}

TEST(World, ChangesComeInAscendingOrderOfSlots) {
  World world(4);
  std::vector<ObjectId> ids;
  for (int i = 0; i < 4; ++i)
    ids.push_back(world.add({.tree = cube_tree()}));
  world.take_changes();
  for (const std::size_t i : {3U, 0U, 2U})
    world.remove(ids[i]);
  EXPECT_THAT(world.take_changes().removed, ElementsAre(0U, 2U, 3U));
  for (int i = 0; i < 3; ++i)
    world.add({.tree = cube_tree()});
  EXPECT_THAT(world.take_changes().added, ElementsAre(0U, 2U, 3U));
}

TEST(World, ARemovedObjectLivesUntilTheNextTake) {
  World world;
  auto tree = cube_tree();
  const std::weak_ptr<const DopTree> observer = tree;
  const ObjectId id = world.add({.tree = std::move(tree)});
  world.take_changes();
  world.remove(id);
  EXPECT_FALSE(observer.expired());
  EXPECT_EQ(world.objects()[id.index].id, id);
  world.take_changes();
  EXPECT_TRUE(observer.expired());
  EXPECT_EQ(world.objects()[id.index].id, ObjectId{});
}

TEST(World, IsFullAtItsCapacityAndNotBefore) {
  World world(2);
  world.add({.tree = cube_tree()});
  const ObjectId second = world.add({.tree = cube_tree()});
  EXPECT_THROW(world.add({.tree = cube_tree()}), std::length_error);
  world.remove(second);
  EXPECT_NO_THROW(world.add({.tree = cube_tree()}));
}

TEST(World, RefusesInvalidCapacitiesAndObjects) {
  EXPECT_THROW(World(0), std::invalid_argument);
  EXPECT_THROW(World(1000001), std::invalid_argument);
  World world;
  EXPECT_THROW(world.add({}), std::invalid_argument);
  EXPECT_THROW(world.add({.tree = cube_tree(), .group = 64}), std::invalid_argument);
  EXPECT_THROW(world.add({.tree = cube_tree(), .group = -1}), std::invalid_argument);
  EXPECT_THROW(world.add({.tree = cube_tree(), .X_WO = at(std::nan(""))}), std::invalid_argument);
}

// Queries refuse two trees of different options.
TEST(World, HasTreesOfOneKind) {
  World world;
  const ObjectId id = world.add({.tree = cube_tree()});
  EXPECT_THROW(world.add({.tree = cube_tree({.directions = 14})}), std::invalid_argument);
  world.remove(id);
  EXPECT_NO_THROW(world.add({.tree = cube_tree({.directions = 14})}));
}

TEST(World, RefusesInvalidPoses) {
  World world;
  const ObjectId id = world.add({.tree = cube_tree()});
  Eigen::Isometry3d scaled = at(1.0);
  scaled.linear() *= 1.0001;
  Eigen::Isometry3d mirrored = at(1.0);
  mirrored.linear()(0, 0) = -1.0;
  Eigen::Isometry3d without_number = at(1.0);
  without_number.linear()(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(world.move(id, scaled));
  EXPECT_FALSE(world.move(id, mirrored));
  EXPECT_FALSE(world.move(id, without_number));
  EXPECT_FALSE(world.move(id, at(std::numeric_limits<double>::infinity())));
  EXPECT_FALSE(world.move(id, at(-1.1e9)));
  EXPECT_TRUE(world.move(id, at(-1e9)));
  world.take_changes();
  EXPECT_EQ(x_of(world, id), -1e9);
}

TEST(World, DisabledPairsApplyFromTheNextTake) {
  World world;
  const ObjectId a = world.add({.tree = cube_tree()});
  const ObjectId b = world.add({.tree = cube_tree()});
  const ObjectId c = world.add({.tree = cube_tree(), .group = 1});
  EXPECT_FALSE(world.take_changes().interest);
  EXPECT_TRUE(world.is_enabled(a.index, b.index));
  EXPECT_FALSE(world.is_enabled(a.index, a.index));

  world.disable_pair(b, a);
  world.disable_groups(0, 1);
  EXPECT_TRUE(world.is_enabled(a.index, b.index)) << "before the take";
  EXPECT_TRUE(world.take_changes().interest);
  EXPECT_FALSE(world.is_enabled(a.index, b.index));
  EXPECT_FALSE(world.is_enabled(c.index, a.index));
  EXPECT_FALSE(world.take_changes().interest);

  world.enable_pair(a, b);
  world.enable_groups(1, 0);
  EXPECT_TRUE(world.take_changes().interest);
  EXPECT_TRUE(world.is_enabled(a.index, b.index));
  EXPECT_TRUE(world.is_enabled(c.index, a.index));
}

TEST(World, NewObjectInASlotInheritsNoDisabledPairs) {
  World world;
  const ObjectId a = world.add({.tree = cube_tree()});
  const ObjectId b = world.add({.tree = cube_tree()});
  world.disable_pair(a, b);
  world.take_changes();
  world.remove(b);
  const ObjectId next = world.add({.tree = cube_tree()});
  ASSERT_EQ(next.index, b.index);
  world.take_changes();
  EXPECT_TRUE(world.is_enabled(a.index, next.index));
}

TEST(World, MovingAndTakingPosesAllocateNothing) {
  if (!test_support::allocations_are_counted()) GTEST_SKIP() << "allocations are not counted here";
  World world;
  std::vector<ObjectId> ids;
  for (int i = 0; i < 100; ++i)
    ids.push_back(world.add({.tree = cube_tree()}));
  world.take_changes();
  const std::int64_t before = test_support::allocations_of_this_thread();
  for (int frame = 0; frame < 3; ++frame) {
    for (const ObjectId id : ids)
      world.move(id, at(frame));
    world.take_changes();
  }
  EXPECT_EQ(test_support::allocations_of_this_thread(), before);
}

TEST(ObjectId, IsHashableAndOrdered) {
  const std::unordered_set<ObjectId> set{{1, 2}, {2, 1}, {1, 2}};
  EXPECT_EQ(set.size(), 2U);
  EXPECT_LT((ObjectId{1, 2}), (ObjectId{2, 1}));
}

}  // namespace
}  // namespace glissade::collision
