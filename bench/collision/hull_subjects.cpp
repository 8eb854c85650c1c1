#include "hull_subjects.h"

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <ccd/ccd.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>

namespace glissade::bench {
namespace {

using collision::ConvexHull;
using collision::HullMemory;
using collision::HullTest;
using Eigen::Isometry3d;
using Eigen::Vector3d;

class GlissadeHulls : public HullQuery {
 public:
  GlissadeHulls(const ConvexHull& hull, HullTest test) : hull_(hull), test_(test) {}

  void forget() override { memory_ = HullMemory(); }
  bool intersects(const Isometry3d& X_AB) override {
    return !collision::hulls_apart(hull_, hull_, X_AB, memory_, test_);
  }

 private:
  const ConvexHull& hull_;
  HullTest test_;
  HullMemory memory_;
};

// The object of libccd's callbacks.
struct CcdObject {
  const ConvexHull* hull;
  Isometry3d X_WO;
  std::int32_t corner = 0;
};

ccd_vec3_t ccd_vector(const Vector3d& v) {
  ccd_vec3_t result;
  ccdVec3Set(&result, v.x(), v.y(), v.z());
  return result;
}

void ccd_support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* result) {
  auto* o = static_cast<CcdObject*>(const_cast<void*>(object));  // libccd passes its argument on
  const Vector3d direction_O =
      o->X_WO.linear().transpose() * Vector3d(direction->v[0], direction->v[1], direction->v[2]);
  o->corner = o->hull->support(direction_O, o->corner);
  *result = ccd_vector(o->X_WO * o->hull->vertices()[static_cast<std::size_t>(o->corner)]);
}

void ccd_center(const void* object, ccd_vec3_t* result) {
  const auto* o = static_cast<const CcdObject*>(object);
  *result = ccd_vector(o->X_WO * o->hull->center());
}

void ccd_first_direction(const void* object_A, const void* object_B, ccd_vec3_t* direction) {
  const auto* a = static_cast<const CcdObject*>(object_A);
  const auto* b = static_cast<const CcdObject*>(object_B);
  *direction = ccd_vector(b->X_WO * b->hull->center() - a->X_WO * a->hull->center());
}

using CcdTest = int (*)(const void*, const void*, const ccd_t*);

class CcdHulls : public HullQuery {
 public:
  CcdHulls(const ConvexHull& hull, CcdTest test) : test_(test), A_{&hull, Isometry3d::Identity()}, B_(A_) {
    CCD_INIT(&ccd_);
    ccd_.support1 = ccd_support;
    ccd_.support2 = ccd_support;
    ccd_.center1 = ccd_center;
    ccd_.center2 = ccd_center;
    ccd_.first_dir = ccd_first_direction;
    ccd_.max_iterations = 1000;
    ccd_.mpr_tolerance = 1e-9;
  }

  bool intersects(const Isometry3d& X_AB) override {
    B_.X_WO = X_AB;
    return test_(&A_, &B_, &ccd_) != 0;
  }

 private:
  CcdTest test_;
  CcdObject A_;
  CcdObject B_;
  ccd_t ccd_{};
};

class FclHulls : public HullQuery {
 public:
  explicit FclHulls(const geometry::TriangleMesh& mesh) {
    auto faces = std::make_shared<std::vector<int>>();
    for (const geometry::Triangle& triangle : mesh.triangles) {
      faces->push_back(3);
      faces->insert(faces->end(), triangle.begin(), triangle.end());
    }
    convex_ = std::make_unique<fcl::Convexd>(std::make_shared<const std::vector<Vector3d>>(mesh.vertices),
                                             static_cast<int>(mesh.triangles.size()), faces);
  }

  bool intersects(const Isometry3d& X_AB) override {
    return solver_.shapeIntersect(*convex_, Isometry3d(Isometry3d::Identity()), *convex_, X_AB, nullptr);
  }

 private:
  std::unique_ptr<fcl::Convexd> convex_;
  fcl::detail::GJKSolver_libccd<double> solver_;
};

btVector3 bullet_vector(const Vector3d& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

class BulletHulls : public HullQuery {
 public:
  explicit BulletHulls(const ConvexHull& hull) {
    for (const Vector3d& vertex : hull.vertices())
      shape_.addPoint(bullet_vector(vertex), false);
    shape_.recalcLocalAabb();
    shape_.setMargin(0);
  }

  bool intersects(const Isometry3d& X_AB) override {
    btMatrix3x3 rotation;
    for (int row = 0; row < 3; ++row)
      rotation[row] = bullet_vector(X_AB.linear().row(row).transpose());
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA.setIdentity();
    input.m_transformB = btTransform(rotation, bullet_vector(X_AB.translation()));
    btPointCollector closest;
    btGjkPairDetector(&shape_, &shape_, &simplex_, nullptr).getClosestPoints(input, closest, nullptr);
    return !closest.m_hasResult || closest.m_distance <= 0;
  }

 private:
  btConvexHullShape shape_;
  btVoronoiSimplexSolver simplex_;
};

}  // namespace

HullSubject glissade_hulls(const std::string& name, HullTest test) {
  return {name, [test](const HullModel& model) { return std::make_unique<GlissadeHulls>(model.hull, test); }};
}

HullSubject libccd_gjk() {
  return {"libccd", [](const HullModel& model) { return std::make_unique<CcdHulls>(model.hull, ccdGJKIntersect); }};
}

HullSubject libccd_mpr() {
  return {"libccd-mpr", [](const HullModel& model) { return std::make_unique<CcdHulls>(model.hull, ccdMPRIntersect); }};
}

HullSubject fcl_hulls() {
  return {"fcl", [](const HullModel& model) { return std::make_unique<FclHulls>(model.mesh); }};
}

HullSubject bullet_hulls() {
  return {"bullet", [](const HullModel& model) { return std::make_unique<BulletHulls>(model.hull); }};
}

}  // namespace glissade::bench
