#pragma once

/// Statistics of a simulation of sliding contact.

#include <cstdint>

#include <glissade/collision/frame_result.h>

namespace glissade::contact {

/// The work of searches. A search finds the triangle pairs that may yield contacts, and the pairs of triangles and
/// boxes that the next steps must certify.
struct SearchStatistics {
  std::int64_t searches = 0;  ///< number of searches whose answers were used
  /// The sum of the reports of these searches. The stages of `reports` cover the search for near bodies.
  /// `reports.total` also includes the search among triangles, and the time for which a search waits for its share of
  /// work. With a search thread, times and stages differ from run to run, because a search that is ended early clears
  /// the memory of the pipeline.
  collision::FrameReport reports;
};

/// The calls of a simulation and their work.
struct CallStatistics {
  std::int64_t calls = 0;
  std::int64_t ended_early = 0;  ///< number of calls that used up their work budget
  /// Number of steps without a solution for friction, mostly because the work for friction was used up. Such steps are
  /// certified, but their forces do not balance the springs.
  std::int64_t unsettled_friction = 0;
  std::int64_t most_work = 0;  ///< largest work of one call's cycles, in the unit of `SlidingRules::work_budget`
};

}  // namespace glissade::contact
