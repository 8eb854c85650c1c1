#pragma once

/// The ODE model of all comparisons: triangles in its own tree, shared by all geoms of the mesh.

#include <cstdarg>
#include <vector>

#include <ode/ode.h>

#include <glissade/geometry/triangle_mesh.h>

#include "subject.h"

namespace glissade::bench {

inline void keep_ode_alive() {
  struct Session {
    Session() {
      dInitODE2(0);
      dSetMessageHandler([](int, const char*, va_list) {});  // warns of every deep overlap
    }
    ~Session() { dCloseODE(); }
  };
  static const Session session;
}

// ODE refers to the arrays that it receives.
class OdeModel : public Model {
 public:
  explicit OdeModel(const geometry::TriangleMesh& mesh) {
    keep_ode_alive();
    for (const Eigen::Vector3d& vertex : mesh.vertices)
      vertices_.insert(vertices_.end(), {vertex.x(), vertex.y(), vertex.z()});
    for (const geometry::Triangle& triangle : mesh.triangles) {
      for (const std::int32_t index : triangle)
        indices_.push_back(static_cast<dTriIndex>(index));
    }
    data_ = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(data_, vertices_.data(), 3 * sizeof(double), static_cast<int>(mesh.vertices.size()),
                                indices_.data(), static_cast<int>(indices_.size()), 3 * sizeof(dTriIndex));
  }
  ~OdeModel() override { dGeomTriMeshDataDestroy(data_); }
  OdeModel(const OdeModel&) = delete;
  OdeModel& operator=(const OdeModel&) = delete;

  dTriMeshDataID data() const { return data_; }

 private:
  std::vector<double> vertices_;
  std::vector<dTriIndex> indices_;
  dTriMeshDataID data_;
};

inline dGeomID ode_geom(const Model& model) {
  return dCreateTriMesh(nullptr, dynamic_cast<const OdeModel&>(model).data(), nullptr, nullptr, nullptr);
}

inline void place(dGeomID geom, const Eigen::Isometry3d& X_WO) {
  dMatrix3 rotation = {};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      rotation[4 * row + column] = X_WO(row, column);
  }
  dGeomSetRotation(geom, rotation);
  dGeomSetPosition(geom, X_WO(0, 3), X_WO(1, 3), X_WO(2, 3));
}

}  // namespace glissade::bench
