#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include <glissade/apps/progress.h>
#include <glissade/apps/say.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/study/study_report.h>
#include <glissade/apps/text.h>
#include <glissade/apps/view/slide_replay.h>
#include <glissade/study/slide_row.h>
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

SlidePage slide_page(const study::Study& study, const study::SlideRunner& runner, std::int64_t slide, double longest_s,
                     bool (*should_stop)()) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  std::optional<HapticScene> scene;
  std::optional<SlideReplay> replay;
  const study::SlideRow row = runner.run(slide, [&](std::chrono::nanoseconds time, const contact::Sliding& sliding) {
    if (should_stop()) throw std::runtime_error("stopped");
    if (std::chrono::duration<double>(Clock::now() - start).count() > longest_s)
      throw std::runtime_error(study::too_long(longest_s));
    // A slide that is impossible does not begin.
    if (!replay) replay.emplace(scene.emplace(make_haptic_scene(runner.scene(slide), {study.part})));
    replay->add(time, sliding);
  });
  SlidePage page{.row = study::json_of(study, row)};
  page.report.title = "Slide " + std::to_string(slide) + " of " + name_of(study);
  page.report.summary = values_of_row(page.row);
  if (replay) replay->finish(page.report);
  return page;
}

SlidePage StudyReport::page_of(std::int64_t slide) const {
  return slide_page(source_.study, source_.runner, slide, source_.longest_s, source_.should_stop);
}

std::string StudyReport::served_data() const {
  study::StudyPage page(source_.study);
  const std::scoped_lock lock(source_.rows_mutex);
  source_.results.for_each_row([&](const std::string& row) { page.add(row); });
  return page.to_json({.command = source_.command, .is_served = true, .is_complete = source_.results.is_finished()});
}

bool StudyReport::write() const {
  study::StudyPage rows(source_.study);
  {
    const std::scoped_lock lock(source_.rows_mutex);
    source_.results.for_each_row([&](const std::string& row) { rows.add(row); });
  }
  const std::vector<std::int64_t> notable = rows.notable_slides();
  ProgressBar progress("replays", static_cast<std::int64_t>(notable.size()) + 1);
  study::StudyPageContext context{.command = source_.command, .is_complete = true};
  std::int64_t done = 0;
  for (const std::int64_t slide : notable) {
    try {
      const SlidePage page = page_of(slide);
      write_html_report(page.report, source_.folder + std::string(kSlides) + std::to_string(slide));
      context.replays.push_back(slide);
    } catch (const std::runtime_error& error) {
      if (source_.should_stop()) break;
      warn("the replay of slide " + std::to_string(slide) + ": " + error.what());
    }
    progress.update(++done);
  }
  write_html_report({.title = name_of(source_.study), .study = rows.to_json(context)}, source_.folder);
  return !source_.should_stop();
}

std::optional<viewer::ServedFile> StudyReport::find(std::string_view path) const {
  constexpr const char* kHtml = "text/html; charset=utf-8";
  if (path == "/") {
    return viewer::ServedFile{kHtml, html_report({.title = name_of(source_.study), .study = served_data()})};
  }
  if (path == kPageData) return viewer::ServedFile{"application/json", served_data()};
  if (const auto slide = slide_of(path, source_.study.slides)) {
    return viewer::ServedFile{kHtml, html_report(page_of(*slide).report)};
  }
  constexpr std::array<std::pair<std::string_view, const char*>, 3> kFiles{
      {{"/slides.csv", "text/csv"}, {"/slides.jsonl", "application/jsonl"}, {"/study.json", "application/json"}}};
  for (const auto& [name, type] : kFiles) {
    if (path == name) return file_of(source_.folder + std::string(name), type);
  }
  return std::nullopt;
}

}  // namespace glissade::apps
