#pragma once

/// The files of `glissade example`: scenes with the hands that move in them, meshes, and poses, with which the examples
/// of every command's help work.

#include <string>
#include <vector>

namespace glissade::apps {

struct ExampleFile {
  std::string name;  ///< without a folder
  std::string text;
};

/// All of them. The scenes are those of examples/scenes when the program was built. Cost: some milliseconds.
std::vector<ExampleFile> example_files();

}  // namespace glissade::apps
