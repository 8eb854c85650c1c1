#include "node_kernels.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <glissade/collision/dop_tree.h>
#include <glissade/collision/instruction_set.h>
#include <glissade/collision/mesh_generators.h>
#include <glissade/collision/mesh_operations.h>
#include <glissade/collision/triangle_distance.h>

#include "leaf_kernels.h"
#include "random_numbers.h"
#include "vertex_alignment.h"

namespace glissade::collision {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr unsigned kSeed = 20;

// Two trees at random poses of many scales, for every instruction set.
class Kernels : public ::testing::TestWithParam<InstructionSet> {
 protected:
  Kernels() {
    use_instruction_set(GetParam());
    ::testing::Test::RecordProperty("seed", static_cast<int>(kSeed));
  }
  ~Kernels() override { use_instruction_set(available_instruction_sets().front()); }

  Vector3d random_vector() { return random_.point(1.0); }

  Isometry3d random_pose(double translation) {
    Isometry3d X = Isometry3d::Identity();
    X.linear() = random_.rotation();
    X.translation() = translation * random_vector();
    return X;
  }

  // Small thin triangles scattered over a sphere of radius 1, some large ones among them.
  TriangleMesh soup(int triangles) {
    TriangleMesh mesh;
    for (std::int32_t t = 0; t < triangles; ++t) {
      const Vector3d middle = random_vector().normalized();
      const double size = t % 10 == 0 ? 1.0 : 0.1;
      for (std::int32_t c = 0; c < 3; ++c) {
        mesh.vertices.push_back(middle + size * random_vector());
      }
      mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    return mesh;
  }

  DopTree tree(const TriangleMesh& mesh, double scale, const Vector3d& offset, const DopTreeOptions& options = {}) {
    TriangleMesh placed = mesh;
    for (Vector3d& vertex : placed.vertices)
      vertex = scale * vertex + offset;
    return DopTree(std::make_shared<const TriangleMesh>(std::move(placed)), options);
  }

  test_support::RandomNumbers random_{kSeed};
};

// Triangles below child c of a node.
void collect(const DopTree& tree, const NodeHead& head, int c, std::vector<std::int32_t>& triangles) {
  if (head.is_leaf(c)) {
    for (const std::int32_t t : tree.leaves()[head.child(c)].triangle) {
      if (t != kNoTriangle) triangles.push_back(t);
    }
    return;
  }
  const NodeHead& child = tree.nodes()[head.child(c)];
  for (int grandchild = 0; grandchild < child.child_count(); ++grandchild)
    collect(tree, child, grandchild, triangles);
}

double least_distance(const DopTree& tree_A, const std::vector<std::int32_t>& triangles_A, const DopTree& tree_B,
                      const std::vector<std::int32_t>& triangles_B, const Isometry3d& X_AB) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t a : triangles_A) {
    for (const std::int32_t b : triangles_B) {
      const auto corner_A = [&](int c) { return tree_A.mesh().corner(a, c); };
      const auto corner_B = [&](int c) { return X_AB * tree_B.mesh().corner(b, c); };
      least = std::min(
          least,
          triangle_distance({corner_A(0), corner_A(1), corner_A(2)}, {corner_B(0), corner_B(1), corner_B(2)}).distance);
    }
  }
  return least;
}

struct Setting {
  double scale_A;
  double scale_B;
  double offset;       ///< of the mesh of A from its own origin, in its radii
  double translation;  ///< of B from the middle of A, in radii of A
};

constexpr Setting kSettings[] = {{1, 1, 0, 0.5},     {1, 1, 0, 1.9},  {1e-6, 1e-6, 0, 1},
                                 {1e3, 1e3, 0, 1.5}, {1, 1e-3, 0, 1}, {1e-3, 1, 0, 1},
                                 {1, 0.3, 1e6, 1},   {1, 1e-6, 0, 1}, {1e-6, 1e-9, 10, 1}};

void expect_inside(const AlignedNode& aligned, const DopDirections& directions, int c, const Vector3d& x) {
  for (int i = 0; i < directions.slabs; ++i) {
    const double height = directions.half_space(i).dot(x);
    const auto lane = static_cast<std::size_t>(8 * i + c);
    const double below = aligned.facing[lane];
    const double above = aligned.facing[lane + 4];
    // What saturates lies beyond the whole grid of the base, where nothing is to be enclosed.
    if (above < 32767.0 && height < kGridRadius) {
      ASSERT_LE(height, above);
    }
    if (below < 32767.0 && height > -kGridRadius) {
      ASSERT_LE(-height, below);
    }
  }
}

TEST_P(Kernels, RealignedNodesEncloseEveryTransformedPoint) {
  for (const int k : {6, 14, 18, 24, 26}) {
    const DopDirections& directions = dop_directions(k);
    for (const Setting& s : kSettings) {
      const DopTreeOptions options{.directions = k, .realignment = Realignment::kBruteForce};  // for the vertices, too
      const DopTree tree_A = tree(soup(40), s.scale_A, s.scale_A * s.offset * random_vector(), options);
      const DopTree tree_B = tree(soup(40), s.scale_B, s.scale_B * random_vector(), options);
      for (int trial = 0; trial < 10; ++trial) {
        Isometry3d X_AB = random_pose(s.translation * s.scale_A);
        X_AB.translation() += tree_A.center() - X_AB.linear() * tree_B.center();
        const QueryFrame frame(tree_A, tree_B, X_AB);
        const DopTree& base = frame.base_is_A ? tree_A : tree_B;
        const DopTree& other = frame.base_is_A ? tree_B : tree_A;
        const Isometry3d X_PQ = frame.base_is_A ? X_AB : X_AB.inverse();
        DopAlignment alignment;
        align(k, frame, alignment);
        for (std::uint32_t node = 0; node < other.nodes().size(); ++node) {
          AlignedNode aligned[2];
          node_kernels().realign(alignment, other.slabs(node), aligned[0]);
          realign_vertices()(VertexAlignment(directions, frame), other.vertices(node), aligned[1]);
          for (int c = 0; c < other.nodes()[node].child_count(); ++c) {
            std::vector<std::int32_t> triangles;
            collect(other, other.nodes()[node], c, triangles);
            for (const std::int32_t t : triangles) {
              for (int corner = 0; corner < 3; ++corner) {
                const Vector3d x =
                    (X_PQ * other.mesh().corner(t, corner) - base.center()) * (kGridRadius / base.radius());
                ASSERT_NO_FATAL_FAILURE(expect_inside(aligned[0], directions, c, x)) << "affine, k " << k;
                ASSERT_NO_FATAL_FAILURE(expect_inside(aligned[1], directions, c, x)) << "brute force, k " << k;
              }
            }
          }
        }
      }
    }
  }
}

TEST_P(Kernels, OverlapsOfPairsBoundTheirDistance) {
  for (const bool with_thin_slabs : {false, true}) {
    for (const Setting& s : kSettings) {
      // Curved surfaces, whose nodes are thin.
      const DopTree tree_A = tree(make_sphere(1.0, 200), s.scale_A, s.scale_A * s.offset * random_vector());
      const DopTree tree_B = tree(make_torus(0.7, 0.3, 200), s.scale_B, s.scale_B * random_vector());
      int separated = 0;
      for (int trial = 0; trial < 3; ++trial) {
        Isometry3d X_AB = random_pose(s.translation * s.scale_A);
        X_AB.translation() += tree_A.center() - X_AB.linear() * tree_B.center();
        const QueryFrame frame(tree_A, tree_B, X_AB);
        const DopTree& base = frame.base_is_A ? tree_A : tree_B;
        const DopTree& other = frame.base_is_A ? tree_B : tree_A;
        const Isometry3d X_PQ = frame.base_is_A ? X_AB : X_AB.inverse();
        DopAlignment alignment;
        align(24, frame, alignment);
        for (std::uint32_t p = 0; p < base.nodes().size(); p += 3) {
          for (std::uint32_t q = 0; q < other.nodes().size(); q += 5) {
            AlignedNode aligned;
            PairOverlaps overlaps;
            const NodeHead& head_P = base.nodes()[p];
            const NodeHead& head_Q = other.nodes()[q];
            node_kernels().realign(alignment, other.slabs(q), aligned);
            PairMask near = node_kernels().test(base.slabs(p), aligned, 12, 0, overlaps);
            if (with_thin_slabs) {
              near = node_kernels().test_thin(ThinSlabFrame(frame), head_P, base.slabs(p), head_Q, other.slabs(q), 0,
                                              overlaps);
            }
            for (int i = 0; i < head_P.child_count(); ++i) {
              for (int j = 0; j < head_Q.child_count(); ++j) {
                const auto pair = static_cast<std::size_t>(kWidth * i + j);
                ASSERT_EQ((near >> pair & 1U) != 0, overlaps.overlap[pair] >= 0);
                if (overlaps.overlap[pair] >= 0) continue;
                ++separated;
                std::vector<std::int32_t> triangles_P;
                std::vector<std::int32_t> triangles_Q;
                collect(base, head_P, i, triangles_P);
                collect(other, head_Q, j, triangles_Q);
                const double distance = least_distance(base, triangles_P, other, triangles_Q, X_PQ);
                const double rounding = 1e-12 * (base.center().norm() + X_PQ.translation().norm());
                ASSERT_LE(-overlaps.overlap[pair] * base.radius() / kGridRadius, distance + rounding);
              }
            }
          }
        }
      }
      EXPECT_GT(separated, 0);
    }
  }
}

TEST_P(Kernels, TestFindsTheLeastOverlapOfEverySlab) {
  for (int trial = 0; trial < 200; ++trial) {
    alignas(64) std::array<SlabLine, 4> node;
    AlignedNode aligned;
    for (SlabLine& line : node) {
      for (SlabRow& row : line.rows) {
        for (std::size_t c = 0; c < 4; ++c) {
          row.above[c] = static_cast<std::int16_t>(random_.integer(-20000, 20000));
          row.below[c] = static_cast<std::int16_t>(random_.integer(-20000, 20000));
        }
      }
    }
    for (std::int16_t& value : aligned.facing)
      value = static_cast<std::int16_t>(random_.integer(-20000, 20000));
    for (const int slabs : {4, 8, 12, 16}) {
      PairOverlaps overlaps;
      const PairMask near = node_kernels().test(node.data(), aligned, slabs, -9000, overlaps);
      for (std::size_t p = 0; p < 4; ++p) {
        for (std::size_t q = 0; q < 4; ++q) {
          int least = 32767;
          for (std::size_t i = 0; i < static_cast<std::size_t>(slabs); ++i) {
            const SlabRow& row = node[i / 4].rows[i % 4];
            least = std::min(
                {least, row.above[p] + aligned.facing[8 * i + q], row.below[p] + aligned.facing[8 * i + 4 + q]});
          }
          least = std::max(least, -32768);
          EXPECT_EQ(overlaps.overlap[4 * p + q], least);
          EXPECT_EQ((near >> (4 * p + q) & 1U) != 0, least >= -9000);
        }
      }
    }
  }
}

TEST_P(Kernels, LeavesSeparateOnlyWhatIsFurtherApart) {
  for (const Setting& s : kSettings) {
    const DopTree tree_A = tree(soup(40), s.scale_A, s.scale_A * s.offset * random_vector());
    const DopTree tree_B = tree(soup(40), s.scale_B, s.scale_B * random_vector());
    int separated = 0;
    for (const double tolerance : {0.0, 0.01, 0.3}) {
      Isometry3d X_AB = random_pose(s.translation * s.scale_A);
      X_AB.translation() += tree_A.center() - X_AB.linear() * tree_B.center();
      const QueryFrame frame(tree_A, tree_B, X_AB);
      const DopTree& base = frame.base_is_A ? tree_A : tree_B;
      const DopTree& other = frame.base_is_A ? tree_B : tree_A;
      const Isometry3d X_PQ = frame.base_is_A ? X_AB : X_AB.inverse();
      const double rounding = 1e-12 * (base.center().norm() + X_PQ.translation().norm());
      for (const TriangleLeaf& leaf_P : base.leaves()) {
        for (const TriangleLeaf& leaf_Q : other.leaves()) {
          LeafPair leaves;
          const PairMask near =
              leaf_kernels().test(LeafFrame(frame), leaf_P, leaf_Q, static_cast<float>(tolerance), leaves);
          for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = 0; j < 4; ++j) {
              const bool is_near = (near >> (4 * i + j) & 1U) != 0;
              if (leaf_P.triangle[i] < 0 || leaf_Q.triangle[j] < 0) {
                ASSERT_FALSE(is_near);
                continue;
              }
              if (is_near) continue;
              ++separated;
              const double distance =
                  least_distance(base, {leaf_P.triangle[i]}, other, {leaf_Q.triangle[j]}, X_PQ) / base.radius();
              ASSERT_GT(distance + rounding, tolerance);
              ASSERT_LE(static_cast<double>(leaves.gaps.gap[4 * i + j]), distance + rounding / base.radius());
            }
          }
        }
      }
    }
    EXPECT_GT(separated, 0);
  }
}

TEST_P(Kernels, CertaintiesAboutTrianglesAreTrue) {
  for (const Setting& s : kSettings) {
    const DopTree tree_A = tree(soup(40), s.scale_A, s.scale_A * s.offset * random_vector());
    const DopTree tree_B = tree(soup(40), s.scale_B, s.scale_B * random_vector());
    int certain_pairs = 0;
    for (int trial = 0; trial < 5; ++trial) {
      Isometry3d X_AB = random_pose(0.5 * s.translation * s.scale_A);
      X_AB.translation() += tree_A.center() - X_AB.linear() * tree_B.center();
      const QueryFrame frame(tree_A, tree_B, X_AB);
      const DopTree& base = frame.base_is_A ? tree_A : tree_B;
      const DopTree& other = frame.base_is_A ? tree_B : tree_A;
      const LeafFrame leaf_frame(frame);
      const double rounding = 1e-12 * (tree_A.center().norm() + X_AB.translation().norm());
      for (const TriangleLeaf& leaf_P : base.leaves()) {
        for (const TriangleLeaf& leaf_Q : other.leaves()) {
          LeafPair leaves;
          const PairMask near = leaf_kernels().test(leaf_frame, leaf_P, leaf_Q, 0.0F, leaves);
          const CertainPairs certain = leaf_kernels().cross(leaf_frame, leaves);
          for (int pair = 0; pair < 16; ++pair) {
            if ((near >> pair & 1U) == 0) continue;
            const std::int32_t p = leaf_P.triangle[static_cast<std::size_t>(pair / 4)];
            const std::int32_t q = leaf_Q.triangle[static_cast<std::size_t>(pair % 4)];
            const double distance = frame.base_is_A ? least_distance(tree_A, {p}, tree_B, {q}, X_AB)
                                                    : least_distance(tree_A, {q}, tree_B, {p}, X_AB);
            if ((certain.intersect >> pair & 1U) != 0) {
              ASSERT_EQ(distance, 0.0);
            }
            if ((certain.apart >> pair & 1U) != 0) {
              ASSERT_GT(distance, 0.0);
            }
            certain_pairs += static_cast<int>((certain.intersect | certain.apart) >> pair & 1U);
            ASSERT_LE(static_cast<double>(leaf_kernels().edge_gap(leaf_frame, leaves, pair)),
                      (distance + rounding) / base.radius());
          }
        }
      }
    }
    if (s.offset < 1e3 && s.scale_A == s.scale_B) {
      EXPECT_GT(certain_pairs, 15);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, Kernels, ::testing::ValuesIn(available_instruction_sets()),
                         [](const auto& test) { return std::string(name(test.param)); });

}  // namespace
}  // namespace glissade::collision
