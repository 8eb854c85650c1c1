// See `register_hull` in benches.h.

#include <memory>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include <glissade/geometry/mesh_generators.h>

#include "benches.h"
#include "hull_oracle.h"
#include "hull_subjects.h"
#include "query_case.h"
#include "register_bench.h"

namespace glissade::bench {
namespace {

using collision::ConvexHull;
using collision::HullMemory;
using collision::HullTest;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr std::size_t kSteps = 200;

struct Shape {
  const char* name;
  Vector3d semi_axes;  // metres: the size is 1
};
const std::vector<Shape> kShapes{{"sphere", {0.5, 0.5, 0.5}}, {"ellipsoid", {0.5, 0.3, 0.15}}};

struct Gap {
  const char* name;
  double size;  // metres; also a fraction of the size, which is 1 m
};
const std::vector<Gap> kGaps{{"gap-1e-2", 1e-2}, {"gap-1e-4", 1e-4}, {"gap-1e-6", 1e-6}, {"depth-1e-3", -1e-3}};
constexpr double kGapOfAllPaces = 1e-4;  // the other gaps are measured at the slowest pace

struct Pace {
  const char* name;
  double degrees;
};
const std::vector<Pace> kPaces{{"0.05deg", 0.05}, {"0.5deg", 0.5}, {"5deg", 5.0}};

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
Poses walk(const ConvexHull& hull, double gap, double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  const Vector3d spin = Vector3d(1.0, 2.0, 3.0).normalized();
  const Vector3d orbit = Vector3d(0.3, -0.2, 1.0).normalized();
  const Eigen::AngleAxisd first(1.0, Vector3d(0.3, -1.0, 0.2).normalized());
  HullMemory memory;
  Poses poses;
  while (poses.size() < kSteps) {
    const double turned = static_cast<double>(poses.size()) * angle;
    Isometry3d X_AB(Eigen::AngleAxisd(turned, spin) * first);
    X_AB.translation() = Eigen::AngleAxisd(turned, orbit) * Vector3d(0.8, 0.6, 0.0);
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

int count_wrong(HullQuery& query, const Poses& poses, const std::vector<bool>& expected) {
  query.forget();
  return std::inner_product(
      poses.begin(), poses.end(), expected.begin(), 0, std::plus<>(),
      [&](const Isometry3d& X_AB, bool expects) { return query.intersects(X_AB) == expects ? 0 : 1; });
}

// What the subjects of a case share.
struct HullCase {
  HullCase(const HullModel& model, double gap, double degrees)
      : poses(walk(model.hull, gap, degrees)), expected(exact_answers(model.hull, poses)) {}

  Poses poses;
  std::vector<bool> expected;
};

// What a subject has in a case.
struct HullContestant {
  HullContestant(const HullSubject& subject, const HullModel& model, const HullCase& of_case)
      : query(subject.query(model)), wrong(count_wrong(*query, of_case.poses, of_case.expected)) {}

  std::unique_ptr<HullQuery> query;
  int wrong;
};

void register_hull_case(const std::string& name, const std::shared_ptr<Lazy<HullModel>>& model, double gap,
                        double degrees) {
  const auto hull_case = lazy([=] { return HullCase(**model, gap, degrees); });
  for (const HullSubject& subject :
       {glissade_hulls("glissade", HullTest::kExact), glissade_hulls("glissade-perceptron", HullTest::kPerceptron),
        libccd_gjk(), libccd_mpr(), fcl_hulls(), bullet_hulls()}) {
    const auto contestant = lazy([=] { return HullContestant(subject, **model, **hull_case); });
    register_bench("hull/" + name + "/" + subject.name, [=](benchmark::State& state) {
      state.counters["wrong"] = (*contestant)->wrong;
      measure_passes(state, *(*contestant)->query, (*hull_case)->poses, Operation::kIntersects);
    });
  }
}

}  // namespace

void register_hull(const Suite& suite) {
  std::vector<std::int64_t> sizes{100, 1'000};
  if (!suite.quick) sizes.push_back(20'000);
  for (const Shape& shape : kShapes) {
    for (const std::int64_t size : sizes) {
      const auto model = lazy([=] { return make_model(shape, size); });
      for (const Pace& pace : kPaces) {
        for (const Gap& gap : kGaps) {
          if (&pace != &kPaces.front() && gap.size != kGapOfAllPaces) continue;
          register_hull_case(std::string(shape.name) + "-" + std::to_string(size) + "-" + pace.name + "-" + gap.name,
                             model, gap.size, pace.degrees);
        }
      }
    }
  }
}

}  // namespace glissade::bench
