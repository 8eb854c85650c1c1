#include <stdexcept>

#include <glissade/haptics/contact_body.h>

#include "certificate/obb_tree.h"

namespace glissade::haptics {
namespace {

const std::shared_ptr<const geometry::TriangleMesh>& checked(
    const std::shared_ptr<const geometry::TriangleMesh>& mesh) {
  if (mesh == nullptr) throw std::invalid_argument("a body in contact needs a mesh, not a null pointer");
  return mesh;
}

}  // namespace

ContactBody::ContactBody(const std::shared_ptr<const geometry::TriangleMesh>& mesh)
    : tree(checked(mesh)),
      hull(*mesh),
      topology(*mesh),
      features(tree, [this](std::int32_t triangle) { return topology.owns_stopping_feature(triangle); }),
      obbs_(std::make_unique<const ObbTree>(tree)) {}

ContactBody::~ContactBody() = default;

}  // namespace glissade::haptics
