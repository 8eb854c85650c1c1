#include <string>
#include <utility>

#include <glissade/devices/lcm_glove.h>

#include "lcm/checked_bus.h"
#include "lcm/glove_messages.h"
#include "lcm/link_monitor.h"

namespace glissade::devices {

namespace {

/// Anyone may send any number.
constexpr std::size_t kMostSenders = 64;

/// Adds a sentence about a refused message, if it is the first one of its kind.
void note_refusal(std::set<std::string>& sentences, const std::string& what, const DecodeResult& result) {
  const std::string kind = what + " are refused: " + std::string(words_of(result.error));
  const auto next = sentences.lower_bound(kind);
  if (next == sentences.end() || !next->starts_with(kind)) sentences.insert(what + " are refused: " + text_of(result));
}

}  // namespace

GloveSearch::GloveSearch(std::shared_ptr<LcmBus> bus) : bus_(checked_bus(std::move(bus), "The search for a glove")) {
  infos_ = bus_->subscribe(kGloveInfoChannel, [this](std::span<const std::uint8_t> message) {
    GloveInfo info;
    const DecodeResult result = decode(message, info);
    const std::lock_guard lock(mutex_);
    if (result == MessageError::kNone) {
      const std::int64_t device = info.device;
      found_.insert_or_assign(device, std::move(info));
      has_come_.notify_all();
    } else {
      note_refusal(refusals_, std::string("announcements on ") + kGloveInfoChannel, result);
    }
  });
  states_ = bus_->subscribe(kGloveStateChannel, [this](std::span<const std::uint8_t> message) {
    StateHeader header;
    GloveState state;
    const DecodeResult result = decode(message, header, state);
    const std::lock_guard lock(mutex_);
    if (result == MessageError::kNone) {
      if (senders_.size() < kMostSenders) senders_.insert(header.device);
    } else {
      note_refusal(refusals_, std::string("states on ") + kGloveStateChannel, result);
    }
  });
}

std::optional<GloveInfo> GloveSearch::wait_for(std::int64_t device, std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  has_come_.wait_for(lock, timeout, [&] { return found_.contains(device); });
  const auto found = found_.find(device);
  return found == found_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::int64_t> GloveSearch::heard() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::int64_t> numbers;
  for (const auto& [device, info] : found_)
    numbers.push_back(device);
  return numbers;
}

std::vector<std::string> GloveSearch::troubles() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> sentences(refusals_.begin(), refusals_.end());
  for (const std::int64_t device : senders_) {
    if (found_.contains(device)) continue;
    sentences.push_back("glove " + std::to_string(device) + " sends states, but no announcement on " +
                        kGloveInfoChannel + " that can be used");
  }
  return sentences;
}

}  // namespace glissade::devices
