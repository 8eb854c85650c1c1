#pragma once

/// The row of a slide in the table of a study.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glissade/study/slide_meter.h>
#include <glissade/study/study.h>

namespace glissade::study {

/// The outcome of a slide that was given up because of the machine: it took too long, or its process crashed.
inline constexpr const char* kNotRun = "not run";

struct SlideRow {
  std::int64_t slide = 0;  ///< number, from 0
  std::vector<double> values{};
  std::uint64_t input_hash = 0;
  std::string outcome{};                 ///< "success", or what failed first: see docs/studies.md
  std::optional<std::string> problem{};  ///< one sentence: why the slide was impossible; then there are no measures
  SlideMeasures measures{};
};

/// A hash of everything on which a row depends.
std::uint64_t input_hash(std::uint64_t study_hash, const std::vector<double>& values);

/// The row as a JSON object on one line, without a line break. The keys are the columns of the table, in their order.
std::string json_of(const Study& study, const SlideRow& row);

/// The problem of a slide that took longer than allowed, as a sentence.
std::string too_long(double longest_s);

/// The names of the columns.
std::vector<std::string> columns_of(const Study& study);

/// The row of a line that `json_of` made, as a line of CSV without a line break (RFC 4180). Throws
/// std::invalid_argument if the line is no JSON object.
std::string csv_of(std::string_view json);

}  // namespace glissade::study
