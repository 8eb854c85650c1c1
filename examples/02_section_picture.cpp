// Draws the demonstration in section, seen along the car: a window motor slides to its seat in a car door. The section
// of the motor is through the middle of its drum, that of the door at the final position of the drum. Usage:
// section_picture SCRIPT.csv PICTURE.svg SCRIPT.csv holds the pose X_WG of the ghost over time, like the script in
// `examples/scenes`.

#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <glissade/contact/sliding.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/shapes/car_door_parts.h>

namespace {

using namespace glissade;
using geometry::TriangleMesh;

constexpr double kDrumX_m = 0.04;  // in the motor's frame V
constexpr double kDetail = 0.4;    // no dimension of the parts depends on it

std::vector<Eigen::Isometry3d> read_poses(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);  // the header
  std::vector<Eigen::Isometry3d> poses;
  while (std::getline(file, line)) {
    for (char& c : line)
      if (c == ',') c = ' ';
    double t = 0.0;
    Eigen::Vector3d p;
    Eigen::Quaterniond q;
    std::istringstream(line) >> t >> p.x() >> p.y() >> p.z() >> q.w() >> q.x() >> q.y() >> q.z();
    poses.push_back(Eigen::Translation3d(p) * q.normalized());
  }
  return poses;
}

// The intersection of the plane x = cut_m of B with the triangles, as an SVG path: y_W to the right, z_W up,
// millimetres.
std::string section(const geometry::TriangleMesh& mesh_B, double cut_m, const Eigen::Isometry3d& X_WB) {
  std::ostringstream path;
  path.precision(5);
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh_B.triangles.size()); ++t) {
    std::vector<Eigen::Vector3d> cut;
    for (int c = 0; c < 3; ++c) {
      const Eigen::Vector3d& a = mesh_B.corner(t, c);
      const Eigen::Vector3d& b = mesh_B.corner(t, (c + 1) % 3);
      if ((a.x() < cut_m) != (b.x() < cut_m)) cut.push_back(X_WB * (a + (cut_m - a.x()) / (b.x() - a.x()) * (b - a)));
    }
    if (cut.size() != 2) continue;
    path << 'M' << 1e3 * cut[0].y() << ' ' << -1e3 * cut[0].z() << 'L' << 1e3 * cut[1].y() << ' ' << -1e3 * cut[1].z();
  }
  return path.str();
}

void draw(std::ostream& svg, const std::string& path, const std::string& style) {
  svg << "<path d=\"" << path << "\" style=\"fill:none;stroke-linecap:round;" << style << "\"/>\n";
}

void label(std::ostream& svg, double y_mm, double z_mm, const std::string& text) {
  svg << "<text x=\"" << y_mm << "\" y=\"" << -z_mm << "\">" << text << "</text>\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: section_picture SCRIPT.csv PICTURE.svg\n";
    return 2;
  }
  const std::vector<geometry::TriangleMesh> door{
      shapes::make_door_inner_panel(kDetail), shapes::make_door_outer_panel(kDetail),
      shapes::make_door_impact_tube(kDetail), shapes::make_door_hose(kDetail)};
  std::vector<contact::Obstacle> obstacles;
  for (const geometry::TriangleMesh& mesh : door)
    obstacles.push_back({std::make_shared<contact::ContactBody>(std::make_shared<const geometry::TriangleMesh>(mesh))});
  const auto motor_V = std::make_shared<contact::SlidingPart>(
      std::make_shared<const geometry::TriangleMesh>(shapes::make_window_motor(kDetail)));
  const std::vector<Eigen::Isometry3d> poses_WG = read_poses(argv[1]);

  std::ofstream svg(argv[2]);
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-330 -320 560 640\" font-family=\"sans-serif\" "
         "font-size=\"13\">\n<rect x=\"-330\" y=\"-320\" width=\"560\" height=\"640\" fill=\"#ffffff\"/>\n";
  contact::Sliding sliding(obstacles, motor_V, poses_WG.at(0));
  std::ostringstream track;
  for (std::size_t i = 0; i < poses_WG.size(); ++i) {
    const Eigen::Isometry3d& X_WV = sliding.advance(poses_WG[i]).X_WV;
    track << (i == 0 ? 'M' : 'L') << 1e3 * X_WV.translation().y() << ' ' << -1e3 * X_WV.translation().z();
    if (i % 70 == 0) draw(svg, section(motor_V->tree.mesh(), kDrumX_m, X_WV), "stroke:#9fbfe8;stroke-width:1");
  }
  draw(svg, track.str(), "stroke:#d08020;stroke-width:1.5;stroke-dasharray:5 4");
  const double door_cut_m = (sliding.result().X_WV * Eigen::Vector3d(kDrumX_m, 0.0, 0.0)).x();
  for (const geometry::TriangleMesh& mesh : door)
    draw(svg, section(mesh, door_cut_m, Eigen::Isometry3d::Identity()), "stroke:#303030;stroke-width:2.2");
  draw(svg, section(motor_V->tree.mesh(), kDrumX_m, sliding.result().X_WV), "stroke:#1050b0;stroke-width:1.8");

  label(svg, -320, -300, "y outwards to the right, z up");
  label(svg, -95, 290, "inner panel");
  label(svg, 100, 290, "outer panel");
  label(svg, 60, -38, "side-impact tube");
  label(svg, 128, 20, "hose");
  label(svg, -85, -90, "access hole");
  label(svg, -325, -85, "window motor, start");
  label(svg, -60, 150, "seat");
  svg << "</svg>\n";
  return svg.good() ? 0 : 1;
}
