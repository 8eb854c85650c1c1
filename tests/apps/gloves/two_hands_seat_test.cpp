/// Two hands take a bar from its stands together, lift it, carry it over two forks, press it into them and let go: over
/// UDP multicast, as in `two_hands_test`.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/geometry/mesh_generators.h>

#include "faults/stall_meter.h"
#include "finger_hands.h"
#include "glissade_program.h"
#include "poses.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using hands::JointValues;
using test_support::at;
using test_support::HandPause;
using test_support::HeldByHands;
using test_support::RecordedTick;
using testing::Contains;

constexpr double kSeatSeconds = 5.6;

const Vector3d kBar(0.036, 0.37, 0.036);  // edges, metres
const Vector3d kBarPlace(0.088, 0.0, -0.036);
const Vector3d kSeat(0.148, 0.0, -0.096);  // the bar's place in the forks
constexpr double kFork_m = 0.044;          // inner width
constexpr double kGrip_m = 0.065;          // of each hand from the middle of the bar

/// A box that stands still.
struct Block {
  Vector3d edges;
  Vector3d place;
};

/// A stand under each end of the bar, without which the thumb that comes first would push it away; and two forks, open
/// above: a bottom and two sides each.
std::vector<Block> stands_and_forks() {
  constexpr double kThick = 0.02;
  std::vector<Block> blocks;
  for (const double y : {-0.165, 0.165}) {
    blocks.push_back({{kThick, kThick, kThick}, kBarPlace + Vector3d(0.0, y, -0.5 * (kBar.z() + kThick) - 1e-4)});
    const Vector3d bottom = kSeat + Vector3d(0.0, y, -0.5 * kBar.z());
    blocks.push_back({{kFork_m + 2.0 * kThick, kThick, kThick}, bottom - Vector3d(0.0, 0.0, 0.5 * kThick)});
    for (const double side : {-0.5, 0.5})
      blocks.push_back({{kThick, kThick, 0.04}, bottom + Vector3d(side * (kFork_m + kThick), 0.0, 0.02)});
  }
  return blocks;
}

std::string object(const std::string& name, const Block& block, const std::string& more = "") {
  std::ostringstream text;
  text << "  - name: " << name << "\n    shape: {type: box, size_x_m: " << block.edges.x()
       << ", size_y_m: " << block.edges.y() << ", size_z_m: " << block.edges.z() << "}\n    pose: {position_m: ["
       << block.place.x() << ", " << block.place.y() << ", " << block.place.z() << "]}\n"
       << more;
  return text.str();
}

std::string scene() {
  std::string text = "objects:\n";
  int number = 0;
  for (const Block& block : stands_and_forks())
    text += object("block_" + std::to_string(++number), block);
  return text + object("bar", {kBar, kBarPlace}, "    movable: true\n");
}

/// The hand whose palm is over the bar at this place along it. It presses 5 mm deeper than the seat.
std::string script(double y) {
  const Vector3d way = kSeat - kBarPlace;
  const Isometry3d here = at(0.0, y, 0.0);
  const Isometry3d lifted = at(0.0, y, 0.03);
  const Isometry3d over = at(way.x(), y, 0.03);
  const Isometry3d seated = at(way.x(), y, way.z());
  const Isometry3d deeper = at(way.x() + 0.002, y, way.z() - 0.005);
  const Isometry3d away = at(way.x(), y, 0.1);
  const std::vector<HandPause> pauses{{0.0, here, 0.0},   {0.5, here, 0.0},   {0.8, here, 1.0},   {1.3, here, 1.0},
                                      {1.7, lifted, 1.0}, {2.3, over, 1.0},   {3.1, deeper, 1.0}, {3.6, deeper, 1.0},
                                      {3.9, seated, 0.0}, {4.3, seated, 0.0}, {4.9, away, 0.0},   {5.5, away, 0.0}};
  return script_text(pauses, {{-20, -10, -15, 50}, {50, 20, 20, 30}});
}

std::shared_ptr<const geometry::TriangleMesh> mesh_of(const Vector3d& edges) {
  return std::make_shared<const geometry::TriangleMesh>(geometry::make_box(edges, 12));
}

class TwoHandsSeat : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
    folder = std::make_unique<test_support::TemporaryFolder>();
    test_support::StallMeter stalls;
    server = test_support::record_two_hands(*folder, scene(), {script(kGrip_m), script(-kGrip_m)}, kSeatSeconds, log());
    stall = std::chrono::duration_cast<std::chrono::microseconds>(stalls.end());
    ASSERT_EQ(server.exit_code, 0) << server.standard_error;
    recorded = test_support::read_ticks(log());
    ASSERT_FALSE(recorded.empty());
  }
  static void TearDownTestSuite() { folder.reset(); }

  static std::string log() { return folder->path("run.lcmlog"); }

  static Vector3d bar_of(const RecordedTick& tick) { return tick.state.parts[0].X_WV.translation(); }

  static bool both_hold(const RecordedTick& tick) {
    return tick.state.hands[0].part == 0 && tick.state.hands[1].part == 0;
  }
  /// The bar is between the sides of the forks.
  static bool is_seated(const RecordedTick& tick) { return bar_of(tick).z() < kSeat.z() + 0.01; }

  static inline std::unique_ptr<test_support::TemporaryFolder> folder;
  static inline test_support::ProgramResult server;
  static inline std::chrono::microseconds stall{0};  // the longest of the run
  static inline std::vector<RecordedTick> recorded;
};

TEST_F(TwoHandsSeat, BarEndsInItsForks) {
  const std::vector<HeldByHands> holds = test_support::holds_of(recorded);
  EXPECT_THAT(holds, Contains(HeldByHands(0, 0)));
  EXPECT_EQ(holds.back(), HeldByHands(-1, -1)) << server.standard_error;
  double highest = bar_of(recorded.front()).z();
  bool slides = false;
  for (const RecordedTick& tick : recorded) {
    if (!both_hold(tick)) continue;
    highest = std::max(highest, bar_of(tick).z());
    slides = slides || (is_seated(tick) && tick.state.parts[0].state == devices::PartState::kSliding);
  }
  EXPECT_GT(highest, kBarPlace.z() + 0.02) << "lifted by both";
  EXPECT_TRUE(slides);
  const Vector3d place = bar_of(recorded.back());
  EXPECT_NEAR(place.z(), kSeat.z(), 1.5e-3);
  EXPECT_NEAR(place.x(), kSeat.x(), 0.5 * (kFork_m - kBar.x()));
  EXPECT_EQ(nlohmann::json::parse(server.standard_output)["colliding_poses"], 0);
}

TEST_F(TwoHandsSeat, NothingPenetrates) {
  std::vector<reference::PlacedMesh> obstacles;
  for (const Block& block : stands_and_forks())
    obstacles.push_back({mesh_of(block.edges), at(block.place.x(), block.place.y(), block.place.z())});
  test_support::VisibleBodies bodies(mesh_of(kBar), obstacles);
  for (std::size_t i = 0; i < recorded.size(); i += 5)
    ASSERT_FALSE(bodies.collide(recorded[i].state)) << "after " << i << " ms";
}

TEST_F(TwoHandsSeat, FeelsTheForks) {
  std::array<double, 2> greatest_N{};
  for (const RecordedTick& tick : recorded) {
    if (!both_hold(tick) || !is_seated(tick)) continue;
    for (std::size_t h = 0; h < 2; ++h)
      greatest_N[h] = std::max(greatest_N[h], tick.state.hands[h].force_W.norm());
  }
  // Where states or commands come late again and again, the force never returns fully: `run_where_quiet` judges.
  RecordProperty("stall_us", static_cast<int>(stall.count()));
  EXPECT_GT(greatest_N[0], 1.0);
  EXPECT_GT(greatest_N[1], 1.0);
}

TEST_F(TwoHandsSeat, ForceNeverJumpsAndIsZeroAfterLettingGo) {
  test_support::expect_nothing_that_jumps(recorded);
  std::optional<std::chrono::nanoseconds> left;  // both have opened, and are away from the bar
  for (const RecordedTick& tick : recorded) {
    for (const devices::HapticHandState& hand : std::span(tick.state.hands).first(2)) {
      if (!left || tick.time < *left + std::chrono::milliseconds(100)) continue;
      ASSERT_TRUE(hand.force_W.isZero(0.0));
      ASSERT_EQ(hand.joint_torques, JointValues{});
    }
    const bool are_above = std::all_of(tick.gloves.begin(), tick.gloves.end(), [](const devices::GloveState& glove) {
      return glove.X_WH.translation().z() > 0.0;
    });
    if (!left && is_seated(tick) && are_above) left = tick.time;
  }
  ASSERT_TRUE(left);
}

TEST_F(TwoHandsSeat, ReplayIsBitIdentical) {
  const test_support::ProgramResult replay = test_support::glissade({"replay", log()});
  EXPECT_EQ(replay.exit_code, 0) << replay.standard_error;
}

}  // namespace
}  // namespace glissade::apps
