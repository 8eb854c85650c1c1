#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/collision/mesh_generators.h>
#include <glissade/collision/world.h>

namespace glissade::collision {
namespace {

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
class Witness {
 public:
  explicit Witness(const World& world) : world_(world), seen_(world.objects().size()) {}

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

// An editor's objects come and go, and a mover learns of them in its own time: it moves what may be gone, and whose
// slot may have another object.
struct ShortLived {
  std::atomic<std::uint64_t> newest{0};
  std::atomic<bool> is_over = false;

  void edit(World& world, const std::shared_ptr<const DopTree>& tree, int objects) {
    for (int i = 0; i < objects; ++i) {
      const ObjectId id = world.add({.tree = tree});
      newest.store(std::uint64_t{id.generation} << 32 | id.index);
      if (i % 4 != 0) std::this_thread::yield();
      world.remove(id);
    }
    is_over = true;
  }

  void move(World& world) {
    ObjectId last;
    std::uint32_t count = 0;
    for (; !is_over; std::this_thread::yield()) {
      const std::uint64_t id = newest;
      const ObjectId object{static_cast<std::uint32_t>(id), static_cast<std::uint32_t>(id >> 32)};
      count = object == last ? count : 0;
      last = object;
      for (int i = 0; i < 16; ++i)
        world.move(object, pose(object, ++count));
    }
  }
};

// Movers, editors and the consumer at full speed, with so few slots that objects follow each other closely.
TEST(WorldStress, NoPoseIsTornLostOrMeantForAnother) {
  constexpr std::uint32_t kMoves = 10000;
  constexpr int kShortLives = 10000;
  const auto tree = std::make_shared<const DopTree>(std::make_shared<TriangleMesh>(make_box({1.0, 1.0, 1.0}, 12)));
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
    start([&] { lives.move(world); });
  }

  Witness witness(world);
  std::size_t changes = 0;
  while (at_work > 0) {
    const WorldChanges& taken = world.take_changes();
    witness.look(taken);
    changes += taken.moved.size() + taken.added.size();
    std::this_thread::yield();
  }
  for (std::thread& thread : threads)
    thread.join();
  witness.look(world.take_changes());

  EXPECT_GT(changes, own.size()) << "the threads did not meet";
  for (const ObjectId id : own)
    EXPECT_EQ(count_of(world.objects()[id.index]), kMoves) << "the newest pose has not arrived";
  for (const WorldObject& object : world.objects())
    EXPECT_EQ(object.id != ObjectId{}, std::find(own.begin(), own.end(), object.id) != own.end());
}

}  // namespace
}  // namespace glissade::collision
