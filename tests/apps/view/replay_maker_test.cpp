// The replay of a report.

#include <cstring>
#include <memory>

#include <gtest/gtest.h>

#include <glissade/apps/view/replay_maker.h>
#include <glissade/geometry/mesh_generators.h>

namespace glissade::apps {
namespace {

using std::chrono::milliseconds;

viewer::ViewScene scene_of_a_box() {
  viewer::ViewScene scene;
  scene.objects.push_back({"part", std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.1, 0.1, 0.1}, 12)),
                           Eigen::Isometry3d::Identity(), 0});
  return scene;
}

/// The times of the frames, in seconds.
std::vector<double> times_of(const std::string& frames) {
  std::vector<double> times;
  for (std::size_t offset = 0; offset < frames.size();) {
    std::uint32_t size = 0;
    std::memcpy(&size, frames.data() + offset, sizeof size);
    std::memcpy(&times.emplace_back(), frames.data() + offset + 4, sizeof(double));
    offset += 4 + size;
  }
  return times;
}

TEST(ReplayMaker, MakesSixtyFramesASecondUpToTheLastTick) {
  ReplayMaker maker(scene_of_a_box());
  for (int i = 0; i <= 1000; ++i) {
    devices::HapticState state;
    state.sequence = i + 1;
    state.time = milliseconds(5000 + i);
    maker.add(state);
  }
  const Replay replay = maker.finish();
  EXPECT_EQ(replay.model.substr(0, 4), "glTF");
  const std::vector<double> times = times_of(replay.frames);
  ASSERT_EQ(times.size(), 61u);
  EXPECT_EQ(times.front(), 5.0) << "the start, from which plots count their time too";
  EXPECT_EQ(times.back(), 6.0);
  for (std::size_t i = 2; i < times.size(); ++i)
    EXPECT_NEAR(times[i] - times[i - 1], 1.0 / 60.0, 1.1e-3);
}

TEST(ReplayMaker, MakesFewerFramesASecondOfALongRun) {
  ReplayMaker maker(scene_of_a_box());
  constexpr int kSeconds = 600;
  for (int i = 0; i <= 1000 * kSeconds; i += 5) {
    devices::HapticState state;
    state.sequence = i + 1;
    state.time = milliseconds(i);
    maker.add(state);
  }
  const std::string frames = maker.finish().frames;
  EXPECT_LT(frames.size(), 1'100'000U);
  EXPECT_GT(frames.size(), 400'000U);
  const std::vector<double> times = times_of(frames);
  EXPECT_EQ(times.front(), 0.0);
  EXPECT_EQ(times.back(), kSeconds);
  const double period = (times[2] - times[1]);
  EXPECT_GT(period, 1.5 / 60.0);
  for (std::size_t i = 2; i + 1 < times.size(); ++i)
    ASSERT_NEAR(times[i] - times[i - 1], period, 0.03) << "evenly over the whole run";
}

TEST(ReplayMaker, SaysThatItSimplifiesALargeScene) {
  viewer::ViewScene scene = scene_of_a_box();
  scene.title = "large.yaml";
  const auto said = [&](std::int64_t triangles) {
    scene.objects.back().mesh = std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(0.1, triangles));
    testing::internal::CaptureStderr();
    ReplayMaker(scene).finish();
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(said(130'000), "");
  const std::string large = said(150'000);
  EXPECT_EQ(large, "glissade: large.yaml has " + std::to_string(scene.triangles()) +
                       " triangles: the report shows it with about 140000\n");
}

TEST(ReplayMaker, HasASmallModelOfALargeSceneBesideTheWhole) {
  viewer::ViewScene scene = scene_of_a_box();
  EXPECT_TRUE(ReplayMaker(scene).finish().whole_model.empty()) << "the first one is whole";
  scene.objects.front().mesh = std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(0.1, 100'000));
  const Replay large = ReplayMaker(scene).finish();
  EXPECT_LT(large.model.size(), large.whole_model.size() / 3);
}

}  // namespace
}  // namespace glissade::apps
