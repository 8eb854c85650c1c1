// Hulls told apart, against exact arithmetic on all points that they were made of, where they nearly touch: gaps and
// depths of 1e-12 to 1e-3 of the size and none at all, of smooth, flat-faced, thin and degenerate bodies, which roll
// about each other, so that what a query remembers is put to the test as well.

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <string>
#include <vector>

#include <oneapi/tbb/parallel_for.h>

#include <glissade/collision/convex_hull.h>
#include <glissade/geometry/mesh_generators.h>

#include "hull_oracle.h"
#include "random_numbers.h"
#include "sweeps/sweep_report.h"

namespace glissade::collision {
namespace {

using namespace test_support;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int kPosesPerCase = 40;
constexpr int kCasesPerBatch = 64;
// Of the size: nearer hulls may be said to meet. Where one is a needle, normals are those of triangles much narrower
// than long, and less certain.
constexpr double kDoubt = 1e-12;
constexpr double kDoubtOfNeedles = 1e-11;

struct Body {
  std::string name;
  std::vector<Vector3d> points;
};

std::vector<Vector3d> cloud(int count, const Vector3d& size, RandomNumbers& random) {
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i)
    points.emplace_back(random.point(0.5).cwiseProduct(size));
  return points;
}

std::vector<Vector3d> ellipsoid(const Vector3d& size, RandomNumbers& random) {
  std::vector<Vector3d> points = geometry::make_sphere(0.5, random.integer(20, 400)).vertices;
  for (Vector3d& x : points)
    x = x.cwiseProduct(size);
  return points;
}

// Points within a millionth of each other, whose facets are small and narrow.
std::vector<Vector3d> blunt_corners(RandomNumbers& random) {
  std::vector<Vector3d> points;
  for (const Vector3d& corner : cloud(6, Vector3d::Ones(), random)) {
    const double spread = random.power_of_ten(-12.0, -2.0);
    for (int i = 0; i < 5; ++i)
      points.emplace_back(corner + spread * random.point(1.0));
  }
  return points;
}

Body random_body(RandomNumbers& random) {
  const Vector3d size(1.0, random.uniform(0.2, 1.0), random.uniform(0.2, 1.0));
  const double thin = random.power_of_ten(-13.0, -2.0);
  switch (random.integer(0, 9)) {
    case 0:
      return {"sphere", ellipsoid(Vector3d::Ones(), random)};
    case 1:
      return {"ellipsoid", ellipsoid({1.0, 0.6, 0.3}, random)};
    case 2:
      return {"box", geometry::make_box(size, random.integer(12, 300)).vertices};
    case 3:
      return {"cloud", cloud(random.integer(4, 200), size, random)};
    case 4:
      return {"slab", cloud(random.integer(4, 60), {1.0, 0.7, thin}, random)};
    case 5:
      return {"needle", cloud(random.integer(4, 60), {1.0, thin, thin * random.power_of_ten(-3.0, 0.0)}, random)};
    case 6:
      return {"blunt corners", blunt_corners(random)};
    case 7:
      return {"polygon", cloud(random.integer(3, 40), {1.0, 0.7, 0.0}, random)};
    case 8:
      return {"segment", cloud(random.integer(2, 5), {1.0, 0.0, 0.0}, random)};
    default:
      return {"point", cloud(1, Vector3d::Ones(), random)};
  }
}

// Turned out of the axes, somewhere, of any size.
Body placed(Body body, RandomNumbers& random) {
  const Eigen::Matrix3d R = random.chance(0.5) ? random.rotation() : random.cube_rotation();
  const Vector3d offset = random.chance(0.3) ? random.point(3.0) : Vector3d::Zero();
  const double scale = random.chance(0.3) ? random.power_of_ten(-4.0, 1.0) : 1.0;
  for (Vector3d& x : body.points)
    x = scale * (R * x + offset);
  return body;
}

double reach(const Body& body) {
  double most = 0.0;
  for (const Vector3d& x : body.points)
    most = std::max(most, x.norm());
  return most;
}

// What the answers were, and how they were verified.
struct Tally {
  std::atomic<std::int64_t> poses = 0, apart = 0, proved = 0, by_cgal = 0, perceptron = 0, doubtful = 0;
};

// Two bodies and where they roll.
class Walk {
 public:
  Walk(std::uint64_t seed, std::int64_t index)
      : random_(seed * 1'000'003 + static_cast<std::uint64_t>(index)),
        A_(placed(random_body(random_), random_)),
        B_(placed(random_body(random_), random_)),
        hull_A_(A_.points),
        hull_B_(B_.points),
        scale_(reach(A_) + reach(B_)) {
    X_AB_.linear() = random_.chance(0.3) ? random_.cube_rotation() : random_.rotation();
    direction_ = random_.chance(0.3) ? Vector3d::Unit(random_.integer(0, 2)) : random_.direction();
  }

  std::string name() const { return A_.name + " and " + B_.name; }

  // The next pose, in which they nearly touch; every third is that before, a little nearer or further.
  void step() {
    if (random_.chance(0.7)) {
      const double stride = random_.power_of_ten(-5.0, -1.0);
      if (random_.chance(0.8)) {
        X_AB_.linear() = (X_AB_.linear() * Eigen::AngleAxisd(stride, random_.direction())).eval();
      }
      direction_ = (direction_ + stride * random_.point(1.0)).normalized();
      contact_ = find_contact();
    }
    const double gap = random_.chance(0.1) ? 0.0 : random_.power_of_ten(-13.0, -3.0);
    place(contact_ + (random_.chance(0.5) ? gap : -gap) * scale_);
  }

  // What is wrong with the answers in this pose.
  std::string fault(Tally& tally) {
    HullMemory blank;
    const bool apart = hulls_apart(hull_A_, hull_B_, X_AB_, memory_);
    const bool apart_without_memory = hulls_apart(hull_A_, hull_B_, X_AB_, blank);
    const bool apart_by_perceptron = hulls_apart(hull_A_, hull_B_, X_AB_, perceptron_memory_, HullTest::kPerceptron);
    ++tally.poses;
    tally.apart += apart ? 1 : 0;
    tally.perceptron += apart_by_perceptron ? 1 : 0;

    const HullOracle oracle(A_.points, B_.points, X_AB_);
    // Who says that they are apart must have the plane, and the gap along it.
    if (apart && !oracle.proves_apart(memory_.n_gap_A, memory_.gap)) return "no such gap with memory";
    if (apart_without_memory && !oracle.proves_apart(blank.n_gap_A, blank.gap)) return "no such gap";
    if (apart_by_perceptron && !oracle.proves_apart(perceptron_memory_.n_gap_A, perceptron_memory_.gap)) {
      return "no such gap by perceptron";
    }
    if (apart && apart_without_memory) {
      ++tally.proved;
      return "";
    }
    if (!apart && !apart_without_memory && !apart_by_perceptron && meeting_is_proved(oracle, memory_)) {
      ++tally.proved;
      return "";
    }
    ++tally.by_cgal;
    const double distance = oracle.distance();
    const double doubt = A_.name == "needle" || B_.name == "needle" ? kDoubtOfNeedles : kDoubt;
    const bool doubtful = distance <= doubt * (scale_ + X_AB_.translation().norm());
    tally.doubtful += doubtful ? 1 : 0;
    const std::string text = ", distance " + std::to_string(distance / scale_ * 1e12) + "e-12 of the size";
    if (!doubtful && !apart) return "not apart with memory" + text;
    if (!doubtful && !apart_without_memory) return "not apart" + text;
    return "";
  }

 private:
  void place(double distance) { X_AB_.translation() = middle() + distance * direction_; }

  // Of A to that of B, so that they meet somewhere on the way.
  Vector3d middle() const { return hull_A_.vertices()[0] - X_AB_.linear() * hull_B_.vertices()[0]; }

  double find_contact() {
    double near = 0.0;
    double far = 4.0 * scale_;
    HullMemory memory;
    for (int i = 0; i < 60; ++i) {
      const double between = 0.5 * (near + far);
      place(between);
      (hulls_apart(hull_A_, hull_B_, X_AB_, memory) ? far : near) = between;
    }
    return far;
  }

  bool meeting_is_proved(const HullOracle& oracle, const HullMemory& memory) const {
    std::array<HullOracle::PointPair, 4> pairs;
    if (memory.simplex_count < 4) return false;
    for (std::size_t i = 0; i < 4; ++i) {
      pairs[i] = {hull_A_.vertices()[static_cast<std::size_t>(memory.simplex[i][0])],
                  hull_B_.vertices()[static_cast<std::size_t>(memory.simplex[i][1])]};
    }
    return oracle.proves_meeting(pairs);
  }

  RandomNumbers random_;
  Body A_;
  Body B_;
  ConvexHull hull_A_;
  ConvexHull hull_B_;
  double scale_;
  Isometry3d X_AB_ = Isometry3d::Identity();
  Vector3d direction_;
  double contact_ = 0.0;
  HullMemory memory_;
  HullMemory perceptron_memory_;
};

bool sweep(const SweepArguments& arguments) {
  const Stopwatch watch;
  SweepDifferences differences;
  Tally tally;
  run_batches(arguments, kPosesPerCase, kCasesPerBatch, [&](std::int64_t first, int count) {
    tbb::parallel_for(first, first + count, [&](std::int64_t index) {
      Walk walk(arguments.seed, index);
      for (int pose = 0; pose < kPosesPerCase; ++pose) {
        walk.step();
        const std::string fault = walk.fault(tally);
        if (fault.empty()) continue;
        differences.add(fault + "\n  --seed " + std::to_string(arguments.seed) + " --only-case " +
                        std::to_string(index) + ", pose " + std::to_string(pose) + ", " + walk.name());
      }
    });
  });
  std::printf("%lld pairs in %.1f s: %lld apart, %lld of these by the perceptron alone\n",
              static_cast<long long>(tally.poses), watch.seconds(), static_cast<long long>(tally.apart),
              static_cast<long long>(tally.perceptron));
  std::printf("%lld answers proved, %lld decided by CGAL, %lld of these touch or nearly\n",
              static_cast<long long>(tally.proved), static_cast<long long>(tally.by_cgal),
              static_cast<long long>(tally.doubtful));
  differences.print();
  return differences.count() == 0;
}

}  // namespace
}  // namespace glissade::collision

int main(int argc, char** argv) {
  return glissade::test_support::run_sweep(argc, argv, "Compares separating planes of hulls with exact arithmetic",
                                           "pairs", 100'000, glissade::collision::sweep);
}
