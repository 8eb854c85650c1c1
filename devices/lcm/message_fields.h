#pragma once

/// What the messages on the wire share: poses in them, limits of their numbers, and the check of their fields.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <string_view>
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
inline constexpr double kNormTolerance = 1e-3;
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
DecodeResult from_bytes(std::span<const std::uint8_t> bytes, Message& message) noexcept {
  const int size = message.getEncodedSize();
  if (bytes.size() != static_cast<std::size_t>(size)) {
    return {MessageError::kWrongSize,
            {.name = "the number of bytes", .value = static_cast<double>(bytes.size()), .wanted = size}};
  }
  if (message.decode(bytes.data(), 0, size) != size) return MessageError::kUndecodable;
  constexpr auto kVersion = Message::VERSION;
  if (message.version == kVersion) return MessageError::kNone;
  return {MessageError::kWrongVersion,
          {.name = "version", .value = static_cast<double>(message.version), .wanted = kVersion}};
}

/// Checks the fields of a message, and keeps the first one that is not finite, or else the first one out of its range.
class FieldCheck {
 public:
  template <typename Number, std::size_t N>
  void magnitude(std::string_view name, const Number (&values)[N], double largest) noexcept {
    for (std::size_t i = 0; i < N; ++i)
      magnitude(name, static_cast<double>(values[i]), largest, static_cast<int>(i));
  }
  void magnitude(std::string_view name, double value, double largest, int index = -1) noexcept {
    if (std::abs(value) <= largest) return;
    note(std::isfinite(value) ? out_of_range_ : not_finite_, {.name = name, .index = index, .value = value});
  }
  void amount(std::string_view name, double value, double largest) noexcept {
    magnitude(name, value, largest);
    if (value < 0.0) note(out_of_range_, {.name = name, .value = value});
  }
  /// A quaternion or a direction.
  template <int N>
  void unit_vector(std::string_view name, const double (&values)[N]) noexcept {
    magnitude(name, values, 2.0);
    const double norm = Eigen::Matrix<double, N, 1>(values).norm();
    if (!(std::abs(norm - 1.0) <= kNormTolerance))
      note(out_of_range_, {.name = name, .value = norm, .wanted = 1.0, .is_norm = true});
  }
  void not_negative(std::string_view name, std::int64_t value) noexcept { integer(name, value, value >= 0); }
  void positive(std::string_view name, std::int64_t value) noexcept { integer(name, value, value > 0); }
  void time(std::string_view name, std::int64_t ns) noexcept { integer(name, ns, ns >= 0 && ns <= kLargestTime_ns); }
  void between(std::string_view name, std::int32_t value, std::int32_t least, std::int32_t largest) noexcept {
    integer(name, value, value >= least && value <= largest);
  }

  DecodeResult result() const noexcept {
    if (!not_finite_.name.empty()) return {MessageError::kNotFinite, not_finite_};
    if (!out_of_range_.name.empty()) return {MessageError::kOutOfRange, out_of_range_};
    return MessageError::kNone;
  }

 private:
  void integer(std::string_view name, std::int64_t value, bool is_in_range) noexcept {
    if (!is_in_range) note(out_of_range_, {.name = name, .value = static_cast<double>(value)});
  }
  static void note(RefusedField& first, const RefusedField& field) noexcept {
    if (first.name.empty()) first = field;
  }

  RefusedField not_finite_;
  RefusedField out_of_range_;
};

}  // namespace glissade::devices
