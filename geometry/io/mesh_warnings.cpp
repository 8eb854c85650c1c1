#include "io/mesh_warnings.h"

#include <algorithm>

namespace glissade::geometry {

void MeshWarnings::add(const WarningKind& kind, const std::string& place, std::int64_t count) {
  const auto entry =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& known) { return known.kind == &kind; });
  if (entry == entries_.end()) {
    entries_.push_back({&kind, place, count});
  } else {
    entry->count += count;
  }
}

std::vector<std::string> MeshWarnings::sentences() const {
  std::vector<std::string> sentences;
  for (const auto& [kind, first, count] : entries_) {
    const bool is_one = count == 1;
    sentences.push_back(std::to_string(count) + " " + (is_one ? kind->one : kind->several) + " (" +
                        (is_one ? "" : "the first: ") + first + ").");
  }
  return sentences;
}

}  // namespace glissade::geometry
