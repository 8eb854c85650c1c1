#include "emulation/faulty_device.h"

#include <algorithm>
#include <utility>

namespace glissade::bridges {

FaultyDevice::FaultyDevice(std::shared_ptr<EmulatedDevice> device, std::uint64_t seed)
    : device_(std::move(device)), random_(seed) {}

bool FaultyDevice::happens(double share) {
  constexpr double kSteps = 1e6;
  return static_cast<double>(random_() % static_cast<std::uint64_t>(kSteps)) < share * kSteps;
}

std::string FaultyDevice::distorted(std::string bytes) {
  if (happens(faults.flipped_bit)) {
    char& byte = bytes[random_() % bytes.size()];
    byte = static_cast<char>(byte ^ static_cast<char>(1U << random_() % 7));
  }
  if (happens(faults.cut)) bytes.resize(random_() % bytes.size());
  if (happens(faults.garbage)) {
    std::string garbage(1 + random_() % 20, '\0');
    for (char& byte : garbage)
      byte = static_cast<char>(random_() & 0xFFU);
    bytes.insert(0, garbage);
  }
  return bytes;
}

void FaultyDevice::receive(std::string_view bytes, std::chrono::nanoseconds now) {
  if (faults.has_echo) late_.push_back({now, std::string(bytes)});
  device_->receive(bytes, now);
}

std::string FaultyDevice::send_until(std::chrono::nanoseconds now) {
  while (true) {
    const std::optional<std::chrono::nanoseconds> time = device_->next_time();
    if (!time || *time > now) break;
    std::string bytes = device_->send_until(*time);
    if (bytes.empty()) break;
    late_.push_back({*time + faults.slowness, distorted(std::move(bytes))});
  }
  device_->send_until(now);
  std::string result;
  for (; !late_.empty() && late_.front().time <= now; late_.pop_front())
    result += late_.front().bytes;
  return result;
}

std::optional<std::chrono::nanoseconds> FaultyDevice::next_time() const {
  std::optional<std::chrono::nanoseconds> time = device_->next_time();
  if (time) *time += faults.slowness;
  if (!late_.empty() && (!time || late_.front().time < *time)) time = late_.front().time;
  return time;
}

}  // namespace glissade::bridges
