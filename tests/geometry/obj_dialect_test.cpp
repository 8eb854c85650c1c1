// What exporters write into OBJ files, beside the format and within it.

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cube_files.h"

namespace glissade::geometry {
namespace {

using testing::HasSubstr;

class ObjDialect : public Dialect {
 protected:
  void expect_obj(const std::string& content, const std::vector<std::string>& warnings = {}) const {
    expect_cube("a.obj", content, warnings);
  }
};

TEST_F(ObjDialect, UnknownStatementsAreSkippedWithAWarning) {
  expect_obj("8 12\n" + cube_obj(), {"1 unknown statement is skipped (line 1, '8 12')."});
  expect_obj(with(cube_obj(), "f 1 4 2", "faces: 12\nf 1 4 2"),
             {"1 unknown statement is skipped (line 10, 'faces: 12')."});
  expect_obj("OBJ v1\n" + cube_obj() + "F 1 2 3\n\xff\xfe\x01\n",
             {"3 unknown statements are skipped (the first: line 1, 'OBJ v1')."});
  expect_obj("csh rm part\n" + cube_obj(), {"1 unknown statement is skipped (line 1, 'csh rm part')."});
  const std::vector<std::string> long_line = import("a.obj", std::string(5000, 'x') + "\n" + cube_obj()).warnings;
  ASSERT_EQ(long_line.size(), 1U);
  EXPECT_LT(long_line[0].size(), 100U);
}

TEST_F(ObjDialect, CurvesAreSkippedWithAWarning) {
  expect_obj(cube_obj() + "cstype bezier\ndeg 3\ncurv 0 1 1 2 3 4\nparm u 0 1\nend\n",
             {"3 statements of free-form curves are skipped (the first: line 23, 'curv')."});
}

TEST_F(ObjDialect, AnythingMayBeFollowedByAComment) {
  expect_obj(with_all(with_all(cube_obj(), "1\n", "1 # one\n"), "2\n", "2#two # more\n"));
  expect_obj("g a # b\no c#d\n#\n\t # indented\ns off # smooth\nvn 0 0 1 # normal\n" + cube_obj());
  expect_obj(with(cube_obj(), "v 1 0 0", "v 1 0 0 # C:\\parts\\"));
  expect_obj(with(cube_obj(), "f 1 4 2", "f 1 4 2 # f 1 2 3 \\"));
  EXPECT_THAT(error_of("a.obj", with(cube_obj(), "v 1 0 0", "v 1 0 # 0")),
              HasSubstr("line 2: a vertex needs 3 coordinates, but has 2"));
}

TEST_F(ObjDialect, FacesOfOneOrTwoCornersAreLeftOut) {
  expect_obj(cube_obj() + "f 1\nf 2\n", {"2 faces have fewer than 3 corners and are left out (the first: line 21)."});
  expect_obj(with(cube_obj(), "f 1 3 4", "f 7/1/1 8\nf 1 3 4"),
             {"1 face has fewer than 3 corners and is left out (line 9)."});
  expect_obj(cube_obj() + "f\nf -1 # no face\n",
             {"2 faces have fewer than 3 corners and are left out (the first: line 21)."});
  EXPECT_THAT(error_of("a.obj", cube_obj() + "f 1,2,3\n"), HasSubstr("line 21: '1,2,3' is not a corner of a face"));
}

TEST_F(ObjDialect, OnlyVerticesOfFacesMustBeFinite) {
  for (const char* number : {"nan", "-nan", "inf", "NaN", "-nan(ind)", "1.#QNAN", "-1.#IND00", "1e999", "1e300"}) {
    SCOPED_TRACE(number);
    const std::string vertex = "v 0 " + std::string(number) + " 0\n";
    expect_obj(with(cube_obj(), "f 1 3 4", vertex + "f 1 3 4"));
    expect_obj(cube_obj() + vertex + "l 1 9\np 9\n");
    EXPECT_THAT(error_of("a.obj", cube_obj() + vertex + "f 1 2 -1\n"),
                HasSubstr("line 21, a vertex of a face: the coordinate"));
  }
}

TEST_F(ObjDialect, AfterAVertexComeAWeightAndAColour) {
  expect_obj(with(cube_obj(), "v 1 0 0", "v 1 0 0 1"));
  expect_obj(with(cube_obj(), "v 1 0 0", "v 1 0 0 0.5 nan 1.#QNAN"));
  expect_obj(with(cube_obj(), "v 1 0 0", "v 1 0 0 255 255 255 255"));
  expect_obj(with(with(cube_obj(), "v 1 0 0", "v 1 0 0 red"), "v 1 1 0", "v 1 1 0 0 0 1 1 1 1 1"),
             {"2 vertices are followed by more than a weight and a colour, which is skipped (the first: line 2)."});
}

TEST_F(ObjDialect, ABackslashAtTheEndOfANameIsPartOfIt) {
  for (const char* name : {"usemtl C:\\textures\\", "mtllib .\\", "o part\\", "g a b \\", "\\", "usemap C:\\\\"}) {
    expect_obj(with(cube_obj(), "f 1 3 4", std::string(name) + "\nf 1 3 4"));
    expect_obj(with(cube_obj(), "v 1 0 0", std::string(name) + "\nv 1 0 0"));
  }
  expect_obj(with(cube_obj(), "f 1 3 4", "call_me \\\nf 1 3 4"),
             {"1 unknown statement is skipped (line 9, 'call_me \\')."});
}

TEST_F(ObjDialect, ABackslashContinuesALine) {
  expect_obj(with(with(cube_obj(), "v 1 0 0", "v 1 \\\n0\\\n\\\n 0"), "f 1 3 4", "f\\\n1 3 \\ \r\n4"));
  expect_obj("vn 0 0 \\\n1\ng one \\\ntwo \\\nthree\nl 1 2 \\\n3 4\n" + cube_obj());
  expect_obj(cube_obj() + "usemtl C:\\");
  EXPECT_THAT(error_of("a.obj", with(cube_obj(), "f 1 3 4", "f 1 3 4 \\")), HasSubstr("line 9: 'f' is not a corner"));
}

TEST_F(ObjDialect, AnyLineEndingIsRead) {
  expect_obj(with_all(cube_obj(), "\n", "\r"));
  expect_obj(with_all(cube_obj(), "\n", "\r\n"));
  expect_obj(with_all(cube_obj(), "\n", " \r\r\n"));
  expect_obj("# a\r# b\r" + cube_obj());
  expect_obj(cube_obj().substr(0, cube_obj().size() - 1));
  expect_obj(with_all(cube_obj(), "\n", "\r") + "f 1\r",
             {"1 face has fewer than 3 corners and is left out (line 21)."});
}

TEST_F(ObjDialect, AnOldNameOfFacesIsRead) {
  expect_obj(with_all(cube_obj(), "f ", "fo "));
}

TEST_F(ObjDialect, TextInUtf16IsNamed) {
  std::string wide;
  for (const char c : cube_obj())
    wide += std::string{c, '\0'};
  std::string big;
  for (const char c : cube_obj())
    big += std::string{'\0', c};
  for (const std::string& text : {wide, "\xff\xfe" + wide, "\xfe\xff" + big}) {
    EXPECT_THAT(error_of("a.obj", text), HasSubstr("UTF-16"));
  }
}

TEST_F(ObjDialect, EachKindMakesOneWarning) {
  const std::vector<std::string> warnings =
      import("a.obj", "a\nb\n" + cube_obj() + "f 1\nend\nv 0 0 0 x\nf 1\nc\nend\nv 0 0 0 x\n").warnings;
  EXPECT_THAT(warnings, testing::ElementsAre(HasSubstr("3 unknown statements"), HasSubstr("2 faces"),
                                             HasSubstr("2 statements"), HasSubstr("2 vertices")));
}

}  // namespace
}  // namespace glissade::geometry
