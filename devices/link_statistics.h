#pragma once

/// What came over a link, and what was refused for which reason.

#include <cstdint>

namespace glissade::devices {

/// Messages received so far. `lost` counts the gaps in the sequences of the accepted ones.
struct LinkStatistics {
  std::uint64_t accepted = 0;
  std::uint64_t wrong_size = 0;       ///< not the encoded size of the message's type
  std::uint64_t undecodable = 0;      ///< right in size but of another type
  std::uint64_t not_finite = 0;       ///< with a NaN or an infinity
  std::uint64_t out_of_range = 0;     ///< with a number beyond any sense, or a quaternion that is none
  std::uint64_t out_of_sequence = 0;  ///< not newer than the last accepted one
  std::uint64_t lost = 0;

  std::uint64_t rejected() const noexcept {
    return wrong_size + undecodable + not_finite + out_of_range + out_of_sequence;
  }
};

}  // namespace glissade::devices
