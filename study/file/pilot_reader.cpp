#include "file/pilot_reader.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include <glissade/files/hash.h>
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

namespace {

/// A line of the file.
class PilotRow {
 public:
  PilotRow(const std::string& line, std::string place)
      : place_(std::move(place)), row_(nlohmann::json::parse(line, nullptr, false)) {
    if (!row_.is_object() || !row_.contains("outcome")) fail("is no row of a study");
  }

  bool has_run() const { return row_["outcome"] != kNotRun; }

  bool succeeds() const {
    const auto success = row_.find("success");
    if (success == row_.end() || !success->is_number_integer() || *success < 0 || *success > 1)
      fail("'success' must be 0 or 1");
    return *success == 1;
  }

  double value(const Parameter& parameter) const {
    const std::optional<double> value = value_in(row_, parameter);
    if (!value) fail("has no value of the parameter " + files::in_quotes(parameter.name));
    const Uniform bounds = parameter.distribution.bounds();
    if (*value < bounds.least || *value > bounds.greatest) {
      fail(files::in_quotes(parameter.name) + ": " + files::format_number(*value) +
           " cannot occur in this study, so the pilot is that of another one");
    }
    return *value;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw std::invalid_argument(place_ + ": " + what); }

  std::string place_;
  nlohmann::json row_;
};

}  // namespace

Pilot read_pilot(const std::filesystem::path& folder, const std::vector<Parameter>& parameters) {
  const std::string path = (folder / "slides.jsonl").string();
  std::ifstream file;
  if (std::filesystem::is_regular_file(path)) file.open(path);
  if (!file.is_open()) throw std::invalid_argument(path + ": cannot be read; the pilot must be a study that has ended");
  Pilot pilot;
  files::Hash hash;
  std::string line;
  for (std::int64_t number = 1; std::getline(file, line); ++number) {
    const PilotRow row(line, path + ":" + std::to_string(number));
    if (!row.has_run()) continue;
    PilotSlide& slide = pilot.slides.emplace_back();
    slide.succeeds = row.succeeds();
    hash.add(std::uint64_t{slide.succeeds});
    for (const Parameter& parameter : parameters)
      hash.add(slide.values.emplace_back(row.value(parameter)));
  }
  if (pilot.slides.size() < kLeastSlidesOfPilot) {
    throw std::invalid_argument(path + ": a pilot needs at least " + std::to_string(kLeastSlidesOfPilot) +
                                " slides, not " + std::to_string(pilot.slides.size()));
  }
  pilot.hash = hash.value();
  return pilot;
}

}  // namespace glissade::study
