#pragma once

/// The slides of a pilot study, from the folder with its results.

#include <cstdint>
#include <filesystem>
#include <vector>

#include <glissade/study/strata.h>
#include <glissade/study/study.h>

namespace glissade::study {

struct Pilot {
  std::vector<PilotSlide> slides{};
  std::uint64_t hash = 0;  ///< of all rows
};

/// Reads `folder`/slides.jsonl. Slides that the machine gave up are left out. Throws std::invalid_argument, naming file
/// and line, if the file cannot be read, is no table of a study with these parameters, or has hardly any slides.
Pilot read_pilot(const std::filesystem::path& folder, const std::vector<Parameter>& parameters);

}  // namespace glissade::study
