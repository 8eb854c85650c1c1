/// The loop between a wire and the link: what it says, and that it releases.

#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/bridges/bridge.h>

namespace glissade::bridges {
namespace {

using testing::ElementsAre;

/// A wire that fails in the turns of a list.
class FailingWire final : public Wire {
 public:
  explicit FailingWire(std::vector<int> failures) : failures_(std::move(failures)) { descriptor_.name = "test"; }

  const devices::DeviceDescriptor& descriptor() const noexcept override { return descriptor_; }
  void open() override { fail_if_due(); }
  bool read(devices::GloveState& /*state*/) override {
    fail_if_due();
    return true;
  }
  void write(const devices::SafeCommand& /*command*/) override {}
  void release() noexcept override { ++releases; }

  int releases = 0;
  int turn = 0;

 private:
  void fail_if_due() {
    ++turn;
    for (const int failure : failures_)
      if (failure == turn) throw WireError("turn " + std::to_string(turn));
  }

  std::vector<int> failures_;
  devices::DeviceDescriptor descriptor_;
};

/// What the bridge says until this turn of the wire.
std::vector<std::string> said(FailingWire& wire, int last_turn) {
  std::vector<std::string> sentences;
  run_bridge(
      wire, std::make_shared<devices::LcmBus>("memq://"), {.reopen_after = std::chrono::milliseconds(1)},
      [&] { return wire.turn < last_turn; }, [&](const std::string& sentence) { sentences.push_back(sentence); });
  return sentences;
}

TEST(Bridge, ReleasesAtItsEnd) {
  FailingWire wire({});
  EXPECT_THAT(said(wire, 5), ElementsAre("the device is connected"));
  EXPECT_EQ(wire.releases, 1);
}

TEST(Bridge, SaysOnceWhatIsWrongAndWhenTheDeviceIsBack) {
  FailingWire wire({1, 2, 3, 6, 7});
  EXPECT_THAT(said(wire, 20), ElementsAre("turn 1", "the device is connected", "turn 6", "the device is back"));
  EXPECT_EQ(wire.releases, 6) << "after each failure, and at the end";
}

}  // namespace
}  // namespace glissade::bridges
