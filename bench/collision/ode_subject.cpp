// ODE: triangle mesh against triangle mesh by dCollide. It has no boolean query: here the query requests one
// contact of any quality, but ODE collects all overlapping pairs of boxes first.

#include "ode_model.h"

namespace glissade::bench {
namespace {

using Eigen::Isometry3d;

class OdeQuery : public Query {
 public:
  OdeQuery(const Model& model_A, const Model& model_B)
      : geom_A_(ode_geom(model_A)), geom_B_(ode_geom(model_B)), contacts_(kMostContacts) {}
  ~OdeQuery() override {
    dGeomDestroy(geom_A_);
    dGeomDestroy(geom_B_);
  }
  OdeQuery(const OdeQuery&) = delete;
  OdeQuery& operator=(const OdeQuery&) = delete;

  bool intersects(const Isometry3d& X_AB) override {
    return collide(X_AB, static_cast<int>(CONTACTS_UNIMPORTANT | 1U)) > 0;
  }

  // The contacts of one pair of triangles follow each other.
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

  int collide(const Isometry3d& X_AB, int flags) {
    place(geom_B_, X_AB);
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
      .build = [](const geometry::TriangleMesh& mesh) { return std::make_unique<OdeModel>(mesh); },
      .query = [](const Model& model_A, const Model& model_B) { return std::make_unique<OdeQuery>(model_A, model_B); }};
}

}  // namespace glissade::bench
