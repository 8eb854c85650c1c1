#pragma once

/// The shortest vector that satisfies linear inequalities.

#include <optional>

#include <Eigen/Core>

#include <glissade/devices/glove_device.h>
#include <glissade/geometry/displacement.h>

namespace glissade::devices {

/// Inequalities G x ≥ h, at most one for each half-space of a command.
struct Inequalities {
  Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::ColMajor, kMaxHalfSpaces, 6> G;
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxHalfSpaces, 1> h;
};

/// The x of least norm with G x ≥ h. No value if there is no such x. Source: Lawson and Hanson, Solving Least Squares
/// Problems, 1974, chapter 23: the problem of least distance, by least squares with non-negative unknowns. Bounded
/// work, no allocation.
std::optional<geometry::Vector6d> least_distance(const Inequalities& inequalities) noexcept;

}  // namespace glissade::devices
