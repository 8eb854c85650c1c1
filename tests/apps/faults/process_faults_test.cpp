/// What the hand gets when processes fail, or threads within the server. Each test has real processes, in a network
/// namespace of their own; see `PressingHand`.

#include <algorithm>
#include <csignal>
#include <optional>
#include <thread>

#include "pressing_hand_test.h"

namespace glissade::apps {
namespace {

using namespace test_support;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using testing::HasSubstr;

class ProcessFaults : public PressingHandTest {};

TEST_F(ProcessFaults, AServerThatIsKilledHoldsNoForce) {
  hand().server().signal(SIGKILL);
  wait();
  expect_no_force(record());
}

TEST_F(ProcessFaults, AServerThatIsStoppedAndContinuedComesBackSoftly) {
  hand().server().signal(SIGSTOP);
  wait(milliseconds(1500));  // longer than it takes to believe in another clock
  hand().server().signal(SIGCONT);
  recover();
  wait(milliseconds(700));
  const GloveRecord record = this->record();
  expect_no_force(record);
  expect_soft_return(record);
  EXPECT_THAT(hand().end_server(), HasSubstr("no force: the glove's state is"));
}

TEST_F(ProcessFaults, AServerThatEndsLetsTheForceFade) {
  hand().end_server();
  wait();
  const GloveRecord record = this->record();
  const std::vector<GlovePeriod>& periods = record.periods();
  const auto last =
      std::find_if(periods.rbegin(), periods.rend(), [](const GlovePeriod& period) { return period.f_W.norm() > 0.0; });
  ASSERT_NE(last, periods.rend());
  EXPECT_LT(last->t, std::chrono::duration<double>(monotonic_now() - milliseconds(300)).count());
  EXPECT_THAT(last->reason, testing::Not(HasSubstr("no force"))) << "the server's fade, not an expiry at the glove";
}

TEST_F(ProcessFaults, AGloveThatIsStoppedAndContinuedGetsNoOldForce) {
  hand().glove().signal(SIGSTOP);
  wait();
  const nanoseconds continued = monotonic_now();
  hand().glove().signal(SIGCONT);
  recover();
  const GloveRecord record = this->record();
  EXPECT_LT(record.periods().back().t, std::chrono::duration<double>(monotonic_now()).count());
  expect_pressing_again(record);
  // The commands of before the stop are old: the force goes to zero before it comes back.
  const auto after = record.between(continued, continued + kGenerous);
  EXPECT_TRUE(
      std::any_of(after.begin(), after.end(), [](const GlovePeriod& period) { return period.f_W.norm() < 1.0; }));
  EXPECT_THAT(hand().end_server(), HasSubstr("no force: the glove's state is"));
}

TEST_F(ProcessFaults, ForceReturnsSoftlyToAGloveRestartedElsewhere) {
  const double killed = std::chrono::duration<double>(monotonic_now()).count();
  hand().glove().signal(SIGKILL);
  const std::string file = hand().folder().path("restarted.csv");
  const auto restarted = hand().start_glove(0.2, file);
  wait(milliseconds(1500));  // the lease of the first glove, and then the distrust of the jump
  restarted->signal(SIGINT);
  restarted->wait();
  const GloveRecord record(file);
  expect_within_limits(record);
  EXPECT_LT(greatest_sideways(record.periods()), 0.5) << "the jump along the plate must not be felt";
  double last = 0.0;
  for (const GlovePeriod& period : record.periods()) {
    const double force = period.f_W.norm();
    if (period.t < killed + 0.48) {  // the lease is 0.5 s from the last state of the first glove on
      ASSERT_EQ(force, 0.0) << "the first glove has the lease";
    }
    if (last == 0.0) {
      ASSERT_LT(force, 1.0) << "a return that is not soft";
    }
    last = force;
  }
  expect_pressing_again(record);
  EXPECT_THAT(hand().end_server(), HasSubstr("no force"));
}

TEST_F(ProcessFaults, ASecondGloveInFreeAirFeelsNothingOfTheFirst) {
  const std::string with_other_number = hand().folder().path("second.csv");
  const std::string with_same_number = hand().folder().path("third.csv");
  const auto second = hand().start_glove(0.3, with_other_number, "2");
  const auto third = hand().start_glove(0.4, with_same_number);
  wait(milliseconds(1000));
  for (const auto& glove : {second.get(), third.get()}) {
    glove->signal(SIGINT);
    glove->wait();
  }
  const GloveRecord first = record();
  EXPECT_EQ(greatest_force(GloveRecord(with_other_number).periods()), 0.0);
  EXPECT_EQ(greatest_force(GloveRecord(with_same_number).periods()), 0.0);
  expect_no_effect(first);
}

TEST_F(ProcessFaults, ASecondServerIsRefusedAndSaysSo) {
  const auto second = hand().start_server();
  wait(milliseconds(1500));
  second->signal(SIGINT);
  EXPECT_THAT(second->wait().standard_error, HasSubstr("no force: the glove obeys another server"));
  const GloveRecord record = this->record();
  expect_pressing_again(record);
  EXPECT_THAT(hand().end_server(), testing::Not(HasSubstr("another server")));
}

/// The hand slides at 0.1 m/s to and fro over the plate, with the part pressed 25 mm deep.
class SlidingHandFaults : public PressingHandTest {
 protected:
  PressingHandOptions options() const override {
    return {.motion =
                "0.3,0,0,-0.005,1,0,0,0\n2.3,0.2,0,-0.005,1,0,0,0\n6.3,-0.2,0,-0.005,1,0,0,0\n"
                "10.3,0.2,0,-0.005,1,0,0,0\n60,0.2,0,-0.005,1,0,0,0\n",
            .preload = GLISSADE_THREAD_FAULTS};
  }

  /// A thread of the server halts for half a second: the force of its last contacts fades, without any drag, and comes
  /// back when newer contacts are known.
  void halt(const std::string& thread) {
    const nanoseconds begin = monotonic_now();
    hand().server().signal_thread(thread, SIGUSR1);
    wait(milliseconds(1200));
    const GloveRecord record = this->record();
    const auto halted = record.between(begin + kGenerous, begin + milliseconds(450));
    ASSERT_FALSE(halted.empty());
    EXPECT_EQ(greatest_force(halted), 0.0);
    expect_no_drag(record);
    EXPECT_GT(greatest_force(record.between(begin + milliseconds(800), monotonic_now())), kPressing_N);
    EXPECT_THAT(hand().end_server(), HasSubstr("reduced force: the simulation's contacts are"));
  }

  static void expect_no_drag(const GloveRecord& record) {
    EXPECT_LT(greatest_sideways(record.periods()), 0.02 * greatest_force(record.periods()));
  }
};

TEST_F(SlidingHandFaults, HaltedSimulationCausesNoDrag) {
  halt("simulation");
}

TEST_F(SlidingHandFaults, HaltedSearchThreadCausesNoDrag) {
  halt("search");
}

/// A tracker that repeats its last pose while the hand moves.
class FrozenTracker : public SlidingHandFaults {
 protected:
  PressingHandOptions options() const override {
    PressingHandOptions options = SlidingHandFaults::options();
    options.glove_options = {"--frozen-ms", "50"};
    return options;
  }
};

TEST_F(FrozenTracker, ForceFadesWhenThePoseRepeats) {
  relay().set_states(
      Relay::changed<glissade::glove_state_t>([first = std::optional<glissade::glove_state_t>()](auto& state) mutable {
        if (!first) first = state;
        std::copy_n(first->position_WH_m, 3, state.position_WH_m);
        std::copy_n(first->orientation_WH_wxyz, 4, state.orientation_WH_wxyz);
      }));
  wait();
  recover();
  const GloveRecord record = this->record();
  EXPECT_EQ(greatest_force(record.between(begin() + kGenerous + milliseconds(50), begin() + milliseconds(400))), 0.0);
  expect_pressing_again(record);
  EXPECT_THAT(hand().end_server(), HasSubstr("no force: the glove's pose jumps or freezes"));
}

/// On the way lies a ball, whose contacts need more memory than those of the plate.
class BallOnTheWay : public SlidingHandFaults {
 protected:
  PressingHandOptions options() const override {
    PressingHandOptions options = SlidingHandFaults::options();
    options.more_objects =
        "  - {name: ball, shape: {type: sphere, radius_m: 0.02, triangles: 20000}, pose: {position_m: [0.2, 0, 0]}}\n";
    return options;
  }
};

TEST_F(BallOnTheWay, ForceFadesWhenTheSimulationRunsOutOfMemory) {
  hand().server().signal(SIGUSR2);
  wait(milliseconds(2500));
  const GloveRecord record = this->record();
  ASSERT_FALSE(record.periods().empty());
  EXPECT_EQ(record.periods().back().f_W.norm(), 0.0);
  hand().server().signal(SIGINT);  // a server that goes on would never end
  const ProgramResult server = hand().server().wait();
  EXPECT_EQ(server.exit_code, 1);
  EXPECT_THAT(server.standard_error, HasSubstr("the simulation failed: std::bad_alloc"));
}

/// A server whose answers take many milliseconds, because part and plate have many triangles.
class FineMeshesFaults : public SlidingHandFaults {
 protected:
  static PressingHandOptions with_triangles(PressingHandOptions options, int of_plate, int of_box) {
    options.plate_triangles = of_plate;
    options.box_triangles = of_box;
    return options;
  }

  void expect_no_drag_for_long() {
    wait(milliseconds(3000));
    expect_no_drag(record());
  }
};

class FineMeshes : public FineMeshesFaults {
 protected:
  PressingHandOptions options() const override {
    return with_triangles(SlidingHandFaults::options(), 200'000, 100'000);
  }
};

TEST_F(FineMeshes, SlowAnswersCauseNoDrag) {
  expect_no_drag_for_long();
}

/// Fewer triangles, and a hand five times as fast.
class FastHand : public FineMeshesFaults {
 protected:
  PressingHandOptions options() const override {
    PressingHandOptions options = with_triangles(SlidingHandFaults::options(), 12'000, 20'000);
    options.motion =
        "0.3,0,0,-0.005,1,0,0,0\n0.7,0.2,0,-0.005,1,0,0,0\n1.5,-0.2,0,-0.005,1,0,0,0\n"
        "2.3,0.2,0,-0.005,1,0,0,0\n3.1,-0.2,0,-0.005,1,0,0,0\n60,-0.2,0,-0.005,1,0,0,0\n";
    return options;
  }
};

TEST_F(FastHand, SlowAnswersCauseNoDrag) {
  expect_no_drag_for_long();
}

/// The hand rests so deep that the device gives all its force.
class DeepHand : public PressingHandTest {
 protected:
  PressingHandOptions options() const override {
    return {.motion = "0.3,0,0,-0.08,1,0,0,0\n60,0,0,-0.08,1,0,0,0\n", .preload = GLISSADE_THREAD_FAULTS};
  }
};

TEST_F(DeepHand, ForceFadesAndReturnsSoftlyWhenTheSimulationHalts) {
  const nanoseconds begin = monotonic_now();
  hand().server().signal_thread("simulation", SIGUSR1);
  wait(milliseconds(2500));  // on a busy computer, the force returns more slowly
  const GloveRecord record = this->record();
  EXPECT_EQ(greatest_force(record.between(begin + kGenerous, begin + milliseconds(450))), 0.0);
  EXPECT_LT(greatest_force(record.between(begin + kGenerous, begin + milliseconds(560))), 10.0) << "returns softly";
  EXPECT_GT(greatest_force(record.between(begin + milliseconds(900), monotonic_now())), 15.0);
}

}  // namespace
}  // namespace glissade::apps
