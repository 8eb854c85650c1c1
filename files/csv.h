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

/// Reads a file whose header row is exactly `columns`, or has angles in place of a quaternion (`with_angles`): rows
/// have the quaternion. Blank lines at the end are skipped.
///
/// Throws std::invalid_argument, naming file, line, column and value, for a file that is missing, a folder or not
/// readable, for another header, no rows or a wrong number of columns, and for a value that is not a finite number.
CsvTable read_csv(const std::string& path, const std::vector<std::string>& columns);

/// The same for a text in memory; `source` replaces the file's name in messages.
CsvTable parse_csv(std::string_view text, const std::string& source, const std::vector<std::string>& columns);

/// Reads a CSV file row by row, so that memory does not grow with it. The rules and errors are those of `read_csv`.
class CsvReader {
 public:
  /// Opens the file and reads its header row.
  CsvReader(const std::string& path, const std::vector<std::string>& columns);

  /// Reads the next row; false at the end of the file.
  bool next();
  /// The row read last, a value for each column.
  const std::vector<double>& row() const { return row_; }
  /// Its place as "file:line".
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

/// Writes a CSV file row by row; numbers read back as exactly the values written. Not thread-safe.
class CsvWriter {
 public:
  /// Opens `path`, or standard output when it is "-", and writes the header row.
  /// Throws std::invalid_argument when the file cannot be created.
  CsvWriter(const std::string& path, const std::vector<std::string>& columns);

  /// Appends one value to the current row.
  CsvWriter& add(double value);
  CsvWriter& add(std::int64_t value);
  /// Its three coordinates.
  CsvWriter& add(const Eigen::Vector3d& v);
  /// Position and orientation, seven values: x, y, z and a quaternion qw, qx, qy, qz with qw >= 0.
  CsvWriter& add(const Eigen::Isometry3d& X);
  /// `text` must hold no comma, quote or line break.
  CsvWriter& add(std::string_view text);

  /// Ends the row; it must have one value per column.
  void end_row();

  /// Flushes. Throws std::runtime_error when not everything could be written, for example on a full disk. Call it at
  /// the end: the destructor reports no failure. More rows may follow it, where a reader should not wait for the end.
  void close();

 private:
  std::string path_;
  std::size_t columns_;
  std::size_t values_in_row_ = 0;
  std::ofstream file_;
  std::ostream* out_;
};

}  // namespace glissade::files
