#pragma once

/// Every way to build a tree, and every instruction set to query it with.

#include <memory>
#include <string>
#include <vector>

#include <glissade/collision/dop_tree.h>

#include "kernels/instruction_set.h"
#include "random_numbers.h"
#include "sweep_meshes.h"

namespace glissade::test_support {

/// k × slab × realignment.
std::vector<collision::DopTreeOptions> all_tree_options();
std::string variant_name(const collision::DopTreeOptions& options);

/// A tree for each of `all_tree_options`. One in five times they are built for vertices that are elsewhere, some of
/// them on others, and then refitted.
std::vector<collision::DopTree> trees_of_all_options(const SweepMesh& mesh, RandomNumbers& random);

/// Those this machine has; `only`, if it is not empty. Throws std::invalid_argument if it has not.
std::vector<collision::InstructionSet> instruction_sets(const std::string& only);

}  // namespace glissade::test_support
