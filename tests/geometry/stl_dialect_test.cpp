// What exporters write into STL files, beside the format and within it.

#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cube_files.h"

namespace glissade::geometry {
namespace {

using testing::HasSubstr;

class StlDialect : public Dialect {
 protected:
  void expect_stl(const std::string& content, const std::vector<std::string>& warnings = {}) const {
    expect_cube("a.stl", content, warnings);
  }
};

/// `attribute` stands in the last two bytes of each triangle.
std::string binary_cube(std::string header, const std::string& attribute = std::string(2, '\0')) {
  header.resize(80, ' ');
  std::string file = header + bytes_of<std::uint32_t>({12});
  for (const auto& face : kCubeFaces) {
    file += bytes_of<float>({0, NAN, 0});
    for (const int i : face)
      file += bytes_of<float>({static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1), static_cast<float>(i >> 2)});
    file += attribute;
  }
  return file;
}

TEST_F(StlDialect, KeywordsStandTogetherOrApart) {
  expect_stl(with_all(cube_stl(), "endloop", "end loop"));
  expect_stl(with_all(with_all(cube_stl(), "endfacet", "end facet"), "outer loop", "outerloop"));
  expect_stl(with(cube_stl(), "endsolid cube", "endsolidAssimpScene"));
  expect_stl(with(cube_stl(), "endsolid cube", "end solid cube"));
  expect_stl(with(cube_stl(), "endsolid cube", "endsolid"));
  expect_stl(with(with_all(cube_stl(), "facet", "FACET"), "solid cube", "Solid"));
}

TEST_F(StlDialect, WhatIsMissingIsWarnedOf) {
  const std::string no_end = with(cube_stl(), "endsolid cube\n", "");
  const std::string warning = "1 'endsolid' is missing at the end of the file, which may have been cut off (line 85).";
  expect_stl(no_end, {warning});
  expect_stl(no_end.substr(0, no_end.size() - 1), {warning});
  expect_stl(with(cube_stl(), "endsolid cube", "endso"),
             {"1 unknown statement is skipped (line 86, 'endso').",
              "1 'endsolid' is missing at the end of the file, which may have been cut off (line 86)."});
  expect_stl("solid cube\n" + cube_stl(), {"1 solid begins before the one before it has ended (line 2)."});
  expect_stl(with(cube_stl(), "solid cube\n", ""), {"12 facets are outside of every solid (the first: line 1)."});
  expect_stl(with(cube_stl(), "endloop\n", ""), {"1 facet lacks its 'endloop' or 'endfacet' (line 7)."});
  expect_stl(with(with_all(cube_stl(), "endfacet\n", ""), "endloop\n", ""),
             {"12 facets lack 'endloop' or 'endfacet' (the first: line 6)."});
}

TEST_F(StlDialect, OtherLinesAreSkippedWithAWarning) {
  expect_stl("; made by hand\n" + cube_stl(), {"1 unknown statement is skipped (line 1, ';')."});
  expect_stl(with_all(cube_stl(), "endfacet\n", "endfacet\ncolor 1 0 0\n"),
             {"12 unknown statements are skipped (the first: line 9, 'color')."});
}

TEST_F(StlDialect, AnyLineEndingIsRead) {
  for (const char* end : {" ", "\r", "\r\n", "\n\n", "\r\r\n", "\t\n  "}) {
    expect_stl(with_all(cube_stl(), "\n", end));
  }
  expect_stl(cube_stl().substr(0, cube_stl().size() - 1));
  expect_stl("\n\n" + with_all(cube_stl(), "\nvertex", " vertex"));
}

TEST_F(StlDialect, NamesMayBeAnything) {
  for (const char* name :
       {"", "a solid facet", "endsolid", "facet", "the 'outer loop' vertex", "T\xC3\xBCr", "\xE9\x01"}) {
    SCOPED_TRACE(name);
    expect_stl(with_all(cube_stl(), "solid cube", "solid " + std::string(name)));
  }
}

TEST_F(StlDialect, SeveralSolidsAreOneMesh) {
  const std::string cube = cube_stl();
  const std::size_t middle = cube.find("facet normal", cube.size() / 2);
  for (const char* between : {"endsolid cube\nsolid other\n", "endsolid\n\nsolid\n", "endsolidcube\nsolid\n"}) {
    const std::string two = cube.substr(0, middle) + between + cube.substr(middle);
    expect_stl(two);
    expect_stl(with_all(two, "\n", " "));
  }
}

TEST_F(StlDialect, NormalsAreNotRead) {
  for (const char* normal : {"normal nan nan nan", "normal -nan(ind) 0 0", "normal 1.#QNAN -1.#IND 1.#J", "normal", "",
                             "normal ? ? ?", "normal 0 0 1 0"}) {
    SCOPED_TRACE(normal);
    expect_stl(with_all(cube_stl(), "normal 0 0 1", normal));
  }
}

TEST_F(StlDialect, TextWithZeroBytesOrInUtf16IsNamed) {
  EXPECT_THAT(error_of("a.stl", cube_stl() + std::string(16, '\0')),
              HasSubstr("line 87: 16 zero bytes from here on in a text"));
  EXPECT_THAT(error_of("a.stl", cube_stl() + std::string(5000, '\n') + std::string(1, '\0')),
              HasSubstr("line 5087: a zero byte in a text"));
  EXPECT_THAT(error_of("a.stl", with(cube_stl(), "cube", std::string("c\0be", 4))), HasSubstr("line 1: a zero byte"));
  EXPECT_THAT(error_of("a.stl", "# by hand\n" + cube_stl() + std::string(1, '\0')), HasSubstr("line 88: a zero byte"));
  std::string wide;
  for (const char c : cube_stl())
    wide += std::string{c, '\0'};
  for (const std::string& text : {wide, "\xff\xfe" + wide}) {
    EXPECT_THAT(error_of("a.stl", text), HasSubstr("UTF-16"));
  }
}

TEST_F(StlDialect, BinaryFilesMayBeginAsText) {
  for (const char* header : {"solid cube", "solid facet vertex", "COLOR=", "\xff\xfe", "facet", ""}) {
    expect_stl(binary_cube(header));
    expect_stl(binary_cube(header, "\xff\x7f"));
  }
}

/// Up to 49 bytes cannot be a triangle.
TEST_F(StlDialect, BinaryFilesHaveTheSizeThatTheirHeaderSays) {
  const std::string cube = binary_cube("solid");
  expect_stl(cube + "\n", {"1 byte after the last triangle is skipped (byte 684)."});
  expect_stl(cube + std::string(49, 'x'), {"49 bytes after the last triangle are skipped (the first: byte 684)."});
  EXPECT_THAT(error_of("a.stl", cube + std::string(50, 'x')),
              HasSubstr("its header says 12 triangles, which take 684 bytes, but it has 734 bytes, enough for 13"));
  EXPECT_THAT(
      error_of("a.stl", cube.substr(0, 683)),
      HasSubstr("truncated: its header says 12 triangles, which take 684 bytes, but it has 683 bytes, enough for "
                "11"));
  std::string none = cube;
  none.replace(80, 4, bytes_of<std::uint32_t>({0}));
  EXPECT_THAT(error_of("a.stl", none), HasSubstr("its header says 0 triangles"));
}

TEST_F(StlDialect, MalformedFacetIsAnError) {
  const std::vector<std::vector<std::string>> cases{
      {"vertex 0 1 0", "vertex 0 1", "line 6: a coordinate is not a number"},
      {"vertex 0 1 0\n", "", "line 6: 'vertex' should stand here"},
      {"endloop", "vertex 0 0 0\nendloop", "line 7: 'endloop' should stand here"},
      {"facet normal", "face normal", "line 3: 'outer' stands outside of a facet"},
      {"outer loop\n", "", "line 3: 'outer loop' should stand here"},
      {"vertex 0 1 0", "vertex 0 1,0 0", "line 5: a coordinate is not a number"},
      {"vertex 0 1 0", "vertex 0 -1.#IND 0", "line 5: the coordinate nan is not finite"},
  };
  for (const std::vector<std::string>& c : cases) {
    SCOPED_TRACE(c[1]);
    EXPECT_THAT(error_of("a.stl", with(cube_stl(), c[0], c[1])), HasSubstr(c[2]));
  }
}

}  // namespace
}  // namespace glissade::geometry
