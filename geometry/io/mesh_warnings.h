#pragma once

/// What a reader skips in a file, or finds missing: warnings to the user.

#include <cstdint>
#include <string>
#include <vector>

namespace glissade::geometry {

/// What is counted, in the words that follow the number: "face is left out", "faces are left out".
struct WarningKind {
  const char* one;
  const char* several;
};

/// Counts what is worth a warning. Each kind makes one sentence, however often it occurs.
class MeshWarnings {
 public:
  /// `kind` must outlive the collector. `place` is a line or an element of the file; that of the first occurrence is
  /// told.
  void add(const WarningKind& kind, const std::string& place, std::int64_t count = 1);

  /// "2 faces are left out (the first: line 21).", in the order of the first occurrences.
  std::vector<std::string> sentences() const;

 private:
  struct Entry {
    const WarningKind* kind;
    std::string first;
    std::int64_t count;
  };
  std::vector<Entry> entries_;
};

}  // namespace glissade::geometry
