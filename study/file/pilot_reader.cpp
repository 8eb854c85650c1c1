#include "file/pilot_reader.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include <glissade/files/text.h>
#include <glissade/study/slide_row.h>

namespace glissade::study {
namespace {

constexpr std::size_t kLeastSlidesOfPilot = 8;

/// The value of a parameter in a row; the index of one of several values.
std::optional<double> value_in(const nlohmann::json& row, const Parameter& parameter) {
  if (!row.contains(parameter.name)) return std::nullopt;
  const nlohmann::json& value = row[parameter.name];
  const OneOf* const one_of = parameter.distribution.as_one_of();
  if (one_of == nullptr) return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
  const auto place_in = [](const auto& list, const auto& wanted) -> std::optional<double> {
    const auto found = std::find(list.begin(), list.end(), wanted);
    return found == list.end() ? std::nullopt : std::optional(static_cast<double>(found - list.begin()));
  };
  if (value.is_number()) return place_in(one_of->numbers, value.get<double>());
  return value.is_string() ? place_in(one_of->names, value.get<std::string>()) : std::nullopt;
}

}  // namespace

std::vector<PilotSlide> read_pilot(const std::filesystem::path& folder, const std::vector<Parameter>& parameters) {
  const std::string path = (folder / "slides.jsonl").string();
  std::ifstream file(path);
  if (!file) throw std::invalid_argument(path + ": cannot be read; the pilot must be a study that has ended");
  std::vector<PilotSlide> slides;
  std::string line;
  for (std::int64_t number = 1; std::getline(file, line); ++number) {
    const auto fail = [&](const std::string& what) {
      throw std::invalid_argument(path + ":" + std::to_string(number) + ": " + what);
    };
    const nlohmann::json row = nlohmann::json::parse(line, nullptr, false);
    if (!row.is_object() || !row.contains("success") || !row.contains("outcome")) fail("is no row of a study");
    if (row["outcome"] == kNotRun) continue;
    PilotSlide& slide = slides.emplace_back();
    slide.succeeds = row["success"] == 1;
    for (const Parameter& parameter : parameters) {
      const std::optional<double> value = value_in(row, parameter);
      if (!value) fail("has no value of the parameter " + files::in_quotes(parameter.name));
      slide.values.push_back(*value);
    }
  }
  if (slides.size() < kLeastSlidesOfPilot) {
    throw std::invalid_argument(path + ": a pilot needs at least " + std::to_string(kLeastSlidesOfPilot) +
                                " slides, not " + std::to_string(slides.size()));
  }
  return slides;
}

}  // namespace glissade::study
