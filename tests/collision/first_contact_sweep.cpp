// First contacts of random motions, against conservative advancement of every pair of triangles by itself. What a query
// promises is checked: before its time, all triangles are more than half the tolerance apart; then, two are at most the
// tolerance apart.

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <oneapi/tbb/parallel_for.h>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/triangle_pair.h>

#include "random_numbers.h"
#include "sweeps/sweep_meshes.h"
#include "sweeps/sweep_report.h"
#include "trees.h"

namespace glissade::collision {
namespace {

using namespace test_support;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::TrianglePoints;

constexpr int kMotionsPerCase = 50;
constexpr int kCasesPerBatch = 32;
constexpr int kMostSteps = 20'000;

/// The motion by interpolation of quaternions.
class Interpolation {
 public:
  explicit Interpolation(const RigidMotion& motion)
      : motion_(motion), q_begin_(motion.X_AB_begin.linear()), q_end_(motion.X_AB_end.linear()) {}

  Isometry3d X_AB(double t) const {
    Isometry3d X = Isometry3d::Identity();
    X.linear() = q_begin_.slerp(t, q_end_).toRotationMatrix();
    const Vector3d begin = motion_.X_AB_begin * motion_.p_Bref;
    X.translation() = begin + t * (motion_.X_AB_end * motion_.p_Bref - begin) - X.linear() * motion_.p_Bref;
    return X;
  }
  /// Of the points within a distance of the reference point.
  double greatest_speed(double distance) const {
    const Vector3d way = motion_.X_AB_end * motion_.p_Bref - motion_.X_AB_begin * motion_.p_Bref;
    return way.norm() + 1.001 * q_begin_.angularDistance(q_end_) * distance;
  }

 private:
  const RigidMotion& motion_;
  Eigen::Quaterniond q_begin_;
  Eigen::Quaterniond q_end_;
};

struct Ball {
  Vector3d center;
  double radius;
};

Ball ball_of(const TrianglePoints& triangle) {
  const Vector3d center = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
  double radius = 0.0;
  for (const Vector3d& corner : triangle)
    radius = std::max(radius, (corner - center).norm());
  return {center, radius};
}

TrianglePoints placed(const Isometry3d& X, const TrianglePoints& triangle) {
  return {X * triangle[0], X * triangle[1], X * triangle[2]};
}

struct Tally {
  std::atomic<std::int64_t> motions = 0, contacts = 0, at_begin = 0, left_out = 0;
};

/// Two meshes, and random motions of the second one.
class MotionCase {
 public:
  MotionCase(std::uint64_t seed, std::int64_t index)
      : random_(seed * 1'000'003 + static_cast<std::uint64_t>(index)),
        A_(random_mesh(1.0, random_.chance(0.5) ? Vector3d(random_.point(5.0)) : Vector3d::Zero(), random_)),
        B_(random_mesh(random_.power_of_ten(-1.5, 0.5), random_.point(1.0), random_)),
        tree_A_(tree_of(A_.mesh)),
        tree_B_(tree_of(B_.mesh)) {}

  std::string name() const { return A_.description + " and " + B_.description; }

  std::string fault_of_next(Tally& tally) {
    const RigidMotion motion = random_motion();
    const double tolerance = random_.power_of_ten(-8.0, -2.0);
    const std::optional<FirstContact> contact = first_contact(tree_A_, tree_B_, motion, tolerance);
    ++tally.motions;
    tally.contacts += contact ? 1 : 0;
    tally.at_begin += contact && contact->t == 0.0 ? 1 : 0;
    const Interpolation way(motion);
    if (contact) {
      const TrianglePair& triangles = contact->close.triangles;
      const TrianglePoints b = placed(way.X_AB(contact->t), tree_B_.mesh().corners(triangles.triangle_B));
      const double distance = geometry::triangle_distance(tree_A_.mesh().corners(triangles.triangle_A), b).distance;
      if (!(distance <= tolerance + kRounding)) return "too early: " + std::to_string(distance / tolerance);
    }
    return fault_before(contact ? contact->t : 1.0, way, motion.p_Bref, 0.5 * tolerance, tally);
  }

 private:
  static constexpr double kRounding = 1e-12;  // of coordinates up to 10 m

  /// Past A, away from A, along its surface, or nowhere.
  RigidMotion random_motion() {
    const double size = A_.size + B_.size;
    const auto pose = [&](const Vector3d& p_A, const Eigen::Matrix3d& R) {
      Isometry3d X = Isometry3d::Identity();
      X.linear() = R;
      X.translation() = A_.center + p_A - R * B_.center;
      return X;
    };
    const Vector3d from = random_.uniform(0.3, 1.5) * size * random_.direction();
    const Vector3d to = random_.chance(0.5) ? Vector3d(from + random_.power_of_ten(-3.0, 0.0) * random_.point(size))
                                            : Vector3d(random_.uniform(0.3, 1.5) * size * random_.direction());
    const Eigen::Matrix3d R = random_.chance(0.3) ? random_.cube_rotation() : random_.rotation();
    const double angle = random_.chance(0.3) ? 0.0 : random_.power_of_ten(-3.0, std::log10(std::numbers::pi));
    RigidMotion motion;
    motion.X_AB_begin = pose(from, R);
    motion.X_AB_end = pose(random_.chance(0.1) ? from : to,
                           Eigen::AngleAxisd(0.999 * angle, random_.direction()).toRotationMatrix() * R);
    motion.p_Bref = random_.chance(0.5) ? B_.center : Vector3d(random_.point(2.0));
    return motion;
  }

  std::string fault_before(double end, const Interpolation& way, const Vector3d& p_Bref, double least, Tally& tally) {
    for (std::size_t i = 0; i < A_.mesh.triangles.size(); ++i) {
      const TrianglePoints a = A_.mesh.corners(static_cast<std::int32_t>(i));
      if (geometry::is_degenerate(a)) continue;
      const Ball ball_a = ball_of(a);
      for (std::size_t j = 0; j < B_.mesh.triangles.size(); ++j) {
        const TrianglePoints b = B_.mesh.corners(static_cast<std::int32_t>(j));
        if (geometry::is_degenerate(b)) continue;
        const Ball ball_b = ball_of(b);
        const double speed = way.greatest_speed((ball_b.center - p_Bref).norm() + ball_b.radius);
        double t = 0.0;
        for (int step = 0; t < end; ++step) {
          const Isometry3d X_AB = way.X_AB(t);
          double gap = (X_AB * ball_b.center - ball_a.center).norm() - ball_a.radius - ball_b.radius;
          if (gap <= least) gap = geometry::triangle_distance(a, placed(X_AB, b)).distance;
          if (gap < least - kRounding) {
            return "late: triangles " + std::to_string(i) + " and " + std::to_string(j) + " are " +
                   std::to_string(gap / least) + " of half the tolerance apart at " + std::to_string(t) +
                   ", the answer is " + std::to_string(end);
          }
          if (step == kMostSteps) {
            ++tally.left_out;
            break;
          }
          t += std::max(gap - least, 0.01 * least) / speed;
        }
      }
    }
    return "";
  }

  RandomNumbers random_;
  SweepMesh A_;
  SweepMesh B_;
  DopTree tree_A_;
  DopTree tree_B_;
};

bool sweep(const SweepArguments& arguments) {
  const Stopwatch watch;
  SweepDifferences differences;
  Tally tally;
  run_batches(arguments, kMotionsPerCase, kCasesPerBatch, [&](std::int64_t first, int count) {
    tbb::parallel_for(first, first + count, [&](std::int64_t index) {
      MotionCase motions(arguments.seed, index);
      for (int motion = 0; motion < kMotionsPerCase; ++motion) {
        const std::string fault = motions.fault_of_next(tally);
        if (fault.empty()) continue;
        differences.add(fault + "\n  --seed " + std::to_string(arguments.seed) + " --only-case " +
                        std::to_string(index) + ", motion " + std::to_string(motion) + ", " + motions.name());
      }
    });
  });
  std::printf("%lld motions in %.1f s: %lld with a contact, %lld of these at the beginning\n",
              static_cast<long long>(tally.motions), watch.seconds(), static_cast<long long>(tally.contacts),
              static_cast<long long>(tally.at_begin));
  std::printf("%lld pairs of triangles took too many steps to check\n", static_cast<long long>(tally.left_out));
  differences.print();
  return differences.count() == 0;
}

}  // namespace
}  // namespace glissade::collision

int main(int argc, char** argv) {
  return glissade::test_support::run_sweep(argc, argv, "Checks first contacts of random motions", "motions", 100'000,
                                           glissade::collision::sweep);
}
