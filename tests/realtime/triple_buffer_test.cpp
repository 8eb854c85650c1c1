#include <array>
#include <cstdint>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include <glissade/realtime/triple_buffer.h>

namespace glissade::realtime {
namespace {

TEST(TripleBuffer, HasTheInitialValueUntilOneIsPublished) {
  TripleBuffer<int> buffer(7);
  EXPECT_FALSE(buffer.update());
  EXPECT_EQ(buffer.value(), 7);
  buffer.publish(8);
  EXPECT_EQ(buffer.value(), 7);
  EXPECT_TRUE(buffer.update());
  EXPECT_EQ(buffer.value(), 8);
  EXPECT_FALSE(buffer.update());
}

TEST(TripleBuffer, GivesTheNewestAndForgetsTheRest) {
  TripleBuffer<std::string> buffer;
  for (const char* text : {"one", "two", "three", "four"})
    buffer.publish(text);
  EXPECT_EQ(buffer.latest(), "four");
  buffer.write_slot() = "five";
  EXPECT_EQ(buffer.latest(), "four");
  buffer.publish();
  EXPECT_EQ(buffer.latest(), "five");
}

// The reader never sees a value half written, never an older one after a newer one, and in the end the last.
TEST(TripleBuffer, ReaderSeesWholeValuesInRisingOrder) {
  constexpr std::uint64_t kValues = 100000;
  using Block = std::array<std::uint64_t, 24>;
  TripleBuffer<Block> buffer(Block{});
  bool is_whole = true;
  bool is_rising = true;
  std::uint64_t last = 0;

  std::thread reader([&] {
    while (last < kValues) {
      if (!buffer.update()) {
        std::this_thread::yield();
        continue;
      }
      const Block& block = buffer.value();
      for (const std::uint64_t entry : block)
        is_whole = is_whole && entry == block[0];
      is_rising = is_rising && block[0] > last;
      last = block[0];
    }
  });
  for (std::uint64_t i = 1; i <= kValues; ++i) {
    buffer.write_slot().fill(i);
    buffer.publish();
    if (i % 256 == 0) std::this_thread::yield();
  }
  reader.join();

  EXPECT_TRUE(is_whole);
  EXPECT_TRUE(is_rising);
  EXPECT_EQ(last, kValues);
}

}  // namespace
}  // namespace glissade::realtime
