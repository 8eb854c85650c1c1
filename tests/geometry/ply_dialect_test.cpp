// What exporters write into PLY files, beside the format and within it.

#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cube_files.h"

namespace glissade::geometry {
namespace {

using testing::HasSubstr;

class PlyDialect : public Dialect {
 protected:
  void expect_ply(const std::string& content, const std::vector<std::string>& warnings = {}) const {
    expect_cube("a.ply", content, warnings);
  }
};

std::string header_of(const std::string& format) {
  return with(cube_ply_header(), "ascii", format);
}

/// After a header with one uchar for the count of a list, and ints for its entries.
std::string binary_body(bool is_big_endian, const std::vector<std::vector<std::int32_t>>& more_faces = {}) {
  std::string body;
  for (int i = 0; i < 8; ++i) {
    body += bytes_of<float>({static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1), static_cast<float>(i >> 2)},
                            is_big_endian);
  }
  for (const std::vector<std::int32_t>& face : more_faces) {
    body += static_cast<char>(face.size());
    for (const std::int32_t corner : face)
      body += bytes_of<std::int32_t>({corner}, is_big_endian);
  }
  for (const auto& [a, b, c] : kCubeFaces)
    body += '\3' + bytes_of<std::int32_t>({a, b, c}, is_big_endian);
  return body;
}

TEST_F(PlyDialect, FacesOfFewerThanThreeCornersAreLeftOut) {
  const std::string header = with(cube_ply_header(), "face 12", "face 15");
  const std::string body = cube_ply_corners() + "0\n1 5\n" + cube_ply_faces() + "2 1 2\n";
  expect_ply(header + body, {"3 faces have fewer than 3 corners and are left out (the first: line 18, face 0)."});
  for (const bool is_big : {false, true}) {
    const std::string binary = header_of(is_big ? "binary_big_endian" : "binary_little_endian");
    expect_ply(with(binary, "face 12", "face 13") + binary_body(is_big, {{}}),
               {"1 face has fewer than 3 corners and is left out (face 0)."});
    expect_ply(with(binary, "face 12", "face 15") + binary_body(is_big, {{}, {99}, {-1, 7}}),
               {"3 faces have fewer than 3 corners and are left out (the first: face 0)."});
  }
}

TEST_F(PlyDialect, UnusedPropertiesNeedNotBeNumbers) {
  const std::string header = with(cube_ply_header(), "property float z\n",
                                  "property float z\nproperty float nx\nproperty list uchar float t\n");
  for (const char* number : {"-1.#IND", "1.#QNAN", "nan", "-nan(ind)", "1.#J", "?", "NULL"}) {
    SCOPED_TRACE(number);
    const std::string word = " " + std::string(number);
    expect_ply(header + with_all(cube_ply_corners(), "\n", word + " 2" + word + word + "\n") + cube_ply_faces());
  }
}

TEST_F(PlyDialect, OnlyVerticesOfFacesMustBeFinite) {
  const std::string header = with(cube_ply_header(), "vertex 8", "vertex 9");
  for (const char* number : {"-1.#IND", "nan", "inf", "1e999", "1e300"}) {
    SCOPED_TRACE(number);
    const std::string corners = cube_ply_corners() + "0 0 " + number + "\n";
    expect_ply(header + corners + cube_ply_faces());
    EXPECT_THAT(error_of("a.ply", header + corners + with(cube_ply_faces(), "3 0 2 3", "3 0 2 8")),
                HasSubstr("vertex 8, of a face: the coordinate"));
  }
}

/// The cube as two strips: round its four sides, and its top and bottom. The bottom begins anew after -1.
const std::string kSides = "4 0 5 1 7 3 6 2 4 0";
const std::string kEnds = "0 2 1 3 -1 4 5 6 7";

TEST_F(PlyDialect, StripsAreRead) {
  const std::string header =
      with(cube_ply_header(), "element face 12\nproperty list uchar", "element tristrips 1\nproperty list int");
  expect_ply(header + cube_ply_corners() + "20 " + kSides + " -1 " + kEnds + "\n");
  expect_ply(header + cube_ply_corners() + "21 " + kEnds + " -1 " + kSides + " -1\n");
  expect_ply(header + cube_ply_corners() + "24 -1 -1 " + kEnds + " -1 -1 " + kSides + " -1\n");
  expect_ply(with(header, "tristrips 1", "tristrips 2") + cube_ply_corners() + "10 " + kSides + "\n9 " + kEnds + "\n");
  expect_ply(header + cube_ply_corners() + "25 3 -1 4 5 -1 " + kSides + " -1 " + kEnds + "\n",
             {"2 strips have fewer than 3 corners and are left out (the first: line 18, tristrips 0)."});
  EXPECT_THAT(error_of("a.ply", header + cube_ply_corners() + "4 0 1 -2 3\n"), HasSubstr("index -2 is out of range"));
  EXPECT_THAT(error_of("a.ply", header + cube_ply_corners() + "4 0 1 8 3\n"), HasSubstr("index 8 is out of range"));
  EXPECT_THAT(error_of("a.ply", header + cube_ply_corners() + "3 -1 -1 -1\n"), HasSubstr("no faces"));
  EXPECT_THAT(error_of("a.ply", with(header, "vertex_indices", "corners") + cube_ply_corners() + "4 0 1 2 3\n"),
              HasSubstr("the element tristrips one list vertex_indices"));
}

TEST_F(PlyDialect, StripsBesideFacesAreRead) {
  const std::string strips = "element tristrips 1\nproperty list int int vertex_index\n";
  const std::string header = with(with(cube_ply_header(), "face 12", "face 4"), "end_header", strips + "end_header");
  const std::string ends = cube_ply_faces().substr(0, 4 * std::string("3 0 2 3\n").size());
  expect_ply(header + cube_ply_corners() + ends + "10 " + kSides + "\n");
  EXPECT_EQ(import("a.ply", header + cube_ply_corners() + ends + "9 0 1 2 3 -1 4 5 6 7\n").mesh.triangles.size(), 8U);
}

TEST_F(PlyDialect, OtherElementsThatListVerticesAreWarnedOf) {
  const std::string patch = "element patch 2\nproperty list uchar int vertex_indices\n";
  expect_ply(with(cube_ply_header(), "end_header", patch + "end_header") + cube_ply_corners() + cube_ply_faces() +
                 "4 0 1 2 3\n3 0 1 2\n",
             {"2 elements other than faces and strips list vertices and are left out (the first: line 32, patch 0)."});
}

TEST_F(PlyDialect, UnknownElementsMayStandAnywhere) {
  const std::string edges = "element edge 2\nproperty int vertex1\nproperty list uint8 double w\n";
  const std::string lines = "0 2 .5 .5\n7 0\n";
  expect_ply(with(cube_ply_header(), "element vertex", edges + "element vertex") + lines + cube_ply_corners() +
             cube_ply_faces());
  expect_ply(with(cube_ply_header(), "element face", edges + "element face") + cube_ply_corners() + lines +
             cube_ply_faces());
  expect_ply(with(cube_ply_header(), "end_header", edges + "end_header") + cube_ply_corners() + cube_ply_faces() +
             lines);
}

TEST_F(PlyDialect, CommentsMayStandAnywhere) {
  const std::string comment = "comment 3 0 1 2\nobj_info\n";
  for (const char* place : {"format", "element vertex", "property float y", "element face", "end_header"}) {
    expect_ply(with(cube_ply(), place, comment + place));
  }
  expect_ply(cube_ply_header() + comment + cube_ply_corners() + comment + cube_ply_faces() + comment);
}

TEST_F(PlyDialect, HeaderMayHaveAnyLineEnding) {
  for (const char* end : {"\r", "\r\n", " \n", " \r\n"}) {
    SCOPED_TRACE(end);
    expect_ply(with_all(cube_ply(), "\n", end));
    for (const bool is_big : {false, true}) {
      const std::string header = header_of(is_big ? "binary_big_endian" : "binary_little_endian");
      expect_ply(with_all(header, "\n", end) + binary_body(is_big));
    }
  }
}

/// The body begins with the coordinate 0.0 of the first vertex, or with a property whose first byte is a line feed.
TEST_F(PlyDialect, ALineFeedAfterAHeaderOfCarriageReturnsIsData) {
  const std::string tag = "element tag 1\nproperty uchar value\n";
  const std::string header = with(header_of("binary_little_endian"), "element vertex", tag + "element vertex");
  for (const char* end : {"\n", "\r", "\r\n"}) {
    expect_ply(with_all(header, "\n", end) + "\n" + binary_body(false));
    expect_ply(with_all(header, "\n", end) + "\r" + binary_body(false));
  }
}

TEST_F(PlyDialect, ListsMayHaveAnyTypes) {
  for (const char* types : {"uchar uint", "char short", "int int", "float float", "uint8 float64", "double uchar"}) {
    SCOPED_TRACE(types);
    expect_ply(with(cube_ply(), "uchar int", types));
  }
  std::string faces;
  for (const auto& [a, b, c] : kCubeFaces) {
    faces += bytes_of<std::int16_t>({3}, true) +
             bytes_of<float>({static_cast<float>(a), static_cast<float>(b), static_cast<float>(c)}, true);
  }
  expect_ply(with(header_of("binary_big_endian"), "uchar int", "int16 float32") +
             binary_body(true).substr(0, 8 * 3 * sizeof(float)) + faces);
}

TEST_F(PlyDialect, TextWithZeroBytesOrInUtf16IsNamed) {
  EXPECT_THAT(error_of("a.ply", cube_ply() + std::string(3, '\0')), HasSubstr("line 30: 3 zero bytes from here on"));
  std::string wide;
  for (const char c : cube_ply())
    wide += std::string{c, '\0'};
  for (const std::string& text : {wide, "\xff\xfe" + wide}) {
    EXPECT_THAT(error_of("a.ply", text), HasSubstr("UTF-16"));
  }
}

TEST_F(PlyDialect, MissingFinalNewline) {
  expect_ply(cube_ply().substr(0, cube_ply().size() - 1));
}

TEST_F(PlyDialect, ExcessOrMissingDataIsAnError) {
  EXPECT_THAT(error_of("a.ply", cube_ply() + "3 0 1 2\n"),
              HasSubstr("line 30: the file is longer than its header says"));
  EXPECT_THAT(error_of("a.ply", header_of("binary_little_endian") + binary_body(false) + "tail"),
              HasSubstr("4 bytes follow the last element"));
  EXPECT_THAT(error_of("a.ply", with(cube_ply(), "face 12", "face 13")), HasSubstr("line 29, face 12: the file ends"));
}

}  // namespace
}  // namespace glissade::geometry
