// See `run_coherent` in benches.h.

#include <memory>
#include <numbers>

#include "benches.h"
#include "query_case.h"
#include "sliding_walk.h"
#include "subject_lists.h"

namespace glissade::bench {
namespace {

using collision::DopTree;
using geometry::TriangleMesh;

constexpr const char* kCoherentName = "coherent";
constexpr double kPartSize = 0.1;
constexpr SlidingStep kStep{.length = 1e-5, .angle = 0.005 * std::numbers::pi / 180.0};

const std::vector<SlidingPhase> kPhases{{"gap-1%", 0.01 * kPartSize},
                                        {"gap-0.5%", 0.005 * kPartSize},
                                        {"gap-0.1%", 0.001 * kPartSize},
                                        {"touching", 0.0},
                                        {"colliding", -0.01 * kPartSize}};

}  // namespace

void run_coherent(const BenchOptions& options, Results& results) {
  const std::size_t frames = options.quick ? 200 : 1000;
  std::vector<std::string> names;
  for (const SlidingPhase& phase : kPhases)
    names.emplace_back(phase.name);
  for (const SuiteMesh& suite_mesh : suite_meshes(options.suite, {options.suite.coherent_triangles}, kPartSize)) {
    const auto mesh = std::make_shared<const geometry::TriangleMesh>(suite_mesh.make());
    const DopTree tree(mesh);
    run_query_case({.bench = kCoherentName,
                    .name = suite_mesh.name,
                    .mesh_A = *mesh,
                    .mesh_B = *mesh,
                    .poses = sliding_walk(tree, tree, kPhases, frames, kStep, options.seed),
                    .part_names = names},
                   join({{glissade_subject(), glissade_coherent()},
                         glissade_instruction_sets(),
                         glissade_coherent_instruction_sets(),
                         {fcl_subject()}}),
                   pass_limits(options), results);
  }
  results.add_ratios(kCoherentName, kPeers);
}

}  // namespace glissade::bench
