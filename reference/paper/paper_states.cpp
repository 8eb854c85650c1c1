#include "paper/paper_states.h"

namespace glissade::reference {

PaperState next_state(PaperState state, PaperEvent event) {
  switch (state) {
    case PaperState::kMoving:
      return event == PaperEvent::kCollision ? PaperState::kBisecting : PaperState::kDone;
    case PaperState::kBisecting:
      return event == PaperEvent::kWorked ? PaperState::kClassifying : PaperState::kDone;
    case PaperState::kClassifying:
      return event == PaperEvent::kWorked ? PaperState::kNewDirection : PaperState::kDone;
    case PaperState::kNewDirection:
      return event == PaperEvent::kWorked ? PaperState::kCriterion : PaperState::kDone;
    case PaperState::kCriterion:
      return event == PaperEvent::kGoOn ? PaperState::kSliding : PaperState::kDone;
    case PaperState::kSliding:
      if (event == PaperEvent::kFree) return PaperState::kMoving;
      return event == PaperEvent::kCollision ? PaperState::kBisecting : PaperState::kDone;
    case PaperState::kDone:
      break;
  }
  return PaperState::kDone;
}

}  // namespace glissade::reference
