#pragma once

/// Two gloves with one number on the bus.

#include <cstdint>
#include <utility>

#include <glissade/devices/lcm_bus.h>

namespace glissade::apps {

/// Finds out from the link's counts whether two gloves send under one number. A glove that takes the place of a silent
/// one is no second one.
class SecondGlove {
 public:
  /// To be called ten times a second; true once, when both have sent since each of the last five calls.
  bool appears_in(const devices::LinkStatistics& link) {
    const bool both_send = link.accepted > accepted_ && link.other_sender > refused_;
    accepted_ = link.accepted;
    refused_ = link.other_sender;
    calls_ = both_send ? calls_ + 1 : 0;
    return calls_ == kCalls && !std::exchange(has_appeared_, true);
  }

 private:
  static constexpr int kCalls = 5;

  std::uint64_t accepted_ = 0;
  std::uint64_t refused_ = 0;
  int calls_ = 0;  ///< one after the other between which both sent
  bool has_appeared_ = false;
};

}  // namespace glissade::apps
