#include "pair_poses.h"

#include "suite.h"

namespace glissade::bench {
namespace {

using collision::DopTree;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Calls place(source, R_AB, p_AB, poses) at random poses with this gap, until there are `count` poses.
template <typename Place>
Poses approach(const DopTree& tree_A, const DopTree& tree_B, double gap, std::size_t count, const Place& place) {
  PoseSource source(tree_A, tree_B, kSeed);
  Poses poses;
  for (std::size_t tries = 0; poses.size() < count && tries < 10 * count; ++tries) {
    const Matrix3d R_AB = source.rotation();
    const Vector3d axis = source.direction();
    if (const auto distance = source.approach(R_AB, axis, gap)) place(source, R_AB, *distance * axis, poses);
  }
  return poses;
}

}  // namespace

PosesOfTrees zachmann_poses(int orientations) {
  return [orientations](const DopTree& tree_A, const DopTree& tree_B) {
    PoseSource source(tree_A, tree_B, kSeed);
    constexpr int kAxes = 5;
    Poses poses;
    for (int i = 0; i < orientations; ++i) {
      const Matrix3d R_AB = source.rotation();
      for (int j = 0; j < kAxes; ++j) {
        const Vector3d axis = source.direction();
        const double apart = 1.001 * source.box_separation(R_AB, axis);
        for (std::size_t k = 0; k < kZachmannDistances; ++k)
          poses.push_back(pose(R_AB, apart * static_cast<double>(k) / (kZachmannDistances - 1) * axis));
      }
    }
    return poses;
  };
}

PosesOfTrees poses_at(double gap, std::size_t count) {
  return [gap, count](const DopTree& tree_A, const DopTree& tree_B) {
    return approach(tree_A, tree_B, gap, count,
                    [](PoseSource&, const Matrix3d& R_AB, const Vector3d& p_AB, Poses& poses) {
                      poses.push_back(pose(R_AB, p_AB));
                    });
  };
}

PosesOfTrees overlapping_poses(std::size_t count) {
  return [count](const DopTree& tree_A, const DopTree& tree_B) {
    collision::QueryWorkspace workspace;
    return approach(tree_A, tree_B, 0.0, count,
                    [&](PoseSource& source, const Matrix3d& R_AB, const Vector3d& p_AB, Poses& poses) {
                      const Isometry3d X_AB = pose(R_AB, source.uniform(0.3, 1.0) * p_AB);
                      if (collision::intersects(tree_A, tree_B, X_AB, workspace)) poses.push_back(X_AB);
                    });
  };
}

}  // namespace glissade::bench
