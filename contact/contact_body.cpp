#include <algorithm>
#include <stdexcept>

#include <glissade/contact/contact_body.h>
#include <glissade/geometry/mesh_import.h>

namespace glissade::contact {
namespace {

const std::shared_ptr<const geometry::TriangleMesh>& checked(
    const std::shared_ptr<const geometry::TriangleMesh>& mesh) {
  if (mesh == nullptr) throw std::invalid_argument("a body in contact needs a mesh, not a null pointer");
  return mesh;
}

std::shared_ptr<const geometry::TriangleMesh> mesh_of(const std::filesystem::path& file, double scale) {
  return std::make_shared<const geometry::TriangleMesh>(geometry::import_mesh(file, scale).mesh);
}

bool owns_corner(const geometry::MeshTopology& topology, std::int32_t triangle) {
  return topology.owns_corner(triangle, 0) || topology.owns_corner(triangle, 1) || topology.owns_corner(triangle, 2);
}

}  // namespace

ContactBody::ContactBody(const std::shared_ptr<const geometry::TriangleMesh>& mesh)
    : tree(checked(mesh)),
      hull(*mesh),
      topology(*mesh),
      features(
          tree, [this](std::int32_t triangle) { return owns_corner(topology, triangle); },
          [this](std::int32_t triangle) { return topology.owns_stopping_feature(triangle); }),
      obbs(tree.obb_tree()) {}

ContactBody::~ContactBody() = default;

SlidingPart::SlidingPart(const std::shared_ptr<const geometry::TriangleMesh>& mesh)
    : ContactBody(mesh), p_Vref_(tree.center()), has_chosen_point_(false), radius_(tree.radius()) {}

SlidingPart::SlidingPart(const std::shared_ptr<const geometry::TriangleMesh>& mesh, const Eigen::Vector3d& p_Vref)
    : ContactBody(mesh), p_Vref_(p_Vref), has_chosen_point_(true), radius_(0.0) {
  if (!((p_Vref - tree.center()).norm() <= kFarthestPoint * tree.radius())) {
    throw std::invalid_argument("the compliance point lies too far from the part");
  }
  for (const Eigen::Vector3d& vertex : tree.mesh().vertices)
    radius_ = std::max(radius_, (vertex - p_Vref).norm());
}

std::shared_ptr<const ContactBody> load_body(const std::filesystem::path& file, double scale) {
  return std::make_shared<const ContactBody>(mesh_of(file, scale));
}

std::shared_ptr<const SlidingPart> load_part(const std::filesystem::path& file, double scale) {
  return std::make_shared<const SlidingPart>(mesh_of(file, scale));
}

}  // namespace glissade::contact
