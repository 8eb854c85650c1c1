#include <algorithm>
#include <cerrno>
#include <regex>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <glissade/files/text.h>
#include <glissade/study/slide_row.h>
#include <glissade/study/study_results.h>

#include "summary/study_summary.h"

namespace glissade::study {
namespace {

constexpr const char* kRows = "slides.jsonl";

constexpr const char* kJournal = "slides.journal.jsonl";

std::string journal_name(const Shard& shard) {
  if (shard.is_all()) return kJournal;
  return "slides.shard-" + std::to_string(shard.part) + "-of-" + std::to_string(shard.parts) + ".jsonl";
}

/// Whether a file has rows of a study. Other files, such as copies that a user has made, are left alone.
bool has_rows(const std::string& name) {
  static const std::regex shards("slides\\.shard-[0-9]+-of-[0-9]+\\.jsonl");
  return name == kRows || name == kJournal || std::regex_match(name, shards);
}

/// Removes a journal, unless another run is writing it.
void remove_journal(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  if (flock(file, LOCK_EX | LOCK_NB) == 0) std::filesystem::remove(path);
  close(file);
}

/// Whether this open file still has its name: another run may have removed it since.
bool has_name(int file, const std::filesystem::path& path) {
  struct stat of_file {};
  struct stat of_path {};
  return fstat(file, &of_file) == 0 && stat(path.c_str(), &of_path) == 0 && of_file.st_ino == of_path.st_ino;
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
    const int file = open(partial_.c_str(), O_RDONLY | O_CLOEXEC);
    const bool is_on_disk = file >= 0 && fsync(file) == 0;
    if (file >= 0) close(file);
    if (!file_ || !is_on_disk) throw std::runtime_error(partial_ + ": could not be written completely");
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
  if (!study.pilot.empty() && std::filesystem::equivalent(folder_, study.pilot)) {
    throw std::invalid_argument(folder_.string() +
                                ": has the pilot of this study; the results need another folder (--out)");
  }
  open_journal(shard);
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    if (has_rows(name)) found.push_back(entry.path());
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
  const bool is_locked = flock(journal_, LOCK_EX | LOCK_NB) == 0;
  if (is_locked && has_name(journal_, journal_path_)) return;
  close(journal_);
  if (is_locked) return open_journal(shard);  // a run that has just ended has removed the file
  throw std::invalid_argument(journal_path_.string() + ": another run is writing this file");
}

/// A last line without its end was cut off by the end of its run. In the own journal, it is removed.
void StudyResults::find_rows(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::invalid_argument(path.string() + ": cannot be read");
  const auto number = static_cast<std::int32_t>(paths_.size());
  std::int64_t offset = 0;
  std::int64_t line_number = 0;
  std::string line;
  while (std::getline(file, line) && !file.eof()) {
    note_row(line, path.string() + ":" + std::to_string(++line_number), {number, offset});
    offset += static_cast<std::int64_t>(line.size()) + 1;
  }
  if (path == journal_path_ && ftruncate(journal_, offset) != 0)
    throw std::invalid_argument(path.string() + ": " + std::generic_category().message(errno));
  paths_.push_back(path);
}

void StudyResults::note_row(const std::string& line, const std::string& where, const Place& place) {
  const nlohmann::json row = nlohmann::json::parse(line, nullptr, false);
  const bool is_row = row.is_object() && row.contains("slide") && row["slide"].is_number_unsigned() &&
                      row.contains("input_hash") && row["input_hash"].is_string() && row.contains("outcome");
  if (!is_row) throw std::invalid_argument(where + ": is no row of a study: " + files::in_quotes(line));
  if (row["outcome"] == kNotRun) return;  // it is tried again
  const auto slide = row["slide"].get<std::int64_t>();
  const bool belongs = slide < study_.slides && row["input_hash"] == files::hexadecimal(runner_.hash(slide));
  outdated_ += belongs ? 0 : 1;
  if (!belongs || has(slide)) return;
  places_[static_cast<std::size_t>(slide)] = place;
  ++count_;
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
  const std::filesystem::path& path = paths_[static_cast<std::size_t>(place.file)];
  if (place.file != reading_) file_ = std::ifstream(path, std::ios::binary);
  reading_ = place.file;
  file_.seekg(place.offset);
  std::string line;
  if (!std::getline(file_, line)) throw std::runtime_error(path.string() + ": cannot be read any more");
  return line;
}

void StudyResults::for_each_row(const std::function<void(const std::string& json)>& see) {
  for (std::int64_t slide = 0; slide < study_.slides; ++slide) {
    if (has(slide)) see(row(slide));
  }
}

StudyCounts StudyResults::finish() {
  if (count_ != study_.slides)
    throw std::logic_error(folder_.string() + ": " + std::to_string(study_.slides - count_) + " rows are missing");
  RenamedFile csv(folder_ / "slides.csv");
  RenamedFile rows(folder_ / kRows);
  csv.line(files::joined(columns_of(study_), ","));
  StudySummary summary(study_);
  std::vector<Place> places;
  std::int64_t offset = 0;
  for_each_row([&](const std::string& json) {
    summary.add(nlohmann::json::parse(json));
    csv.line(csv_of(json));
    rows.line(json);
    places.push_back({0, offset});
    offset += static_cast<std::int64_t>(json.size()) + 1;
  });
  csv.finish();
  rows.finish();
  RenamedFile numbers(folder_ / "study.json");
  numbers.line(summary.to_json().dump(2));
  numbers.finish();
  for (const std::filesystem::path& path : paths_) {
    if (path.filename() != kRows && path != journal_path_) remove_journal(path);
  }
  std::filesystem::remove(journal_path_);
  places_ = std::move(places);
  paths_ = {folder_ / kRows};
  reading_ = -1;
  is_finished_ = true;
  return {summary.rows(), summary.successes(), summary.problems(), *summary.rate()};
}

}  // namespace glissade::study
