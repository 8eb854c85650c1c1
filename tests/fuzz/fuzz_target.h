#pragma once

/// What a fuzz target is: one program under test that reads bytes nobody vouches for. A target is a source file that
/// defines the four functions below, and one call in CMakeLists.txt. It is built twice: with libFuzzer by
/// `scripts/fuzz`, and with replay_main.cpp everywhere, so that every build of the tests tries some thousand damaged
/// files.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace glissade::fuzz {

/// No input is longer.
inline constexpr std::size_t kLongestInput = 65536;

struct Seed {
  std::string name;
  std::string bytes;
};

/// Runs the code under test. True when it takes the input, false when it refuses it in the way its documentation says.
/// Whatever else happens is a finding: leave exceptions alone, and throw std::logic_error for a wrong result.
bool try_input(std::string_view bytes);

/// Inputs to begin with; all of them are taken.
std::vector<Seed> seeds();

/// Words of the format, which mutations could not guess.
std::vector<std::string> dictionary();

/// Puts right what every mutation breaks and what keeps the code under test from looking further: lengths, checksums.
/// One mutation in eight goes without.
void repair(std::string& bytes);

}  // namespace glissade::fuzz
