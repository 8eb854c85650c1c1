#pragma once

/// Why a hand has held nothing.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glissade/grasping/grasp_analysis.h>
#include <glissade/grasping/hand_model.h>

namespace glissade::apps {

/// Follows a hand with fingers, and remembers its longest touch that made no grasp.
class MissedGrasp {
 public:
  /// The names of all bodies by `Grasp::object`, and which of them hands can hold. Without names, sentences name no
  /// object.
  explicit MissedGrasp(std::vector<std::string> names = {}, std::vector<bool> can_be_held = {})
      : names_(std::move(names)), can_be_held_(std::move(can_be_held)) {}

  /// What the hand touches at this time, in seconds that rise, and whether it holds something.
  void note(double time_s, const grasping::Grasp& grasp, bool holds);

  /// Such as "the thumb alone pushed 'mug' from 0.400 to 1.280 s: a grasp needs a finger as well, or ..."; empty if the
  /// hand has ever held something.
  std::string text() const;

 private:
  /// A touch of one object that lacks the same all the time.
  struct Touch {
    std::int32_t object = -1;
    grasping::GraspLack lack = grasping::GraspLack::kTouch;
    grasping::TouchingSegments segments;  // all that touched meanwhile
    double first_s = 0.0;
    double last_s = 0.0;
  };

  bool can_be_held(const Touch& touch) const;
  bool is_worth_more(const Touch& touch, const Touch& other) const;

  std::vector<std::string> names_;
  std::vector<bool> can_be_held_;
  bool has_held_ = false;
  std::optional<Touch> present_;
  std::optional<Touch> longest_;
};

}  // namespace glissade::apps
