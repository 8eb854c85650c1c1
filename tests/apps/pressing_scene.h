#pragma once

/// A small scene for tests of the program, with a script for its hand.

#include <string>

#include "temporary_folder.h"

namespace glissade::test_support {

/// A box that is pressed on a plate and pushed to its goal along it, in one second. Returns the scene's file.
inline std::string write_pressing_scene(const TemporaryFolder& folder) {
  folder.write("hand.csv",
               "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n"
               "0,0,0,0.03,1,0,0,0\n"
               "0.2,0,0,0.01,1,0,0,0\n"
               "0.8,0.05,0,0.01,1,0,0,0\n"
               "1,0.05,0,0.01,1,0,0,0\n");
  return folder.write("scene.yaml",
                      "objects:\n"
                      "  - name: plate\n"
                      "    shape: {type: plate, size_x_m: 0.5, size_y_m: 0.5, triangles: 200}\n"
                      "  - name: box\n"
                      "    movable: true\n"
                      "    shape: {type: box, size_x_m: 0.1, size_y_m: 0.06, size_z_m: 0.04, triangles: 60}\n"
                      "    pose: {position_m: [0, 0, 0.03]}\n"
                      "script: hand.csv\n"
                      "goal: {position_m: [0.05, 0, 0.02]}\n");
}

}  // namespace glissade::test_support
