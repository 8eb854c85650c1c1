// Event logs of LCM: what makes one, what damages one. The bytes are made here, by the format's own description.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <glissade/base/byte_order.h>
#include <glissade/devices/event_log.h>

#include "expect_bad_input.h"
#include "temporary_folder.h"

namespace glissade::devices {
namespace {

using testing::HasSubstr;

std::string event_bytes(std::int64_t number, const std::string& channel, const std::string& message) {
  std::string bytes("\xED\xA1\xDA\x01");
  const auto order = std::endian::big;
  base::append_number(bytes, number, order);
  base::append_number(bytes, std::int64_t{1'000'000 + number}, order);
  base::append_number(bytes, static_cast<std::int32_t>(channel.size()), order);
  base::append_number(bytes, static_cast<std::int32_t>(message.size()), order);
  return bytes + channel + message;
}

/// A log with as many events, numbered from 0.
std::string log_bytes(std::int64_t events) {
  std::string bytes;
  for (std::int64_t i = 0; i < events; ++i)
    bytes += event_bytes(i, "CHANNEL", "message " + std::to_string(i));
  return bytes;
}

class EventLog : public testing::Test {
 protected:
  struct Found {
    std::vector<std::string> messages;
    std::string damage;
  };

  Found read(const std::string& bytes) const {
    EventLogReader reader(folder.write("test.lcmlog", bytes));
    Found found;
    while (const auto event = reader.next())
      found.messages.emplace_back(event->message.begin(), event->message.end());
    found.damage = reader.damage();
    return found;
  }

  test_support::TemporaryFolder folder;
};

TEST_F(EventLog, JoinedLogsAreReadToTheEnd) {
  const Found found = read(log_bytes(2) + log_bytes(3));
  EXPECT_EQ(found.damage, "");
  EXPECT_THAT(found.messages, testing::ElementsAre("message 0", "message 1", "message 0", "message 1", "message 2"));
}

TEST_F(EventLog, EventsMayBeMissingOrHaveAnyNumber) {
  std::string bytes;
  for (const std::int64_t number : {7, 8, 1000, 3, 3, -1})
    bytes += event_bytes(number, "CHANNEL", std::to_string(number));
  const Found found = read(bytes);
  EXPECT_EQ(found.damage, "");
  EXPECT_THAT(found.messages, testing::ElementsAre("7", "8", "1000", "3", "3", "-1"));
}

TEST_F(EventLog, AChannelMayHaveSpacesAndUmlautsAndAMessageNoByte) {
  const Found found = read(event_bytes(0, "my channel", "") + event_bytes(1, "Händedruck", "1"));
  EXPECT_EQ(found.damage, "");
  EXPECT_THAT(found.messages, testing::ElementsAre("", "1"));
}

TEST_F(EventLog, AMessageMayHoldALog) {
  const Found found = read(event_bytes(0, "LOG", log_bytes(2)) + event_bytes(1, "LOG", log_bytes(1)));
  EXPECT_EQ(found.damage, "");
  EXPECT_THAT(found.messages, testing::ElementsAre(log_bytes(2), log_bytes(1)));
}

TEST_F(EventLog, ALogThatWasCutShortBeforeAnotherWasJoinedIsDamagedThere) {
  const std::string first = log_bytes(3);
  const std::size_t third = log_bytes(2).size();
  for (std::size_t cut = third + 1; cut < first.size(); ++cut) {
    const bool has_channel = cut >= third + 28 + 7;
    const std::string place = has_channel ? std::to_string(third) + "," : "";  // otherwise, where the rest is missing
    const Found found = read(first.substr(0, cut) + log_bytes(3));
    EXPECT_THAT(found.damage, HasSubstr("test.lcmlog: damaged at byte " + place)) << cut;
    EXPECT_THAT(found.damage, HasSubstr("after 2 whole events")) << cut;
    EXPECT_EQ(found.messages.size(), 2U) << cut;
  }
}

TEST_F(EventLog, ALogThatEndsEarlyIsDamagedThere) {
  const std::string whole = log_bytes(3);
  const std::size_t third = log_bytes(2).size();
  for (std::size_t cut = third + 1; cut < whole.size(); ++cut) {
    const Found found = read(whole.substr(0, cut));
    EXPECT_THAT(found.damage, HasSubstr("byte " + std::to_string(third))) << cut;
    EXPECT_THAT(found.damage, HasSubstr("the file ends within an event")) << cut;
  }
}

TEST_F(EventLog, AChangedSyncWordIsDamageAfterTheEventBeforeIt) {
  std::string bytes = log_bytes(3);
  const std::size_t second = log_bytes(1).size();
  bytes[second + 2] ^= 1;
  const Found found = read(bytes);
  EXPECT_THAT(found.damage, HasSubstr("byte " + std::to_string(second) + ", after 1 whole events: no event begins"));
  EXPECT_THAT(found.messages, testing::ElementsAre("message 0"));
}

TEST_F(EventLog, ChangedLengthsAreDamage) {
  for (const std::size_t place : {20U, 24U}) {
    std::string bytes = log_bytes(1) + log_bytes(2);
    bytes[log_bytes(1).size() + place] = '\x7f';
    EXPECT_THAT(read(bytes).damage, HasSubstr("byte " + std::to_string(log_bytes(1).size() + place))) << place;
  }
}

TEST_F(EventLog, OnlyARegularFileIsALog) {
  const std::string pipe = folder.path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  test_support::expect_bad_input([&] { EventLogReader reader(pipe); }, {"pipe", "is not a regular file"});
  const std::string loop = folder.path("loop");
  std::filesystem::create_symlink(loop, loop);
  test_support::expect_bad_input([&] { EventLogReader reader(loop); }, {"loop", "symbolic links"});
  test_support::expect_bad_input([&] { EventLogReader reader(folder.path("")); }, {"is a folder"});
  test_support::expect_bad_input([&] { EventLogReader reader(folder.path("none")); }, {"there is no such file"});
}

}  // namespace
}  // namespace glissade::devices
