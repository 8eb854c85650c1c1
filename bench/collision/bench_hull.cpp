// See `run_hull` in benches.h.

#include <cstdio>
#include <memory>
#include <numbers>
#include <stdexcept>

#include <glissade/geometry/mesh_generators.h>

#include "benches.h"
#include "hull_oracle.h"
#include "hull_subjects.h"

namespace glissade::bench {
namespace {

using collision::ConvexHull;
using collision::HullMemory;
using collision::HullTest;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using Poses = std::vector<Isometry3d>;

constexpr const char* kHullName = "hull";
const std::vector<std::string> kHullPeers{"libccd", "libccd-mpr", "fcl", "bullet"};

struct Shape {
  const char* name;
  Vector3d semi_axes;  // metres: the size is 1
};
const std::vector<Shape> kShapes{{"sphere", {0.5, 0.5, 0.5}}, {"ellipsoid", {0.5, 0.3, 0.15}}};

struct Gap {
  const char* name;
  double size;  // metres; also a fraction of the size, which is 1 m
  const char* group;
};
const std::vector<Gap> kGaps{{"gap-1e-2", 1e-2, "separated"},
                             {"gap-1e-4", 1e-4, "separated"},
                             {"gap-1e-6", 1e-6, "touching"},
                             {"depth-1e-3", -1e-3, "penetrating"}};

struct Pace {
  const char* name;
  double degrees;
};
const std::vector<Pace> kPaces{{"0.05deg", 0.05}, {"0.5deg", 0.5}, {"5deg", 5.0}};
constexpr const char* kSlowest = "0.05deg";

HullModel make_model(const Shape& shape, std::int64_t vertices) {
  geometry::TriangleMesh mesh = geometry::make_sphere(1.0, 2 * vertices);
  for (Vector3d& x : mesh.vertices)
    x = x.cwiseProduct(shape.semi_axes);
  return HullModel(std::move(mesh));
}

// Moves B along the direction of its translation, from far away to contact of the hulls; `memory` then holds the plane
// between them.
void approach(const ConvexHull& hull, Isometry3d& X_AB, HullMemory& memory) {
  const Vector3d direction = X_AB.translation();
  double near = 0.0;
  double far = 2.0;
  for (int i = 0; i < 50; ++i) {
    const double between = 0.5 * (near + far);
    X_AB.translation() = between * direction;
    (collision::hulls_apart(hull, hull, X_AB, memory) ? far : near) = between;
  }
  X_AB.translation() = (far + 1e-11) * direction;  // out of reach of rounding
  if (!collision::hulls_apart(hull, hull, X_AB, memory)) throw std::logic_error("the bench has lost its contact");
}

// B turns about itself and circles A, at the same pace about different axes. At each step its distance along the normal
// of contact is `gap`.
Poses walk(const ConvexHull& hull, double gap, double degrees, int steps) {
  const double angle = degrees * std::numbers::pi / 180.0;
  const Vector3d spin = Vector3d(1.0, 2.0, 3.0).normalized();
  const Vector3d orbit = Vector3d(0.3, -0.2, 1.0).normalized();
  const Eigen::AngleAxisd first(1.0, Vector3d(0.3, -1.0, 0.2).normalized());
  HullMemory memory;
  Poses poses;
  for (int step = 0; step < steps; ++step) {
    Isometry3d X_AB(Eigen::AngleAxisd(step * angle, spin) * first);
    X_AB.translation() = Eigen::AngleAxisd(step * angle, orbit) * Vector3d(0.8, 0.6, 0.0);
    approach(hull, X_AB, memory);
    X_AB.translation() += gap * memory.n_gap_A;
    poses.push_back(X_AB);
  }
  return poses;
}

// Whether the hulls meet, exactly: the claim of Glissade is verified in exact arithmetic; otherwise CGAL decides.
std::vector<bool> exact_answers(const ConvexHull& hull, const Poses& poses) {
  std::vector<bool> answers;
  HullMemory memory;
  for (const Isometry3d& X_AB : poses) {
    const bool apart = collision::hulls_apart(hull, hull, X_AB, memory);
    const test_support::HullOracle oracle(hull.vertices(), hull.vertices(), X_AB);
    std::array<test_support::HullOracle::PointPair, 4> pairs;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t side = 0; side < 2; ++side)
        pairs[i][side] = hull.vertices()[static_cast<std::size_t>(memory.simplex[i][side])];
    }
    const bool is_proved = apart ? oracle.proves_apart(memory.n_gap_A, memory.gap) : oracle.proves_meeting(pairs);
    answers.push_back(is_proved ? !apart : oracle.distance() == 0.0);
  }
  return answers;
}

double count_wrong(HullQuery& query, const Poses& poses, const std::vector<bool>& expected) {
  int wrong = 0;
  query.start();
  for (std::size_t i = 0; i < poses.size(); ++i)
    wrong += query.intersects(poses[i]) == expected[i] ? 0 : 1;
  return wrong;
}

void run_case(const std::string& name, const HullModel& model, const Poses& poses,
              const std::vector<HullSubject>& subjects, const BenchOptions& options, Results& results) {
  std::fprintf(stderr, "%s %s\n", kHullName, name.c_str());
  const std::vector<bool> expected = exact_answers(model.hull, poses);
  std::vector<std::unique_ptr<HullQuery>> queries;
  std::vector<Contestant> contestants;
  for (const HullSubject& subject : subjects) {
    queries.push_back(subject.query(model));
    contestants.push_back({queries.back().get(), subject.slow});
    results.add({kHullName, name, subject.name, "wrong", count_wrong(*queries.back(), poses, expected), "1"});
  }
  const std::vector<PassTimes> times =
      interleaved_passes(contestants, {poses}, Operation::kIntersects, pass_limits(options));
  for (std::size_t i = 0; i < subjects.size(); ++i)
    results.add({kHullName, name, subjects[i].name, "time", times[i].all_ns, "ns"});
}

}  // namespace

void run_hull(const BenchOptions& options, Results& results) {
  const int steps = options.quick ? 200 : 1000;
  const std::vector<HullSubject> subjects{glissade_hulls("glissade", HullTest::kExact),
                                          glissade_hulls("glissade-perceptron", HullTest::kPerceptron),
                                          libccd_gjk(),
                                          libccd_mpr(),
                                          fcl_hulls(),
                                          bullet_hulls()};
  for (const Shape& shape : kShapes) {
    for (const std::int64_t size : options.suite.hull_vertices) {
      const HullModel model = make_model(shape, size);
      for (const Pace& pace : kPaces) {
        for (const Gap& gap : kGaps) {
          const std::string name =
              std::string(shape.name) + "-" + std::to_string(size) + "-" + pace.name + "-" + gap.name;
          run_case(name, model, walk(model.hull, gap.size, pace.degrees, steps), subjects, options, results);
        }
      }
    }
  }
  results.add_ratios(kHullName, kHullPeers);
  for (const char* group : {"separated", "touching", "penetrating"}) {
    std::vector<std::string> endings;
    for (const Gap& gap : kGaps) {
      if (gap.group == std::string(group)) endings.push_back(std::string(kSlowest) + "-" + gap.name);
    }
    results.add_group_ratios(kHullName, group, endings, kHullPeers);
  }
}

}  // namespace glissade::bench
