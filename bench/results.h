#pragma once

/// The figures of a run: the rows of results.csv, `bench,case,subject,metric,value,unit`.

#include <filesystem>
#include <string>
#include <vector>

namespace glissade::bench {

double geometric_mean(const std::vector<double>& values);

struct Row {
  std::string bench;
  std::string case_name;
  std::string subject;
  std::string metric;
  double value;
  std::string unit;
};

class Results {
 public:
  void add(Row row) { rows_.push_back(std::move(row)); }
  const std::vector<Row>& rows() const { return rows_; }

  /// Appends to a bench the cases `geomean` and `worst`: the ratio of the time of each peer to that of Glissade, and to
  /// that of each variant that ran in all cases (`ratio_to_fcl`; larger is better).
  void add_ratios(const std::string& bench, const std::vector<std::string>& peers);

  /// The same for the cases whose names end in one of `endings`, as the cases `GROUP-geomean` and `GROUP-worst`; only
  /// for the metric `time`.
  void add_group_ratios(const std::string& bench, const std::string& group, const std::vector<std::string>& endings,
                        const std::vector<std::string>& peers);

  /// Throws std::runtime_error when the file cannot be written.
  void write_csv(const std::filesystem::path& path) const;

 private:
  std::vector<Row> rows_;
};

}  // namespace glissade::bench
