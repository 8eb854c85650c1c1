#pragma once

/// The wrenches of the contacts on all parts that hands lead *now*, from the newest contact set, which may be some
/// milliseconds old. It gives the haptic thread forces that follow the hands at its own rate, without any collision
/// query.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/projection.h>
#include <glissade/contact/spring.h>
#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/coupling.h>

namespace glissade::haptics {

/// A part at one tick.
struct LedPart {
  Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d X_GT = Eigen::Isometry3d::Identity();
  contact::CouplingStiffness stiffness{};  ///< of all hands that hold the part
  bool acts = false;                       ///< a hand holds the part, and the rows of the set are about this hold
};

/// The contacts of one part.
struct PartContacts {
  contact::Wrench wrench;    ///< on the hands, about the part's reference point
  double known = 1.0;        ///< share of the force whose rows are known to hold where the projection is
  bool is_unsolved = false;  ///< the rows have no solution, and there is no wrench
  double from_hands = 0.0;   ///< J: work on the part since the last call of parts in other hands
  double from_movers = 0.0;  ///< J: the same of bodies that move without a hand
};

/// The wanted displacements of the parts are projected on the rows of the set, those of parts in contact with each
/// other together. The force is the sum of the multipliers times the normals, with the friction that belongs to them.
/// Friction was found for the lag of that time. Now it is a share of the force that the springs exert on the way that
/// the contacts leave the parts, and no greater than the rows demand: it never drives a part, and holds it back no
/// farther than where it is.
///
/// Rows that did not push count no more once the ghost has left their `range`. The plane of one that pushed goes on;
/// its force fades where the projection is more than 3 mm beyond the range, and is zero from 9 mm on. Bodies that move
/// without a hand go on at their speed for kFullForce. So the force never holds a hand back along a frictionless
/// contact, however old the set is: an old set knows too few contacts, or contacts that the part has left.
///
/// Real-time safe: bounded work, no allocation after construction. Not thread-safe.
class ContactProjection {
 public:
  explicit ContactProjection(std::size_t parts);

  /// `parts` has one entry for each part. `age` is the time since the ghost poses that the set answers, `dt` (seconds)
  /// that since the last call.
  void update(const ContactSet& set, std::chrono::nanoseconds age, std::span<const LedPart> parts, double dt) noexcept;

  /// Of the last call. Exactly zero where no contact of the set is in the way.
  const PartContacts& of_part(std::size_t part) const { return contacts_[part]; }

  /// Whether a row in range is between this part and another that a hand leads.
  bool meets_led_part(std::size_t part) const noexcept;

  /// Fills `nearest` with constraints on the displacement of the part from the pose of its rows, and returns how many.
  /// Those that push come first, the greatest force first; then those with the smallest gap. The other parts stand
  /// where the last call has put them. None if the rows have no solution.
  std::size_t constraints_of(std::size_t part, std::span<contact::ConstraintRow> nearest) const noexcept;

 private:
  void take_rows(const ContactSet& set, std::chrono::nanoseconds age, double dt) noexcept;
  void choose_island(std::size_t first) noexcept;
  void solve_island(const ContactSet& set, std::span<const LedPart> parts, double dt) noexcept;
  void move_to(std::size_t part, const Eigen::Isometry3d& X_WP, const Eigen::Vector3d& p_Vref, double dt) noexcept;
  void add_push(std::size_t row_number, double push, const contact::CoupledProjection& projection) noexcept;
  contact::ConstraintRow seen_from_part(const contact::CoupledRow& row) const noexcept;
  contact::ConstraintRow seen_from_other(const contact::CoupledRow& row) const noexcept;
  void add_friction(std::span<const contact::CouplingStiffness> stiffness,
                    const contact::CoupledProjection& projection) noexcept;

  struct ActiveRow {
    contact::CoupledRow row;  // as it is now; the numbers of parts are those in the scene
    double way;               // metres of a body that moves without a hand, along n since the last call
    double push;              // N
    const ContactRow* in_set;
  };

  std::size_t part_count_;
  contact::ProjectionSolver solver_;
  std::vector<ActiveRow> rows_;                           // in range
  std::array<std::size_t, contact::kMaxParts> island_{};  // of each part: the lowest number of a part in it
  // The island at work: its parts, its rows with the numbers that the parts have in it, and where these are in rows_.
  std::array<std::int32_t, contact::kMaxParts> local_{};  // number of each part in the island; −1: it is not there
  std::vector<contact::CoupledRow> in_island_;
  std::vector<std::size_t> numbers_;
  std::array<bool, contact::kMaxParts> acts_{};
  std::array<geometry::Displacement, contact::kMaxParts> wanted_{};
  // Since the poses of the rows: the last step, and the ghosts since that.
  std::array<geometry::Displacement, contact::kMaxParts> moved_{};
  std::array<geometry::Displacement, contact::kMaxParts> projected_{};       // since the poses of the rows
  std::array<std::optional<Eigen::Isometry3d>, contact::kMaxParts> X_WP_{};  // where the last projection put each part
  std::array<geometry::Displacement, contact::kMaxParts> way_{};  // from there to where the present one puts it
  std::array<contact::Wrench, contact::kMaxParts> friction_{};    // of the active rows, if all of it acted
  std::array<double, contact::kMaxParts> rubbing_{};              // N, the sum of its magnitudes
  std::array<double, contact::kMaxParts> pushes_{};               // N, sums over the rows of each part
  std::array<double, contact::kMaxParts> known_pushes_{};
  std::array<PartContacts, contact::kMaxParts> contacts_{};
};

}  // namespace glissade::haptics
