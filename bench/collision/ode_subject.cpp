// ODE: triangle mesh against triangle mesh by dCollide. It has no query that only says yes or no: the boolean asks for
// one contact of any quality, but ODE collects all overlapping pairs of boxes first.

#include <cstdarg>

#include <ode/ode.h>

#include "subject.h"

namespace glissade::bench {
namespace {

using Eigen::Isometry3d;

void keep_ode_alive() {
  struct Session {
    Session() {
      dInitODE2(0);
      dSetMessageHandler([](int, const char*, va_list) {});  // warns of every deep overlap
    }
    ~Session() { dCloseODE(); }
  };
  static const Session session;
}

// ODE refers to the arrays it is given.
class OdeModel : public Model {
 public:
  explicit OdeModel(const collision::TriangleMesh& mesh) {
    keep_ode_alive();
    for (const Eigen::Vector3d& vertex : mesh.vertices)
      vertices_.insert(vertices_.end(), {vertex.x(), vertex.y(), vertex.z()});
    for (const collision::Triangle& triangle : mesh.triangles) {
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

class OdeQuery : public Query {
 public:
  OdeQuery(const Model& model_A, const Model& model_B)
      : geom_A_(make(model_A)), geom_B_(make(model_B)), contacts_(kMostContacts) {}
  ~OdeQuery() override {
    dGeomDestroy(geom_A_);
    dGeomDestroy(geom_B_);
  }
  OdeQuery(const OdeQuery&) = delete;
  OdeQuery& operator=(const OdeQuery&) = delete;

  bool intersects(const Isometry3d& X_AB) override {
    return collide(X_AB, static_cast<int>(CONTACTS_UNIMPORTANT | 1U)) > 0;
  }

  // Pairs of triangles with several contacts give them one after the other.
  std::int64_t count_pairs(const Isometry3d& X_AB) override {
    const int count = collide(X_AB, kMostContacts);
    std::int64_t pairs = 0;
    for (int i = 0; i < count; ++i) {
      const dContactGeom& now = contacts_[static_cast<std::size_t>(i)];
      if (i == 0 || now.side1 != contacts_[static_cast<std::size_t>(i - 1)].side1 ||
          now.side2 != contacts_[static_cast<std::size_t>(i - 1)].side2) {
        ++pairs;
      }
    }
    return pairs;
  }

 private:
  static constexpr int kMostContacts = 0xffff;

  static dGeomID make(const Model& model) {
    return dCreateTriMesh(nullptr, dynamic_cast<const OdeModel&>(model).data(), nullptr, nullptr, nullptr);
  }

  int collide(const Isometry3d& X_AB, int flags) {
    dMatrix3 rotation = {};
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column)
        rotation[4 * row + column] = X_AB(row, column);
    }
    dGeomSetRotation(geom_B_, rotation);
    dGeomSetPosition(geom_B_, X_AB(0, 3), X_AB(1, 3), X_AB(2, 3));
    return dCollide(geom_A_, geom_B_, flags, contacts_.data(), sizeof(dContactGeom));
  }

  dGeomID geom_A_;
  dGeomID geom_B_;
  std::vector<dContactGeom> contacts_;
};

}  // namespace

Subject ode_subject() {
  return {
      .name = "ode",
      .model = "ode",
      .build = [](const collision::TriangleMesh& mesh) { return std::make_unique<OdeModel>(mesh); },
      .query = [](const Model& model_A, const Model& model_B) { return std::make_unique<OdeQuery>(model_A, model_B); },
      .slow = true};
}

}  // namespace glissade::bench
