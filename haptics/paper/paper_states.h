#pragma once

/// The finite state machine of the founding paper's sliding simulation (§3.1 and Figure 6), apart from what is done in
/// its states: `paper_sliding.h` does that.

#include <array>
#include <cstdint>
#include <string_view>

namespace glissade::haptics {

enum class PaperState : std::uint8_t {
  kMoving,        ///< under the user's control: the collision object goes to where the metaphor wants it
  kBisecting,     ///< it penetrates: the contact is approximated, the visible object goes up to it
  kClassifying,   ///< what touches there is made contacts
  kNewDirection,  ///< the contacts turn the rest of the motion
  kCriterion,     ///< is it worth another cycle?
  kSliding,       ///< under the simulation's control: the collision object goes in the new direction
  kDone,          ///< the answer to this pose of the hand is there
};

/// What became of a state's work.
enum class PaperEvent : std::uint8_t {
  kFree,       ///< the collision object collides with nothing
  kCollision,  ///< it does
  kWorked,     ///< what the state is for is done
  kGoOn,       ///< the criterion asks for another cycle
  kStop,       ///< it does not
};

inline constexpr std::array<std::string_view, 7> kPaperStateNames{
    "moving", "bisecting", "classifying", "new-direction", "criterion", "sliding", "done"};

inline std::string_view name_of(PaperState state) {
  return kPaperStateNames[static_cast<std::size_t>(state)];
}

/// The state that follows:
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
/// A state that has no such event, and `done` itself, leads to `done`.
PaperState next_state(PaperState state, PaperEvent event);

}  // namespace glissade::haptics
