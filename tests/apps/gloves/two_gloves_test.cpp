/// Two gloves and a server, each a process of its own over UDP multicast, in a network namespace. The hands pass a
/// cube, hold one together, push one with another, let go and take again; then they grasp and let go at any moment. All
/// is checked from the recording of the run, by code that shares nothing with the simulation.

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <memory>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/devices/event_log.h>
#include <glissade/haptics/recording.h>
#include <glissade/lcmtypes/contact_set_t.hpp>

#include "glissade_program.h"
#include "poses.h"
#include "recorded_ways.h"
#include "two_hand_scripts.h"

namespace glissade::apps {
namespace {

using devices::HapticState;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using haptics::TickRecord;
using test_support::at;
using test_support::BoxOfScene;
using test_support::GripScript;
using test_support::kLesson;
using test_support::kUrl;
using test_support::Process;
using test_support::ProgramResult;
using testing::HasSubstr;

constexpr std::uint64_t kSeed = 3;
constexpr double kForceRate = 20.0 / 7e-3;  // N/s: the simulated glove's
constexpr double kPeriod_s = 1e-3;
const Vector3d kCube(0.02, 0.02, 0.02);

const std::string kMovesAlone = "    moves: lift.csv\n";

/// A closed room, so small that a hand in it can reach all parts, with a bar.
constexpr double kRoom_m = 0.09;  // from its centre to each wall
const Vector3d kBar(0.01, 0.09, 0.01);
const Vector3d kBarPlace(-0.075, 0.0, 0.0);
const std::vector<BoxOfScene> kParts{
    {kCube, at(-0.03)}, {kCube, at(0.03)}, {kCube, at(0.0, 0.06)}, {kCube, at(0.0, 0.0, -0.065)}};

std::vector<BoxOfScene> obstacles() {
  std::vector<BoxOfScene> boxes{{kBar, at(kBarPlace.x(), kBarPlace.y(), kBarPlace.z())}};
  for (const double side : {-kRoom_m, kRoom_m}) {
    for (int axis = 0; axis < 3; ++axis) {
      // A half turn about the middle of two axes swaps them.
      const Vector3d n = Vector3d::Unit(axis);
      const Vector3d middle = axis == 2 ? Vector3d::UnitZ() : Vector3d(n + Vector3d::UnitZ());
      boxes.push_back(
          {{kRoom_m, kRoom_m, 0.0}, test_support::pose(side * n, test_support::turn(std::numbers::pi, middle))});
    }
  }
  return boxes;
}

std::string list(std::initializer_list<double> numbers) {
  std::ostringstream text;
  text.precision(17);
  for (const double number : numbers)
    text << (text.tellp() == 0 ? "[" : ", ") << number;
  return text.str() + "]";
}

std::string object(const std::string& name, const BoxOfScene& box, const std::string& more = {}) {
  const Eigen::Quaterniond q(box.X_WB.linear());
  const Vector3d& p = box.X_WB.translation();
  std::ostringstream text;
  text << "  - name: " << name << "\n    shape: {type: " << (box.half.z() > 0.0 ? "box" : "plate")
       << ", size_x_m: " << 2.0 * box.half.x() << ", size_y_m: " << 2.0 * box.half.y();
  if (box.half.z() > 0.0) text << ", size_z_m: " << 2.0 * box.half.z();
  text << "}\n";
  if (more != kMovesAlone) {
    text << "    pose: {position_m: " << list({p.x(), p.y(), p.z()})
         << ", orientation_wxyz: " << list({q.w(), q.x(), q.y(), q.z()}) << "}\n";
  }
  return text.str() + more;
}

/// The last part moves on its own, up and down below the others.
std::string write_scene(const test_support::TemporaryFolder& folder) {
  folder.write("lift.csv",
               "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n"
               "0,0,0,-0.065,1,0,0,0\n"
               "4,0,0,-0.03,1,0,0,0\n"
               "8,0,0,-0.065,1,0,0,0\n");
  std::string scene = "objects:\n";
  for (const BoxOfScene& box : obstacles())
    scene += object("obstacle" + std::to_string(scene.size()), box);
  for (const std::size_t part : {0U, 1U, 2U})
    scene += object("part" + std::to_string(part), kParts[part], "    movable: true\n");
  return folder.write("scene.yaml", scene + object("lift", kParts[3], kMovesAlone));
}

/// What one hand does in a recording.
class RecordedHand {
 public:
  /// `grip` is its count at the end of the script.
  RecordedHand(std::string name, std::int64_t first_grip, std::int64_t grip)
      : name_(std::move(name)), grip_(first_grip), last_grip_(grip) {}

  void take(const devices::GloveState& state, const devices::HapticHandState& hand) {
    follow_grip(state);
    const bool is_fading = hand.reasons.is_fading();
    ready_ticks_ = is_fading || told_states_ < kGripStates ? 0 : ready_ticks_ + 1;
    // The server has followed the grip: a closed hand holds something, because all parts are within its reach.
    if (ready_ticks_ >= kReadyTicks) {
      ++followed_;
      const bool is_right = (hand.part >= 0) == (grip_ % 2 == 1);
      if (!is_right && wrong_ticks_++ == 0) ADD_FAILURE() << name_ << ", grip " << grip_ << ", part " << hand.part;
    }
    greatest_N_ = std::max(greatest_N_, hand.force_W.norm());
  }

  /// The grips that the glove made are all there.
  void finish() const {
    EXPECT_EQ(grip_, last_grip_) << name_;
    EXPECT_EQ(wrong_ticks_, 0) << name_;
    EXPECT_GT(followed_, 100) << name_;
    EXPECT_GT(greatest_N_, 3.0) << name_;
  }

  std::int64_t grip() const { return grip_; }

 private:
  static constexpr int kGripStates = 4;  // the server waits for three
  static constexpr int kReadyTicks = 3;
  static constexpr std::int64_t kShortestGrip = 45;  // states: the scripts have none shorter than 50 ms

  void follow_grip(const devices::GloveState& state) {
    if (state.sequence == sequence_) return;
    told_states_ = state.grip == grip_ ? told_states_ + 1 : 1;
    EXPECT_GE(state.grip, grip_) << name_;
    // More than one change at once is possible only where the states of a whole grip were lost on the network.
    if (sequence_ >= 0 && state.grip > grip_ + 1) {
      EXPECT_GT(state.sequence - sequence_, kShortestGrip * (state.grip - grip_ - 1)) << name_;
    }
    sequence_ = state.sequence;
    grip_ = state.grip;
  }

  std::string name_;
  std::int64_t grip_;
  std::int64_t last_grip_;
  std::int64_t sequence_ = -1;
  int told_states_ = 0;
  int ready_ticks_ = 0;
  std::int64_t followed_ = 0;
  std::int64_t wrong_ticks_ = 0;
  double greatest_N_ = 0.0;
};

/// What happened in a run, so that one in which nothing happens proves nothing.
struct RunFigures {
  std::int64_t ticks = 0;
  std::int64_t grips = 0;
  std::int64_t passes = 0;         ///< from hand to hand without a tick in which nobody held the part
  std::int64_t shared_ticks = 0;   ///< both hands held one part
  std::int64_t mutual_pushes = 0;  ///< answers in which two parts push each other
  double greatest_step = 0.0;      ///< of the force of a hand in a tick, over what is allowed
};

/// Reads a recording from its beginning to its end.
class RecordingCheck {
 public:
  explicit RecordingCheck(const std::array<GripScript, 2>& scripts)
      : hands_{RecordedHand("first hand", 1, scripts[0].grip), RecordedHand("second hand", 0, scripts[1].grip)} {}

  void read(const std::string& path) {
    devices::EventLogReader log(path);
    while (const auto event = log.next()) {
      if (event->channel == "CONTACT_SET") {
        take_answer(*event);
      } else if (event->channel == "HAPTIC_TICK") {
        tick_ = haptics::consumed_by_tick(*event);
        ASSERT_TRUE(tick_);
      } else if (const auto state = devices::haptic_state_of(*event)) {
        ASSERT_TRUE(tick_) << "a state comes after its tick";
        take_tick(*state);
      }
    }
    EXPECT_EQ(log.damage(), "");
    for (const RecordedHand& hand : hands_)
      hand.finish();
    for (std::size_t i = 0; i < kLesson.size(); ++i) {
      EXPECT_EQ(parts_[i], kLesson[i].parts) << kLesson[i].what;
      for (const double force_N : forces_N_[i])
        EXPECT_GE(force_N, kLesson[i].least_force_N) << kLesson[i].what;
    }
  }

  const RunFigures& figures() const { return figures_; }
  const test_support::WayFigures& ways() { return ways_.finish(); }

 private:
  using Held = std::array<std::int32_t, 2>;

  void take_answer(const devices::LogEvent& event) {
    contact_set_t set;
    ASSERT_GT(set.decode(event.message.data(), 0, static_cast<int>(event.message.size())), 0);
    ASSERT_EQ(set.part_count, std::ssize(kParts));
    std::vector<Isometry3d> X_WV;
    for (const part_answer_t& answer : set.answers) {
      Isometry3d& X = X_WV.emplace_back(Isometry3d::Identity());
      X.linear() = Eigen::Map<const Eigen::Matrix3d>(answer.X_WV.rotation);
      X.translation() = Eigen::Map<const Vector3d>(answer.X_WV.position_m);
    }
    ways_.take(X_WV);
    figures_.mutual_pushes += std::any_of(set.rows.begin(), set.rows.end(),
                                          [](const contact_row_t& row) { return row.pushes != 0 && row.other >= 0; })
                                  ? 1
                                  : 0;
  }

  void take_tick(const HapticState& state) {
    ++figures_.ticks;
    // The envelope counts at most two periods for a step.
    const double dt = std::clamp(std::chrono::duration<double>(tick_->time - last_time_).count(), 0.0, 2.0 * kPeriod_s);
    Held held{-1, -1};
    for (std::size_t h = 0; h < hands_.size(); ++h) {
      held[h] = state.hands[h].part;
      ASSERT_TRUE(state.hands[h].force_W.allFinite());
      if (figures_.ticks > 1) {
        const double step_N = (state.hands[h].force_W - last_.hands[h].force_W).norm();
        figures_.greatest_step = std::max(figures_.greatest_step, step_N / (kForceRate * dt + 1e-9));
      }
      if (!tick_->has_state[h]) continue;
      const std::int64_t before = hands_[h].grip();
      hands_[h].take(tick_->states[h], state.hands[h]);
      figures_.grips += hands_[h].grip() - before;
    }
    figures_.shared_ticks += held[0] >= 0 && held[0] == held[1] ? 1 : 0;
    note_pass(held);
    note_lesson(state, held);
    last_ = state;
    last_time_ = tick_->time;
  }

  /// The other hand holds the part on, which alone held it some ticks ago.
  void note_pass(const Held& held) {
    for (std::size_t h = 0; h < held.size(); ++h) {
      const std::int32_t part = held[h];
      if (part < 0 || held[1 - h] == part) continue;
      auto& holder = last_holder_[static_cast<std::size_t>(part)];
      figures_.passes += holder && *holder != h ? 1 : 0;
      holder = h;
    }
    for (std::size_t part = 0; part < last_holder_.size(); ++part) {
      if (std::find(held.begin(), held.end(), static_cast<std::int32_t>(part)) == held.end())
        last_holder_[part].reset();
    }
  }

  void note_lesson(const HapticState& state, const Held& held) {
    for (std::size_t i = 0; i < kLesson.size(); ++i) {
      if (kLesson[i].grips[0] != hands_[0].grip() || kLesson[i].grips[1] != hands_[1].grip()) continue;
      parts_[i] = held;
      for (std::size_t h = 0; h < held.size(); ++h)
        forces_N_[i][h] = std::max(forces_N_[i][h], state.hands[h].force_W.norm());
    }
  }

  test_support::RecordedWays ways_{obstacles(), kParts};
  std::array<RecordedHand, 2> hands_;
  std::optional<TickRecord> tick_;
  HapticState last_;
  std::chrono::nanoseconds last_time_{0};
  std::array<std::optional<std::size_t>, 4> last_holder_;  // of each part, while somebody holds it
  std::array<Held, kLesson.size()> parts_{};               // at the end of each step of the lesson
  std::array<std::array<double, 2>, kLesson.size()> forces_N_{};
  RunFigures figures_;
};

/// Expects that the force which the glove gave to its hand did not jump.
void expect_no_jump_at_the_glove(const std::string& record) {
  std::ifstream file(record);
  std::string line;
  std::getline(file, line);
  std::optional<Vector3d> last;
  std::int64_t periods = 0;
  for (; std::getline(file, line); ++periods) {
    const std::vector<std::string> cells = test_support::split(line);
    ASSERT_GT(cells.size(), 11U) << line;
    const auto number = [&](std::size_t cell) { return std::strtod(cells[cell].c_str(), nullptr); };
    const Vector3d f_W(number(8), number(9), number(10));
    ASSERT_TRUE(f_W.allFinite()) << line;
    // The file rounds, and the envelope counts at most two periods for a step.
    if (last) {
      ASSERT_LE((f_W - *last).norm(), 2.0 * kForceRate * kPeriod_s * (1.0 + 1e-6)) << line;
    }
    last = f_W;
  }
  EXPECT_GT(periods, 1000);
}

/// The last of what a program has said: a line for each grasp is too much.
std::string end_of(const std::string& text) {
  constexpr std::size_t kMost = 1000;
  return text.size() > kMost ? "..." + text.substr(text.size() - kMost) : text;
}

/// Ten thousand grasps and releases in ten minutes: GLISSADE_HAND_SECONDS=600.
TEST(TwoGloves, RandomGraspsCauseNoCollisionForceJumpOrLostTick) {
  ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  const char* const wish = std::getenv("GLISSADE_HAND_SECONDS");
  const int seconds = wish != nullptr ? std::max(8, std::atoi(wish)) : 15;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  const test_support::TemporaryFolder folder;
  const std::string scene = write_scene(folder);
  const std::array<GripScript, 2> scripts = test_support::two_hand_scripts(seconds, kSeed);
  std::array<std::unique_ptr<Process>, 2> gloves;
  for (std::size_t h = 0; h < gloves.size(); ++h) {
    const std::string number = std::to_string(h + 1);
    gloves[h] = std::make_unique<Process>(std::vector<std::string>{
        GLISSADE_PROGRAM, "glove", "--lcm", kUrl, "--device", number, "--side", h == 0 ? "right" : "left", "--script",
        folder.write("hand_" + number + ".csv", scripts[h].csv), "--record", folder.path("glove_" + number + ".csv")});
  }
  const std::string log = folder.path("run.lcmlog");
  const ProgramResult server =
      test_support::glissade({"record", log, scene, "--lcm", kUrl, "--device", "1", "2", "--hold", "1=part0",
                              "2=", "--friction", "0.2", "--seconds", std::to_string(seconds), "--json"});
  ASSERT_EQ(server.exit_code, 0) << end_of(server.standard_error);
  EXPECT_NE(server.standard_error.find("glissade record: "), std::string::npos) << end_of(server.standard_error);
  const nlohmann::json summary = nlohmann::json::parse(server.standard_output);
  EXPECT_EQ(summary["colliding_poses"], 0);
  EXPECT_EQ(summary["ticks"], 1000 * seconds);
  for (std::size_t h = 0; h < gloves.size(); ++h) {
    gloves[h]->signal(SIGINT);
    EXPECT_EQ(gloves[h]->wait().exit_code, 0);
    expect_no_jump_at_the_glove(folder.path("glove_" + std::to_string(h + 1) + ".csv"));
  }

  RecordingCheck check(scripts);
  check.read(log);
  const RunFigures& figures = check.figures();
  EXPECT_EQ(figures.ticks, 1000 * seconds);
  EXPECT_LE(figures.greatest_step, 1.0 + 1e-9);
  EXPECT_GT(figures.passes, 0);
  EXPECT_GT(figures.shared_ticks, 500);
  EXPECT_GT(figures.mutual_pushes, 100);
  const test_support::WayFigures& ways = check.ways();
  EXPECT_EQ(ways.colliding, 0) << ways.first_fault;
  EXPECT_EQ(ways.blocked, 0) << ways.first_fault;
  EXPECT_GT(ways.ways, 1000);
  RecordProperty("grips", static_cast<int>(figures.grips));
  RecordProperty("passes", static_cast<int>(figures.passes));
  RecordProperty("detours", static_cast<int>(ways.detours));

  const ProgramResult replay = test_support::glissade({"replay", log});
  EXPECT_EQ(replay.exit_code, 0) << replay.standard_error;
  EXPECT_THAT(replay.standard_output, HasSubstr("bit-identical"));
}

}  // namespace
}  // namespace glissade::apps
