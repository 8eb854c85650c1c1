#include "certificate/pairs_to_certify.h"

#include <glissade/base/assert.h>

namespace glissade::contact {

TreeItem child_of(const ContactBody& body, std::uint32_t node, int child) {
  const collision::TreeNode head = body.tree.node(node);
  GLISSADE_ASSERT(child < head.child_count());
  const TreeItem::Kind kind = head.is_leaf(child) ? TreeItem::Kind::kLeaf : TreeItem::Kind::kNode;
  return {kind, head.child(child), &body.obbs->box(node, child)};
}

}  // namespace glissade::contact
