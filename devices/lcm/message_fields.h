#pragma once

/// What the messages on the wire share: poses in them, limits of their numbers, and the check of their fields.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lcm/link_monitor.h"

namespace glissade::devices {

// Numbers beyond these limits are errors of the sender, for any device.
inline constexpr double kLargestPosition = 1e3;         // m
inline constexpr double kLargestVelocity = 1e3;         // m/s
inline constexpr double kLargestAngularVelocity = 1e4;  // rad/s
inline constexpr double kLargestAngle = 2.0 * std::numbers::pi;
inline constexpr double kLargestForce = 1e6;   // N
inline constexpr double kLargestTorque = 1e6;  // Nm
inline constexpr double kLargestEnergy = 1e9;  // J
inline constexpr double kQuaternionTolerance = 1e-3;
inline constexpr std::int64_t kLargestTime_ns = std::int64_t{1} << 60;  // 36 years

inline void put(const Eigen::Vector3d& vector, double (&out)[3]) {
  std::copy_n(vector.data(), 3, out);
}

inline void put(const Eigen::Vector3f& vector, float (&out)[3]) {
  std::copy_n(vector.data(), 3, out);
}

inline void put(const Eigen::Matrix3d& R, double (&wxyz)[4]) {
  const Eigen::Quaterniond q(R);
  wxyz[0] = q.w();
  wxyz[1] = q.x();
  wxyz[2] = q.y();
  wxyz[3] = q.z();
}

inline Eigen::Isometry3d pose_of(const double (&position_m)[3], const double (&wxyz)[4]) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = Eigen::Vector3d(position_m);
  X.linear() = Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized().toRotationMatrix();
  return X;
}

template <typename Message>
std::vector<std::uint8_t> to_bytes(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

template <typename Message>
MessageError from_bytes(std::span<const std::uint8_t> bytes, Message& message) noexcept {
  const int size = message.getEncodedSize();
  if (bytes.size() != static_cast<std::size_t>(size)) return MessageError::kWrongSize;
  return message.decode(bytes.data(), 0, size) == size ? MessageError::kNone : MessageError::kUndecodable;
}

/// Checks the fields of a message and keeps the most serious error.
class FieldCheck {
 public:
  template <typename Number, std::size_t N>
  void magnitude(const Number (&values)[N], double largest) noexcept {
    for (const Number number : values) {
      const auto value = static_cast<double>(number);
      is_finite_ = is_finite_ && std::isfinite(value);
      is_in_range_ = is_in_range_ && std::abs(value) <= largest;
    }
  }
  void magnitude(double value, double largest) noexcept {
    const double values[] = {value};
    magnitude(values, largest);
  }
  void unit_quaternion(const double (&wxyz)[4]) noexcept {
    magnitude(wxyz, 2.0);
    const double norm = Eigen::Vector4d(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).norm();
    is_in_range_ = is_in_range_ && std::abs(norm - 1.0) <= kQuaternionTolerance;
  }
  void not_negative(std::int64_t value) noexcept { is_in_range_ = is_in_range_ && value >= 0; }
  void positive(std::int64_t value) noexcept { is_in_range_ = is_in_range_ && value > 0; }
  void time(std::int64_t ns) noexcept { is_in_range_ = is_in_range_ && ns >= 0 && ns <= kLargestTime_ns; }
  void between(std::int32_t value, std::int32_t least, std::int32_t largest) noexcept {
    is_in_range_ = is_in_range_ && value >= least && value <= largest;
  }

  MessageError result() const noexcept {
    if (!is_finite_) return MessageError::kNotFinite;
    return is_in_range_ ? MessageError::kNone : MessageError::kOutOfRange;
  }

 private:
  bool is_finite_ = true;
  bool is_in_range_ = true;
};

}  // namespace glissade::devices
