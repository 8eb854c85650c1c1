/// Time and operations of one realignment: three weighted offsets for each new one (paper §2.1, eq. 1) beside the
/// projection of all vertices (§2.1.1), which the paper counts as 6k and 6k² + 17k floating-point operations.
///
/// The nodes fit into the first-level cache, so only arithmetic counts. Both methods take turns; times are medians.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/collision/dop_tree.h>
#include <glissade/geometry/mesh_generators.h>

#include "kernels/instruction_set.h"
#include "kernels/node_kernels.h"
#include "kernels/vertex_alignment.h"
#include "tree/tree_nodes.h"

namespace {

namespace geometry = glissade::geometry;
using namespace glissade::collision;

constexpr int kRounds = 1001;
constexpr double kRound_ns = 20e3;  // short, so that other programs interrupt few rounds
constexpr std::uint32_t kNodes = 8;

// Multiplications, additions and comparisons count as one operation each.
constexpr int kOperationsOfOffset = 3 + 3;          // three products, and sums of them and the constant
constexpr int kOperationsOfProjection = 3 + 2 + 2;  // a dot product, the greatest and the least
constexpr int kOperationsOfDirection = 2;           // a constant to be added to both

struct Bench {
  explicit Bench(int directions)
      : tree(std::make_shared<const geometry::TriangleMesh>(geometry::make_torus(0.7, 0.3, 2000)),
             {.directions = directions, .realignment = Realignment::kBruteForce}),
        k(directions) {
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

  DopTree tree;
  int k;
  Eigen::Isometry3d X_AB = Eigen::Isometry3d::Identity();
  std::array<std::uint32_t, kNodes> nodes{};
};

// Realigns the nodes repeatedly. Every realignment reads from memory and writes to memory.
template <typename Realign>
class Stopwatch {
 public:
  Stopwatch(const Bench& bench, Realign realign) : bench_(bench), realign_(std::move(realign)) {
    while (time_round() < kRound_ns)
      passes_ *= 2;
  }

  void measure() { times_.push_back(time_round() / (passes_ * kNodes * kWidth)); }

  /// Median, nanoseconds a child.
  double median() {
    const auto middle = times_.begin() + kRounds / 2;
    std::nth_element(times_.begin(), middle, times_.end());
    return *middle;
  }

 private:
  double time_round() {
    const auto begin = std::chrono::steady_clock::now();
    for (std::uint32_t pass = 0; pass < passes_; ++pass) {
      for (std::size_t i = 0; i < kNodes; ++i)
        realign_(bench_.nodes[i], aligned_[i]);
    }
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
  }

  const Bench& bench_;
  Realign realign_;
  std::uint32_t passes_ = 1;
  std::array<AlignedNode, kNodes> aligned_;
  std::vector<double> times_;
};

void print(int k, const std::string& subject, const char* metric, double value, const char* unit) {
  std::printf("realignment,k%d,%s,%s,%.9g,%s\n", k, subject.c_str(), metric, value, unit);
}

void run(const Bench& bench, InstructionSet instruction_set) {
  use_instruction_set(instruction_set);
  const DopDirections& directions = dop_directions(bench.k);
  const QueryFrame frame(bench.tree, bench.tree, bench.X_AB);
  DopAlignment affine;
  align(bench.k, frame, affine);
  const VertexAlignment brute_force(directions, frame);
  const NodeKernels& kernels = node_kernels();
  const RealignVertices realign_by_vertices = realign_vertices();

  Stopwatch by_offsets(bench, [&](std::uint32_t node, AlignedNode& aligned) {
    kernels.realign(affine, slabs_of(bench.tree, node), aligned);
  });
  Stopwatch by_vertices(bench, [&](std::uint32_t node, AlignedNode& aligned) {
    realign_by_vertices(brute_force, vertices_of(bench.tree, node), aligned);
  });
  for (int round = 0; round < kRounds; ++round) {
    by_offsets.measure();
    by_vertices.measure();
  }
  const std::string with = "-" + std::string(name_of(instruction_set));
  const double affine_time = by_offsets.median();
  const double vertex_time = by_vertices.median();
  // Per child; the code realigns four at a time.
  print(bench.k, "affine" + with, "time", affine_time, "ns");
  print(bench.k, "brute-force" + with, "time", vertex_time, "ns");
  print(bench.k, "brute-force" + with, "ratio_to_affine", vertex_time / affine_time, "x");
}

void print_operations(const Bench& bench) {
  const double k = bench.k;
  const double vertices = bench.vertices_of_child();
  print(bench.k, "affine", "operations", kOperationsOfOffset * k, "1");
  print(bench.k, "affine", "operations_of_paper", 6.0 * k, "1");
  print(bench.k, "brute-force", "vertices", vertices, "1");
  print(bench.k, "brute-force", "operations", (kOperationsOfProjection * vertices + kOperationsOfDirection) * k / 2.0,
        "1");
  print(bench.k, "brute-force", "operations_of_paper", 6.0 * k * k + 17.0 * k, "1");
}

}  // namespace

int main() {
  std::printf("bench,case,subject,metric,value,unit\n");
  for (const int k : {6, 14, 18, 24, 26}) {
    const Bench bench(k);
    print_operations(bench);
    for (const InstructionSet instruction_set : available_instruction_sets())
      run(bench, instruction_set);
  }
}
