#pragma once

/// Arguments and results of DOP-tree queries: triangle pairs, selections of triangles, and workspaces.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <glissade/base/export.h>

namespace glissade::collision {

class CoherentFront;
class DopTree;
struct QueryMemory;

/// Triangle indices into the meshes of tree A and tree B. Import renumbers the triangles of a file: it splits polygons
/// and drops degenerate triangles.
struct TrianglePair {
  std::int32_t triangle_A;
  std::int32_t triangle_B;

  auto operator<=>(const TrianglePair&) const = default;
};

/// Two triangles and their closest points, in the frame of A, metres. If the triangles intersect, the distance is 0,
/// and both points are the same point of the intersection up to rounding.
struct ClosePair {
  TrianglePair triangles;
  double distance;
  Eigen::Vector3d p_A;  ///< on triangle A
  Eigen::Vector3d p_B;  ///< on triangle B
};

/// The distance of two meshes.
struct MeshDistance {
  /// The distance (metres): 0 if the meshes intersect; the limit of the query if no triangle pair is nearer.
  double distance;
  /// The nearest pair of triangles. Among equally near pairs, this is the first in ascending order of the triangle
  /// indices. Empty if the meshes intersect (see `intersecting_pairs`), or if no pair is nearer than the limit.
  std::optional<ClosePair> nearest;
};

/// Work of one query.
struct QueryCounters {
  std::int64_t node_tests = 0;      ///< pairs of DOPs tested
  std::int64_t realignments = 0;    ///< DOPs realigned
  std::int64_t triangle_tests = 0;  ///< pairs of triangles tested
};

/// Receives the work of a query while the query runs. Called in the thread of the query, so a meter can report the
/// progress of the query, or make the query wait. The unit of work is about a nanosecond on an ordinary processor. The
/// work depends on the trees, on their poses and on what a coherent workspace remembers, but not on the speed of the
/// machine. The work may differ a little between instruction sets, because conservative tests in single precision may
/// keep different pairs.
class GLISSADE_EXPORT WorkMeter {
 public:
  /// Adds the `work` on a pair of nodes, on a pair of leaves, or on the exact tests of up to 16 triangle pairs of two
  /// leaves. Called just before or just after this work. May throw an exception to end the query. After such an
  /// exception, a pipeline cannot be used any more.
  virtual void spend(std::int64_t work) = 0;

 protected:
  ~WorkMeter() = default;
};

/// Scratch memory and counters of queries. Keep one workspace per thread and reuse it. After the first few queries,
/// queries allocate nothing. Not thread-safe.
class GLISSADE_EXPORT QueryWorkspace {
 public:
  QueryWorkspace();
  ~QueryWorkspace();
  QueryWorkspace(QueryWorkspace&&) noexcept;
  QueryWorkspace& operator=(QueryWorkspace&&) noexcept;

  /// Work of the last query.
  const QueryCounters& counters() const;

  /// Sets the meter of all later queries for pairs (`intersecting_pairs`, `pairs_within`, `traverse_near`) that use
  /// this workspace. Null means no meter. The meter must outlive these queries.
  void set_meter(WorkMeter* meter);

 private:
  friend struct WorkspaceAccess;
  std::unique_ptr<QueryMemory> memory_;
};

/// A workspace that exploits temporal coherence. The workspace remembers the last query of one pair of trees. If the
/// trees have moved little, the next query is much cheaper. The answers are bit-identical to those with a
/// `QueryWorkspace`. Use one workspace for each pair of trees. A workspace forgets the last query if the next query has
/// other trees, or a tree that was refitted. Not thread-safe.
class GLISSADE_EXPORT CoherentWorkspace {
 public:
  CoherentWorkspace();
  ~CoherentWorkspace();
  CoherentWorkspace(CoherentWorkspace&&) noexcept;
  CoherentWorkspace& operator=(CoherentWorkspace&&) noexcept;

  /// Work of the last query.
  const QueryCounters& counters() const { return workspace_.counters(); }

  /// Forgets all earlier queries.
  void forget();

 private:
  friend struct WorkspaceAccess;
  QueryWorkspace workspace_;
  std::unique_ptr<CoherentFront> front_;
};

/// A set of selected triangles of one tree. Each other triangle may be half selected, a weaker choice. A triangle pair
/// of two trees is a selected pair if at least one of its triangles is selected, or if both are half selected.
/// Immutable after construction, so threads may share it.
class GLISSADE_EXPORT TriangleSelection {
 public:
  /// Calls both functions once for each triangle, with the index of the triangle in the mesh. Without
  /// `is_half_selected`, no triangle is half selected. The selection is valid for `tree` and for copies of `tree`, also
  /// after a refit. Throws std::invalid_argument if the function `is_selected` is empty. Cost O(n).
  TriangleSelection(const DopTree& tree, const std::function<bool(std::int32_t)>& is_selected,
                    const std::function<bool(std::int32_t)>& is_half_selected = {});

  /// Marks of a set of triangles, stored for the nodes and leaves of a tree.
  struct Marks {
    std::vector<std::uint8_t> nodes;   ///< by node: bit c is set if child c has a marked triangle below it
    std::vector<std::uint8_t> leaves;  ///< by leaf: bit t is set if triangle t of the leaf is marked
  };
  /// The marks of the selected triangles.
  const Marks& selected() const { return selected_; }
  /// The marks of the selected and the half selected triangles.
  const Marks& at_least_half() const { return at_least_half_; }
  /// By node: bit c is set if all triangles below child c are selected or half selected.
  const std::vector<std::uint8_t>& whole_children() const { return whole_children_; }

  /// Whether `tree` has as many nodes and leaves as the tree of the selection.
  bool is_of(const DopTree& tree) const;

  /// A number (≥ 1) that identifies the selection, unique in this process. A copy has the number of the original.
  std::uint64_t id() const { return id_; }

 private:
  Marks selected_;
  Marks at_least_half_;
  std::vector<std::uint8_t> whole_children_;
  std::uint64_t id_;
};

/// Restricts a query to selected pairs of triangles. A null selection selects all triangles of its tree, so that every
/// pair is a selected pair. Therefore a query is restricted only if both selections are given.
struct PairSelection {
  const TriangleSelection* of_A = nullptr;
  const TriangleSelection* of_B = nullptr;
};

}  // namespace glissade::collision
