#include "sweeps/sweep_variants.h"

#include <stdexcept>

namespace glissade::test_support {

using collision::DopTreeOptions;
using collision::InstructionSet;
using collision::Realignment;

std::vector<DopTreeOptions> all_tree_options() {
  std::vector<DopTreeOptions> all;
  for (const int directions : {6, 14, 18, 24, 26}) {
    for (const bool thin_slab : {true, false}) {
      for (const Realignment realignment : {Realignment::kAffine, Realignment::kBruteForce})
        all.push_back({.directions = directions, .thin_slab = thin_slab, .realignment = realignment});
    }
  }
  return all;
}

std::string variant_name(const DopTreeOptions& options) {
  return "k=" + std::to_string(options.directions) + (options.thin_slab ? ", slab" : ", no slab") +
         (options.realignment == Realignment::kAffine ? ", affine" : ", brute force");
}

std::vector<collision::DopTree> trees_of_all_options(const SweepMesh& mesh, RandomNumbers& random) {
  const auto shared = std::make_shared<geometry::TriangleMesh>(mesh.mesh);
  const bool refitted = random.chance(0.2);
  if (refitted) deform(*shared, mesh.size, random);
  std::vector<collision::DopTree> trees;
  for (const DopTreeOptions& options : all_tree_options())
    trees.emplace_back(shared, options);
  if (refitted) {
    shared->vertices = mesh.mesh.vertices;
    for (collision::DopTree& tree : trees)
      tree.refit();
  }
  return trees;
}

std::vector<InstructionSet> instruction_sets(const std::string& only) {
  std::vector<InstructionSet> chosen;
  for (const InstructionSet set : collision::available_instruction_sets()) {
    if (only.empty() || collision::name_of(set) == only) chosen.push_back(set);
  }
  if (chosen.empty()) throw std::invalid_argument("instruction set '" + only + "' is not available");
  return chosen;
}

void with_every_instruction_set(const std::function<void(std::string_view name)>& use) {
  const std::vector<InstructionSet> all = collision::available_instruction_sets();
  for (const InstructionSet set : all) {
    collision::use_instruction_set(set);
    use(name_of(set));
  }
  collision::use_instruction_set(all.front());
}

}  // namespace glissade::test_support
