#pragma once

/// The state of two objects whose boxes overlap, kept from frame to frame.

#include <cstdint>
#include <memory>
#include <vector>

#include <glissade/collision/convex_hull.h>
#include <glissade/collision/query_types.h>

#include "pipeline/broad_phase.h"
#include "pipeline/placed_objects.h"
#include "query/coherent_front.h"
#include "query/parallel_query.h"

namespace glissade::collision {

/// Data of pairs that meet, for pipelines that compute more than verdicts.
struct MeetingDetails {
  ParallelWorkspace workspace;
  std::vector<TrianglePair> triangle_pairs;
  std::vector<ClosePair> close_pairs;
};

/// Data that every frame reads, for many pairs.
struct TrackedPair {
  SlotPair slots{0, 0};      ///< in the world; object a is A of every query; equal slots: no pair
  Separation separation;     ///< the last known one
  std::uint32_t frame = 0;   ///< the last frame that considered the pair; low bits of its number
  float expected_ns = 0.0F;  ///< of the exact query, estimated from the last one
  bool is_enabled = false;
  bool meets = false;
};

/// Data that only queries read, for few pairs.
struct PairMemory {
  HullMemory hulls;
  std::unique_ptr<CoherentFront> front;     ///< while the pair is near
  std::unique_ptr<MeetingDetails> details;  ///< the same, if the options require them
};

}  // namespace glissade::collision
