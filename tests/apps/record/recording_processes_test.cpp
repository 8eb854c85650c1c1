/// Recordings of several processes over UDP multicast, also by LCM's own programs, in a network namespace.

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/devices/event_log.h>

#include "glissade_program.h"
#include "pressing_scene.h"
#include "process.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using test_support::kUrl;
using test_support::Process;
using test_support::ProgramResult;
using testing::HasSubstr;

class RecordingProcesses : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  }

  std::string log(const std::string& name) const { return folder.path(name); }

  std::vector<std::string> glove() const {
    return {GLISSADE_PROGRAM, "glove", "--lcm", kUrl, "--script", folder.path("hand.csv")};
  }

  /// The number of messages of a log by their channels.
  static std::map<std::string, int> channels(const std::string& path) {
    std::map<std::string, int> counts;
    devices::EventLogReader reader(path);
    while (const auto event = reader.next())
      ++counts[event->channel];
    EXPECT_EQ(reader.damage(), "");
    return counts;
  }

  /// Waits until there is such a file; false after twenty seconds.
  static bool comes_at_last(const std::string& path) {
    for (int i = 0; i < 2000; ++i) {
      if (std::filesystem::exists(path)) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  /// Waits until the program has said this; false after twenty seconds.
  static bool says_at_last(const Process& program, const std::string& text) {
    for (int i = 0; i < 2000; ++i) {
      if (program.standard_error().find(text) != std::string::npos) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  static void expect_same(const std::string& path) {
    const ProgramResult result = test_support::glissade({"replay", path});
    EXPECT_EQ(result.exit_code, 0) << result.standard_error;
    EXPECT_THAT(result.standard_output, HasSubstr("bit-identical"));
  }

  test_support::TemporaryFolder folder;
  std::string scene = test_support::write_pressing_scene(folder);
};

TEST_F(RecordingProcesses, ServerRunIsReplayedAndLeadsAnotherServer) {
  {
    const Process hand(glove());
    const ProgramResult server =
        test_support::glissade({"record", log("run.lcmlog"), scene, "--lcm", kUrl, "--seconds", "0.8", "--json"});
    ASSERT_EQ(server.exit_code, 0) << server.standard_error;
  }
  expect_same(log("run.lcmlog"));

  // The recorded glove leads another server.
  Process player({GLISSADE_PROGRAM, "replay", log("run.lcmlog"), "--lcm", kUrl, "--json"});
  const ProgramResult server = test_support::glissade({"run", scene, "--lcm", kUrl, "--seconds", "0.7", "--json"});
  EXPECT_EQ(server.exit_code, 0) << server.standard_error;
  const nlohmann::json summary = nlohmann::json::parse(server.standard_output);
  EXPECT_EQ(summary["colliding_poses"], 0);
  EXPECT_GT(summary["parts"][0]["contact_fraction"], 0.3);
  const ProgramResult played = player.wait();
  ASSERT_EQ(played.exit_code, 0) << played.standard_error;
  const nlohmann::json glove = nlohmann::json::parse(played.standard_output)["gloves"][0];
  EXPECT_GT(glove["states"], 700);
  EXPECT_GT(glove["commands"], 300);
  // How much depends on the machine: where a state comes late, the force fades and returns slowly.
  EXPECT_GT(glove["force_max_N"], 0.0);
}

/// The recorded gloves of a log, as if they had told `rate` states a second: every second one is left out.
void halve_rate(const std::string& from, const std::string& to, double rate) {
  devices::EventLogReader reader(from);
  devices::EventLogWriter writer(to);
  bool is_kept = false;
  while (const auto event = reader.next()) {
    if (auto glove = devices::glove_info_of(*event)) {
      glove->descriptor.update_rate = rate;
      writer.write(devices::to_event(event->time, *glove));
    } else if (devices::glove_state_of(*event)) {
      is_kept = !is_kept;
      if (is_kept) writer.write(*event);
    }
  }
  writer.close();
}

TEST_F(RecordingProcesses, ASlowerGloveIsPlayedAtItsOwnRate) {
  constexpr double kRate = 500.0;
  ASSERT_EQ(test_support::glissade({"demo", "--offline", "--seconds", "1", "--scene", scene, "--record", log("1kHz")})
                .exit_code,
            0);
  halve_rate(log("1kHz"), log("500Hz"), kRate);
  // The player waits at the first states; so the times of the states are those of its own clock from then on.
  Process logger({"lcm-logger", "--lcm-url", kUrl, "--quiet", log("played.lcmlog")});
  ASSERT_TRUE(comes_at_last(log("played.lcmlog")));
  Process player({GLISSADE_PROGRAM, "replay", log("500Hz"), "--lcm", kUrl, "--json"});
  const ProgramResult server = test_support::glissade({"run", scene, "--lcm", kUrl, "--seconds", "0.7", "--json"});
  const ProgramResult played = player.wait();
  logger.signal(SIGINT);
  logger.wait();
  ASSERT_EQ(server.exit_code, 0) << server.standard_error;
  const nlohmann::json summary = nlohmann::json::parse(server.standard_output);
  EXPECT_EQ(summary["ticks"], 350) << "the server goes at the rate of the glove";
  EXPECT_EQ(summary["colliding_poses"], 0);
  EXPECT_GT(summary["parts"][0]["contact_fraction"], 0.3);
  ASSERT_EQ(played.exit_code, 0) << played.standard_error;
  EXPECT_GT(nlohmann::json::parse(played.standard_output)["gloves"][0]["force_max_N"], 0.0);
  std::optional<devices::GloveState> first;
  devices::GloveState last;
  devices::EventLogReader reader(log("played.lcmlog"));
  while (const auto event = reader.next()) {
    const auto logged = devices::glove_state_of(*event);
    if (!logged) continue;
    last = logged->state;
    if (!first) first = last;
    // A state that comes late does not make the next one late.
    ASSERT_GE((last.time - first->time).count(), 2'000'000 * (last.sequence - first->sequence))
        << "more states than the glove told";
  }
  EXPECT_GT(last.sequence, 300);
}

TEST_F(RecordingProcesses, LcmLoggerRecordsARun) {
  {
    Process logger({"lcm-logger", "--lcm-url", kUrl, "--quiet", log("logger.lcmlog")});
    ASSERT_TRUE(comes_at_last(log("logger.lcmlog")));
    const Process hand(glove());
    const ProgramResult server = test_support::glissade({"run", scene, "--lcm", kUrl, "--seconds", "0.8"});
    ASSERT_EQ(server.exit_code, 0) << server.standard_error;
    logger.signal(SIGINT);
    logger.wait();
  }
  const std::map<std::string, int> counts = channels(log("logger.lcmlog"));
  // Of 800 each; a busy machine loses some.
  EXPECT_GT(counts.at("HAPTIC_STATE"), 200);
  EXPECT_GT(counts.at("GLOVE_STATE"), 200);
  EXPECT_GT(counts.at("GLOVE_COMMAND"), 200);
  const ProgramResult tables = test_support::glissade({"log", "to-csv", log("logger.lcmlog"), log("tables")});
  EXPECT_EQ(tables.exit_code, 0) << tables.standard_error;
  EXPECT_THAT(tables.standard_output, HasSubstr("hands.csv"));
}

TEST_F(RecordingProcesses, WhatLcmLoggerAppendsIsRead) {
  const Process hand(glove());
  const std::string joined = log("joined.lcmlog");
  folder.write("joined.lcmlog", "");
  int before = 0;
  for (int i = 0; i < 2; ++i) {
    const std::uintmax_t size = std::filesystem::file_size(joined);
    Process logger({"lcm-logger", "--lcm-url", kUrl, "--quiet", "--append", joined});
    for (int turn = 0; turn < 2000 && std::filesystem::file_size(joined) < size + 10'000; ++turn)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    logger.signal(SIGINT);
    logger.wait();
    const int states = channels(joined).at("GLOVE_STATE");
    EXPECT_GT(states, before);
    before = states;
  }
}

TEST_F(RecordingProcesses, LcmLogplayerPlaysARecording) {
  // The player waits for nobody: the hand does, until the server has started and holds the box.
  folder.write("hand.csv",
               "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n"
               "0,0,0,0.03,1,0,0,0\n"
               "1.5,0,0,0.03,1,0,0,0\n"
               "1.7,0,0,0.01,1,0,0,0\n"
               "2.3,0.05,0,0.01,1,0,0,0\n");
  const ProgramResult demo = test_support::glissade(
      {"demo", "--offline", "--seconds", "2.5", "--scene", scene, "--record", log("run.lcmlog")});
  ASSERT_EQ(demo.exit_code, 0) << demo.standard_error;
  Process server({GLISSADE_PROGRAM, "run", scene, "--lcm", kUrl, "--json"});
  ASSERT_TRUE(says_at_last(server, "waiting for a glove"));
  Process player({"lcm-logplayer", "--lcm-url", kUrl, log("run.lcmlog")});
  EXPECT_EQ(player.wait().exit_code, 0);
  server.signal(SIGINT);
  const ProgramResult result = server.wait();
  ASSERT_EQ(result.exit_code, 0) << result.standard_error;
  const nlohmann::json summary = nlohmann::json::parse(result.standard_output);
  EXPECT_GT(summary["parts"][0]["contact_fraction"], 0.0) << "it has followed the recorded hand";
  EXPECT_EQ(summary["colliding_poses"], 0);
}

TEST_F(RecordingProcesses, TheFlightRecorderTellsOfALostGloveAndOfARequest) {
  std::optional<Process> hand(std::in_place, glove());
  Process server({GLISSADE_PROGRAM, "run", scene, "--lcm", kUrl, "--flight-recorder", log("flight.lcmlog")});
  ASSERT_TRUE(says_at_last(server, "holds 'box'"));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  server.signal(SIGUSR1);
  EXPECT_TRUE(says_at_last(server, "the last seconds are in " + log("flight.lcmlog")));
  hand.reset();  // killed
  EXPECT_TRUE(says_at_last(server, "the last seconds are in " + log("flight-2.lcmlog")));
  server.signal(SIGINT);
  EXPECT_EQ(server.wait().exit_code, 0);
  EXPECT_GT(channels(log("flight.lcmlog")).at("HAPTIC_TICK"), 300);
  EXPECT_GT(channels(log("flight-2.lcmlog")).at("HAPTIC_TICK"), channels(log("flight.lcmlog")).at("HAPTIC_TICK"));
}

}  // namespace
}  // namespace glissade::apps
