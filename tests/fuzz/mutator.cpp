#include "mutator.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "fuzz_target.h"

namespace glissade::fuzz {

std::string Mutator::mutated(std::string bytes, const std::string& other) {
  for (std::size_t changes = 1 + below(4); changes > 0; --changes) {
    if (bytes.empty()) bytes = other;
    change(bytes, other);
  }
  if (bytes.empty()) bytes = "\n";
  bytes.resize(std::min(bytes.size(), kLongestInput));
  return bytes;
}

void Mutator::change(std::string& bytes, const std::string& other) {
  const std::size_t at = below(bytes.size());
  switch (below(8)) {
    case 0:
      bytes[at] = static_cast<char>(random_());
      break;
    case 1:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
      break;
    case 2:
      bytes.erase(at, 1 + below(std::min<std::size_t>(bytes.size() - at, 64)));
      break;
    case 3:
      bytes.resize(at);  // truncated
      break;
    case 4:
      if (!dictionary_.empty()) bytes.insert(at, dictionary_[below(dictionary_.size())]);
      break;
    case 5:
      put_number(bytes);
      break;
    case 6:
      put_piece(bytes, bytes);
      break;
    default:
      put_piece(bytes, other);
  }
}

/// Overwrites one to eight bytes with a number at the limit of something, or a run of digits with another number.
void Mutator::put_number(std::string& bytes) {
  constexpr std::array<std::uint64_t, 12> kNumbers{0,          1,          0x7F,        0xFF,
                                                   0x7FFF,     0xFFFF,     0x7FFFFFFF,  0x80000000,
                                                   0xFFFFFFFF, 0x7F800000, 0x7FC00000U, 0xFFFFFFFFFFFFFFFF};
  const std::uint64_t number = kNumbers[below(kNumbers.size())];
  const std::size_t at = below(bytes.size());
  const std::size_t digits = bytes.find_first_of("0123456789", at);
  if (below(2) == 0 && digits != std::string::npos) {
    const std::size_t end = std::min(bytes.find_first_not_of("0123456789", digits), bytes.size());
    bytes.replace(digits, end - digits, std::to_string(number));
    return;
  }
  const std::size_t size = std::min<std::size_t>(std::size_t{1} << below(4), bytes.size() - at);
  std::memcpy(bytes.data() + at, &number, size);
}

void Mutator::put_piece(std::string& bytes, const std::string& source) {
  if (source.empty()) return;
  const std::size_t begin = below(source.size());
  const std::string piece = source.substr(begin, 1 + below(256));
  bytes.insert(below(bytes.size()), piece);
}

}  // namespace glissade::fuzz
