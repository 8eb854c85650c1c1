// Frames that several threads share: the same answers as by one, and no data race (the thread sanitizer's lane runs
// this).

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/collision/collision_pipeline.h>
#include <glissade/geometry/mesh_generators.h>

#include "random_numbers.h"

namespace glissade::collision {
namespace {

constexpr std::uint64_t kPipelineThreadsSeed = 20261122;
constexpr int kObjects = 150;
constexpr int kFrames = 40;

// A crowd of balls in a box, each pipeline with a world of its own.
class Crowd {
 public:
  explicit Crowd(int threads) : pipeline_(world_, clock_, {.threads = threads}) {
    const auto mesh = std::make_shared<geometry::TriangleMesh>(geometry::make_sphere(0.5, 500));
    const auto tree = std::make_shared<DopTree>(mesh);
    const auto hull = std::make_shared<ConvexHull>(*mesh);
    for (int i = 0; i < kObjects; ++i) {
      poses_.emplace_back(Eigen::Translation3d(random_.point(2.0)));
      ids_.push_back(world_.add({tree, hull, poses_.back()}));
    }
  }

  std::vector<ObjectPair> step() {
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      poses_[i] =
          poses_[i] * Eigen::AngleAxisd(0.05, random_.direction()) * Eigen::Translation3d(0.02 * random_.direction());
      world_.move(ids_[i], poses_[i]);
    }
    const FrameResult& result = pipeline_.step();
    near_ += result.report.exact.in;
    return result.meeting;
  }

  std::int64_t near() const { return near_; }

 private:
  test_support::RandomNumbers random_{kPipelineThreadsSeed};
  World world_{kObjects};
  realtime::SteadyClock clock_;
  CollisionPipeline pipeline_;
  std::vector<ObjectId> ids_;
  std::vector<Eigen::Isometry3d> poses_;
  std::int64_t near_ = 0;
};

TEST(PipelineThreads, MatchTheSingleThreadedResult) {
  RecordProperty("seed", static_cast<int>(kPipelineThreadsSeed));
  Crowd by_one(1);
  Crowd by_two(2);
  Crowd by_four(4);
  for (int frame = 0; frame < kFrames; ++frame) {
    const std::vector<ObjectPair> expected = by_one.step();
    ASSERT_EQ(by_two.step(), expected) << "seed " << kPipelineThreadsSeed << ", frame " << frame;
    ASSERT_EQ(by_four.step(), expected) << "seed " << kPipelineThreadsSeed << ", frame " << frame;
  }
  EXPECT_GT(by_one.near(), 100 * kFrames) << "too little to be worth sharing";
}

}  // namespace
}  // namespace glissade::collision
