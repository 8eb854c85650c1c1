#include "paper/paper_direction.h"

#include <algorithm>
#include <array>

#include <Eigen/Geometry>

#include <glissade/contact/spring.h>

namespace glissade::reference {
namespace {

constexpr std::size_t kMostNormals = 32;
constexpr double kSameNormal = 1.0 - 1e-9;    // cosine
constexpr double kNoLineSineSquared = 1e-12;  // planes more parallel than this have no line in common
constexpr double kInto = -1e-9;               // of the wanted length: a smaller approach is along the plane

/// Different normals, the most opposed to the motion first.
class OpposedNormals {
 public:
  OpposedNormals(const Eigen::Vector3d& wanted, std::span<const Eigen::Vector3d> all) {
    for (const Eigen::Vector3d& n : all) {
      const double opposed = n.dot(wanted);
      std::size_t place = count_;
      bool known = false;
      for (std::size_t i = 0; i < count_; ++i) {
        known = known || entries_[i].dot(n) > kSameNormal;
        if (place == count_ && opposed < entries_[i].dot(wanted)) place = i;
      }
      if (known || place == kMostNormals) continue;
      count_ = std::min(count_ + 1, kMostNormals);
      for (std::size_t i = count_ - 1; i > place; --i)
        entries_[i] = entries_[i - 1];
      entries_[place] = n;
    }
  }

  std::size_t count() const { return count_; }
  const Eigen::Vector3d& operator[](std::size_t i) const { return entries_[i]; }

  bool allow(const Eigen::Vector3d& v, double length) const {
    return std::none_of(entries_.begin(), entries_.begin() + static_cast<std::ptrdiff_t>(count_),
                        [&](const Eigen::Vector3d& n) { return n.dot(v) < kInto * length; });
  }

 private:
  std::array<Eigen::Vector3d, kMostNormals> entries_;
  std::size_t count_ = 0;
};

Eigen::Vector3d on_plane(const Eigen::Vector3d& v, const Eigen::Vector3d& n) {
  return v - n.dot(v) * n;
}

Eigen::Vector3d on_line(const Eigen::Vector3d& v, const Eigen::Vector3d& n1, const Eigen::Vector3d& n2) {
  const Eigen::Vector3d along = n1.cross(n2);
  const double squared = along.squaredNorm();
  if (squared < kNoLineSineSquared) return Eigen::Vector3d::Zero();
  return along * (along.dot(v) / squared);
}

}  // namespace

NewTranslation new_translation(const Eigen::Vector3d& wanted, std::span<const Eigen::Vector3d> all) {
  const double length = wanted.norm();
  const OpposedNormals normals(wanted, all);
  if (normals.allow(wanted, length)) return {wanted, 0};
  NewTranslation best{.planes = 3};
  const auto try_out = [&](const Eigen::Vector3d& v, int planes) {
    if (v.squaredNorm() > best.v.squaredNorm() && normals.allow(v, length)) best = {v, planes};
  };
  for (std::size_t i = 0; i < normals.count(); ++i)
    try_out(on_plane(wanted, normals[i]), 1);
  if (best.planes == 1) return best;
  for (std::size_t i = 0; i < normals.count(); ++i) {
    for (std::size_t j = i + 1; j < normals.count(); ++j)
      try_out(on_line(wanted, normals[i], normals[j]), 2);
  }
  return best;
}

std::optional<geometry::Displacement> new_motion(const geometry::Displacement& wanted,
                                                 const contact::CouplingStiffness& stiffness,
                                                 std::span<const contact::ConstraintRow> rows,
                                                 contact::ProjectionSolver& solver) {
  const contact::Projection<1> projection = solver.project(wanted, stiffness, rows);
  if (projection.status != contact::ProjectionStatus::kSolved) return std::nullopt;
  return projection.displacement();
}

}  // namespace glissade::reference
