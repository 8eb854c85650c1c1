#pragma once

/// The built program, run as its users do.

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "process.h"

namespace glissade::test_support {

/// The network on which programs of a test find each other.
inline constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=0";

/// Runs `glissade` with the arguments and waits for its end.
inline ProgramResult glissade(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), GLISSADE_PROGRAM);
  return Process(arguments).wait();
}

/// The cells of one line of the CSV it prints.
inline std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');)
    cells.push_back(cell);
  if (line.ends_with(',')) cells.emplace_back();
  return cells;
}

/// Rows of CSV below its header, each cell by the name of its column.
using CsvRow = std::map<std::string, std::string>;

inline std::vector<CsvRow> rows_of(const std::string& csv) {
  std::istringstream in(csv);
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> header = split(line);
  std::vector<CsvRow> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = split(line);
    EXPECT_EQ(cells.size(), header.size()) << line;
    CsvRow& row = rows.emplace_back();
    for (std::size_t i = 0; i < std::min(header.size(), cells.size()); ++i)
      row[header[i]] = cells[i];
  }
  return rows;
}

/// How far from what it touches `slide` may say that a part rests, where no margin is asked for.
constexpr double kTwoMargins = 20e-6;

/// Expects an exit code and one line on standard error that holds every one of `parts`.
inline void expect_fails(int exit_code, const std::vector<std::string>& arguments,
                         const std::vector<std::string>& parts) {
  const ProgramResult result = glissade(arguments);
  const std::string& message = result.standard_error;
  EXPECT_EQ(result.exit_code, exit_code) << message;
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1) << message;
  EXPECT_TRUE(message.starts_with("glissade: ") && message.ends_with("\n")) << message;
  for (const std::string& part : parts)
    EXPECT_THAT(message, testing::HasSubstr(part));
}

/// Expects that bad input or usage is refused.
inline void expect_refused(const std::vector<std::string>& arguments, const std::vector<std::string>& parts) {
  expect_fails(2, arguments, parts);
}

}  // namespace glissade::test_support
