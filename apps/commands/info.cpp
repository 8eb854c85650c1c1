#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <glissade/apps/commands/command.h>
#include <glissade/apps/commands/load_or_build_tree.h>
#include <glissade/apps/commands/size_warnings.h>
#include <glissade/apps/open_files.h>
#include <glissade/apps/usage.h>
#include <glissade/collision/dop_tree.h>
#include <glissade/geometry/mesh_topology.h>

namespace glissade::apps {

namespace {

constexpr const char* kInfoDescription = "Print the size and the defects of a mesh, and the statistics of its DOP-tree";

constexpr const char* kInfoFooter =
    "Meshes with defects can be used. The import welds vertices at equal positions, triangulates polygons, and omits\n"
    "triangles without area. For the keys of --json, see docs/file_formats.md in the sources.\n"
    "\n"
    "Examples, with the files of 'glissade example':\n"
    "  glissade info motor.obj\n"
    "  glissade info motor.obj --json\n"
    "  glissade info motor_in_mm.obj --scale 0.001";

struct InfoOptions {
  std::string mesh;
  bool json = false;
  bool cache = false;
  double scale = 1.0;
};

/// The figures that the command prints.
struct Info {
  geometry::MeshReport report;  ///< of the imported mesh, without degenerate triangles
  std::int64_t degenerate_triangles;
  bool closed_by_degenerate;  ///< only they are missing for a watertight mesh
  std::int64_t polygons_triangulated;
  std::int64_t tree_nodes;
  int tree_depth;
  double tree_bytes_per_triangle;
};

Info gather(const InfoOptions& options) {
  geometry::ImportedMesh imported = import_with_warnings(options.mesh, options.scale);
  const auto mesh = std::make_shared<const geometry::TriangleMesh>(std::move(imported.mesh));
  const collision::DopTree tree = load_or_build_tree(mesh, options.cache ? options.mesh : "");
  return {geometry::report(*mesh),
          imported.degenerate_triangles,
          imported.closed_by_degenerate,
          imported.polygons_triangulated,
          static_cast<std::int64_t>(tree.node_count()),
          tree.depth(),
          static_cast<double>(tree.memory_bytes()) / static_cast<double>(mesh->triangles.size())};
}

/// Adding zero turns a negative zero into the plain one.
std::vector<double> list(const Eigen::Vector3d& p) {
  return {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};
}

void print_json(const Info& info) {
  const geometry::MeshReport& report = info.report;
  const nlohmann::ordered_json json{{"vertices", report.vertices},
                                    {"triangles", report.triangles},
                                    {"degenerate_triangles", info.degenerate_triangles},
                                    {"polygons_triangulated", info.polygons_triangulated},
                                    {"duplicate_triangles", report.duplicates},
                                    {"open_edges", report.open_edges},
                                    {"nonmanifold_edges", report.nonmanifold_edges},
                                    {"inconsistent_edges", report.inconsistent_edges},
                                    {"components", report.components},
                                    {"watertight", report.is_watertight},
                                    {"area_m2", report.area},
                                    {"bounds_min_m", list(report.bounds.min())},
                                    {"bounds_max_m", list(report.bounds.max())},
                                    {"tree_nodes", info.tree_nodes},
                                    {"tree_depth", info.tree_depth},
                                    {"tree_bytes_per_triangle", info.tree_bytes_per_triangle}};
  std::cout << json.dump(2) << '\n';
}

/// With six digits of the mesh's size, wherever it lies.
std::string spaced(const Eigen::Vector3d& p, const Eigen::AlignedBox3d& bounds) {
  constexpr double kDigits = 6.0;
  const double size = bounds.sizes().maxCoeff();
  const double farthest = std::max(bounds.min().cwiseAbs().maxCoeff(), bounds.max().cwiseAbs().maxCoeff());
  const double more = size > 0.0 ? std::ceil(std::log10(farthest / size)) : 0.0;
  std::ostringstream text;
  text << std::setprecision(static_cast<int>(std::clamp(kDigits + more, kDigits, 17.0))) << p.x() + 0.0 << ' '
       << p.y() + 0.0 << ' ' << p.z() + 0.0;
  return text.str();
}

void print_text(const Info& info, double scale) {
  const auto row = [](const char* what, const auto& value, const char* unit = "") {
    std::cout << std::left << std::setw(28) << what << value << unit << '\n';
  };
  const geometry::MeshReport& report = info.report;
  row("vertices", report.vertices);
  row("triangles", report.triangles);
  row("duplicate triangles", report.duplicates);
  row("left out, without area", info.degenerate_triangles);
  row("polygons triangulated", info.polygons_triangulated);
  row("open edges", report.open_edges);
  row("non-manifold edges", report.nonmanifold_edges);
  row("inconsistent edges", report.inconsistent_edges);
  row("components", report.components);
  row("watertight", report.is_watertight        ? "yes"
                    : info.closed_by_degenerate ? "no: open only where triangles without area are left out"
                                                : "no");
  row("area", report.area, " m^2");
  row("size", told_size(report.bounds.sizes().maxCoeff(), scale, "--scale "));
  row("bounds from", spaced(report.bounds.min(), report.bounds), " m");
  row("bounds to", spaced(report.bounds.max(), report.bounds), " m");
  row("tree nodes", info.tree_nodes);
  row("tree depth", info.tree_depth);
  row("tree bytes per triangle", info.tree_bytes_per_triangle);
}

int run(const InfoOptions& options) {
  const Info info = gather(options);
  if (options.json) {
    print_json(info);
  } else {
    print_text(info, options.scale);
  }
  return 0;
}

}  // namespace

void add_info_command(CLI::App& app, Command& chosen) {
  const auto options = std::make_shared<InfoOptions>();
  CLI::App* command = app.add_subcommand("info", kInfoDescription);
  command->footer(kInfoFooter);
  command->add_option("MESH", options->mesh, "Mesh file: OBJ, STL, PLY or glTF, in metres or with --scale")->required();
  command->add_option("--scale", options->scale, "Metres per unit of the mesh: 0.001 for millimetres")
      ->capture_default_str()
      ->check(positive());
  command->add_flag("--json", options->json, "Print one JSON object instead of a table");
  command->add_flag("--cache", options->cache, kCacheHelp);
  add_strict_option(*command);
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
