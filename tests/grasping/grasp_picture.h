#pragma once

/// Pictures of hands, for docs/grasps.md and docs/grasping.md, in parallel projection. R_VW turns the world into the
/// view: x to the right, y up, z towards the eye.

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "labelled_grasps.h"

namespace glissade::test_support {

struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  ///< by rows from the top

  void paste(const Picture& other, int left, int top);
  /// As a binary PPM file. Throws std::invalid_argument if the file cannot be written.
  void save(const std::filesystem::path& file) const;
};

/// A white picture.
Picture blank(int width, int height);

/// The visible hand and its object, touching segments in another color, seen in parallel projection from the side from
/// which most of them are in sight.
Picture draw_grasp(const GraspTrial& trial, const LabelledGrasp& grasp, int size);

/// The open hand, its segments in the colors of their kinds.
Picture draw_segments(const grasping::HandModel& hand, const Eigen::Matrix3d& R_VW, int size);

/// A hand that closes, at these times (ascending): the visible hand and its object, and the outline of the target.
std::vector<Picture> draw_clasping(const LabelledGrasp& grasp, std::span<const int> times_ms,
                                   const Eigen::Matrix3d& R_VW, int size);

}  // namespace glissade::test_support
