#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include <glissade/files/text.h>
#include <glissade/study/slide_row.h>
#include <glissade/study/study_results.h>

#include "summary/study_summary.h"

namespace glissade::study {
namespace {

constexpr const char* kRows = "slides.jsonl";

std::string journal_name(const Shard& shard) {
  if (shard.is_all()) return "slides.journal.jsonl";
  return "slides.shard-" + std::to_string(shard.part) + "-of-" + std::to_string(shard.parts) + ".jsonl";
}

/// Writes a file under another name, and renames it when it is complete.
class RenamedFile {
 public:
  explicit RenamedFile(std::filesystem::path path) : path_(std::move(path)), partial_(path_.string() + ".partial") {
    file_.open(partial_, std::ios::binary);
  }
  void line(std::string_view text) { file_ << text << '\n'; }
  void finish() {
    file_.close();
    if (!file_) throw std::runtime_error(partial_ + ": could not be written completely");
    std::filesystem::rename(partial_, path_);
  }

 private:
  std::filesystem::path path_;
  std::string partial_;
  std::ofstream file_;
};

}  // namespace

StudyResults::StudyResults(std::filesystem::path folder, const Study& study, const SlideRunner& runner,
                           const Shard& shard)
    : folder_(std::move(folder)), study_(study), runner_(runner), places_(static_cast<std::size_t>(study.slides)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw std::invalid_argument(folder_.string() + ": " + error.message());
  open_journal(shard);
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("slides") && name.ends_with(".jsonl")) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  for (const std::filesystem::path& path : found)
    find_rows(path);
}

StudyResults::~StudyResults() {
  close(journal_);
}

void StudyResults::open_journal(const Shard& shard) {
  journal_path_ = folder_ / journal_name(shard);
  journal_ = open(journal_path_.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
  if (journal_ < 0) {
    throw std::invalid_argument(journal_path_.string() + ": " + std::generic_category().message(errno));
  }
  if (!std::filesystem::is_regular_file(journal_path_)) {
    close(journal_);
    throw std::invalid_argument(journal_path_.string() + ": is not a regular file");
  }
  if (flock(journal_, LOCK_EX | LOCK_NB) == 0) return;
  close(journal_);
  throw std::invalid_argument(journal_path_.string() + ": another run is writing this file");
}

/// A last line without its end was cut off by the end of its run. In the own journal, it is removed.
void StudyResults::find_rows(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::invalid_argument(path.string() + ": cannot be read");
  const auto number = static_cast<std::int32_t>(files_.size());
  std::int64_t offset = 0;
  std::string line;
  while (std::getline(file, line) && !file.eof()) {
    const nlohmann::json row = nlohmann::json::parse(line, nullptr, false);
    const std::int64_t slide = row.is_object() ? row.value("slide", std::int64_t{-1}) : -1;
    if (slide < 0)
      throw std::invalid_argument(path.string() + ": has a line that is no row: " + files::in_quotes(line));
    const bool belongs =
        slide < study_.slides && row.value("input_hash", "") == files::hexadecimal(runner_.hash(slide));
    outdated_ += belongs ? 0 : 1;
    if (belongs && !has(slide)) {
      places_[static_cast<std::size_t>(slide)] = {number, offset};
      ++count_;
    }
    offset += static_cast<std::int64_t>(line.size()) + 1;
  }
  if (path == journal_path_ && ftruncate(journal_, offset) != 0)
    throw std::invalid_argument(path.string() + ": " + std::generic_category().message(errno));
  paths_.push_back(path);
  files_.emplace_back(path, std::ios::binary);
}

void StudyResults::add(std::int64_t slide, const std::string& json) {
  if (!json.ends_with("\"" + files::hexadecimal(runner_.hash(slide)) + "\"}")) {
    throw std::runtime_error("slide " + std::to_string(slide) +
                             ": its row belongs to other inputs: have the files of " + study_.source +
                             " changed during the run?");
  }
  const std::string line = json + '\n';
  const off_t offset = lseek(journal_, 0, SEEK_END);
  if (write(journal_, line.data(), line.size()) != static_cast<ssize_t>(line.size())) {
    throw std::runtime_error(journal_path_.string() + ": could not be written completely (" +
                             std::generic_category().message(errno) + "). All rows before are in the file");
  }
  const auto file = std::find(paths_.begin(), paths_.end(), journal_path_) - paths_.begin();
  places_[static_cast<std::size_t>(slide)] = {static_cast<std::int32_t>(file), offset};
  ++count_;
}

std::string StudyResults::row(std::int64_t slide) {
  const Place& place = places_[static_cast<std::size_t>(slide)];
  std::ifstream& file = files_[static_cast<std::size_t>(place.file)];
  file.clear();
  file.seekg(place.offset);
  std::string line;
  std::getline(file, line);
  return line;
}

StudyCounts StudyResults::finish() {
  if (count_ != study_.slides)
    throw std::logic_error(folder_.string() + ": " + std::to_string(study_.slides - count_) + " rows are missing");
  RenamedFile csv(folder_ / "slides.csv");
  RenamedFile rows(folder_ / kRows);
  csv.line(files::joined(columns_of(study_), ","));
  StudySummary summary(study_);
  for (std::int64_t slide = 0; slide < study_.slides; ++slide) {
    const std::string json = row(slide);
    summary.add(nlohmann::json::parse(json));
    csv.line(csv_of(json));
    rows.line(json);
  }
  csv.finish();
  rows.finish();
  RenamedFile numbers(folder_ / "study.json");
  numbers.line(summary.to_json().dump(2));
  numbers.finish();
  for (const std::filesystem::path& path : paths_) {
    if (path.filename() != kRows) std::filesystem::remove(path);
  }
  return {summary.rows(), summary.successes(), summary.problems()};
}

}  // namespace glissade::study
