// Functions of `multi_part_sliding.h` that tell of a part and a body without a simulation.

#include <optional>

#include <glissade/collision/dop_query.h>
#include <glissade/contact/multi_part_sliding.h>

#include "cycle/inset.h"
#include "cycle/orientation.h"
#include "cycle/seats.h"
#include "cycle/simulated_parts.h"

namespace glissade::contact {

double overlap_depth(const ContactBody& body, const SlidingPart& part_V, const Eigen::Isometry3d& X_BV) {
  collision::QueryWorkspace workspace;
  if (!collision::intersects(body.tree, part_V.tree, X_BV, workspace)) return 0.0;
  const double touching = kTouchingOfMargin * default_margin(part_V);
  const std::optional<double> depth = Inset(part_V.tree.mesh()).overlap(body, X_BV, touching);
  if (depth) return *depth;
  const double way_out = collision::find_way_out(body.tree, part_V.tree, X_BV, workspace).depth();
  return way_out > touching ? way_out : 0.0;
}

std::optional<geometry::TriangleMesh> inset_mesh(const SlidingPart& part_V, double depth) {
  Inset inset(part_V.tree.mesh());
  if (!inset.exists()) return std::nullopt;
  return inset.at(depth);
}

bool is_enclosed(const ContactBody& body, const SlidingPart& part_V, const Eigen::Isometry3d& X_BV) {
  collision::QueryWorkspace workspace;
  return encloses(body.tree.mesh(), X_BV * part_V.tree.mesh().corner(0, 0)) &&
         !collision::intersects(body.tree, part_V.tree, X_BV, workspace);
}

}  // namespace glissade::contact
