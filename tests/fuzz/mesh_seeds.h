#pragma once

/// Valid mesh files to begin fuzzing with, made by code. A format is known by its extension: ".obj", ".stl", ".ply",
/// ".gltf" or ".glb".

#include <string>
#include <vector>

#include "fuzz_target.h"

namespace glissade::fuzz {

std::vector<Seed> mesh_seeds(const std::string& extension);

/// Keywords, types and limits of the format.
std::vector<std::string> mesh_words(const std::string& extension);

/// Makes the lengths in a GLB file and the count of a binary STL file agree with the size of the file.
void repair_mesh_lengths(const std::string& extension, std::string& bytes);

/// The content of a file data.bin, which the buffer of a glTF document may be.
std::string mesh_buffer();

// Private to mesh_seeds*.cpp.
std::vector<Seed> gltf_seeds(bool is_glb);

}  // namespace glissade::fuzz
