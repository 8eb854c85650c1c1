#pragma once

/// One case of a query benchmark: all subjects on two meshes at many poses. Its rows go to the results.

#include <string>
#include <vector>

#include <glissade/geometry/triangle_mesh.h>

#include "interleaved_passes.h"
#include "results.h"
#include "subject.h"

namespace glissade::bench {

struct QueryCase {
  std::string bench;
  std::string name;
  const geometry::TriangleMesh& mesh_A;
  const geometry::TriangleMesh& mesh_B;  ///< may be the same object: then both use one model
  PoseParts poses;
  std::vector<std::string> part_names = {"sample"};  ///< of the first parts, which are reported by themselves
  Operation operation = Operation::kIntersects;
};

/// Divides poses into a sample (`every`-th series of `series` poses each) and the rest.
PoseParts with_sample(const std::vector<Eigen::Isometry3d>& poses, std::size_t series, std::size_t every);

/// Adds for each subject the mean `time` (for slow subjects only `time_sample`, which the others have, too). Adds
/// `node_tests`, `realignments` and `triangle_tests` (means over the poses) for subjects that count their work, and,
/// for all but the first, `disagreements`: the number of poses at which the answer differs from that of the first
/// subject. The answers come from an untimed round that also warms up. Prints a summary on standard error.
void run_query_case(const QueryCase& query_case, const std::vector<Subject>& subjects, const PassLimits& limits,
                    Results& results);

}  // namespace glissade::bench
