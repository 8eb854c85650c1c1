#pragma once

/// A place where part and obstacles are close, as the projection sees it.

#include <cstdint>

#include <Eigen/Core>

namespace glissade::haptics {

/// The two features that are close: the part's first, the obstacle's second.
enum class ContactKind : std::uint8_t {
  kVertexFace,
  kFaceVertex,
  kEdgeEdge,
  kVertexEdge,
  kEdgeVertex,
  kVertexVertex,
};

struct Contact {
  ContactKind kind;
  std::int32_t part_triangle;
  std::int32_t obstacle;  ///< number among the surroundings
  std::int32_t obstacle_triangle;
  Eigen::Vector3d n_W;  ///< unit, from the obstacle to the part
  Eigen::Vector3d p_W;  ///< the contact point on the part, metres
  double gap;           ///< metres, positive
  double force = 0.0;   ///< newtons along n_W; 0 where the contact does not push
};

}  // namespace glissade::haptics
