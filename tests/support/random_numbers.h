#pragma once

/// Random numbers, directions and rotations that depend only on the seed and the order of the calls. C++ leaves the
/// order of evaluation within an expression open, so an expression with several calls draws other cases with another
/// compiler. Not thread-safe.

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include <Eigen/Geometry>

namespace glissade::test_support {

class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : random_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  /// 10 to a power between `low` and `high`.
  double power_of_ten(double low, double high) { return std::pow(10.0, uniform(low, high)); }

  /// Both ends included.
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }

  /// In the cube about the origin.
  Eigen::Vector3d point(double half_edge) {
    const double x = uniform(-half_edge, half_edge);
    const double y = uniform(-half_edge, half_edge);
    return {x, y, uniform(-half_edge, half_edge)};
  }

  Eigen::Vector3d direction() {
    std::normal_distribution<double> normal;
    const double x = normal(random_);
    const double y = normal(random_);
    return Eigen::Vector3d(x, y, normal(random_)).normalized();
  }

  Eigen::Matrix3d rotation() {
    const Eigen::Vector3d axis = direction();
    return Eigen::AngleAxisd(uniform(-std::numbers::pi, std::numbers::pi), axis).toRotationMatrix();
  }

  /// One of the 24 rotations that take the axes to the axes; its entries are exactly 0, 1 and -1.
  Eigen::Matrix3d cube_rotation() {
    Eigen::Matrix3d R = Eigen::Matrix3d::Zero();
    const int first = integer(0, 2);
    const int second = (first + integer(1, 2)) % 3;
    R(first, 0) = integer(0, 1) == 0 ? 1.0 : -1.0;
    R(second, 1) = integer(0, 1) == 0 ? 1.0 : -1.0;
    R(3 - first - second, 2) = 1.0;
    R.col(2) *= R.determinant();
    return R;
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace glissade::test_support
