#pragma once

/// The figures of a run: rows of `bench,case,subject,metric,value,unit`, as results.csv holds them.

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

  /// Appends to a bench its cases `geomean` and `worst`: how many times faster than each peer (`ratio_to_fcl`, larger
  /// is better) Glissade is, and each variant of it that ran in all of the cases.
  void add_ratios(const std::string& bench, const std::vector<std::string>& peers);

  /// The same for some cases, those that end so, as the cases `GROUP-geomean` and `GROUP-worst`; only of `time`.
  void add_group_ratios(const std::string& bench, const std::string& group, const std::vector<std::string>& endings,
                        const std::vector<std::string>& peers);

  /// Throws std::runtime_error when the file cannot be written.
  void write_csv(const std::filesystem::path& path) const;

 private:
  std::vector<Row> rows_;
};

}  // namespace glissade::bench
