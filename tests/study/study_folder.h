#pragma once

/// A folder with a scene and studies of it.

#include <string>

#include <glissade/study/study.h>

#include "temporary_folder.h"

namespace glissade::study {

/// A square peg of 8 mm, 0.2 m long, over a hole of `hole_m` in four blocks. Neither has chamfers. A path presses the
/// peg 3 mm down; its goal is at the end of the path.
class StudyFolder {
 public:
  explicit StudyFolder(double hole_m = 0.0082) {
    const double side = 0.04;
    const double center = hole_m / 2.0 + side / 2.0;
    std::string objects = "objects:\n";
    const auto block = [&](const char* name, double x, double y, double size_x, double size_y) {
      objects += std::string("  - {name: ") + name + ", shape: {type: box, size_x_m: " + std::to_string(size_x) +
                 ", size_y_m: " + std::to_string(size_y) + ", size_z_m: 0.01}, pose: {position_m: [" +
                 std::to_string(x) + ", " + std::to_string(y) + ", -0.005]}}\n";
    };
    block("left", -center, 0.0, side, 0.1);
    block("right", center, 0.0, side, 0.1);
    block("front", 0.0, -center, hole_m, side);
    block("back", 0.0, center, hole_m, side);
    folder_.write("scene.yaml", objects +
                                    "  - {name: peg, movable: true, compliance_point_m: [0, 0, -0.1], shape: {type: "
                                    "box, size_x_m: 0.008, size_y_m: 0.008, size_z_m: 0.2}}\n"
                                    "goal: {position_m: [0, 0, 0.097]}\n");
    folder_.write("path.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0.101,1,0,0,0\n0.1,0,0,0.097,1,0,0,0\n");
  }

  /// A study file with these lines, which come after scene, part and trajectory.
  std::string write(const std::string& lines) const {
    return folder_.write("study.yaml", "scene: scene.yaml\npart: peg\ntrajectory: path.csv\n" + lines);
  }
  Study read(const std::string& lines) const { return read_study(write(lines)); }
  const test_support::TemporaryFolder& folder() const { return folder_; }

 private:
  test_support::TemporaryFolder folder_{};
};

}  // namespace glissade::study
