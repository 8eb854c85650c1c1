#pragma once

/// Who tells convex hulls apart: Glissade and other libraries, each behind a small adapter. All that can climb from
/// corner to corner do so on the same neighbors, beginning where they were.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <glissade/collision/convex_hull.h>
#include <glissade/geometry/triangle_mesh.h>

#include "subject.h"

namespace glissade::bench {

/// A convex mesh, all of whose vertices are corners.
struct HullModel {
  explicit HullModel(geometry::TriangleMesh convex) : mesh(std::move(convex)), hull(mesh) {}

  geometry::TriangleMesh mesh;
  collision::ConvexHull hull;
};

/// Says whether two copies of a model meet.
class HullQuery : public Query {
 public:
  std::int64_t count_pairs(const Eigen::Isometry3d& X_AB) override { return intersects(X_AB) ? 1 : 0; }
};

struct HullSubject {
  std::string name;
  std::function<std::unique_ptr<HullQuery>(const HullModel&)> query;
  bool slow = false;  ///< one pass may be enough
};

/// `glissade` is the exact test, `glissade-perceptron` the paper's.
HullSubject glissade_hulls(const std::string& name, collision::HullTest test);
/// libccd: GJK, and its other algorithm, MPR.
HullSubject libccd_gjk();
HullSubject libccd_mpr();
/// FCL's own GJK on `fcl::Convex`.
HullSubject fcl_hulls();
/// `btGjkPairDetector` on `btConvexHullShape`: single precision, every corner looked at for each support.
HullSubject bullet_hulls();

}  // namespace glissade::bench
