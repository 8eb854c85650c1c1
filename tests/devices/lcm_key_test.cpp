#include <atomic>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include <glissade/devices/lcm_bus.h>

#include "eventually.h"
#include "expect_bad_input.h"
#include "lcm/message_seal.h"
#include "temporary_folder.h"

namespace glissade::devices {
namespace {

using test_support::TemporaryFolder;

const LcmKey kSecret{{1, 2, 3}};
const std::vector<std::uint8_t> kText{5, 6, 7};

std::string key_file(const TemporaryFolder& folder, const std::string& text,
                     std::filesystem::perms perms = std::filesystem::perms::owner_read) {
  const std::string path = folder.write("key", text);
  std::filesystem::permissions(path, perms);
  return path;
}

TEST(MessageSeal, OpensWhatItHasSealedForThisChannelOnly) {
  const MessageSeal seal(kSecret.bytes);
  const std::vector<std::uint8_t> bytes = seal.sealed("A", kText);
  EXPECT_EQ(bytes.size(), kText.size() + 32);
  const auto opened = seal.opened("A", bytes);
  ASSERT_TRUE(opened.has_value());
  EXPECT_TRUE(std::equal(opened->begin(), opened->end(), kText.begin(), kText.end()));
  EXPECT_FALSE(seal.opened("B", bytes).has_value());
  EXPECT_FALSE(MessageSeal(LcmKey{}.bytes).opened("A", bytes).has_value()) << "another key";
}

TEST(MessageSeal, NoChangedOrCutMessageOpens) {
  const MessageSeal seal(kSecret.bytes);
  const std::vector<std::uint8_t> bytes = seal.sealed("A", kText);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::vector<std::uint8_t> changed = bytes;
    changed[i] ^= 1;
    EXPECT_FALSE(seal.opened("A", changed).has_value()) << i;
    EXPECT_FALSE(seal.opened("A", std::span(bytes).first(i)).has_value()) << i;
  }
}

TEST(LcmBusWithKey, PassesMessagesOfItsKey) {
  LcmBus bus("memq://", kSecret);
  std::atomic<int> good{0};
  const auto subscription = bus.subscribe("TEST", [&](std::span<const std::uint8_t> message) {
    good += std::equal(message.begin(), message.end(), kText.begin(), kText.end()) ? 1 : 0;
  });
  bus.publish("TEST", kText);
  EXPECT_TRUE(eventually([&] { return good == 1; }));
  EXPECT_EQ(bus.refused_packets(), 0U);
}

TEST(LcmKey, IsReadFromAFile) {
  const TemporaryFolder folder;
  std::string digits = "0fF0";
  digits.append(60, '0');
  const LcmKey key = read_lcm_key(key_file(folder, digits + "\n"));
  EXPECT_EQ(key.bytes[0], 0x0f);
  EXPECT_EQ(key.bytes[1], 0xf0);
}

TEST(LcmKey, InvalidKeyFilesAreNamed) {
  const TemporaryFolder folder;
  const std::string digits(64, 'a');
  for (const std::string& text : {std::string(), digits.substr(1), digits + "a", digits + "\n\n",
                                  "g" + digits.substr(1), "+" + digits.substr(1), digits + digits}) {
    test_support::expect_bad_input([&] { read_lcm_key(key_file(folder, text, std::filesystem::perms::owner_all)); },
                                   {"key", "64 hexadecimal digits"});
  }
  test_support::expect_bad_input([&] { read_lcm_key(folder.path("nowhere")); }, {"nowhere: there is no such file"});
  test_support::expect_bad_input(
      [&] {
        read_lcm_key(key_file(folder, digits, std::filesystem::perms::owner_all | std::filesystem::perms::others_read));
      },
      {"key", "chmod 600"});
}

}  // namespace
}  // namespace glissade::devices
