#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>
#include <string_view>

#include <nlohmann/json.hpp>

#include <glissade/study/slide_row.h>
#include <glissade/study/study_page.h>

#include "summary/study_summary.h"

namespace glissade::study {
namespace {

using nlohmann::json;

/// Columns that are not on the page. They are in slides.csv.
bool is_left_out(std::string_view column) {
  constexpr std::array<std::string_view, 5> kLeftOut{"input_hash", "clearance_min_at_s", "jam_x_m", "jam_y_m",
                                                     "jam_z_m"};
  return column.starts_with("last_") || std::find(kLeftOut.begin(), kLeftOut.end(), column) != kLeftOut.end();
}

/// With six digits, which keeps the page small.
double rounded(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return std::strtod(text.data(), nullptr);
}

/// One of `step` slides, by multiplicative hashing (Knuth). Every second point of a Sobol sequence would lie in one
/// half of a parameter.
bool is_chosen(std::uint64_t slide, std::uint64_t step) {
  constexpr std::uint64_t kGoldenRatio = 0x9e3779b97f4a7c15U;
  return ((slide * kGoldenRatio) >> 32U) % step == 0;
}

}  // namespace

struct StudyPage::Table {
  explicit Table(const Study& study) : summary(study) {
    for (std::string& column : columns_of(study)) {
      if (!is_left_out(column)) columns.push_back(std::move(column));
    }
    data.assign(columns.size(), json::array());
    words.resize(columns.size());
  }

  void add(const json& row) {
    for (std::size_t c = 0; c < columns.size(); ++c)
      data[c].push_back(cell(c, row.at(columns[c])));
  }

  /// A text becomes the number of its word.
  json cell(std::size_t column, const json& value) {
    if (value.is_number_float()) return rounded(value.get<double>());
    if (!value.is_string()) return value;
    const auto next = static_cast<std::int64_t>(words[column].size());
    return words[column].try_emplace(value.get<std::string>(), next).first->second;
  }

  json words_json() const {
    json result = json::object();
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (words[c].empty()) continue;
      std::vector<std::string> list(words[c].size());
      for (const auto& [word, number] : words[c])
        list[static_cast<std::size_t>(number)] = word;
      result[columns[c]] = list;
    }
    return result;
  }

  StudySummary summary;
  std::vector<std::string> columns;
  std::vector<json> data;                                  // by column
  std::vector<std::map<std::string, std::int64_t>> words;  // by column
  std::uint64_t step = 1;
};

StudyPage::StudyPage(const Study& study, std::int64_t most_rows)
    : study_(study), table_(std::make_unique<Table>(study)) {
  table_->step = static_cast<std::uint64_t>((study.slides + most_rows - 1) / most_rows);
}

StudyPage::~StudyPage() = default;

void StudyPage::add(const std::string& text) {
  const json row = json::parse(text);
  table_->summary.add(row);
  if (is_chosen(row.at("slide").get<std::uint64_t>(), table_->step)) table_->add(row);
}

std::vector<std::int64_t> StudyPage::notable_slides() const {
  constexpr std::size_t kMostJams = 10;
  const nlohmann::ordered_json summary = table_->summary.to_json();
  std::set<std::int64_t> slides;
  for (const auto& slide : summary.at("greatest_forces"))
    slides.insert(slide.get<std::int64_t>());
  const auto& jams = summary.at("jams");
  for (std::size_t i = 0; i < std::min(kMostJams, jams.size()); ++i)
    slides.insert(jams[i].at("first_slide").get<std::int64_t>());
  for (const std::int64_t slide : table_->summary.first_failures())
    slides.insert(slide);
  return {slides.begin(), slides.end()};
}

std::string StudyPage::to_json(const StudyPageContext& context) const {
  nlohmann::ordered_json page;
  page["slides"] = study_.slides;
  page["is_complete"] = context.is_complete;
  page["is_served"] = context.is_served;
  page["summary"] = table_->summary.to_json();
  page["table"] = {{"columns", table_->columns}, {"data", table_->data}, {"words", table_->words_json()}};
  page["replays"] = context.replays;
  page["command"] = context.command;
  return page.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace glissade::study
