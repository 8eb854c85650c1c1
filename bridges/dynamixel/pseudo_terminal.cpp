#include "dynamixel/pseudo_terminal.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <glissade/realtime/clock.h>

namespace glissade::bridges::dynamixel {
namespace {

/// Bytes pass unchanged, and nothing is echoed.
void make_raw(int port) {
  termios settings{};
  if (tcgetattr(port, &settings) != 0) return;
  cfmakeraw(&settings);
  tcsetattr(port, TCSANOW, &settings);
}

/// Waits until the host has sent bytes, but not longer than until `next` or a millisecond.
void wait_for_host(int master, std::chrono::nanoseconds now, std::optional<std::chrono::nanoseconds> next) {
  constexpr std::chrono::nanoseconds kLongest = std::chrono::milliseconds(1);
  const std::chrono::nanoseconds left =
      next ? std::clamp(*next - now, std::chrono::nanoseconds(0), kLongest) : kLongest;
  timespec patience{0, static_cast<long>(left.count())};
  pollfd waiting{master, POLLIN, 0};
  ppoll(&waiting, 1, &patience, nullptr);
}

void send_all(int master, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(master, bytes.data(), bytes.size());
    if (count <= 0) return;  // nobody reads: the bytes are lost, as on a real line
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

}  // namespace

PseudoTerminal::PseudoTerminal(std::shared_ptr<EmulatedDevice> device) : device_(std::move(device)) {
  master_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
  std::array<char, 128> path{};
  if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0 ||
      ptsname_r(master_, path.data(), path.size()) != 0) {
    if (master_ >= 0) ::close(master_);
    throw std::runtime_error("The system has no pseudo-terminal for an emulated device.");
  }
  path_ = path.data();
  kept_open_ = ::open(path_.c_str(), O_RDWR | O_NOCTTY);
  if (kept_open_ >= 0) make_raw(kept_open_);
  thread_ = std::thread([this] { run(); });
}

PseudoTerminal::~PseudoTerminal() {
  should_stop_ = true;
  thread_.join();
  if (kept_open_ >= 0) ::close(kept_open_);
  ::close(master_);
}

void PseudoTerminal::run() {
  // The device's time starts at 0.
  const realtime::SteadyClock clock;
  const std::chrono::nanoseconds start = clock.now();
  std::array<char, 4096> buffer{};
  while (!should_stop_) {
    const ssize_t count = ::read(master_, buffer.data(), buffer.size());
    const std::chrono::nanoseconds now = clock.now() - start;
    if (count > 0) device_->receive({buffer.data(), static_cast<std::size_t>(count)}, now);
    send_all(master_, device_->send_until(now));
    wait_for_host(master_, now, device_->next_time());
  }
}

}  // namespace glissade::bridges::dynamixel
