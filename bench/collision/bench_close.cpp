// See `register_close` in benches.h.

#include "benches.h"
#include "pair_poses.h"
#include "query_case.h"
#include "subject_lists.h"

namespace glissade::bench {
namespace {

struct RelativeGap {
  const char* name;
  double share;  // of the size
};
constexpr RelativeGap kRelativeGaps[] = {{"gap-0.1%", 0.001}, {"gap-0.3%", 0.003}, {"gap-1%", 0.01}};

}  // namespace

void register_close(const Suite& suite) {
  const std::size_t count = suite.quick ? 50 : 200;
  for (const SuiteMesh& mesh : suite.meshes) {
    for (const RelativeGap& gap : kRelativeGaps) {
      const QueryCase query_case{"close/" + mesh.name + "-" + gap.name, mesh.pair,
                                 lazy_poses(mesh.pair, poses_at(gap.share * kSize, count))};
      register_queries(query_case, fast_subjects(false));
      if (mesh.is_typical) register_sample(query_case, 1, suite.quick ? 5 : 20, sample_subjects());
    }
  }
}

}  // namespace glissade::bench
