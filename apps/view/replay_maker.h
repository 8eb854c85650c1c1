#pragma once

/// The replay of a report, made tick by tick.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include <glissade/apps/report/html_report.h>
#include <glissade/devices/haptic_state.h>
#include <glissade/viewer/view_frame.h>
#include <glissade/viewer/view_scene.h>

namespace glissade::apps {

/// The scene with at most about 140,000 triangles, which take 3.5 MB of a page, and frames that take 1.4 MB: 60 a
/// second, of a long run half as many, a quarter, and so on. A frame has the greatest force and the worst timing of
/// the sixtieth of a second before it, or of the time between two frames, if that is longer.
class ReplayMaker {
 public:
  /// Says so if the scene has more triangles.
  explicit ReplayMaker(const viewer::ViewScene& scene);

  /// States in the order of their times.
  void add(const devices::HapticState& state);
  /// Once, at the end.
  Replay finish();

 private:
  viewer::FrameMaker maker_;
  std::future<Replay> models_;  // made meanwhile, in a thread
  /// Ends the frame that is being made.
  void end_frame();
  void leave_out_half();

  std::vector<std::string> frames_;
  std::size_t bytes_ = 0;  // of them
  std::chrono::nanoseconds period_{16'667'000};
  std::optional<std::chrono::nanoseconds> first_;
  std::int64_t frame_ = 0;  // the number of the one that is being made
};

}  // namespace glissade::apps
