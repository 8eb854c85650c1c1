#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/files/csv.h>
#include <glissade/files/text.h>

#include "expect_bad_input.h"
#include "temporary_folder.h"

namespace glissade::files {
namespace {

using test_support::expect_bad_input;
using test_support::TemporaryFolder;

const std::vector<std::string> kColumns{"t_s", "x_m"};

CsvTable parse_table(const std::string& text) {
  return parse_csv(text, "table.csv", kColumns);
}

TEST(Csv, ReadsRowsOfNumbers) {
  const CsvTable table = parse_table("t_s,x_m\n0,1.5\n-2e-3,.25\n");
  EXPECT_THAT(table.rows, testing::ElementsAre(std::vector<double>{0.0, 1.5}, std::vector<double>{-2e-3, 0.25}));
  EXPECT_EQ(table.where(1), "table.csv:3");
}

TEST(Csv, LineBreaksMayBeOfEitherKindAndTheLastOneMayBeMissing) {
  EXPECT_EQ(parse_table("t_s,x_m\r\n1,2\r\n3,4").rows, parse_table("t_s,x_m\n1,2\n3,4\n").rows);
}

TEST(Csv, TheHeaderMustBeExact) {
  expect_bad_input([] { parse_table("t_s,y_m\n1,2\n"); }, {"table.csv:1:", "t_s,x_m", "'t_s,y_m'"});
  expect_bad_input([] { parse_table("t_s,x_m,y_m\n1,2,3\n"); }, {"table.csv:1:", "t_s,x_m,y_m"});
  expect_bad_input([] { parse_table("1,2\n3,4\n"); }, {"table.csv:1:", "'1,2'"});
}

TEST(Csv, AByteOrderMarkBeforeTheHeaderIsSkipped) {
  const std::string marked = "\xef\xbb\xbft_s,x_m\n1,2\n";
  EXPECT_EQ(parse_table(marked).rows.size(), 1u);
  const TemporaryFolder folder;
  CsvReader reader(folder.write("marked.csv", marked), kColumns);
  EXPECT_TRUE(reader.next());
  expect_bad_input(
      [] {
        parse_table(
            "t_s,x_m\n\xef\xbb\xbf"
            "1,2\n");
      },
      {"table.csv:2:"});
}

TEST(Csv, BlankLinesAtTheEndAreSkipped) {
  const TemporaryFolder folder;
  for (const std::string end : {"", "\n", "\n\n", "\r\n\r\n", "\n  \n\t"}) {
    const std::string text = "t_s,x_m\n1,2\n3,4" + end;
    EXPECT_EQ(parse_table(text).rows.size(), 2U) << text;
    CsvReader reader(folder.write("table.csv", text), kColumns);
    EXPECT_TRUE(reader.next());
    EXPECT_TRUE(reader.next());
    EXPECT_FALSE(reader.next());
    EXPECT_EQ(reader.row().front(), 3.0);
  }
}

TEST(Csv, ABlankLineBetweenRowsIsAnError) {
  const TemporaryFolder folder;
  CsvReader reader(folder.write("table.csv", "t_s,x_m\n1,2\n\n3,4\n"), kColumns);
  EXPECT_TRUE(reader.next());
  expect_bad_input([&] { reader.next(); }, {"table.csv:3:", "2 columns, not 0"});
}

TEST(Csv, SpacesInTheHeaderAreNamed) {
  expect_bad_input([] { parse_table("t_s, x_m\n1,2\n"); }, {"not 't_s, x_m'; leave out the spaces"});
}

TEST(Csv, SpacesAroundANumberAreNamed) {
  expect_bad_input([] { parse_table("t_s,x_m\n1, 2\n"); }, {"' 2' is not a finite number; leave out the spaces"});
  expect_bad_input([] { parse_table("t_s,x_m\n1,2 \n"); }, {"'2 '", "spaces"});
  try {
    parse_table("t_s,x_m\n1, left\n");
    ADD_FAILURE();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::EndsWith("is not a finite number")) << "the spaces are not what is wrong";
  }
}

TEST(Csv, AWrongNumberOfColumnsNamesTheLine) {
  expect_bad_input([] { parse_table("t_s,x_m\n1,2\n3\n"); }, {"table.csv:3:", "2 columns, not 1"});
  expect_bad_input([] { parse_table("t_s,x_m\n1,2,3\n"); }, {"table.csv:2:", "2 columns, not 3"});
  expect_bad_input([] { parse_table("t_s,x_m\n1,2\n\n3,4\n"); }, {"table.csv:3:", "2 columns, not 0"});
}

TEST(Csv, WhatIsNotAFiniteNumberNamesLineColumnAndValue) {
  for (const std::string bad : {"left", "nan", "inf", "-inf", "1e999", "", " 1", "1 ", "1;2", "0x10", "\"1\""}) {
    expect_bad_input([&] { parse_table("t_s,x_m\n1,2\n1," + bad + "\n"); },
                     {"table.csv:3:", "column x_m", "'" + bad + "'"});
  }
}

TEST(Csv, BinaryFileMakesAShortErrorMessage) {
  const std::string garbage(10000, '\x01');
  expect_bad_input([&] { parse_table(garbage); }, {"table.csv:1:"});
  expect_bad_input([&] { parse_table("t_s,x_m\n1," + std::string(10000, 'x')); }, {"'xxxxx", "...'"});
}

TEST(Csv, ATableWithoutRowsIsAnError) {
  expect_bad_input([] { parse_table(""); }, {"table.csv: the file is empty"});
  expect_bad_input([] { parse_table("t_s,x_m\n"); }, {"table.csv:1:", "not followed by any row"});
  expect_bad_input([] { parse_table("t_s,x_m\n\n"); }, {"table.csv:1:", "not followed by any row"});
  const TemporaryFolder folder;
  CsvReader reader(folder.write("table.csv", "t_s,x_m\n\n"), kColumns);
  expect_bad_input([&] { reader.next(); }, {"table.csv:1:", "not followed by any row"});
}

TEST(Csv, FilesThatCannotBeReadAreNamed) {
  const TemporaryFolder folder;
  expect_bad_input([&] { read_csv(folder.path("none.csv"), kColumns); }, {"none.csv: there is no such file"});
  expect_bad_input([&] { read_csv(folder.path(""), kColumns); }, {folder.path("") + ": is a folder"});
}

TEST(CsvWriter, WrittenNumbersReadBackAsTheSameBits) {
  const TemporaryFolder folder;
  const std::string path = folder.path("out.csv");
  const std::vector<double> values{
      0.1,          1.0 / 3.0, -1e-300, std::numeric_limits<double>::max(), std::numeric_limits<double>::denorm_min(),
      123456789.125};
  CsvWriter writer(path, kColumns);
  for (const double value : values) {
    writer.add(std::int64_t{7}).add(value);
    writer.end_row();
  }
  writer.close();

  const CsvTable table = read_csv(path, kColumns);
  ASSERT_EQ(table.rows.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(table.rows[i], (std::vector<double>{7.0, values[i]}));
  }
}

TEST(CsvWriter, AFileThatCannotBeMadeIsNamed) {
  const TemporaryFolder folder;
  expect_bad_input([&] { CsvWriter(folder.path("none/out.csv"), kColumns); }, {"none/out.csv", "there is no folder"});
}

TEST(CsvWriter, FullDiskThrowsARuntimeError) {
  CsvWriter writer("/dev/full", kColumns);
  EXPECT_THROW(writer.close(), std::runtime_error);
}

TEST(Text, QuotedTextStaysShortAndOnOneLine) {
  EXPECT_EQ(in_quotes("a\r\nb"), "'a b'");
  EXPECT_LT(in_quotes(std::string(1000, 'a')).size(), 80U);
}

}  // namespace
}  // namespace glissade::files
