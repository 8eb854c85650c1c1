#pragma once

/// All variants of trees, and all instruction sets of their queries.

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <glissade/collision/dop_tree.h>

#include "kernels/instruction_set.h"
#include "random_numbers.h"
#include "sweeps/sweep_meshes.h"

namespace glissade::test_support {

/// k × slab × realignment.
std::vector<collision::DopTreeOptions> all_tree_options();
std::string variant_name(const collision::DopTreeOptions& options);

/// A tree for each of `all_tree_options`. In one of five cases they are built for displaced vertices, some of which
/// coincide, and then refitted.
std::vector<collision::DopTree> trees_of_all_options(const SweepMesh& mesh, RandomNumbers& random);

/// The instruction sets of this machine, or `only` that one unless it is empty. Throws std::invalid_argument if the
/// machine lacks it.
std::vector<collision::InstructionSet> instruction_sets(const std::string& only);

/// Calls `use` with the name of each instruction set of this machine, while it is in use. The best one stays in use.
void with_every_instruction_set(const std::function<void(std::string_view name)>& use);

}  // namespace glissade::test_support
