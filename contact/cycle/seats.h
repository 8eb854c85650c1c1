#pragma once

/// Parts that touch or overlap other bodies where the simulation starts. Such a pair of bodies is a seat. No direction
/// separates it, so no certificate can hold for it. Instead, what certificates and contacts keep apart from the other
/// body is the part's inset, i.e. the part with its faces so far inside that it is just free: it moves with the part
/// and is in no other body's way. An open part has no inside; its inset is a copy of it, so far aside. So the part can
/// go wherever it overlaps the other body no deeper than at the start (to a twentieth of the margin; at corners to half
/// of it, if a face touches the same body too), and never through one of its surfaces. Once part and body are apart,
/// the inset goes, and they are a pair like any other.

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/contact_body.h>
#include <glissade/contact/sliding_rules.h>

#include "scene/contact_scene.h"

namespace glissade::contact {

struct Seat {
  BodyPair bodies;
  double depth;   ///< metres of overlap at the start; 0: they only touch
  double margin;  ///< metres: the gap at which contacts of the inset with the other body stop the part
  std::shared_ptr<const SlidingPart> inset_V;
  double min_clearance;  ///< metres, of the inset from the other body
  /// A translation (metres) out of an overlap that is deeper than the margin. On it, the insets of all seats of the
  /// part stay free.
  std::optional<Eigen::Vector3d> way_out_W{};
};

/// Share of the margin that an inset has at its start, and that it keeps. Between the two, an overlap may become
/// deeper. Above `kEnough` (`near_pairs.cpp`) of the margin, boxes are certified as a whole. From an inset at the
/// margin, the part itself is more than the minimum clearance away.
inline constexpr double kGapOfInset = 0.65;
inline constexpr double kClearanceOfInset = 0.6;
static_assert(1.0 - kGapOfInset > kMinClearanceOfMargin);

/// Shares of the margin: bodies that overlap by less only touch, and so do bodies that are less apart, where rounding
/// has left a gap that would have to be kept.
inline constexpr double kTouchingOfMargin = 0.01;
inline constexpr double kApartByRounding = 1e-3;

/// The seats of all parts at the poses of the scene; bodies closer than `touching` (metres) touch in any case. Throws
/// std::invalid_argument for an overlap deeper than the margin, unless it is one of a part in a hand with an obstacle
/// and the rule is to depenetrate it, and where a part has no inset that is free.
std::vector<Seat> find_seats(const ContactScene& scene, const std::vector<HeldPart>& parts, OverlapRule rule,
                             double touching);

}  // namespace glissade::contact
