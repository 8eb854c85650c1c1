#pragma once

/// A hash of numbers, to tell whether two runs or two scenes are the same to the bit.

#include <bit>
#include <cstdint>

#include <Eigen/Geometry>

namespace glissade::files {

/// FNV-1a over the bits of what is added, in its order.
class Hash {
 public:
  void add(std::uint64_t bits) {
    for (int i = 0; i < 8; ++i)
      state_ = (state_ ^ ((bits >> (8 * i)) & 0xffU)) * 0x100000001b3U;
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(const Eigen::Vector3d& v) {
    for (int i = 0; i < 3; ++i)
      add(v[i]);
  }
  void add(const Eigen::Isometry3d& X) {
    for (int column = 0; column < 3; ++column)
      add(Eigen::Vector3d(X.linear().col(column)));
    add(Eigen::Vector3d(X.translation()));
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325U;
};

}  // namespace glissade::files
