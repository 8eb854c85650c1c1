#pragma once

/// Separation tests of convex hulls: Glissade and other libraries, each behind a small adapter. All subjects that can
/// climb from corner to corner use the same adjacency and start at their last corner.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <glissade/collision/convex_hull.h>
#include <glissade/geometry/triangle_mesh.h>

#include "subject.h"

namespace glissade::bench {

/// A convex mesh whose vertices are all corners.
struct HullModel {
  explicit HullModel(geometry::TriangleMesh convex) : mesh(std::move(convex)), hull(mesh) {}

  geometry::TriangleMesh mesh;
  collision::ConvexHull hull;
};

/// The query whether two copies of a model collide.
class HullQuery : public Query {
 public:
  std::int64_t count_pairs(const Eigen::Isometry3d& X_AB) override { return intersects(X_AB) ? 1 : 0; }
};

struct HullSubject {
  std::string name;
  std::function<std::unique_ptr<HullQuery>(const HullModel&)> query;
};

/// `glissade` is the exact test, `glissade-perceptron` the paper's.
HullSubject glissade_hulls(const std::string& name, collision::HullTest test);
/// libccd: GJK, and its other algorithm, MPR.
HullSubject libccd_gjk();
HullSubject libccd_mpr();
/// FCL's own GJK on `fcl::Convex`.
HullSubject fcl_hulls();
/// `btGjkPairDetector` on `btConvexHullShape`: single precision, a support function over all corners.
HullSubject bullet_hulls();

}  // namespace glissade::bench
