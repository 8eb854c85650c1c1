#pragma once

/// Two objects whose boxes overlap, and what the pipeline knows of them from frame to frame.

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

/// What only pairs have that meet in more than a verdict.
struct MeetingDetails {
  ParallelWorkspace workspace;
  std::vector<TrianglePair> triangle_pairs;
  std::vector<ClosePair> close_pairs;
};

/// What every frame looks at, of many pairs.
struct TrackedPair {
  SlotPair slots{0, 0};      ///< of the world; object a is A of every query; equal ones: no pair
  Separation separation;     ///< the last that is known
  std::uint32_t frame = 0;   ///< the last that looked at it; low bits of the number
  float expected_ns = 0.0F;  ///< of the exact query, by what the last one did
  bool is_of_interest = false;
  bool meets = false;
};

/// What only queries look at, of few.
struct PairMemory {
  HullMemory hulls;
  std::unique_ptr<CoherentFront> front;     ///< while the pair is near
  std::unique_ptr<MeetingDetails> details;  ///< the same, if they are asked for
};

}  // namespace glissade::collision
