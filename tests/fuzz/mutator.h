#pragma once

/// Damages files: a small stand-in for libFuzzer's mutations, without its feedback, for builds that lack it.

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace glissade::fuzz {

/// The same seed gives the same mutations.
class Mutator {
 public:
  Mutator(std::uint64_t seed, std::vector<std::string> dictionary)
      : random_(seed), dictionary_(std::move(dictionary)) {}

  /// `bytes` with one to four changes, one of which may be a piece of `other`. Never empty.
  std::string mutated(std::string bytes, const std::string& other);

  /// A number from 0 to `end` - 1.
  std::size_t below(std::size_t end) { return static_cast<std::size_t>(random_() % end); }

 private:
  void change(std::string& bytes, const std::string& other);
  void put_number(std::string& bytes);
  void put_piece(std::string& bytes, const std::string& source);

  std::mt19937_64 random_;
  std::vector<std::string> dictionary_;
};

}  // namespace glissade::fuzz
