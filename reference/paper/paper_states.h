#pragma once

/// The finite state machine of the founding paper's sliding simulation (§3.1 and Figure 6). The work of its states is
/// in `paper_sliding.h`.

#include <array>
#include <cstdint>
#include <string_view>

namespace glissade::reference {

enum class PaperState : std::uint8_t {
  kMoving,        ///< under the user's control: the collision object goes to the target
  kBisecting,     ///< it penetrates: the contact is approximated, the visible object goes up to the contact
  kClassifying,   ///< polygons that touch there become contacts
  kNewDirection,  ///< the contacts deflect the remaining motion
  kCriterion,     ///< decides whether another cycle is worth it
  kSliding,       ///< under the simulation's control: the collision object goes in the new direction
  kDone,          ///< this pose of the hand is answered
};

/// The outcome of a state's work.
enum class PaperEvent : std::uint8_t {
  kFree,       ///< the collision object collides with nothing
  kCollision,  ///< the collision object collides
  kWorked,     ///< the state's work is done
  kGoOn,       ///< the criterion demands another cycle
  kStop,       ///< the criterion ends the call
};

/// Names of the states, in the order of the values of `PaperState`.
inline constexpr std::array<std::string_view, 7> kPaperStateNames{
    "moving", "bisecting", "classifying", "new-direction", "criterion", "sliding", "done"};

inline std::string_view name_of(PaperState state) {
  return kPaperStateNames[static_cast<std::size_t>(state)];
}

/// The next state:
///
///   state          event       next
///   moving         free        done           the visible object follows the hand
///   moving         collision   bisecting
///   bisecting      worked      classifying
///   classifying    worked      new-direction
///   new-direction  worked      criterion
///   criterion      go on       sliding
///   criterion      stop        done
///   sliding        free        moving         back under the user's control
///   sliding        collision   bisecting
///
/// Every other event, and every event of `done`, leads to `done`.
PaperState next_state(PaperState state, PaperEvent event);

}  // namespace glissade::reference
