#pragma once

/// A recorded run, once more: on a simulated clock, with the recorded states of the gloves.

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/scene/sliding_option.h>
#include <glissade/devices/haptic_state.h>
#include <glissade/grasping/hand_model.h>

namespace glissade::apps {

/// What came of it.
struct ReplayOutcome {
  std::int64_t runs = 0;                 ///< of the log, joined logs have several
  std::int64_t ticks = 0;                ///< that were repeated
  std::int64_t contact_sets = 0;         ///< that were repeated
  std::chrono::nanoseconds recorded{0};  ///< duration of these ticks then
  std::chrono::nanoseconds elapsed{0};   ///< the same now, without reading the scene
  std::string difference;                ///< which tick or contact set differs, and how; empty if none does
  std::string damage;                    ///< where the file is damaged; empty if it is whole

  bool is_same() const { return difference.empty() && damage.empty(); }
};

/// Who looks on while a run is repeated.
class ReplayAudience {
 public:
  virtual ~ReplayAudience() = default;

  /// Before the first tick of each run: the scene, the rules that the user chose, the period of ticks, and each hand's
  /// glove and model, which is null without fingers.
  virtual void begin(const HapticScene& scene, const SlidingChoice& choice, std::chrono::nanoseconds period,
                     const std::vector<std::int64_t>& devices,
                     const std::vector<std::shared_ptr<const grasping::HandModel>>& models) = 0;
  /// The recorded state of a tick. The replay ends if the answer is false.
  virtual bool take(const devices::HapticState& state) = 0;
};

/// Repeats the runs of a log, one after the other, up to its end, the first difference or the first damage. The scene
/// is that of `scene_file`, or the recorded one if the name is empty. `audience` may be null. Shows a progress bar.
/// Throws std::invalid_argument, naming the file, for a log without a run, and for a scene that cannot be read or is
/// not the recorded one.
ReplayOutcome replay_offline(const std::string& log_path, const std::string& scene_file, ReplayAudience* audience);

}  // namespace glissade::apps
