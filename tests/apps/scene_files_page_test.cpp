/// docs/scene_files.md and docs/file_formats.md: their examples work, and their tables name exactly the keys and
/// columns that the program knows.

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/apps/files/scene_file.h>
#include <glissade/apps/latency/latency_output.h>
#include <glissade/apps/record/mcap_schemas.h>
#include <glissade/apps/run/session.h>
#include <glissade/apps/text.h>
#include <glissade/contact/sliding.h>
#include <glissade/devices/event_log.h>
#include <glissade/files/pose_files.h>
#include <glissade/files/scene_keys.h>
#include <glissade/files/text_file.h>
#include <glissade/geometry/pose_trajectory.h>
#include <glissade/shapes/shape_catalog.h>

#include "glissade_program.h"
#include "latency_figures.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using test_support::ProgramResult;
using test_support::TemporaryFolder;
using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::UnorderedElementsAreArray;
using Texts = std::vector<std::string>;

/// The texts between backticks.
Texts code_spans(const std::string& line) {
  Texts spans;
  for (std::size_t begin = line.find('`'); begin != std::string::npos;) {
    const std::size_t end = line.find('`', begin + 1);
    if (end == std::string::npos) break;
    spans.push_back(line.substr(begin + 1, end - begin - 1));
    begin = line.find('`', end + 1);
  }
  return spans;
}

/// The cells of a row of a table, `| a | b |`.
Texts cells_of(const std::string& row) {
  Texts cells;
  for (std::size_t begin = 1; begin < row.size();) {
    const std::size_t end = row.find('|', begin);
    if (end == std::string::npos) break;
    cells.push_back(row.substr(begin, end - begin));
    begin = end + 1;
  }
  return cells;
}

/// A fenced block. Its file is named at the start of the last line before it that begins with a code span.
struct Block {
  std::string language;
  std::string file;
  std::string text;
};

/// A page of docs.
class Page {
 public:
  explicit Page(const std::string& name) {
    std::istringstream text(read_text_file(std::string(GLISSADE_DOCS) + "/" + name));
    for (std::string line; std::getline(text, line);)
      lines_.push_back(line);
  }

  std::vector<Block> blocks() const {
    std::vector<Block> blocks;
    std::string file;
    bool is_inside = false;
    for (const std::string& line : lines_) {
      if (line.starts_with("```")) {
        is_inside = !is_inside;
        if (is_inside) blocks.push_back({line.substr(3), file, ""});
      } else if (is_inside) {
        blocks.back().text += line + "\n";
      } else if (line.starts_with("`")) {
        file = code_spans(line).front();
      }
    }
    return blocks;
  }

  /// The rows of the tables between this heading and the next, without their headers.
  std::vector<Texts> rows_below(const std::string& heading) const {
    std::vector<Texts> rows;
    auto line = std::find(lines_.begin(), lines_.end(), heading);
    EXPECT_NE(line, lines_.end()) << heading;
    bool is_header = true;
    for (; line != lines_.end() && (*line == heading || !line->starts_with("#")); ++line) {
      if (line->starts_with("|---")) {
        is_header = false;
      } else if (!line->starts_with("|")) {
        is_header = true;
      } else if (!is_header) {
        rows.push_back(cells_of(*line));
      }
    }
    return rows;
  }

  /// The code spans in the first column of these tables: the keys or columns that they describe.
  Texts names_below(const std::string& heading) const {
    Texts names;
    for (const Texts& row : rows_below(heading)) {
      const Texts spans = code_spans(row.front());
      names.insert(names.end(), spans.begin(), spans.end());
    }
    return names;
  }

  /// The row of that name.
  Texts row(const std::string& heading, const std::string& name) const {
    for (const Texts& row : rows_below(heading)) {
      const Texts names = code_spans(row.front());
      if (std::find(names.begin(), names.end(), name) != names.end()) return row;
    }
    ADD_FAILURE() << heading << " has no row " << name;
    return Texts(4);
  }

 private:
  Texts lines_;
};

/// Two tetrahedra, 1 unit large and 100 units apart, as OBJ or STL.
std::string tetrahedra(bool is_stl) {
  constexpr int kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  std::ostringstream stl("solid parts\n", std::ios::ate);
  std::ostringstream obj;
  for (const int x : {0, 100}) {
    const std::string corners[4] = {std::to_string(x) + " 0 0", std::to_string(x + 1) + " 0 0",
                                    std::to_string(x) + " 1 0", std::to_string(x) + " 0 1"};
    for (const std::string& corner : corners)
      obj << "v " << corner << '\n';
    for (const auto& face : kFaces) {
      stl << "facet normal 0 0 0\nouter loop\n";
      for (const int corner : face)
        stl << "vertex " << corners[corner] << '\n';
      stl << "endloop\nendfacet\n";
      obj << "f " << face[0] - 4 << ' ' << face[1] - 4 << ' ' << face[2] - 4 << '\n';
    }
  }
  stl << "endsolid parts\n";
  return is_stl ? stl.str() : obj.str();
}

/// The pages, and a folder with the files of their examples and small meshes by the names used there.
class ScenePages : public testing::Test {
 protected:
  ScenePages() {
    for (const Page* page : {&scenes, &formats}) {
      for (const Block& block : page->blocks()) {
        if (block.language == "yaml" || block.language == "csv") folder.write(block.file, block.text);
        if (block.language == "yaml") write_meshes(block.text);
      }
    }
  }

  void write_meshes(const std::string& scene) const {
    constexpr std::string_view kKey = "mesh: ";
    for (std::size_t at = scene.find(kKey); at != std::string::npos; at = scene.find(kKey, at + 1)) {
      const std::size_t begin = at + kKey.size();
      const std::string name = scene.substr(begin, scene.find_first_of(",\n} ", begin) - begin);
      folder.write(name, tetrahedra(name.ends_with(".stl")));
    }
  }

  /// Runs the program; scenes, tables and meshes among the arguments are files of the folder.
  ProgramResult run(const std::string& command) const {
    std::istringstream words(command);
    Texts arguments;
    for (std::string word; words >> word;) {
      const auto ends = [&](const char* suffix) { return word.ends_with(suffix); };
      const bool is_file = ends(".yaml") || ends(".csv") || ends(".stl") || ends(".obj");
      arguments.push_back(is_file ? folder.path(word) : word);
    }
    const ProgramResult result = test_support::glissade(arguments);
    const bool misses_goal = result.standard_error.find("missed its goal") != std::string::npos;  // tetrahedra do
    EXPECT_TRUE(result.exit_code == 0 || misses_goal) << command << '\n' << result.standard_error;
    return result;
  }

  Texts header_of(const std::string& file) const {
    const std::string text = read_text_file(folder.path(file));
    return test_support::split(text.substr(0, text.find('\n')));
  }

  TemporaryFolder folder;
  const Page scenes{"scene_files.md"};
  const Page formats{"file_formats.md"};
};

TEST_F(ScenePages, EveryExampleIsRead) {
  int read = 0;
  for (const Page* page : {&scenes, &formats}) {
    for (const Block& block : page->blocks()) {
      SCOPED_TRACE(block.file);
      ++read;
      if (block.language == "yaml") {
        EXPECT_NO_THROW(read_scene(folder.path(block.file)));
      } else if (block.language == "csv" && block.text.starts_with("t_s")) {
        EXPECT_NO_THROW(read_trajectory(folder.path(block.file)));
      } else if (block.language == "csv") {
        EXPECT_NO_THROW(read_poses(folder.path(block.file)));
      } else {
        EXPECT_EQ(block.language, "sh");
      }
    }
  }
  EXPECT_GE(read, 10);
}

TEST_F(ScenePages, EveryCommandWorks) {
  int commands = 0;
  for (const Block& block : scenes.blocks()) {
    if (block.language != "sh") continue;
    std::istringstream lines(block.text);
    for (std::string line; std::getline(lines, line); ++commands) {
      constexpr std::string_view kProgram = "glissade ";
      ASSERT_TRUE(line.starts_with(kProgram)) << line;
      run(line.substr(kProgram.size()));
    }
  }
  EXPECT_GE(commands, 5);
}

TEST_F(ScenePages, TheTablesHaveExactlyTheKeysOfTheReader) {
  EXPECT_THAT(scenes.names_below("### Scene"), UnorderedElementsAreArray(kSceneKeys));
  EXPECT_THAT(scenes.names_below("### Object"), UnorderedElementsAreArray(kObjectKeys));
  EXPECT_THAT(scenes.names_below("### Pose"), UnorderedElementsAreArray(kPoseKeys));
  EXPECT_THAT(scenes.names_below("### Timed pose"), testing::ElementsAre(kTimeKey));
  EXPECT_THAT(scenes.names_below("### Box"), UnorderedElementsAreArray(kBoxKeys));
  EXPECT_THAT(scenes.names_below("### Shape"), testing::ElementsAre(kShapeTypeKey));
}

TEST_F(ScenePages, EveryKeyIsInAnExample) {
  std::string examples;
  for (const Block& block : scenes.blocks())
    examples += block.language == "yaml" ? block.text : "";
  std::set<std::string_view> keys{kShapeTypeKey, kTimeKey};
  keys.insert(kSceneKeys.begin(), kSceneKeys.end());
  keys.insert(kObjectKeys.begin(), kObjectKeys.end());
  keys.insert(kPoseKeys.begin(), kPoseKeys.end());
  keys.insert(kBoxKeys.begin(), kBoxKeys.end());
  for (const std::string_view key : keys)
    EXPECT_THAT(examples, HasSubstr(std::string(key) + ":"));
}

TEST_F(ScenePages, DefaultsAndLimitsAreThoseOfTheLibrary) {
  const Texts grip = code_spans(scenes.row("### Object", "grip_N_per_m")[2]);
  ASSERT_EQ(grip.size(), 1U);
  const contact::ScriptedPart defaults{nullptr, geometry::PoseTrajectory({geometry::TimedPose{}})};
  EXPECT_EQ(parse_number(grip.front()), defaults.grip_N_per_m);
  EXPECT_THAT(scenes.row("### Object", "margin_m")[1], HasSubstr(format_number(contact::kGreatestMargin_m)));
}

TEST_F(ScenePages, TheCatalogueHasEveryShapeWithParametersAndDefaults) {
  Texts expected;
  for (const shapes::Shape& shape : shapes::shape_catalog()) {
    expected.push_back(shape.name);
    const std::string parameters = scenes.row("## Shape catalogue", shape.name)[2];
    Texts names;
    for (const shapes::ShapeParameter& parameter : shape.parameters) {
      names.push_back(parameter.name);
      const std::string quoted = "`" + parameter.name + "` ";
      const std::size_t begin = parameters.find(quoted) + quoted.size();
      const std::string value = parameters.substr(begin, parameters.find_first_of(",< ", begin) - begin);
      EXPECT_EQ(parse_number(value), parameter.default_value) << shape.name << ": " << parameter.name;
    }
    EXPECT_THAT(code_spans(parameters), ElementsAreArray(names)) << shape.name;
  }
  EXPECT_THAT(scenes.names_below("## Shape catalogue"), UnorderedElementsAreArray(expected));
}

TEST_F(ScenePages, TheTablesHaveExactlyTheColumnsOfPosesAndTrajectories) {
  EXPECT_EQ(formats.names_below("### Poses file"), pose_columns());
  const auto table_of = [](const Texts& columns) {
    std::string header;
    std::string row;
    for (const std::string& column : columns) {
      header += (header.empty() ? "" : ",") + column;
      row += (row.empty() ? "" : ",") + std::string(column == "qw" ? "1" : "0");
    }
    return header + "\n" + row + "\n";
  };
  EXPECT_NO_THROW(parse_trajectory(table_of(formats.names_below("### Trajectories")), "the columns of the page"));
}

TEST_F(ScenePages, TheTablesHaveExactlyTheColumnsOfCollide) {
  run("collide bracket.obj bracket.obj --poses poses.csv --pairs --distance --out pairs.csv");
  EXPECT_EQ(formats.names_below("## Output of collide"), header_of("pairs.csv"));
}

TEST_F(ScenePages, TheTablesHaveExactlyTheColumnsOfGrasp) {
  std::string header;
  std::string row;
  for (const std::string& column : formats.names_below("### Hand trajectories")) {
    if (column == "side" || column == "length_m" || column == "breadth_m") continue;
    header += (header.empty() ? "" : ",") + column;
    row += (row.empty() ? "" : ",") + std::string(column == "qw" || column == "z_m" ? "1" : "0");
  }
  folder.write("open_hand.csv", header + "\n" + row + "\n");
  folder.write("whose.yaml", "side: left\nlength_m: 0.17\nbreadth_m: 0.08\n");
  folder.write("loose.yaml",
               "objects:\n- {name: ball, movable: true, shape: {type: sphere}}\n"
               "- {name: floor, shape: {type: plate}, pose: {position_m: [0, 0, -0.1]}}\n");
  run("grasp loose.yaml --hand-trajectory open_hand.csv --hand whose.yaml --out hands.csv --objects objects.csv");
  EXPECT_EQ(formats.names_below("### Visible hands"), header_of("hands.csv"));
  EXPECT_EQ(formats.names_below("### Movable objects"), header_of("objects.csv"));
}

TEST_F(ScenePages, TheTablesHaveExactlyTheColumnsOfSlide) {
  const std::string slide = "slide lift.yaml --part cube --trajectory hold.csv ";
  run(slide + "--out motion.csv --contacts contacts.csv --patches patches.csv --moving moving.csv");
  run(slide + "--summary summary.csv");
  run("slide peg.yaml --part peg --trajectory push.csv --method paper --out paper.csv");
  EXPECT_EQ(formats.names_below("### Contacts"), header_of("contacts.csv"));
  EXPECT_EQ(formats.names_below("### Patches"), header_of("patches.csv"));
  EXPECT_EQ(formats.names_below("### Moving objects"), header_of("moving.csv"));
  EXPECT_EQ(formats.names_below("### Summary"), header_of("summary.csv"));

  Texts motion = formats.names_below("### Motion");
  EXPECT_EQ(motion, header_of("paper.csv"));
  ASSERT_FALSE(motion.empty());
  motion.pop_back();
  EXPECT_EQ(motion, header_of("motion.csv"));
}

TEST_F(ScenePages, TheTablesHaveExactlyTheKeysOfInfo) {
  const auto json = nlohmann::ordered_json::parse(run("info bracket.obj --json").standard_output);
  Texts keys;
  for (const auto& [key, value] : json.items())
    keys.push_back(key);
  EXPECT_EQ(formats.names_below("## Output of info"), keys);
}

/// The keys of an object, each in a row of the table below `heading`, with the names inside it.
void expect_keys(const Page& page, const std::string& heading, const nlohmann::json& json) {
  Texts keys;
  for (const auto& [key, value] : json.items()) {
    keys.push_back(key);
    if (!value.is_object()) continue;
    Texts inner;
    for (const auto& [inner_key, inner_value] : value.items()) {
      inner.push_back(inner_key);
      if (!inner_value.is_object()) continue;
      for (const auto& [innermost_key, innermost_value] : inner_value.items())
        inner.push_back(innermost_key);
    }
    const Texts on_page = code_spans(page.row(heading, key)[2]);
    EXPECT_EQ(std::set(on_page.begin(), on_page.end()), std::set(inner.begin(), inner.end())) << key;
  }
  EXPECT_THAT(page.names_below(heading), UnorderedElementsAreArray(keys));
}

TEST_F(ScenePages, TheTablesHaveExactlyTheKeysOfDemo) {
  const nlohmann::json json = to_json({.parts = {PartSummary{}}, .hands = {HandSummary{}}}, Session{});
  expect_keys(formats, "## Output of demo and run", json);
  expect_keys(formats, "### Parts of a session", json["parts"][0]);
  expect_keys(formats, "### Hands of a session", json["hands"][0]);
}

TEST_F(ScenePages, TheTablesHaveExactlyTheKeysOfLatency) {
  const nlohmann::json json = to_json(test_support::given_latency_figures());
  Texts keys;
  for (const auto& [key, value] : json.items())
    keys.push_back(key);
  EXPECT_THAT(formats.names_below("## Output of latency"), UnorderedElementsAreArray(keys));
  expect_keys(formats, "### Latencies under one load", json["loaded"]);
  expect_keys(formats, "### Latencies of a link", json["loaded"]["links"][0]);
}

TEST_F(ScenePages, TheTablesHaveExactlyTheKeysAndColumnsOfRecordings) {
  const std::string log = folder.path("run.lcmlog");
  const std::string tables = folder.path("tables");
  run("demo --offline --seconds 1 --record " + log);
  run("log to-csv " + log + " " + tables);
  for (const char* name : {"ticks.csv", "parts.csv", "hands.csv", "gloves.csv"})
    EXPECT_EQ(formats.names_below(std::string("#### ") + name), header_of(std::string("tables/") + name));

  const nlohmann::json outcome = nlohmann::json::parse(run("replay " + log + " --json").standard_output);
  expect_keys(formats, "### Output of replay", outcome);
  devices::EventLogReader reader(log);
  const std::optional<devices::LogEvent> session = reader.next();
  ASSERT_TRUE(session);
  expect_keys(formats, "### Session of a recording",
              nlohmann::json::parse(session->message.begin(), session->message.end()));
}

TEST_F(ScenePages, TheTablesHaveExactlyTheKeysOfMcap) {
  const std::vector<std::pair<std::string, nlohmann::json>> schemas{
      {"/loop", loop_schema()}, {"/part_N", part_schema()}, {"/hand_N", hand_schema()}};
  for (const auto& [topic, schema] : schemas) {
    Texts keys;
    for (const auto& [key, value] : schema["properties"].items())
      keys.push_back(key);
    EXPECT_THAT(formats.names_below("#### " + topic), UnorderedElementsAreArray(keys)) << topic;
  }
}

TEST_F(ScenePages, TheHelpOfEveryCommandWithASceneNamesThePageAndAnExample) {
  for (const char* command : {"demo", "export", "record", "run", "slide"}) {
    EXPECT_THAT(run(std::string(command) + " --help").standard_output, HasSubstr(kSceneFileHelp)) << command;
  }
  EXPECT_THAT(kSceneFileHelp, HasSubstr("docs/scene_files.md"));
  std::istringstream help(kSceneFileHelp);
  std::string example;
  for (std::string line; std::getline(help, line);)
    example += line.starts_with("  ") ? line + "\n" : "";
  EXPECT_EQ(read_scene(folder.write("help.yaml", example)).objects.size(), 2U);
}

}  // namespace
}  // namespace glissade::apps
