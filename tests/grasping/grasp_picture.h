#pragma once

/// Pictures of hands that grasp, for docs/grasps.md.

#include <cstdint>
#include <filesystem>
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

}  // namespace glissade::test_support
