// See `register_parts` in benches.h.

#include "benches.h"
#include "pair_poses.h"
#include "query_case.h"
#include "sliding_walk.h"
#include "subject_lists.h"

namespace glissade::bench {
namespace {

PosesOfTrees walk_at_gaps(std::size_t frames) {
  return [frames](const collision::DopTree& tree_A, const collision::DopTree& tree_B) {
    const std::vector<SlidingPhase> phases{
        {"gap-0.1%", 0.001 * kSize}, {"gap-1%", 0.01 * kSize}, {"gap-10%", 0.1 * kSize}};
    Poses poses;
    for (const Poses& phase : sliding_walk(tree_A, tree_B, phases, frames, kSmallStep, kSeed))
      poses.insert(poses.end(), phase.begin(), phase.end());
    return poses;
  };
}

struct Question {
  const char* name;
  Operation operation;
  PosesOfTrees poses;
  Subject ours = glissade_subject();
};

std::vector<Question> questions(bool quick) {
  const std::size_t count = quick ? 20 : 100;
  return {{"yes-no", Operation::kIntersects, zachmann_poses(quick ? 10 : 20)},
          {"yes-no-0.1%", Operation::kIntersects, poses_at(0.001 * kSize, count)},
          {"yes-no-1%", Operation::kIntersects, poses_at(0.01 * kSize, count)},
          {"all-pairs", Operation::kCountPairs, overlapping_poses(count)},
          {"distance-0.1%", Operation::kDistance, poses_at(0.001 * kSize, count)},
          {"distance-1%", Operation::kDistance, poses_at(0.01 * kSize, count)},
          {"distance-10%", Operation::kDistance, poses_at(0.1 * kSize, count)},
          {"distance-coherent", Operation::kDistance, walk_at_gaps(quick ? 30 : 200), glissade_coherent()}};
}

}  // namespace

void register_parts(const Suite& suite) {
  for (const SuiteMesh& part : suite.parts) {
    for (const Question& question : questions(suite.quick)) {
      register_queries({"parts/" + std::string(question.name) + ":" + part.name, part.pair,
                        lazy_poses(part.pair, question.poses), question.operation},
                       {question.ours, fcl_subject(), pqp_subject()});
    }
  }
}

}  // namespace glissade::bench
