#pragma once

/// One case of a query benchmark: two meshes, poses, and all subjects on them; its rows go to the results.

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
  std::vector<std::string> part_names = {
      "sample"};  ///< the first parts, as many as there are names, are reported apart
  Operation operation = Operation::kIntersects;
};

/// Divides poses into a sample, of every n-th series of `series` poses, and the rest.
PoseParts with_sample(const std::vector<Eigen::Isometry3d>& poses, std::size_t series, std::size_t every);

/// Adds for each subject the mean `time` (slow ones: only `time_sample`, which the others have, too), where it counts
/// its work also `node_tests`, `realignments` and `triangle_tests` (means over the poses), and for each but the first
/// `disagreements`: at how many poses its answer is not that of the first. The answers come from an untimed round that
/// also warms up. Says on standard error what came out.
void run_query_case(const QueryCase& query_case, const std::vector<Subject>& subjects, const PassLimits& limits,
                    Results& results);

}  // namespace glissade::bench
