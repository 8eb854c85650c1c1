#pragma once

/// The poses of boxes in a recording, checked after the run by code that shares nothing with the simulation: no two
/// boxes may meet, neither where they are seen (`GridCheck`) nor on the way from one answer to the next (`MovingBox`).

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/geometry/triangle_mesh.h>
#include <glissade/reference/grid_check.h>

namespace glissade::test_support {

/// A box of the scene about the origin of its frame B.
struct BoxOfScene {
  Eigen::Vector3d half;                                    ///< of the edges, metres; z is 0 for a sheet
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();  ///< at the start
};

/// The figures of all answers so far.
struct WayFigures {
  std::int64_t answers = 0;
  std::int64_t poses = 0;      ///< of a pair of boxes, each checked once
  std::int64_t colliding = 0;  ///< of these
  std::int64_t ways = 0;       ///< of all parts at once, from one answer to the next that differs
  /// Of these, the ones round a corner. An answer takes up to three steps, of which a recording has only the last pose:
  /// where the straight way is not free, one by two poses aside must be, no farther than the parts move in all, or one
  /// on which the parts go one after another. Poses aside are tried along the direction in which the parts are apart,
  /// and then at random.
  std::int64_t detours = 0;
  std::int64_t blocked = 0;  ///< of these ways, not proven free
  std::string first_fault;
};

class RecordedWays {
 public:
  /// The obstacles stand still; the numbers of the parts are those of the recording.
  RecordedWays(const std::vector<BoxOfScene>& obstacles, const std::vector<BoxOfScene>& parts);

  /// The next answer: where all parts are.
  void take(const std::vector<Eigen::Isometry3d>& X_WV);

  /// Checks what is left, and returns the figures.
  const WayFigures& finish();

 private:
  using Pair = std::pair<std::size_t, std::size_t>;  // numbers of bodies; the second is a part
  using Poses = std::vector<Eigen::Isometry3d>;      // of all bodies

  std::optional<Pair> what_meets(const Poses& from, const Poses& to) const;
  bool goes_round(const Poses& from, const Poses& to, Pair blocked) const;
  bool goes_one_by_one(const Poses& from, const Poses& to) const;
  bool goes_somehow(const Poses& from, const Poses& to) const;
  bool has_detour(const Poses& from, const Poses& to, Pair blocked, double aside) const;
  bool move_apart(Pair pair, double aside, const Poses& at, Poses& via) const;
  double length_of(const Poses& from, const Poses& to) const;
  void note_poses(const Poses& now);
  void check_poses();
  /// Keeps the first fault, with the poses of all parts.
  void fault(Pair pair, const std::string& what, std::initializer_list<Poses> poses = {});

  std::size_t first_part_;
  std::vector<Eigen::Vector3d> halves_;
  std::vector<geometry::TriangleMesh> meshes_;
  std::vector<reference::GridCheck> grids_;
  std::vector<Pair> pairs_;
  std::vector<Poses> X_AB_;  // of each pair, not checked yet
  Poses last_;
  WayFigures figures_;
};

}  // namespace glissade::test_support
