#pragma once

/// The Bullet model of all comparisons: a GImpact shape, the only one for two concave meshes, without collision margin,
/// in single precision as the package builds it.

#include <memory>
#include <vector>

#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <Eigen/Geometry>

#include <glissade/geometry/triangle_mesh.h>

#include "subject.h"

namespace glissade::bench {

inline btVector3 vector(const Eigen::Vector3d& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

inline btTransform transform(const Eigen::Isometry3d& X_WO) {
  btMatrix3x3 rotation;
  for (int row = 0; row < 3; ++row)
    rotation[row] = vector(X_WO.linear().row(row).transpose());
  return btTransform(rotation, vector(X_WO.translation()));
}

// Bullet refers to the arrays that it receives.
class BulletModel : public Model {
 public:
  explicit BulletModel(const geometry::TriangleMesh& mesh) {
    for (const Eigen::Vector3d& vertex : mesh.vertices)
      vertices_.push_back(vector(vertex));
    for (const geometry::Triangle& triangle : mesh.triangles)
      indices_.insert(indices_.end(), triangle.begin(), triangle.end());
    arrays_ = std::make_unique<btTriangleIndexVertexArray>(
        static_cast<int>(mesh.triangles.size()), indices_.data(), static_cast<int>(3 * sizeof(int)),
        static_cast<int>(vertices_.size()), static_cast<btScalar*>(vertices_[0]), static_cast<int>(sizeof(btVector3)));
    shape_ = std::make_unique<btGImpactMeshShape>(arrays_.get());
    shape_->setMargin(0.0F);
    shape_->updateBound();  // builds the tree
  }

  btGImpactMeshShape* shape() const { return shape_.get(); }

 private:
  std::vector<btVector3> vertices_;
  std::vector<int> indices_;
  std::unique_ptr<btTriangleIndexVertexArray> arrays_;
  std::unique_ptr<btGImpactMeshShape> shape_;
};

}  // namespace glissade::bench
