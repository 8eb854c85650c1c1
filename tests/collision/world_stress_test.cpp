#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/collision/world.h>

#include "sanitizers.h"
#include "trees.h"

namespace glissade::collision {
namespace {

using namespace std::chrono_literals;

// A pose that says whose it is and the how-manieth, twice over: a torn one contradicts itself.
Eigen::Isometry3d pose(ObjectId id, std::uint32_t count) {
  Eigen::Isometry3d X(Eigen::AngleAxisd(1e-3 * count, Eigen::Vector3d::UnitZ()));
  X.translation() = Eigen::Vector3d(id.generation, count, -1.0 * count);
  return X;
}

// 0 for an object that nobody has moved.
std::uint32_t count_of(const WorldObject& object) {
  return static_cast<std::uint32_t>(object.X_WO.translation().y());
}

// What the consumer has seen so far, and whether it may see that.
class Observer {
 public:
  explicit Observer(const World& world) : world_(world), seen_(world.objects().size()) {}

  void look(const WorldChanges& changes) {
    for (const std::uint32_t slot : changes.removed) {
      EXPECT_TRUE(seen_[slot].is_here);
      seen_[slot].is_here = false;
    }
    for (const std::uint32_t slot : changes.added) {
      const std::uint32_t generation = world_.objects()[slot].id.generation;
      EXPECT_FALSE(seen_[slot].is_here);
      EXPECT_GT(generation, seen_[slot].generation) << "an object has come back";
      seen_[slot] = {true, generation, 0};
      look_at(slot);
    }
    for (const std::uint32_t slot : changes.moved)
      look_at(slot);
  }

 private:
  struct Seen {
    bool is_here = false;
    std::uint32_t generation = 0;
    std::uint32_t count = 0;
  };

  void look_at(std::uint32_t slot) {
    const WorldObject& object = world_.objects()[slot];
    const std::uint32_t count = count_of(object);
    const Eigen::Isometry3d whole = count == 0 ? Eigen::Isometry3d::Identity() : pose(object.id, count);
    EXPECT_TRUE(object.X_WO.matrix() == whole.matrix()) << "torn, or meant for another object";
    EXPECT_EQ(object.id.generation, seen_[slot].generation);
    EXPECT_GE(count, seen_[slot].count) << "an older pose after a newer one";
    seen_[slot].count = count;
  }

  const World& world_;
  std::vector<Seen> seen_;
};

// An editor's objects come and go, and movers learn of them in their own time: they move what may be gone, and whose
// slot may have another object. Objects that follow each other in a slot have different movers.
class ShortLived {
 public:
  void edit(World& world, const std::shared_ptr<const DopTree>& tree, int objects) {
    for (int i = 0; i < objects; ++i) {
      const ObjectId id = world.add({.tree = tree});
      newest_ = std::uint64_t{id.generation} << 32 | id.index;
      if (i % 4 != 0) std::this_thread::yield();
      world.remove(id);
    }
    is_over_ = true;
  }

  /// One thread for each `parity`, 0 and 1.
  void move(World& world, std::uint32_t parity) {
    ObjectId id;
    std::uint32_t count = 0;
    for (; !is_over_; std::this_thread::yield()) {
      const std::uint64_t newest = newest_;
      const ObjectId newest_id{static_cast<std::uint32_t>(newest), static_cast<std::uint32_t>(newest >> 32)};
      if (newest_id != id && newest_id.generation % 2 == parity) {
        id = newest_id;
        count = 0;
      }
      for (int i = 0; i < 16; ++i)
        world.move(id, pose(id, ++count));
    }
  }

 private:
  std::atomic<std::uint64_t> newest_ = 0;
  std::atomic<bool> is_over_ = false;
};

// Movers, editors and the consumer at full speed, with so few slots that objects follow each other closely.
TEST(WorldStress, NoPoseIsTornLostOrMeantForAnother) {
  constexpr std::uint32_t kMoves = 10000;
  constexpr int kShortLives = 10000;
  const auto tree = test_support::cube_tree();
  World world(7);
  std::array<ObjectId, 3> own;
  for (ObjectId& id : own)
    id = world.add({.tree = tree});
  std::array<ShortLived, 2> short_lived;
  std::atomic<int> at_work = 0;
  std::vector<std::thread> threads;
  const auto start = [&](auto work) {
    ++at_work;
    threads.emplace_back([&at_work, work] {
      work();
      --at_work;
    });
  };
  for (const ObjectId id : own) {
    start([&world, id] {
      for (std::uint32_t count = 1; count <= kMoves; ++count) {
        ASSERT_TRUE(world.move(id, pose(id, count)));
        if (count % 256 == 0) std::this_thread::yield();
      }
    });
  }
  for (ShortLived& lives : short_lived) {
    start([&] { lives.edit(world, tree, kShortLives); });
    start([&] { lives.move(world, 0); });
    start([&] { lives.move(world, 1); });
  }

  Observer observer(world);
  std::size_t changes = 0;
  while (at_work > 0) {
    const WorldChanges& taken = world.take_changes();
    observer.look(taken);
    changes += taken.moved.size() + taken.added.size();
    std::this_thread::yield();
  }
  for (std::thread& thread : threads)
    thread.join();
  observer.look(world.take_changes());

  EXPECT_GT(changes, own.size()) << "the threads did not meet";
  for (const ObjectId id : own)
    EXPECT_EQ(count_of(world.objects()[id.index]), kMoves) << "the newest pose has not arrived";
  for (const WorldObject& object : world.objects())
    EXPECT_EQ(object.id != ObjectId{}, std::find(own.begin(), own.end(), object.id) != own.end());
}

// One object, movers and the consumer in loops as tight as can be, so that a pose is written while it is read, and
// while another mover writes.
void move_and_take_at_once(int movers, int takes, std::chrono::microseconds pause) {
  constexpr std::uint32_t kPoses = 64;
  World world(1);
  const ObjectId id = world.add({.tree = test_support::cube_tree()});
  std::vector<Eigen::Isometry3d> poses;
  for (std::uint32_t i = 0; i < kPoses; ++i)
    poses.push_back(pose(id, i + 1));
  std::atomic<bool> is_over = false;
  std::atomic<int> refused = 0;
  std::vector<std::thread> threads;
  for (int mover = 0; mover < movers; ++mover) {
    threads.emplace_back([&, mover] {
      for (auto i = static_cast<std::uint32_t>(mover); !is_over; i += 7) {
        if (!world.move(id, poses[i % kPoses])) ++refused;
      }
    });
  }
  // On a busy machine, threads may not meet for a while.
  const auto deadline = std::chrono::steady_clock::now() + 30s;
  const auto may_still_meet = [&] { return movers > 1 && refused == 0 && std::chrono::steady_clock::now() < deadline; };
  for (int take = 0; take < takes || may_still_meet(); ++take) {
    if (pause.count() > 0) std::this_thread::sleep_for(pause);
    world.take_changes();
    const std::uint32_t count = count_of(world.objects()[id.index]);
    if (count == 0 || world.objects()[id.index].X_WO.matrix() == poses[count - 1].matrix()) continue;
    ADD_FAILURE() << "torn, at the " << take << ". take";
    break;
  }
  is_over = true;
  for (std::thread& thread : threads)
    thread.join();
  EXPECT_EQ(refused > 0, movers > 1) << "only who meets another inside is refused";
}

TEST(WorldStress, APoseThatIsRenewedWhileItIsReadIsNotTorn) {
  move_and_take_at_once(1, test_support::affordable(1'000'000), 0us);
}

TEST(WorldStress, ConcurrentMovesOfOneObjectTearNoPose) {
  // The consumer leaves the processors to them.
  move_and_take_at_once(2, test_support::affordable(5'000), 20us);
}

// An object that is added and moved while the consumer is taking poses: the take may come upon the pose of an object it
// does not know yet. Others that have moved as well make takes long enough for that.
TEST(WorldStress, AnObjectAddedAndMovedDuringATakeIsWhereItWasMoved) {
  constexpr int kObjects = 1000;
  const auto tree = test_support::cube_tree();
  World world(512);
  std::vector<ObjectId> others(500);
  for (ObjectId& id : others)
    id = world.add({.tree = tree});
  std::atomic<bool> is_waiting = false;
  std::atomic<bool> is_over = false;
  ObjectId id;
  std::thread editor([&] {
    for (int i = 0; i < kObjects; ++i) {
      id = world.add({.tree = tree});
      world.move(id, pose(id, 1));
      is_waiting = true;
      while (is_waiting)
        std::this_thread::yield();
      world.remove(id);
    }
    is_over = true;
  });
  for (std::uint32_t count = 1; !is_over; ++count) {
    const bool is_moved = is_waiting;
    for (const ObjectId other : others)
      world.move(other, pose(other, count));
    world.take_changes();
    if (!is_moved) continue;
    EXPECT_EQ(world.objects()[id.index].id, id);
    EXPECT_EQ(count_of(world.objects()[id.index]), 1U);
    is_waiting = false;
    std::this_thread::yield();
  }
  editor.join();
}

}  // namespace
}  // namespace glissade::collision
