// See `register_all_pairs` in benches.h.

#include "benches.h"
#include "pair_poses.h"
#include "query_case.h"
#include "subject_lists.h"

namespace glissade::bench {

void register_all_pairs(const Suite& suite) {
  for (const SuiteMesh& mesh : suite.meshes) {
    register_queries({"all-pairs/" + mesh.name, mesh.pair,
                      lazy_poses(mesh.pair, overlapping_poses(suite.quick ? 6 : 12)), Operation::kCountPairs},
                     join({fast_subjects(mesh.is_typical), {ode_subject(), bullet_subject()}}));
  }
}

}  // namespace glissade::bench
