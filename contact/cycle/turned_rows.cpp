#include "cycle/turned_rows.h"

#include <array>
#include <cstddef>
#include <cstdint>

#include <Eigen/Geometry>

#include <glissade/geometry/displacement.h>

#include "cycle/sliding_constants.h"

namespace glissade::contact {
namespace {

/// Of the angle between two edges: lines that are more parallel cross somewhere else after the least turn.
constexpr double kLeastSine = 0.1;

/// How a part has moved about its reference point.
struct Motion {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d v = Eigen::Vector3d::Zero();

  /// From the place of the reference point before, of a point that was at `r` from there.
  Eigen::Vector3d moved(const Eigen::Vector3d& r) const { return v + R * r; }
};

/// The direction of an edge, in world axes.
Eigen::Vector3d direction_W(const PlacedBody& body, std::int32_t edge) {
  const auto& ends = body.body->topology.edges()[static_cast<std::size_t>(edge)].vertices;
  const auto& vertices = body.body->tree.mesh().vertices;
  return body.X_WB.linear() *
         (vertices[static_cast<std::size_t>(ends[1])] - vertices[static_cast<std::size_t>(ends[0])]).normalized();
}

/// A contact whose features have moved: its normal, and the way from the point of the part that was the contact point
/// to the one that is, along the part's face or edge.
struct Turned {
  Eigen::Vector3d n_W;
  Eigen::Vector3d along_W = Eigen::Vector3d::Zero();
};

/// Two lines past each other. `apart_W`: from a point of the obstacle's line to one of the part's.
Turned turned_edges(const Eigen::Vector3d& e, const Eigen::Vector3d& f, const Eigen::Vector3d& n_before,
                    const Eigen::Vector3d& apart_W) {
  Eigen::Vector3d n = e.cross(f);
  const double sine = n.norm();
  if (sine < kLeastSine) return {n_before};
  n /= n.dot(n_before) < 0.0 ? -sine : sine;
  const Eigen::Vector3d across = f.cross(n);
  return {n, -apart_W.dot(across) / e.dot(across) * e};
}

}  // namespace

std::span<const CoupledRow> TurnedRows::find(const Displacements& displacements, std::span<const CoupledRow> rows,
                                             std::span<const Contact> contacts) {
  std::array<Motion, kMaxParts> of_parts;
  for (std::size_t p = 0; p < shared_.count(); ++p)
    of_parts[p] = {geometry::rotation_by(displacements[p].w).toRotationMatrix(), displacements[p].v};
  const ContactScene& scene = shared_.scene;
  rows_.clear();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Contact& contact = contacts[i];
    const auto part = static_cast<std::size_t>(rows[i].part);
    const Motion& of_part = of_parts[part];
    const Motion of_other = rows[i].other < 0 ? Motion{} : of_parts[static_cast<std::size_t>(rows[i].other)];
    const Eigen::Vector3d moved = of_part.moved(rows[i].r);
    const Eigen::Vector3d r_obstacle = rows[i].r_other - contact.gap * rows[i].n;
    const Eigen::Vector3d apart_W =
        contact.gap * rows[i].n + moved - rows[i].r - (of_other.moved(r_obstacle) - r_obstacle);
    Turned turned{rows[i].n};
    switch (contact.kind) {
      case ContactKind::kVertexFace:
        turned.n_W = of_other.R * rows[i].n;
        break;
      case ContactKind::kFaceVertex:
        turned.n_W = of_part.R * rows[i].n;
        turned.along_W = turned.n_W.dot(apart_W) * turned.n_W - apart_W;
        break;
      case ContactKind::kEdgeEdge: {
        const std::size_t own =
            contact.rider < 0 ? part : scene.first_rider() + static_cast<std::size_t>(contact.rider);
        const PlacedBody& own_body = scene.bodies()[scene.body_of_mover(own)];
        const PlacedBody& other_body = scene.bodies()[static_cast<std::size_t>(contact.obstacle)];
        turned = turned_edges(of_part.R * direction_W(own_body, contact.part_feature),
                              of_other.R * direction_W(other_body, contact.obstacle_feature), rows[i].n, apart_W);
        break;
      }
      case ContactKind::kVertexEdge:
      case ContactKind::kEdgeVertex:
      case ContactKind::kVertexVertex:
      case ContactKind::kOverlap:
        break;
    }
    CoupledRow& row = rows_.emplace_back(rows[i]);
    row.n = turned.n_W;
    row.r = moved - of_part.v + turned.along_W;
    row.bound = rows[i].bound == -kUnbounded ? -kUnbounded : contact.gap + rows[i].bound - turned.n_W.dot(apart_W);
    if (row.other >= 0) row.r_other = rows[i].r_other - rows[i].r + moved - of_other.v + turned.along_W;
  }
  return rows_;
}

}  // namespace glissade::contact
