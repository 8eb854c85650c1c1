// CGAL: its rigid-motion collision detection over AABB-trees, which leaves the trees unchanged and decides exactly.
// Boolean queries only.

#include <array>
#include <stdexcept>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Rigid_triangle_mesh_collision_detection.h>
#include <CGAL/Surface_mesh.h>

#include "subject.h"

namespace glissade::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Detection = CGAL::Rigid_triangle_mesh_collision_detection<SurfaceMesh>;
using Eigen::Isometry3d;

struct CgalModel : Model {
  // Triangles share no vertices here: a surface mesh must be a manifold, and ours need not be.
  explicit CgalModel(const geometry::TriangleMesh& mesh) {
    for (const geometry::Triangle& triangle : mesh.triangles) {
      std::array<SurfaceMesh::Vertex_index, 3> corners;
      for (std::size_t i = 0; i < 3; ++i) {
        const Eigen::Vector3d& p = mesh.vertices[static_cast<std::size_t>(triangle[i])];
        corners[i] = surface.add_vertex({p.x(), p.y(), p.z()});
      }
      surface.add_face(corners[0], corners[1], corners[2]);
    }
    tree = std::make_unique<Detection::AABB_tree>(faces(surface).begin(), faces(surface).end(), surface);
    tree->build();
  }

  SurfaceMesh surface;
  std::unique_ptr<Detection::AABB_tree> tree;
};

class CgalQuery : public Query {
 public:
  CgalQuery(const Model& model_A, const Model& model_B) : id_A_(add(model_A)), id_B_(add(model_B)) {}

  bool intersects(const Isometry3d& X_AB) override {
    const auto& m = X_AB.matrix();
    detection_.set_transformation(id_B_, {m(0, 0), m(0, 1), m(0, 2), m(0, 3), m(1, 0), m(1, 1), m(1, 2), m(1, 3),
                                          m(2, 0), m(2, 1), m(2, 2), m(2, 3)});
    return !detection_.get_all_intersections(id_A_).empty();
  }
  std::int64_t count_pairs(const Isometry3d&) override {
    throw std::logic_error("CGAL's collision detection does not report pairs of triangles");
  }

 private:
  // Declaring one component saves the search for one point of each component: the points serve only to detect a mesh
  // inside another.
  std::size_t add(const Model& model) {
    const auto& cgal = dynamic_cast<const CgalModel&>(model);
    return detection_.add_mesh(*cgal.tree, cgal.surface, CGAL::parameters::apply_per_connected_component(false));
  }

  Detection detection_;
  std::size_t id_A_;
  std::size_t id_B_;
};

}  // namespace

Subject cgal_subject() {
  return {.name = "cgal",
          .model = "cgal",
          .build = [](const geometry::TriangleMesh& mesh) { return std::make_unique<CgalModel>(mesh); },
          .query = [](const Model& model_A,
                      const Model& model_B) { return std::make_unique<CgalQuery>(model_A, model_B); }};
}

}  // namespace glissade::bench
