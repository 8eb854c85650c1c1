// The mesh importer on files of one format, GLISSADE_FUZZ_EXTENSION.

#include "fuzz_target.h"
#include "mesh_import_check.h"
#include "mesh_seeds.h"

namespace glissade::fuzz {

bool try_input(std::string_view bytes) {
  return try_mesh_import(GLISSADE_FUZZ_EXTENSION, bytes);
}

std::vector<Seed> seeds() {
  return mesh_seeds(GLISSADE_FUZZ_EXTENSION);
}

std::vector<std::string> dictionary() {
  return mesh_words(GLISSADE_FUZZ_EXTENSION);
}

void repair(std::string& bytes) {
  repair_mesh_lengths(GLISSADE_FUZZ_EXTENSION, bytes);
}

}  // namespace glissade::fuzz
