// The collision thread with its users at full speed; under the thread sanitizer this is where races would show.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/collision/collision_pipeline.h>
#include <glissade/geometry/mesh_generators.h>

#include "poses.h"

namespace glissade::collision {
namespace {

using Eigen::Isometry3d;
using test_support::at;
using namespace std::chrono_literals;

ObjectDescription box(const Isometry3d& X_WO) {
  static const auto mesh = std::make_shared<geometry::TriangleMesh>(geometry::make_box({1.0, 1.0, 1.0}, 300));
  static const auto tree = std::make_shared<DopTree>(mesh);
  static const auto hull = std::make_shared<ConvexHull>(*mesh);
  return {tree, hull, X_WO, 0};
}

// Reads until a frame is as wanted; gives up after a while that is long on any machine.
template <typename Wanted>
bool comes(FrameReader& reader, const Wanted& wanted) {
  const auto deadline = std::chrono::steady_clock::now() + 20s;
  while (std::chrono::steady_clock::now() < deadline) {
    if (reader.update() && wanted(reader.frame())) return true;
    std::this_thread::yield();
  }
  return false;
}

TEST(CollisionThread, PublishesWhatMeetsWithItsAgeAndCost) {
  World world(8);
  realtime::SteadyClock clock;
  CollisionThread collision(world, clock, {.period = 200us});
  FrameReader& reader = collision.reader();
  EXPECT_EQ(FrameReader().frame().frame, 0U) << "none yet";
  const ObjectId a = world.add(box(at(0.0)));
  const ObjectId b = world.add(box(at(0.9)));
  const std::vector<ObjectPair> both{{a, b}};
  ASSERT_TRUE(comes(reader, [&](const FrameResult& frame) { return frame.meeting == both; }));
  EXPECT_GT(reader.frame().report.total, 0ns);
  EXPECT_GE(reader.frame().age(clock.now()), reader.frame().report.total);

  const std::uint64_t frame_before = reader.frame().frame;
  ASSERT_TRUE(world.move(b, at(1.2)));
  ASSERT_TRUE(comes(reader, [](const FrameResult& frame) { return frame.meeting.empty(); }));
  EXPECT_GT(reader.frame().frame, frame_before);
  collision.stop();
  EXPECT_GT(collision.statistics().ticks, 1U);
}

TEST(CollisionThread, HasReadersThatDoNotDependOnEachOther) {
  World world(8);
  realtime::SteadyClock clock;
  CollisionThread collision(world, clock, {.period = 200us, .readers = 2});
  world.add(box(at(0.0)));
  world.add(box(at(0.9)));
  const auto one_pair = [](const FrameResult& frame) { return frame.meeting.size() == 1; };
  EXPECT_TRUE(comes(collision.reader(0), one_pair));
  EXPECT_TRUE(comes(collision.reader(1), one_pair)) << "the other one has not taken it away";
  EXPECT_THROW(collision.reader(2), std::out_of_range);
}

TEST(CollisionThread, RefusesInvalidOptions) {
  World world(8);
  realtime::SteadyClock clock;
  EXPECT_THROW(CollisionThread(world, clock, {.distance = 0.1}), std::invalid_argument);
  EXPECT_THROW(CollisionThread(world, clock, {.readers = 0}), std::invalid_argument);
  EXPECT_THROW(CollisionThread(world, clock, {.period = 0ns}), std::invalid_argument);
  EXPECT_THROW(CollisionThread(world, clock, {.pipeline = {.threads = -2}}), std::invalid_argument);
}

constexpr int kMovers = 2;
constexpr int kBoxesOfMover = 20;

// The boxes stay about fixed places in the mover's own row, so what may meet is known: neighbors of one row.
void shake_row(World& world, int mover, const std::vector<ObjectId>& row, unsigned seed,
               const std::atomic<bool>& stop) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shake(-0.04, 0.04);
  while (!stop) {
    for (int i = 0; i < kBoxesOfMover; ++i)
      EXPECT_TRUE(world.move(row[static_cast<std::size_t>(i)], at(1.05 * i + shake(random), 5.0 * mover)));
  }
}

// Far away from the movers' rows, in a place of its own where all meet.
void add_and_remove_crowd(World& world, const std::atomic<bool>& stop) {
  while (!stop) {
    std::vector<ObjectId> crowd;
    for (int i = 0; i < 10; ++i)
      crowd.push_back(world.add(box(at(-50.0 + 0.1 * i))));
    world.disable_pair(crowd[0], crowd[1]);
    for (const ObjectId& id : crowd)
      world.remove(id);
  }
}

void expect_only_possible_pairs(const FrameResult& frame) {
  EXPECT_TRUE(std::is_sorted(frame.meeting.begin(), frame.meeting.end()));
  for (const ObjectPair& pair : frame.meeting) {
    EXPECT_LT(pair.object_A.index, pair.object_B.index);
    const auto movers_boxes = static_cast<std::uint32_t>(kMovers * kBoxesOfMover);
    if (pair.object_B.index >= movers_boxes) {
      EXPECT_GE(pair.object_A.index, movers_boxes) << "the crowd is far away";
    } else {
      EXPECT_EQ(pair.object_A.index + 1, pair.object_B.index) << "only neighbors can meet";
    }
  }
}

void read_frames(FrameReader& reader, const std::atomic<bool>& stop, std::atomic<std::int64_t>& frames_read) {
  std::uint64_t last = 0;
  while (!stop) {
    if (!reader.update()) continue;
    const FrameResult& frame = reader.frame();
    EXPECT_GT(frame.frame, last) << "frames come in order";
    expect_only_possible_pairs(frame);
    last = frame.frame;
    ++frames_read;
  }
}

TEST(CollisionThreadStress, MoversEditorsAndReadersAtOnce) {
  constexpr unsigned kSeed = 5;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  constexpr int kReaders = 2;
  World world(128);
  realtime::SteadyClock clock;
  std::vector<std::vector<ObjectId>> rows(kMovers);
  for (int m = 0; m < kMovers; ++m) {
    for (int i = 0; i < kBoxesOfMover; ++i)
      rows[static_cast<std::size_t>(m)].push_back(world.add(box(at(1.05 * i, 5.0 * m))));
  }
  CollisionThread collision(world, clock, {.pipeline = {.threads = 2}, .period = 100us, .readers = kReaders});
  std::atomic<bool> stop{false};
  std::atomic<std::int64_t> frames_read{0};
  std::vector<std::thread> threads;
  for (int m = 0; m < kMovers; ++m) {
    threads.emplace_back(
        [&, m] { shake_row(world, m, rows[static_cast<std::size_t>(m)], kSeed + static_cast<unsigned>(m), stop); });
  }
  threads.emplace_back([&] { add_and_remove_crowd(world, stop); });
  for (int r = 0; r < kReaders; ++r)
    threads.emplace_back([&, r] { read_frames(collision.reader(r), stop, frames_read); });
  std::this_thread::sleep_for(1s);
  stop = true;
  for (std::thread& thread : threads)
    thread.join();
  collision.stop();
  EXPECT_GT(frames_read, 10);
}

}  // namespace
}  // namespace glissade::collision
