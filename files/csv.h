#pragma once

/// Tables of numbers as CSV: a header row, decimal points, commas, no quoting.

#include <cstdint>
#include <fstream>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

namespace glissade::files {

/// The rows of a CSV file; every value is finite.
struct CsvTable {
  std::string source;                     ///< the file's name, for messages
  std::vector<std::vector<double>> rows;  ///< row i has one value per column and stands on line i + 2

  /// "source:line" of row `row`.
  std::string where(std::size_t row) const;
};

/// Reads a file whose header row is `columns` or `with_angles(columns)`. Angles are converted to a quaternion. Blank
/// lines at the end are skipped.
///
/// Throws std::invalid_argument, naming file, line, column and value, in these cases: the file is missing, is a folder
/// or is not readable; the header is different; there are no rows; a row has a wrong number of columns; or a value is
/// not a finite number.
CsvTable read_csv(const std::string& path, const std::vector<std::string>& columns);

/// Like `read_csv`, for a text in memory. `source` replaces the file's name in messages.
CsvTable parse_csv(std::string_view text, const std::string& source, const std::vector<std::string>& columns);

/// Reads a CSV file row by row, so that the memory does not grow with the file. The rules and errors are those of
/// `read_csv`.
class CsvReader {
 public:
  /// Opens the file and reads its header row.
  CsvReader(const std::string& path, const std::vector<std::string>& columns);

  /// Reads the next row; false at the end of the file.
  bool next();
  /// The last row read; it has one value for each column.
  const std::vector<double>& row() const { return row_; }
  /// The place of the last row read, as "file:line".
  std::string where() const;

 private:
  bool only_blanks_follow();

  std::string path_;
  std::vector<std::string> columns_;  // of the file
  std::ifstream file_;
  std::string line_;
  std::size_t line_number_ = 1;
  std::vector<double> row_;
};

/// Writes a CSV file row by row. Numbers read back exactly. Not thread-safe.
class CsvWriter {
 public:
  /// Opens the file `path`, or standard output if `path` is "-", and writes the header row. Throws
  /// std::invalid_argument if the file cannot be created.
  CsvWriter(const std::string& path, const std::vector<std::string>& columns);

  /// Appends one value to the current row.
  CsvWriter& add(double value);
  CsvWriter& add(std::int64_t value);
  /// Appends the three coordinates.
  CsvWriter& add(const Eigen::Vector3d& v);
  /// Appends position and orientation as seven values: x, y, z and a quaternion qw, qx, qy, qz with qw >= 0.
  CsvWriter& add(const Eigen::Isometry3d& X);
  /// `text` must not contain a comma, a quote or a line break.
  CsvWriter& add(std::string_view text);

  /// Ends the row; it must have one value per column.
  void end_row();

  /// Flushes the output. Throws std::runtime_error if not everything could be written, for example on a full disk. Call
  /// this function after the last row, because the destructor cannot report a failure. Further rows may follow. So call
  /// it earlier if a reader should not wait for the end.
  void close();

 private:
  std::string path_;
  std::size_t columns_;
  std::size_t values_in_row_ = 0;
  std::ofstream file_;
  std::ostream* out_;
};

}  // namespace glissade::files
