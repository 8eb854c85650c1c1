// See `register_coherent` in benches.h.

#include "benches.h"
#include "query_case.h"
#include "sliding_walk.h"
#include "subject_lists.h"

namespace glissade::bench {
namespace {

using collision::DopTree;

const std::vector<SlidingPhase> kPhases{{"gap-1%", 0.01 * kSize},
                                        {"gap-0.5%", 0.005 * kSize},
                                        {"gap-0.1%", 0.001 * kSize},
                                        {"touching", 0.0},
                                        {"colliding", -0.01 * kSize}};

}  // namespace

void register_coherent(const Suite& suite) {
  const std::size_t frames = suite.quick ? 200 : 1000;
  for (const SuiteMesh& mesh : suite.meshes) {
    if (!mesh.is_typical) continue;
    const auto walk = lazy([pair = mesh.pair, frames] {
      const DopTree tree((*pair)->mesh_A);
      return sliding_walk(tree, tree, kPhases, frames, kSmallStep, kSeed);
    });
    for (std::size_t i = 0; i < kPhases.size(); ++i) {
      register_queries({"coherent/" + mesh.name + "-" + kPhases[i].name, mesh.pair, lazy([=] { return (**walk)[i]; })},
                       {glissade_subject(), glissade_coherent(), fcl_subject()});
    }
  }
}

}  // namespace glissade::bench
