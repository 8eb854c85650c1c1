#include "bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Eigenvalues>

namespace glissade::bench::pqp {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

using Points = std::span<const Vector3d>;

// Eigenvectors of the covariance of all points of the triangles, whose corners the points are, three each: every
// triangle counts by its area (Gottschalk and others 1996, section 4, which does so with the convex hull).
Matrix3d principal_axes(Points points_M) {
  const Vector3d& origin = points_M[0];
  Vector3d first_moment = Vector3d::Zero();
  Matrix3d second_moment = Matrix3d::Zero();
  double area = 0.0;
  for (std::size_t i = 0; i < points_M.size(); i += 3) {
    const Vector3d a = points_M[i] - origin;
    const Vector3d b = points_M[i + 1] - origin;
    const Vector3d c = points_M[i + 2] - origin;
    const double weight = std::max(1e-100, 0.5 * (b - a).cross(c - a).norm());  // a needle's may be 0
    const Vector3d sum = a + b + c;
    first_moment += weight / 3.0 * sum;
    second_moment +=
        weight / 12.0 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
    area += weight;
  }
  const Vector3d mean = first_moment / area;
  const Matrix3d covariance = second_moment / area - mean * mean.transpose();
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(covariance).eigenvectors();
}

struct Box {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity());
  Vector3d high = -low;
};

Box box_along(const Matrix3d& R_MN, Points points_M) {
  Box box;
  for (const Vector3d& point : points_M) {
    const Vector3d p_N = R_MN.transpose() * point;
    box.low = box.low.cwiseMin(p_N);
    box.high = box.high.cwiseMax(p_N);
  }
  return box;
}

// The same axes with the longest extent first, right-handed.
Matrix3d longest_first(const Matrix3d& R_MN, Points points_M) {
  const Box box = box_along(R_MN, points_M);
  const Vector3d extent = box.high - box.low;
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int i, int j) { return extent[i] > extent[j]; });
  Matrix3d sorted;
  sorted.col(0) = R_MN.col(order[0]);
  sorted.col(1) = R_MN.col(order[1]);
  sorted.col(2) = sorted.col(0).cross(sorted.col(1));
  return sorted;
}

struct Rectangle {
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d high = -low;
};

// How far the sphere reaches along the rectangle's plane at the height of a point.
double reach(double radius, double height) {
  return std::sqrt(std::max(0.0, radius * radius - height * height));
}

// The least sides with which each point is in reach of its side.
Rectangle between_sides(const Matrix3d& R_MN, Points points_M, double radius, double middle) {
  Rectangle rectangle;
  for (const Vector3d& point : points_M) {
    const Vector3d p_N = R_MN.transpose() * point;
    const Vector2d in_reach = Vector2d::Constant(reach(radius, p_N.z() - middle));
    rectangle.low = rectangle.low.cwiseMin(p_N.head<2>() + in_reach);
    rectangle.high = rectangle.high.cwiseMax(p_N.head<2>() - in_reach);
  }
  for (int i = 0; i < 2; ++i) {  // any place between serves
    if (rectangle.low[i] > rectangle.high[i])
      rectangle.low[i] = rectangle.high[i] = 0.5 * (rectangle.low[i] + rectangle.high[i]);
  }
  return rectangle;
}

// Moves corners outwards, along their diagonals, until points beyond two sides are in reach too.
void extend_corners(Rectangle& rectangle, const Matrix3d& R_MN, Points points_M, double radius, double middle) {
  for (const Vector3d& point : points_M) {
    const Vector3d p_N = R_MN.transpose() * point;
    Vector2d beyond;
    for (int i = 0; i < 2; ++i)
      beyond[i] = std::max({0.0, rectangle.low[i] - p_N[i], p_N[i] - rectangle.high[i]});
    if (beyond.x() == 0.0 || beyond.y() == 0.0) continue;
    const double along = (beyond.x() + beyond.y()) / std::numbers::sqrt2;
    const double across = (beyond.x() - beyond.y()) / std::numbers::sqrt2;
    const double missing = along - reach(radius, std::hypot(across, p_N.z() - middle));
    if (missing <= 0.0) continue;
    for (int i = 0; i < 2; ++i) {
      double& side = p_N[i] < rectangle.low[i] ? rectangle.low[i] : rectangle.high[i];
      side += (p_N[i] < rectangle.low[i] ? -missing : missing) / std::numbers::sqrt2;
    }
  }
}

}  // namespace

Bounds fit_bounds(Points points_M) {
  Bounds bounds;

  bounds.R_MN = longest_first(principal_axes(points_M), points_M);
  const Box box = box_along(bounds.R_MN, points_M);
  bounds.p_MC = bounds.R_MN * (0.5 * (box.low + box.high));
  bounds.half = 0.5 * (box.high - box.low);

  // The sphere covers the thinnest extent, and the rectangle the rest (Larsen and others 1999).
  bounds.radius = bounds.half.z();
  const double middle = 0.5 * (box.low.z() + box.high.z());
  Rectangle rectangle = between_sides(bounds.R_MN, points_M, bounds.radius, middle);
  extend_corners(rectangle, bounds.R_MN, points_M, bounds.radius, middle);
  bounds.p_MO = bounds.R_MN * Vector3d(rectangle.low.x(), rectangle.low.y(), middle);
  bounds.sides = rectangle.high - rectangle.low;
  return bounds;
}

}  // namespace glissade::bench::pqp
