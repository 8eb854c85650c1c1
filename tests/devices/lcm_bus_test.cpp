#include <atomic>
#include <cstdint>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/devices/lcm_bus.h>

#include "eventually.h"
#include "expect_bad_input.h"

namespace glissade::devices {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(LcmBus, CarriesBytesToEverySubscriberOfAChannel) {
  LcmBus bus("memq://");
  EXPECT_EQ(bus.url(), "memq://");
  std::mutex mutex;
  std::vector<Bytes> first;
  std::atomic<int> second{0};
  std::atomic<int> other{0};
  const auto keep = [&](std::span<const std::uint8_t> message) {
    const std::lock_guard lock(mutex);
    first.emplace_back(message.begin(), message.end());
  };
  const auto a = bus.subscribe("A", keep);
  const auto b = bus.subscribe("A", [&](auto) { ++second; });
  const auto c = bus.subscribe("A_2", [&](auto) { ++other; });
  EXPECT_TRUE(bus.publish("A", Bytes{1, 2, 3}));
  EXPECT_TRUE(bus.publish("A", Bytes{}));
  EXPECT_TRUE(bus.publish("A_2", Bytes{7}));
  ASSERT_TRUE(eventually([&] { return other == 1; }));
  EXPECT_EQ(second, 2);
  const std::lock_guard lock(mutex);
  EXPECT_EQ(first, (std::vector<Bytes>{{1, 2, 3}, {}}));
}

TEST(LcmBus, AnEndedSubscriptionIsNotCalledAnyMore) {
  LcmBus bus("memq://");
  std::atomic<int> ended{0};
  std::atomic<int> lasting{0};
  const auto rest = bus.subscribe("A", [&](auto) { ++lasting; });
  {
    const auto gone = bus.subscribe("A", [&](auto) { ++ended; });
    bus.publish("A", Bytes{1});
    ASSERT_TRUE(eventually([&] { return ended == 1; }));
  }
  bus.publish("A", Bytes{2});
  ASSERT_TRUE(eventually([&] { return lasting == 2; }));
  EXPECT_EQ(ended, 1);
}

// Subscriptions end while messages for them pour in: the handler's target must never be used after its end.
TEST(LcmBus, SubscriptionsMayEndWhileMessagesArrive) {
  LcmBus bus("memq://");
  std::atomic<bool> done{false};
  std::thread sender([&] {
    while (!done) {
      bus.publish("A", Bytes{1, 2, 3, 4});
      std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
  });
  for (int i = 0; i < 100; ++i) {
    auto counter = std::make_unique<int>(0);
    const auto subscription = bus.subscribe("A", [&counter](auto) { ++*counter; });
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  done = true;
  sender.join();
}

TEST(LcmBus, OutlivesAHandlerThatThrows) {
  LcmBus bus("memq://");
  std::atomic<int> calls{0};
  const auto subscription = bus.subscribe("A", [&](auto) {
    ++calls;
    throw std::runtime_error("unused");
  });
  bus.publish("A", Bytes{1});
  bus.publish("A", Bytes{2});
  EXPECT_TRUE(eventually([&] { return calls == 2; }));
}

TEST(LcmBus, RefusesChannelsThatAreNotPlainNames) {
  LcmBus bus("memq://");
  for (const char* channel : {"", "SIXTEEN_LETTERS_", "A.*", "glove", "A B"}) {
    EXPECT_THROW(static_cast<void>(bus.subscribe(channel, [](auto) {})), std::invalid_argument) << channel;
    EXPECT_THROW(bus.publish(channel, Bytes{1}), std::invalid_argument) << channel;
  }
}

// None of these gets as far as sending anything.
TEST(LcmBus, RefusesAddressesThatDoNotWorkAndNamesThem) {
  const char* const kUrls[] = {"",
                               "memq",
                               "memq://x",
                               "file:///tmp/log",
                               "nonsense://239.255.76.67:7667",
                               "udpm://",
                               "udpm://:7667",
                               "udpm://localhost:7667",
                               "udpm://127.0.0.1:7667",
                               "udpm://239.255.76.67",
                               "udpm://239.255.76.67:",
                               "udpm://239.255.76.67:0",
                               "udpm://239.255.76.67:65536",
                               "udpm://239.255.76.67:7667x",
                               "udpm://239.255.76.67:7667?ttl=256",
                               "udpm://239.255.76.67:7667?ttl",
                               "udpm://239.255.76.67:7667?ttl=0&speed=9",
                               "udpm://239.255.76.67:7667?recv_buf_size=-1"};
  for (const char* url : kUrls) {
    test_support::expect_bad_input([&] { const LcmBus bus(url); }, {"The LCM address '" + std::string(url) + "'"});
  }
}

}  // namespace
}  // namespace glissade::devices
