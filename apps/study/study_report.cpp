#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include <nlohmann/json.hpp>

#include <glissade/apps/progress.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/study/study_report.h>
#include <glissade/apps/text.h>
#include <glissade/apps/view/slide_replay.h>
#include <glissade/study/study_page.h>

namespace glissade::apps {

namespace {

constexpr const char* kPageData = "/study_page.json";
constexpr std::string_view kSlides = "/slides/";

std::string name_of(const study::Study& study) {
  return std::filesystem::path(study.source).stem().string();
}

std::vector<std::pair<std::string, std::string>> values_of_row(const std::string& json) {
  std::vector<std::pair<std::string, std::string>> values;
  const auto row = nlohmann::ordered_json::parse(json);
  for (const auto& [column, value] : row.items()) {
    if (value.is_null()) continue;
    values.emplace_back(column, value.is_string() ? value.get<std::string>() : value.dump());
  }
  return values;
}

/// The number of a path such as /slides/12/.
std::optional<std::int64_t> slide_of(std::string_view path, std::int64_t slides) {
  if (!path.starts_with(kSlides) || !path.ends_with('/')) return std::nullopt;
  const std::string_view text = path.substr(kSlides.size(), path.size() - kSlides.size() - 1);
  const bool is_number = !text.empty() && text.size() < 10 && text.find_first_not_of("0123456789") == text.npos;
  if (!is_number) return std::nullopt;
  const std::int64_t slide = std::stoll(std::string(text));
  return slide < slides ? std::optional(slide) : std::nullopt;
}

std::optional<viewer::ServedFile> file_of(const std::filesystem::path& path, std::string_view type) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return viewer::ServedFile{type, {std::istreambuf_iterator<char>(file), {}}};
}

}  // namespace

Report slide_report(const study::Study& study, const study::SlideRunner& runner, std::int64_t slide) {
  std::optional<HapticScene> scene;
  std::optional<SlideReplay> replay;
  const study::SlideRow row = runner.run(slide, [&](std::chrono::nanoseconds time, const contact::Sliding& sliding) {
    // A slide that is impossible does not begin.
    if (!replay) replay.emplace(scene.emplace(make_haptic_scene(runner.scene(slide), {study.part})));
    replay->add(time, sliding);
  });
  Report report{.title = "Slide " + std::to_string(slide) + " of " + name_of(study),
                .summary = values_of_row(study::json_of(study, row))};
  if (replay) replay->finish(report);
  return report;
}

std::string StudyReport::data(const std::vector<std::int64_t>& replays) const {
  study::StudyPage page(source_.study);
  const std::scoped_lock lock(source_.rows_mutex);
  source_.results.for_each_row([&](const std::string& row) { page.add(row); });
  return page.to_json(replays, source_.command);
}

Report StudyReport::page(const std::vector<std::int64_t>& replays) const {
  return {.title = name_of(source_.study), .study = data(replays)};
}

void StudyReport::write(bool (*should_stop)()) const {
  study::StudyPage rows(source_.study);
  source_.results.for_each_row([&](const std::string& row) { rows.add(row); });
  const std::vector<std::int64_t> notable = rows.notable_slides();
  ProgressBar progress("replays", static_cast<std::int64_t>(notable.size()) + 1);
  std::vector<std::int64_t> made;
  for (const std::int64_t slide : notable) {
    if (should_stop()) break;
    const std::string folder = source_.folder + std::string(kSlides) + std::to_string(slide);
    write_html_report(slide_report(source_.study, source_.runner, slide), folder);
    made.push_back(slide);
    progress.update(static_cast<std::int64_t>(made.size()));
  }
  write_html_report({.title = name_of(source_.study), .study = rows.to_json(made, source_.command)}, source_.folder);
}

std::optional<viewer::ServedFile> StudyReport::find(std::string_view path) const {
  constexpr const char* kHtml = "text/html; charset=utf-8";
  if (path == "/") return viewer::ServedFile{kHtml, html_report(page({}))};
  if (path == kPageData) return viewer::ServedFile{"application/json", data({})};
  if (const auto slide = slide_of(path, source_.study.slides)) {
    return viewer::ServedFile{kHtml, html_report(slide_report(source_.study, source_.runner, *slide))};
  }
  constexpr std::array<std::pair<std::string_view, const char*>, 3> kFiles{
      {{"/slides.csv", "text/csv"}, {"/slides.jsonl", "application/jsonl"}, {"/study.json", "application/json"}}};
  for (const auto& [name, type] : kFiles) {
    if (path == name) return file_of(source_.folder + std::string(name), type);
  }
  return std::nullopt;
}

}  // namespace glissade::apps
