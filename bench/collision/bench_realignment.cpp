// See `register_realignment` in benches.h. The nodes fit into the first-level cache, so only arithmetic counts.

#include <array>
#include <memory>
#include <string>

#include <Eigen/Geometry>

#include <glissade/collision/dop_tree.h>
#include <glissade/geometry/mesh_generators.h>

#include "bench_program.h"
#include "benches.h"
#include "kernels/node_kernels.h"
#include "kernels/vertex_alignment.h"
#include "register_bench.h"
#include "tree/tree_nodes.h"

namespace glissade::bench {
namespace {

using namespace collision;

constexpr std::uint32_t kNodes = 8;

struct SomeNodes {
  explicit SomeNodes(int directions)
      : k(directions),
        tree(std::make_shared<const geometry::TriangleMesh>(geometry::make_torus(0.7, 0.3, 2000)),
             {.directions = directions, .realignment = Realignment::kBruteForce}) {
    X_AB.linear() = Eigen::Quaterniond(0.5, 0.1, -0.3, 0.8).normalized().toRotationMatrix();
    X_AB.translation() = Eigen::Vector3d(0.3, -0.2, 0.5);
    const auto count = static_cast<std::uint32_t>(nodes_of(tree).size());
    for (std::uint32_t i = 0; i < kNodes; ++i)
      nodes[i] = i * count / kNodes;
  }

  double vertices_of_child() const {
    double groups = 0.0;
    for (const std::uint32_t node : nodes)
      groups += static_cast<double>(vertices_of(tree, node).size());
    return 4.0 * groups / kNodes;
  }

  int k;
  DopTree tree;
  Eigen::Isometry3d X_AB = Eigen::Isometry3d::Identity();
  std::array<std::uint32_t, kNodes> nodes{};
};

// Every realignment reads from memory and writes to memory. The code realigns all children of a node together.
template <typename Realign>
void measure_realignment(benchmark::State& state, const SomeNodes& some, const Realign& realign) {
  std::array<AlignedNode, kNodes> aligned;
  for (auto _ : state) {
    for (std::size_t i = 0; i < kNodes; ++i)
      realign(some.nodes[i], aligned[i]);
    benchmark::DoNotOptimize(aligned.data());
    benchmark::ClobberMemory();
  }
  state.counters["child"] = seconds_each(kNodes * kWidth);
}

// The paper counts 6k operations of floating-point numbers; a multiplication, an addition or a comparison is one: three
// products for each offset, and sums of them and the constant.
void run_affine(benchmark::State& state, const SomeNodes& some) {
  DopAlignment affine;
  align(some.k, QueryFrame(some.tree, some.tree, some.X_AB), affine);
  const NodeKernels& kernels = node_kernels();
  measure_realignment(state, some, [&](std::uint32_t node, AlignedNode& aligned) {
    kernels.realign(affine, slabs_of(some.tree, node), aligned);
  });
  state.counters["operations"] = 6.0 * some.k;
  state.counters["operations_of_paper"] = 6.0 * some.k;
}

// The paper counts 6k² + 17k. For each vertex and pair of opposite directions these are a dot product, the greatest and
// the least; then a constant is added to both.
void run_by_vertices(benchmark::State& state, const SomeNodes& some) {
  const VertexAlignment alignment(dop_directions(some.k), QueryFrame(some.tree, some.tree, some.X_AB));
  const RealignVertices realign = realign_vertices();
  measure_realignment(state, some, [&](std::uint32_t node, AlignedNode& aligned) {
    realign(alignment, vertices_of(some.tree, node), aligned);
  });
  const double vertices = some.vertices_of_child();
  state.counters["vertices"] = vertices;
  state.counters["operations"] = (7.0 * vertices + 2.0) * some.k / 2.0;
  state.counters["operations_of_paper"] = 6.0 * some.k * some.k + 17.0 * some.k;
}

}  // namespace

void register_realignment() {
  for (const int k : {6, 14, 18, 24, 26}) {
    const auto some = lazy([k] { return SomeNodes(k); });
    for (const InstructionSet set : available_instruction_sets()) {
      const auto add = [&](const char* subject, void (*run)(benchmark::State&, const SomeNodes&)) {
        const std::string name = "realignment/k" + std::to_string(k) + "-" + std::string(name_of(set)) + "/" + subject;
        register_bench(name, [=](benchmark::State& state) {
          use_instruction_set(set);
          run(state, **some);
        })->Unit(benchmark::kNanosecond);
      };
      add("affine", run_affine);
      add("brute-force", run_by_vertices);
    }
  }
}

}  // namespace glissade::bench
