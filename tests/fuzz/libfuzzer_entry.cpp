// What libFuzzer calls. Compiled only where clang brings libFuzzer along; see replay_main.cpp for all other builds.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "fuzz_target.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  glissade::fuzz::try_input(std::string_view(reinterpret_cast<const char*>(data), size));
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  const std::size_t mutated_size = LLVMFuzzerMutate(data, size, max_size);
  if (seed % 8 == 0) return mutated_size;
  std::string bytes(reinterpret_cast<const char*>(data), mutated_size);
  glissade::fuzz::repair(bytes);
  bytes.resize(std::min(bytes.size(), max_size));
  std::copy(bytes.begin(), bytes.end(), data);
  return bytes.size();
}
