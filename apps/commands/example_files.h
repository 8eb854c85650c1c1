#pragma once

/// The files of `glissade example`: scenes with the hands that move in them, meshes, and poses, with which the examples
/// of every command's help work.

#include <vector>

#include <glissade/apps/text.h>
#include <glissade/files/text_file.h>

namespace glissade::apps {

/// All of them, their paths without a folder. The scenes are those of examples/scenes when the program was built. Cost:
/// some milliseconds.
std::vector<TextFile> example_files();

}  // namespace glissade::apps
