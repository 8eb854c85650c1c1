#include "results.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <stdexcept>

namespace glissade::bench {
namespace {

using TimeOfCase = std::map<std::string, double>;

// Nine digits: enough to recompute every figure, and equal runs give equal files.
std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

std::vector<double> ratios(const TimeOfCase& ours, const TimeOfCase& theirs) {
  std::vector<double> result;
  for (const auto& [case_name, time] : theirs) {
    if (const auto found = ours.find(case_name); found != ours.end()) result.push_back(time / found->second);
  }
  return result;
}

}  // namespace

double geometric_mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values)
    sum += std::log(value);
  return std::exp(sum / static_cast<double>(values.size()));
}

void Results::add_ratios(const std::string& bench, const std::vector<std::string>& peers) {
  std::map<std::string, std::map<std::string, TimeOfCase>> times;  // by metric and subject
  for (const Row& row : rows_) {
    if (row.bench == bench && row.metric.starts_with("time")) times[row.metric][row.subject][row.case_name] = row.value;
  }
  for (const std::string& peer : peers) {
    // Slow ones took a sample of the poses.
    auto& by_subject = times[times["time"].contains(peer) ? "time" : "time_sample"];
    const TimeOfCase theirs = by_subject[peer];
    const std::size_t cases = by_subject["glissade"].size();
    for (const auto& [subject, ours] : by_subject) {
      const std::vector<double> all = ratios(ours, theirs);
      if (!subject.starts_with("glissade") || ours.size() != cases || all.empty()) continue;
      add({bench, "geomean", subject, "ratio_to_" + peer, geometric_mean(all), "x"});
      add({bench, "worst", subject, "ratio_to_" + peer, *std::min_element(all.begin(), all.end()), "x"});
    }
  }
}

void Results::add_group_ratios(const std::string& bench, const std::string& group,
                               const std::vector<std::string>& endings, const std::vector<std::string>& peers) {
  std::map<std::string, TimeOfCase> times;  // by subject
  for (const Row& row : rows_) {
    const bool is_in_group = std::any_of(endings.begin(), endings.end(),
                                         [&](const std::string& ending) { return row.case_name.ends_with(ending); });
    if (row.bench == bench && row.metric == "time" && is_in_group) times[row.subject][row.case_name] = row.value;
  }
  for (const auto& [subject, ours] : times) {
    if (!subject.starts_with("glissade")) continue;
    for (const std::string& peer : peers) {
      const std::vector<double> all = ratios(ours, times[peer]);
      if (all.empty()) continue;
      add({bench, group + "-geomean", subject, "ratio_to_" + peer, geometric_mean(all), "x"});
      add({bench, group + "-worst", subject, "ratio_to_" + peer, *std::min_element(all.begin(), all.end()), "x"});
    }
  }
}

void Results::write_csv(const std::filesystem::path& path) const {
  std::ofstream file(path);
  file << "bench,case,subject,metric,value,unit\n";
  for (const Row& row : rows_) {
    file << row.bench << ',' << row.case_name << ',' << row.subject << ',' << row.metric << ',' << number(row.value)
         << ',' << row.unit << '\n';
  }
  file.close();
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace glissade::bench
