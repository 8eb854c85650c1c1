/// Emulated servos behind a terminal of this machine.

#include "dynamixel/pseudo_terminal.h"

#include <array>
#include <memory>
#include <stdexcept>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <glissade/bridges/wire.h>

#include "dynamixel/emulated_bus.h"
#include "dynamixel/servo_bus.h"

namespace glissade::bridges::dynamixel {
namespace {

/// The least that reads and writes a terminal.
class TerminalStream final : public ByteStream {
 public:
  explicit TerminalStream(std::string path) : path_(std::move(path)) {}
  ~TerminalStream() override { close(); }

  std::string name() const override { return path_; }
  void open() override {
    file_ = ::open(path_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK);
    if (file_ < 0) throw WireError("cannot open " + path_);
  }
  void close() noexcept override {
    if (file_ >= 0) ::close(file_);
    file_ = -1;
  }
  void write(std::string_view bytes) override {
    if (::write(file_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
      throw WireError("cannot write to " + path_);
  }
  std::string read(std::chrono::nanoseconds patience) override {
    pollfd waiting{file_, POLLIN, 0};
    poll(&waiting, 1, static_cast<int>(std::chrono::ceil<std::chrono::milliseconds>(patience).count()));
    std::array<char, 512> buffer{};
    const ssize_t count = ::read(file_, buffer.data(), buffer.size());
    return count > 0 ? std::string(buffer.data(), static_cast<std::size_t>(count)) : std::string();
  }

 private:
  std::string path_;
  int file_ = -1;
};

TEST(PseudoTerminal, LooksLikeAPortWithServos) {
  const auto finger = std::make_shared<ElasticFinger>(1.0, 0.5, 0.025);
  const auto servos =
      std::make_shared<EmulatedBus>(std::vector<EmulatedServo>{{1, *find_model("XL330-M288"), finger}}, 3e6);
  const PseudoTerminal terminal(servos);
  TerminalStream line(terminal.path());
  line.open();
  realtime::SteadyClock clock;
  ServoBus bus(line, clock, {.patience = std::chrono::seconds(5)});
  const std::optional<PingAnswer> answer = bus.ping(1);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->model, 1200);
  // Bytes that a terminal could change or swallow.
  for (int value = 0; value < 255; ++value) {
    const std::string data = encode_register(kPositionDGain, 0x0300 + value);
    ASSERT_TRUE(bus.write(1, kPositionDGain.address, data)) << value;
    ASSERT_EQ(bus.read(1, kPositionDGain.address, 2)->data, data);
  }
}

}  // namespace
}  // namespace glissade::bridges::dynamixel
