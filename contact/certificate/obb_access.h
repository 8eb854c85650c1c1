#pragma once

/// Access to the OBB tree of a body, for certificates.

#include <glissade/contact/contact_body.h>

#include "certificate/obb_tree.h"

namespace glissade::contact {

struct ObbAccess {
  static const ObbTree& tree(const ContactBody& body) { return *body.obbs_; }
};

inline const ObbTree& obb_tree_of(const ContactBody& body) {
  return ObbAccess::tree(body);
}

}  // namespace glissade::contact
