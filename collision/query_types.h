#pragma once

/// What queries of DOP-trees are given and answer: pairs of triangles, selections, and the memory of a query.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace glissade::collision {

class DopTree;

/// Triangle indices into the meshes of tree A and tree B.
struct TrianglePair {
  std::int32_t triangle_A;
  std::int32_t triangle_B;

  auto operator<=>(const TrianglePair&) const = default;
};

/// Two triangles and the points where they are closest, in the frame of A. Distance 0 when they intersect; the two
/// points are then one point of the intersection as well as rounding allows.
struct ClosePair {
  TrianglePair triangles;
  double distance;
  Eigen::Vector3d p_A;  ///< on triangle A
  Eigen::Vector3d p_B;  ///< on triangle B
};

/// Work of one query.
struct QueryCounters {
  std::int64_t node_tests = 0;      ///< pairs of boxes tested
  std::int64_t realignments = 0;    ///< boxes realigned
  std::int64_t triangle_tests = 0;  ///< pairs of triangles tested
};

/// Scratch memory and counters of the queries. Keep one per thread and reuse it: after a few queries nothing is
/// allocated. Not thread-safe.
class QueryWorkspace {
 public:
  QueryWorkspace();
  ~QueryWorkspace();
  QueryWorkspace(QueryWorkspace&&) noexcept;
  QueryWorkspace& operator=(QueryWorkspace&&) noexcept;

  /// Work of the last query.
  const QueryCounters& counters() const;

  struct Memory;
  Memory& memory() { return *memory_; }

 private:
  std::unique_ptr<Memory> memory_;
};

class CoherentFront;

/// A workspace that remembers the last query of one pair of trees, which makes queries of a pair that moves little from
/// one to the next much cheaper. Answers are the same, bit for bit, as without it. Use one for each pair; a query of
/// other trees, or of a tree that was refitted, makes it start afresh. Not thread-safe.
class CoherentWorkspace {
 public:
  CoherentWorkspace();
  ~CoherentWorkspace();
  CoherentWorkspace(CoherentWorkspace&&) noexcept;
  CoherentWorkspace& operator=(CoherentWorkspace&&) noexcept;

  /// Work of the last query.
  const QueryCounters& counters() const { return workspace_.counters(); }

  /// Starts afresh.
  void forget();

  QueryWorkspace& workspace() { return workspace_; }
  CoherentFront& front() { return *front_; }

 private:
  QueryWorkspace workspace_;
  std::unique_ptr<CoherentFront> front_;
};

/// Which children of each node hold selected triangles, and which triangles of each leaf are selected: a byte for each.
/// Immutable after construction, so safe to share between threads.
class TriangleSelection {
 public:
  /// Asks `is_selected` once for every triangle, by its number in the mesh. Serves the tree that it was made for, also
  /// after a refit, and copies of it. Throws std::invalid_argument for an empty function. Cost O(n).
  TriangleSelection(const DopTree& tree, const std::function<bool(std::int32_t)>& is_selected);

  /// By node: bit c, whether there is a selected triangle below its child c.
  std::span<const std::uint8_t> nodes() const { return nodes_; }
  /// By leaf: bit t, whether its triangle t is selected.
  std::span<const std::uint8_t> leaves() const { return leaves_; }

  /// Whether the selection can be of a tree, by the numbers of its nodes and leaves.
  bool is_of(const DopTree& tree) const;

  /// Another number for every selection of this process, from 1. Copies have the same.
  std::uint64_t id() const { return id_; }

 private:
  std::vector<std::uint8_t> nodes_;
  std::vector<std::uint8_t> leaves_;
  std::uint64_t id_;
};

/// A query of two trees with this answers those pairs of triangles of which at least one is selected. Without a
/// selection all triangles of a tree count as selected, so that both are needed to leave anything out.
struct PairSelection {
  const TriangleSelection* of_A = nullptr;
  const TriangleSelection* of_B = nullptr;
};

}  // namespace glissade::collision
