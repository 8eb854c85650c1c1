#pragma once

/// What a simulation of sliding contact has done so far.

#include <cstdint>

#include <glissade/collision/frame_result.h>

namespace glissade::contact {

/// The work of searching for contacts, and for the pairs of triangles and boxes that must provably stay apart in the
/// next steps. The stages of `reports` find out which bodies are near; only its `total` includes the search among their
/// triangles, and the time in which a search waits for work that it may do.
struct SearchStatistics {
  std::int64_t searches = 0;  ///< number of searches whose answers were used
  /// The sum of the reports of these searches. With a search thread, times and stages differ from run to run: the
  /// pipeline starts afresh after a search that was ended early, and then remembers nothing.
  collision::FrameReport reports;
};

/// The calls of a simulation and their work.
struct CallStatistics {
  std::int64_t calls = 0;
  std::int64_t ended_early = 0;  ///< calls that ended because their work was used up
  /// Steps whose friction was not solved, mostly because its work was used up first. They pass through nothing, but
  /// their forces are not in balance with the springs.
  std::int64_t unsettled_friction = 0;
  std::int64_t most_work = 0;  ///< of a call, without its searches; unit as in `SlidingRules::work_budget`
};

}  // namespace glissade::contact
