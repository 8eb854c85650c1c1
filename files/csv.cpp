#include <algorithm>
#include <array>
#include <cassert>
#include <iostream>
#include <stdexcept>
#include <utility>

#include <glissade/files/csv.h>
#include <glissade/files/csv_columns.h>
#include <glissade/files/file_checks.h>
#include <glissade/files/pose_rules.h>
#include <glissade/files/text.h>
#include <glissade/files/text_file.h>

namespace glissade::files {

namespace {

std::string at_line(const std::string& source, std::size_t line) {
  return source + ":" + std::to_string(line);
}

/// Removes the next line from `text` and returns it without its line break, LF or CR LF.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

/// Replaces `line` by the next line, without its line break, LF or CR LF.
bool read_line(std::istream& file, std::string& line) {
  if (!std::getline(file, line)) return false;
  if (line.ends_with('\r')) line.pop_back();
  return true;
}

constexpr const char* kBlanks = " \t\r\n";

bool is_blank(std::string_view line) {
  return line.find_first_not_of(kBlanks) == std::string_view::npos;
}

/// Editors and spreadsheets leave blank lines at the end of a file.
std::string_view without_blank_end(std::string_view text) {
  const std::size_t last = text.find_last_not_of(kBlanks);
  if (last == std::string_view::npos) return {};
  return text.substr(0, text.find('\n', last));
}

[[noreturn]] void throw_no_rows(const std::string& source) {
  throw std::invalid_argument(at_line(source, 1) + ": the header is not followed by any row");
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t comma = line.find(','); comma != std::string_view::npos; comma = line.find(',')) {
    fields.push_back(line.substr(0, comma));
    line.remove_prefix(comma + 1);
  }
  fields.push_back(line);
  return fields;
}

/// The mark that some spreadsheets put before a text in UTF-8.
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

/// The columns of a file: these, or the same with angles in place of a quaternion.
std::vector<std::string> read_header(std::string_view line, const std::string& source,
                                     const std::vector<std::string>& columns) {
  if (line.starts_with(kByteOrderMark)) line.remove_prefix(kByteOrderMark.size());
  const std::vector<std::string_view> names = fields_of(line);
  for (const std::vector<std::string>& known : {columns, with_angles(columns)}) {
    if (std::equal(names.begin(), names.end(), known.begin(), known.end())) return known;
  }
  const std::string expected = header_of(columns);
  const std::string table = told_table(line);
  std::string without_spaces(line);
  std::erase(without_spaces, ' ');
  const std::vector<std::string> angles(kAngleColumns.begin(), kAngleColumns.end());
  const std::string other =
      with_angles(columns).empty() ? "" : " (or " + header_of(angles) + " in place of the quaternion)";
  throw std::invalid_argument(
      at_line(source, 1) + ": the header row must be " + expected + other + ", not " + in_quotes(line) +
      (without_spaces == expected || without_spaces == header_of(with_angles(columns)) ? "; leave out the spaces"
                                                                                       : "") +
      (table.empty() ? "" : "; this is " + table));
}

/// Whether spaces are all that is wrong with a number.
bool is_spaced(std::string_view field) {
  const std::size_t first = field.find_first_not_of(" \t");
  if (first == std::string_view::npos) return false;
  const std::size_t last = field.find_last_not_of(" \t");
  const std::string_view number = field.substr(first, last - first + 1);
  return number.size() < field.size() && parse_number(number).has_value();
}

/// Replaces angles in a row by the quaternion that they stand for.
void replace_angles(const std::vector<std::string>& columns, std::vector<double>& values) {
  const auto column = std::find(columns.begin(), columns.end(), kAngleColumns.front());
  if (column == columns.end()) return;
  const auto first = values.begin() + (column - columns.begin());
  const Eigen::Quaterniond q = rotation_of(first[0], first[1], first[2]);
  const std::array<double, 4> wxyz{q.w(), q.x(), q.y(), q.z()};
  values.insert(values.erase(first, first + 3), wxyz.begin(), wxyz.end());
}

void parse_row(std::string_view line, const std::string& where, const std::vector<std::string>& columns,
               std::vector<double>& values) {
  const std::vector<std::string_view> fields = fields_of(line);
  if (fields.size() != columns.size()) {
    throw std::invalid_argument(where + ": the row must have " + std::to_string(columns.size()) + " columns, not " +
                                std::to_string(line.empty() ? 0 : fields.size()));
  }
  values.clear();
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::optional<double> value = parse_number(fields[i]);
    if (!value) {
      throw std::invalid_argument(where + ": column " + columns[i] + ": " + in_quotes(fields[i]) +
                                  " is not a finite number" + (is_spaced(fields[i]) ? "; leave out the spaces" : ""));
    }
    values.push_back(*value);
  }
  replace_angles(columns, values);
}

}  // namespace

std::string CsvTable::where(std::size_t row) const {
  return at_line(source, row + 2);
}

CsvTable read_csv(const std::string& path, const std::vector<std::string>& columns) {
  return parse_csv(read_text_file(path), path, columns);
}

CsvTable parse_csv(std::string_view text, const std::string& source, const std::vector<std::string>& columns) {
  if (text.empty()) throw std::invalid_argument(source + ": the file is empty");
  const std::vector<std::string> in_file = read_header(take_line(text), source, columns);
  text = without_blank_end(text);
  CsvTable table{source, {}};
  while (!text.empty()) {
    const std::string where = table.where(table.rows.size());
    parse_row(take_line(text), where, in_file, table.rows.emplace_back());
  }
  if (table.rows.empty()) throw_no_rows(source);
  return table;
}

CsvReader::CsvReader(const std::string& path, const std::vector<std::string>& columns)
    : path_(path), file_(open_text_file(path)) {
  if (!read_line(file_, line_)) throw std::invalid_argument(path + ": the file is empty");
  columns_ = read_header(line_, path_, columns);
  if (file_.peek() == std::ifstream::traits_type::eof()) throw_no_rows(path_);
}

bool CsvReader::next() {
  if (!read_line(file_, line_) || (is_blank(line_) && only_blanks_follow())) {
    if (file_.bad()) throw std::invalid_argument(path_ + ": cannot be read");
    if (line_number_ == 1) throw_no_rows(path_);
    return false;
  }
  ++line_number_;
  parse_row(line_, where(), columns_, row_);
  return true;
}

bool CsvReader::only_blanks_follow() {
  std::string line;
  while (read_line(file_, line)) {
    if (!is_blank(line)) return false;  // the blank line before it is an error, so this one is not needed
  }
  return true;
}

std::string CsvReader::where() const {
  return at_line(path_, line_number_);
}

CsvWriter::CsvWriter(const std::string& path, const std::vector<std::string>& columns)
    : path_(path), columns_(columns.size()), out_(&std::cout) {
  if (path != "-") {
    file_ = open_output(path);
    out_ = &file_;
  }
  for (const std::string& column : columns)
    add(column);
  end_row();
}

CsvWriter& CsvWriter::add(double value) {
  return add(std::string_view{format_number(value)});
}

CsvWriter& CsvWriter::add(std::int64_t value) {
  return add(std::string_view{std::to_string(value)});
}

CsvWriter& CsvWriter::add(const Eigen::Vector3d& v) {
  return add(v.x()).add(v.y()).add(v.z());
}

CsvWriter& CsvWriter::add(const Eigen::Isometry3d& X) {
  Eigen::Quaterniond q(X.linear());
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  add(Eigen::Vector3d(X.translation()));
  return add(q.w()).add(q.x()).add(q.y()).add(q.z());
}

CsvWriter& CsvWriter::add(std::string_view text) {
  assert(text.find_first_of(",\"\n") == std::string_view::npos);
  if (values_in_row_ > 0) *out_ << ',';
  *out_ << text;
  ++values_in_row_;
  return *this;
}

void CsvWriter::end_row() {
  assert(values_in_row_ == columns_);
  *out_ << '\n';
  values_in_row_ = 0;
}

void CsvWriter::close() {
  out_->flush();
  if (!*out_)
    throw std::runtime_error((path_ == "-" ? "standard output" : path_) + ": not everything could be written");
}

}  // namespace glissade::files
