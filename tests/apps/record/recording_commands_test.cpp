/// Recordings made and read by the program: `demo --record`, `replay`, `log to-csv`, `log to-mcap`.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/apps/record/flight_log.h>
#include <glissade/apps/text.h>
#include <glissade/devices/event_log.h>
#include <glissade/files/text_file.h>

#include "glissade_program.h"
#include "pressing_scene.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using test_support::expect_fails;
using test_support::expect_refused;
using testing::HasSubstr;
using testing::Not;

/// The recording of a demonstration of half a second.
class RecordingCommands : public testing::Test {
 protected:
  explicit RecordingCommands(bool is_offline = true) {
    std::vector<std::string> arguments{"demo", "--seconds", "0.5", "--json", "--scene", scene_, "--record", log_};
    if (is_offline) arguments.emplace_back("--offline");
    const test_support::ProgramResult result = test_support::glissade(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.standard_error;
  }

  static nlohmann::json outcome(const test_support::ProgramResult& result) {
    return nlohmann::json::parse(result.standard_output);
  }

  std::string bytes() const {
    std::ifstream file(log_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::string changed(const std::string& bytes) const { return folder_.write("changed.lcmlog", bytes); }

  /// The place of the tenth tick's message in the file.
  std::size_t place_of_a_tick() const {
    const std::string all = bytes();
    std::size_t place = 0;
    for (int i = 0; i < 10; ++i)
      place = all.find("HAPTIC_TICK", place + 1);
    return place + 11;
  }

  test_support::TemporaryFolder folder_;
  std::string scene_ = test_support::write_pressing_scene(folder_);
  std::string log_ = folder_.path("run.lcmlog");
};

class RecordingInRealTime : public RecordingCommands {
 protected:
  RecordingInRealTime() : RecordingCommands(false) {}
};

TEST_F(RecordingCommands, ReplayOfAnOfflineRunIsBitIdentical) {
  const test_support::ProgramResult result = test_support::glissade({"replay", log_, "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.standard_error;
  const nlohmann::json repeated = outcome(result);
  EXPECT_EQ(repeated["same"], true);
  EXPECT_EQ(repeated["ticks"], 500);
  EXPECT_EQ(repeated["contact_sets"], 500);
  EXPECT_NEAR(repeated["recorded_s"].get<double>(), 0.499, 1e-9);
  EXPECT_THAT(test_support::glissade({"replay", log_}).standard_output, HasSubstr("bit-identical"));
}

TEST_F(RecordingInRealTime, ReplayIsBitIdentical) {
  const test_support::ProgramResult result = test_support::glissade({"replay", log_, "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.standard_error;
  EXPECT_EQ(outcome(result)["same"], true);
  EXPECT_GE(outcome(result)["ticks"], 300);
}

TEST_F(RecordingCommands, AReplayTellsWhereItsReportIs) {
  const test_support::ProgramResult result =
      test_support::glissade({"replay", log_, "--report", folder_.path("report")});
  ASSERT_EQ(result.exit_code, 0) << result.standard_error;
  const std::string page = folder_.path("report/index.html");
  EXPECT_THAT(result.standard_output, HasSubstr("report: " + page + "\n"));
  EXPECT_THAT(read_text_file(page), HasSubstr("id=\"report-frames\""));
}

TEST_F(RecordingCommands, ASceneThatHasChangedIsRefused) {
  const std::string text = read_text_file(scene_);
  const std::string moved =
      folder_.write("moved.yaml", std::string(text).replace(text.find("0, 0, 0.03"), 10, "0, 0, 0.04"));
  expect_refused({"replay", log_, "--scene", moved}, {"moved.yaml", "run.lcmlog", "has changed"});
  std::filesystem::remove(scene_);
  expect_refused({"replay", log_}, {"scene.yaml"});
}

TEST_F(RecordingCommands, ATruncatedLogIsRepeatedUpToItsEnd) {
  const std::string cut = changed(bytes().substr(0, bytes().size() / 2));
  const test_support::ProgramResult result = test_support::glissade({"replay", cut, "--json"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.standard_error, HasSubstr("the file ends within an event"));
  EXPECT_EQ(outcome(result)["same"], false);
  EXPECT_GT(outcome(result)["ticks"], 200);
  EXPECT_LT(outcome(result)["ticks"], 300);
}

TEST_F(RecordingCommands, AFlippedBitIsFoundOut) {
  std::string all = bytes();
  all[place_of_a_tick() + 60] ^= 4;  // in the tick's time
  expect_fails(1, {"replay", changed(all), "--json"}, {"changed.lcmlog", "the tick after 9 cannot be read"});
}

TEST_F(RecordingCommands, AnnouncementOfAnotherVersionIsRefused) {
  std::string all = bytes();
  all[all.find("GLOVE_INFO") + 10] ^= 1;  // the first byte of the message, in its type's fingerprint
  expect_refused({"replay", changed(all)}, {"changed.lcmlog: the event on GLOVE_INFO cannot be read"});
}

TEST_F(RecordingCommands, AForeignFileIsRefused) {
  expect_refused({"replay", scene_}, {"scene.yaml", "is no LCM event log"});
  expect_refused({"replay", folder_.path("nothing.lcmlog")}, {"nothing.lcmlog: there is no such file"});
  expect_refused({"log", "to-csv", scene_, folder_.path("tables")}, {"scene.yaml", "is no LCM event log"});
  const std::string log = folder_.path("other.lcmlog");
  devices::EventLogWriter writer(log);
  writer.write(devices::to_event(std::chrono::seconds(1), "OTHER", {1, 2, 3}));
  writer.close();
  expect_refused({"replay", log}, {"other.lcmlog", "HAPTIC_SESSION", "cannot be repeated"});
  expect_refused({"replay", log, "--lcm", "udpm://239.255.76.67:7667?ttl=0"}, {"other.lcmlog", "no glove to play"});
}

TEST_F(RecordingCommands, TheRunsOfJoinedLogsAreRepeatedOneAfterTheOther) {
  const std::string joined = changed(bytes() + bytes());
  const test_support::ProgramResult result = test_support::glissade({"replay", joined, "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.standard_error;
  EXPECT_EQ(outcome(result)["same"], true);
  EXPECT_EQ(outcome(result)["runs"], 2);
  EXPECT_EQ(outcome(result)["ticks"], 1000);
  EXPECT_NEAR(outcome(result)["recorded_s"].get<double>(), 2 * 0.499, 1e-9);

  std::string second = bytes();
  second[place_of_a_tick() + 60] ^= 4;
  expect_fails(1, {"replay", changed(bytes() + second), "--json"}, {"run 2: the tick after 9 cannot be read"});
}

TEST_F(RecordingCommands, ExportsOfJoinedLogsHaveAllRuns) {
  const std::string joined = changed(bytes() + bytes());
  const std::string tables = folder_.path("tables");
  ASSERT_EQ(test_support::glissade({"log", "to-csv", joined, tables}).exit_code, 0);
  EXPECT_EQ(test_support::rows_of(read_text_file(tables + "/ticks.csv")).size(), 1000U);
  const test_support::ProgramResult mcap = test_support::glissade({"log", "to-mcap", joined, folder_.path("run.mcap")});
  EXPECT_EQ(mcap.exit_code, 0) << mcap.standard_error;
  EXPECT_THAT(mcap.standard_output, HasSubstr("/scene: 2 messages\n/tf: 1000 messages"));
  EXPECT_EQ(
      test_support::glissade({"export", "--log", joined, "--at", "0.4", "--out", folder_.path("a.glb")}).exit_code, 0);
  expect_refused({"export", "--log", joined, "--at", "0.6", "--out", folder_.path("a.glb")}, {"--at", "beyond"});
}

TEST_F(RecordingCommands, LogWithMissingEventsIsExportedWithoutError) {
  devices::EventLogReader reader(log_);
  const std::string thin = folder_.path("thin.lcmlog");
  devices::EventLogWriter writer(thin);
  for (int i = 0; const std::optional<devices::LogEvent> event = reader.next(); ++i) {
    if (i % 3 != 1) writer.write(*event);
  }
  writer.close();
  std::string bytes = read_text_file(thin);
  bytes[11] = 77;  // the number of the first event
  const test_support::ProgramResult result =
      test_support::glissade({"log", "to-csv", changed(bytes), folder_.path("tables")});
  EXPECT_EQ(result.exit_code, 0) << result.standard_error;
  EXPECT_EQ(result.standard_error, "");
}

TEST_F(RecordingCommands, TablesTellOfEveryTick) {
  const std::string tables = folder_.path("tables");
  const test_support::ProgramResult result = test_support::glissade({"log", "to-csv", log_, tables});
  ASSERT_EQ(result.exit_code, 0) << result.standard_error;
  EXPECT_THAT(result.standard_output, HasSubstr("ticks.csv: 500 rows"));
  const auto rows = [&](const std::string& name) { return test_support::rows_of(read_text_file(tables + "/" + name)); };
  EXPECT_EQ(rows("ticks.csv").size(), 500U);
  EXPECT_EQ(rows("gloves.csv").size(), 500U);
  ASSERT_EQ(rows("parts.csv").size(), 500U);
  ASSERT_EQ(rows("hands.csv").size(), 500U);
  EXPECT_EQ(rows("parts.csv").back().at("state"), "sliding");
  EXPECT_GT(parse_number(rows("hands.csv").back().at("fz_N")), 0.5) << "the plate pushes the hand up";
  EXPECT_LT(parse_number(rows("parts.csv").back().at("gz_m")), parse_number(rows("parts.csv").back().at("vz_m")));
}

TEST_F(RecordingCommands, LeftoverTablesOfAnotherLogAreReported) {
  const std::string tables = folder_.path("tables");
  ASSERT_EQ(test_support::glissade({"log", "to-csv", log_, tables}).exit_code, 0);
  const std::string only_a_state = folder_.path("state.lcmlog");
  devices::EventLogWriter writer(only_a_state);
  writer.write(devices::to_event(std::chrono::seconds(1), devices::HapticState{.part_count = 1}));
  writer.close();
  const test_support::ProgramResult result = test_support::glissade({"log", "to-csv", only_a_state, tables});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.standard_output, HasSubstr("parts.csv: 1 row\n"));
  for (const std::string table : {"ticks.csv", "gloves.csv"})
    EXPECT_THAT(result.standard_error, HasSubstr(table + " is not of this log"));
  EXPECT_THAT(result.standard_error, Not(HasSubstr("parts.csv")));
}

TEST_F(RecordingCommands, TheTableOfHandsNamesFormAndSegmentsOfAGrasp) {
  const std::string log = folder_.path("grasp.lcmlog");
  devices::HapticState state;
  state.hand_count = 2;
  state.hands[0].visible.form = hands::GraspForm::kTipPinch;
  // The outer segments of thumb and index: 2^(4 f + 3), where f is 1 and 2.
  state.hands[0].visible.touching = (1 << 7) + (1 << 11);
  state.hands[1].visible.touching = 1 + (1 << 22);  // the palm, and the middle segment of the little finger
  devices::EventLogWriter writer(log);
  writer.write(devices::to_event(std::chrono::seconds(1), state));
  writer.close();
  const test_support::ProgramResult result = test_support::glissade({"log", "to-csv", log, folder_.path("tables")});
  ASSERT_EQ(result.exit_code, 0) << result.standard_error;
  const std::vector<test_support::CsvRow> rows =
      test_support::rows_of(read_text_file(folder_.path("tables/hands.csv")));
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].at("form"), "tip-pinch");
  EXPECT_EQ(rows[0].at("touching"), "thumb_distal index_distal");
  EXPECT_EQ(rows[1].at("form"), "");
  EXPECT_EQ(rows[1].at("touching"), "palm little_middle");
}

TEST_F(RecordingCommands, TablesOfADamagedLogHoldWhatComesBefore) {
  const std::string cut = changed(bytes().substr(0, bytes().size() / 2));
  const std::string tables = folder_.path("tables");
  const test_support::ProgramResult result = test_support::glissade({"log", "to-csv", cut, tables});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.standard_error, HasSubstr("changed.lcmlog: damaged at byte"));
  EXPECT_GT(test_support::rows_of(read_text_file(tables + "/ticks.csv")).size(), 200U);
}

// The log itself is whole.
TEST_F(RecordingCommands, UnreadableEventIsOmittedFromExportsAndReported) {
  std::string flipped = bytes();
  flipped[flipped.find("HAPTIC_TICK", flipped.size() / 2) + 200] ^= 1;
  const std::string log = changed(flipped);
  for (const auto& [command, output] : {std::pair("to-csv", "tables"), std::pair("to-mcap", "run.mcap")}) {
    const test_support::ProgramResult result = test_support::glissade({"log", command, log, folder_.path(output)});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.standard_error, HasSubstr("changed.lcmlog: 1 event cannot be read"));
    EXPECT_THAT(result.standard_error, testing::EndsWith(", on HAPTIC_TICK\n"));
  }
  EXPECT_EQ(test_support::rows_of(read_text_file(folder_.path("tables/ticks.csv"))).size(), 499U);
}

TEST_F(RecordingCommands, McapHasEveryTickAndTheScene) {
  const std::string mcap = folder_.path("run.mcap");
  const test_support::ProgramResult result = test_support::glissade({"log", "to-mcap", log_, mcap});
  ASSERT_EQ(result.exit_code, 0) << result.standard_error;
  EXPECT_EQ(result.standard_output,
            "/contacts: 30 messages\n/hand_0: 500 messages\n/loop: 500 messages\n/part_0: 500 messages\n"
            "/scene: 1 message\n/tf: 500 messages\n")
      << "/contacts has at most 60 a second: one in 17 ticks";
  EXPECT_EQ(result.standard_error, "");
  expect_refused({"log", "to-mcap", log_, log_}, {"run.lcmlog", "is an input, which would be overwritten"});
  expect_refused({"log", "to-mcap", log_, folder_.path("no/run.mcap")}, {"no/run.mcap", "cannot be created"});
  expect_refused({"log", "to-mcap", scene_, mcap}, {"scene.yaml", "is no LCM event log"});
}

TEST_F(RecordingCommands, McapOfALargeSceneIsSimplifiedAndSaysSo) {
  std::string large = read_text_file(scene_);
  large.replace(large.find("triangles: 200"), 14, "triangles: 120000");
  const std::string scene = folder_.write("large.yaml", large);
  test_support::glissade({"demo", "--offline", "--seconds", "0.02", "--scene", scene, "--record", log_, "--overwrite"});
  const std::string mcap = folder_.path("large.mcap");
  const test_support::ProgramResult result = test_support::glissade({"log", "to-mcap", log_, mcap});
  ASSERT_EQ(result.exit_code, 0) << result.standard_error;
  EXPECT_THAT(result.standard_error, HasSubstr("large.yaml has 12"));
  EXPECT_THAT(result.standard_error, HasSubstr(" triangles: " + mcap + " shows it with about 100000\n"));
}

TEST_F(RecordingCommands, McapOfADamagedLogHoldsWhatComesBefore) {
  const std::string cut = changed(bytes().substr(0, bytes().size() / 2));
  const std::string mcap = folder_.path("run.mcap");
  const test_support::ProgramResult result = test_support::glissade({"log", "to-mcap", cut, mcap});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.standard_error, HasSubstr("changed.lcmlog: damaged at byte"));
  EXPECT_THAT(result.standard_output, testing::ContainsRegex("/tf: 2[0-9][0-9] messages"));
  EXPECT_THAT(read_text_file(mcap), testing::EndsWith("MCAP0\r\n")) << "the file is whole";
}

TEST_F(RecordingCommands, McapOfALogWithoutASessionHasNoScene) {
  const std::string log = folder_.path("flight.lcmlog");
  devices::EventLogReader reader(log_);
  devices::EventLogWriter writer(log);
  reader.next();
  while (const std::optional<devices::LogEvent> event = reader.next())
    writer.write(*event);
  writer.close();
  const std::string mcap = folder_.path("flight.mcap");
  const test_support::ProgramResult result = test_support::glissade({"log", "to-mcap", log, mcap});
  EXPECT_EQ(result.exit_code, 0) << result.standard_error;
  EXPECT_THAT(result.standard_output, HasSubstr("/tf: 500 messages"));
  EXPECT_THAT(result.standard_output, Not(HasSubstr("/scene")));
  expect_refused({"log", "to-mcap", log, mcap, "--scene", scene_}, {"flight.lcmlog", "HAPTIC_SESSION"});

  const std::string moved = read_text_file(scene_);
  const std::string other =
      folder_.write("moved.yaml", std::string(moved).replace(moved.find("0, 0, 0.03"), 10, "0, 0, 0.04"));
  expect_refused({"log", "to-mcap", log_, mcap, "--scene", other}, {"moved.yaml", "run.lcmlog", "has changed"});
}

TEST_F(RecordingCommands, McapOfALogWithoutTicksIsNotMade) {
  const std::string log = folder_.path("other.lcmlog");
  devices::EventLogWriter writer(log);
  writer.write(devices::to_event(std::chrono::seconds(1), "OTHER", {1, 2, 3}));
  writer.close();
  expect_refused({"log", "to-mcap", log, folder_.path("other.mcap")}, {"other.lcmlog", "no tick"});
  EXPECT_FALSE(std::filesystem::exists(folder_.path("other.mcap")));
}

TEST_F(RecordingCommands, AFileThatCannotBeWrittenIsRefused) {
  expect_refused({"demo", "--seconds", "0.5", "--record", folder_.path("no/run.lcmlog")},
                 {"no/run.lcmlog", "cannot be created"});
  expect_refused({"demo", "--offline", "--record", folder_.path("no/run.lcmlog")},
                 {"no/run.lcmlog", "cannot be created"});
  expect_refused({"log", "to-csv", log_, scene_ + "/tables"}, {"scene.yaml/tables"});
}

TEST(FlightLog, ReplacesNoOlderFile) {
  const test_support::TemporaryFolder folder;
  const std::string path = folder.write("flight.lcmlog", "of an earlier run");
  FlightLog log(path, {});
  EXPECT_THAT(log.write(), HasSubstr("flight-2.lcmlog"));
  EXPECT_THAT(log.write(), HasSubstr("flight-3.lcmlog"));
  EXPECT_EQ(read_text_file(path), "of an earlier run");
}

TEST(FlightLog, WritesAFailureEvenBeyondTheFileLimit) {
  const test_support::TemporaryFolder folder;
  FlightLog log(folder.path("flight.lcmlog"), {});
  for (int i = 0; i < FlightLog::kMostFiles; ++i)
    EXPECT_THAT(log.write(), HasSubstr("the last seconds are in"));
  EXPECT_THAT(log.write(), HasSubstr("writes no more"));
  EXPECT_THAT(log.write(true), HasSubstr("flight-11.lcmlog"));
}

TEST_F(RecordingCommands, FullDiskIsReported) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  const auto arguments = [&](std::vector<std::string> more) {
    std::vector<std::string> all{"demo", "--seconds", "0.5", "--scene", scene_, "--record", "/dev/full"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  expect_fails(1, arguments({"--offline"}), {"/dev/full", "not everything could be written"});
  const test_support::ProgramResult result = test_support::glissade(arguments({}));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.standard_error, HasSubstr("the recording is not whole"));
  EXPECT_THAT(result.standard_output, HasSubstr("ticks")) << "the summary is not lost";
}

}  // namespace
}  // namespace glissade::apps
