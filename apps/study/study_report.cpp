#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include <glissade/apps/progress.h>
#include <glissade/apps/report/html_report.h>
#include <glissade/apps/say.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/study/study_report.h>
#include <glissade/apps/text.h>
#include <glissade/apps/view/slide_replay.h>
#include <glissade/files/text.h>
#include <glissade/study/slide_row.h>
#include <glissade/study/study_page.h>

namespace glissade::apps {

namespace {

constexpr const char* kPageData = "/study_page.json";
constexpr std::string_view kSlides = "/slides/";
constexpr const char* kHtml = "text/html; charset=utf-8";

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

/// Why a row has no page.
std::string problem_of(const std::string& json) {
  const auto row = nlohmann::json::parse(json);
  return row.at("problem").is_string() ? row.at("problem").get<std::string>()
                                       : "its inputs have changed since the study was started";
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

std::string page_folder(const std::string& study_folder, std::int64_t slide) {
  return study_folder + std::string(kSlides) + std::to_string(slide);
}

std::string write_slide_page(const study::Study& study, const study::SlideRunner& runner, std::int64_t slide,
                             const std::string& folder) {
  std::optional<HapticScene> scene;
  std::optional<SlideReplay> replay;
  const study::SlideRow row = runner.run(slide, [&](std::chrono::nanoseconds time, const contact::Sliding& sliding) {
    // A slide that is impossible does not begin.
    if (!replay) replay.emplace(scene.emplace(make_haptic_scene(runner.scene(slide), {study.part})));
    replay->add(time, sliding);
  });
  std::string json = study::json_of(study, row);
  Report report{.title = "Slide " + std::to_string(slide) + " of " + name_of(study), .summary = values_of_row(json)};
  if (replay) replay->finish(report);
  write_html_report(report, folder);
  return json;
}

std::string StudyReport::page_path(std::int64_t slide) const {
  return report_page(page_folder(source_.folder, slide));
}

/// A page with other inputs does not count.
bool StudyReport::has_page(std::int64_t slide) const {
  const auto page = file_of(page_path(slide), kHtml);
  return page && page->text.find(files::hexadecimal(source_.runner.hash(slide))) != std::string::npos;
}

void StudyReport::make_pages(const std::vector<std::int64_t>& slides,
                             const std::function<void(std::int64_t slide, const std::string& row)>& see) {
  const std::scoped_lock lock(pages_mutex_);
  auto missing = slides.begin();
  StudyWork work = source_.work;
  work.pages = source_.folder;
  work.workers = std::min(work.workers, static_cast<int>(slides.size()));
  work.next = [&] { return missing == slides.end() ? std::nullopt : std::optional(*missing++); };
  work.take = see;
  run_slides(source_.study, source_.runner, work);
}

void StudyReport::make_page(std::int64_t slide) {
  std::string why = "the study was stopped";
  make_pages({slide}, [&why](std::int64_t, const std::string& row) { why = problem_of(row); });
  if (!has_page(slide)) throw std::runtime_error("slide " + std::to_string(slide) + " has no page: " + why);
}

std::string StudyReport::served_data() const {
  study::StudyPage page(source_.study);
  const std::scoped_lock lock(source_.rows_mutex);
  source_.results.for_each_row([&](const std::string& row) { page.add(row); });
  return page.to_json({.command = source_.command, .is_served = true, .is_complete = source_.results.is_finished()});
}

bool StudyReport::write() {
  study::StudyPage rows(source_.study);
  {
    const std::scoped_lock lock(source_.rows_mutex);
    source_.results.for_each_row([&](const std::string& row) { rows.add(row); });
  }
  const std::vector<std::int64_t> notable = rows.notable_slides();
  std::vector<std::int64_t> missing;
  std::copy_if(notable.begin(), notable.end(), std::back_inserter(missing), [this](auto n) { return !has_page(n); });
  ProgressBar progress("replays", static_cast<std::int64_t>(missing.size()) + 1);
  std::int64_t done = 0;
  make_pages(missing, [&](std::int64_t slide, const std::string& row) {
    progress.update(++done);
    if (!has_page(slide)) warn("the replay of slide " + std::to_string(slide) + ": " + problem_of(row));
  });
  study::StudyPageContext context{.command = source_.command, .is_complete = true};
  std::copy_if(notable.begin(), notable.end(), std::back_inserter(context.replays),
               [this](auto n) { return has_page(n); });
  write_html_report({.title = name_of(source_.study), .study = rows.to_json(context)}, source_.folder);
  return !source_.work.should_stop();
}

std::optional<viewer::ServedFile> StudyReport::find(std::string_view path) {
  if (path == "/") {
    return viewer::ServedFile{kHtml, html_report({.title = name_of(source_.study), .study = served_data()})};
  }
  if (path == kPageData) return viewer::ServedFile{"application/json", served_data()};
  if (const auto slide = slide_of(path, source_.study.slides)) {
    if (!has_page(*slide)) make_page(*slide);
    return file_of(page_path(*slide), kHtml);
  }
  constexpr std::array<std::pair<std::string_view, const char*>, 3> kFiles{
      {{"/slides.csv", "text/csv"}, {"/slides.jsonl", "application/jsonl"}, {"/study.json", "application/json"}}};
  for (const auto& [name, type] : kFiles) {
    if (path == name) return file_of(source_.folder + std::string(name), type);
  }
  return std::nullopt;
}

}  // namespace glissade::apps
