#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/shapes/benchmark_shapes.h>
#include <glissade/shapes/car_door_parts.h>
#include <glissade/shapes/household_objects.h>
#include <glissade/shapes/shape_catalog.h>
#include <glissade/shapes/sheet_metal.h>

#include "catalog/shape_entries.h"

namespace glissade::shapes {
namespace {

using Values = ShapeValues;
using Entry = ShapeEntry;

ShapeParameter triangles_parameter(double default_value) {
  return {"triangles", "approximate number of triangles", default_value};
}

std::int64_t triangles_of(const Values& values) {
  const double count = values.at("triangles");
  if (!(count >= 1 && count <= 5e7)) {
    std::ostringstream message;
    message << "triangles must be from 1 to 50000000, but is " << count << ".";
    throw std::invalid_argument(message.str());
  }
  return std::llround(count);
}

Entry door_part(const std::string& name, const std::string& description, geometry::TriangleMesh (*make)(double)) {
  return {{name, description, {{"detail", "1 for the full number of triangles, 0.1 for a tenth", 1.0}}},
          [make](const Values& values) { return make(values.at("detail")); }};
}

Entry suite_entry(const std::string& name, const std::string& description,
                  geometry::TriangleMesh (*make)(std::int64_t)) {
  return {{name, description, {triangles_parameter(20'000)}},
          [make](const Values& values) { return make(triangles_of(values)); }};
}

Entry bumpy_plate_entry() {
  return {{"bumpy_plate",
           "sheet without thickness with a smooth field of bumps",
           {{"size_x_m", "edge along x", 0.2},
            {"size_y_m", "edge along y", 0.2},
            {"bump_height_m", "from the lowest to the highest point", 0.01},
            {"waves", "waves along each edge, rounded", 5},
            triangles_parameter(5000)}},
          [](const Values& v) {
            const double waves = v.at("waves");
            if (!(waves >= 1 && waves <= 10'000)) {
              std::ostringstream message;
              message << "waves must be from 1 to 10000, but is " << waves << ".";
              throw std::invalid_argument(message.str());
            }
            return make_bumpy_plate({v.at("size_x_m"), v.at("size_y_m")}, v.at("bump_height_m"),
                                    static_cast<int>(std::lround(waves)), triangles_of(v));
          }};
}

Entry box_entry() {
  return {{"box",
           "box about the origin",
           {{"size_x_m", "edge along x", 0.1},
            {"size_y_m", "edge along y", 0.1},
            {"size_z_m", "edge along z", 0.1},
            triangles_parameter(12)}},
          [](const Values& v) {
            return geometry::make_box({v.at("size_x_m"), v.at("size_y_m"), v.at("size_z_m")}, triangles_of(v));
          }};
}

Entry hose_entry() {
  return {{"hose",
           "open round shell along an S-shaped curve in the plane y = 0",
           {{"length_m", "distance of its ends along x", 0.3},
            {"sway_m", "height of the S along z", 0.05},
            {"radius_m", "radius of the shell", 0.01},
            triangles_parameter(2000)}},
          [](const Values& v) {
            const double length = v.at("length_m");
            const double sway = v.at("sway_m");
            const std::array<Eigen::Vector3d, 5> points{
                {{-length / 2, 0, 0}, {-length / 4, 0, sway}, {0, 0, 0}, {length / 4, 0, -sway}, {length / 2, 0, 0}}};
            return geometry::make_hose(points, v.at("radius_m"), triangles_of(v));
          }};
}

Entry hyperboloid_entry() {
  return {{"hyperboloid",
           "hyperboloid of one sheet about z, open at both ends",
           {{"waist_radius_m", "radius at z = 0", 0.05},
            {"rim_radius_m", "radius at the ends", 0.1},
            {"height_m", "distance of the ends", 0.2},
            triangles_parameter(2000)}},
          [](const Values& v) {
            return geometry::make_hyperboloid(v.at("waist_radius_m"), v.at("rim_radius_m"), v.at("height_m"),
                                              triangles_of(v));
          }};
}

Entry plate_entry() {
  return {{"plate",
           "flat sheet without thickness in the plane z = 0",
           {{"size_x_m", "edge along x", 0.2}, {"size_y_m", "edge along y", 0.2}, triangles_parameter(200)}},
          [](const Values& v) {
            return geometry::make_plate({v.at("size_x_m"), v.at("size_y_m")}, triangles_of(v));
          }};
}

Entry sheet_entry() {
  return {
      {"sheet",
       "sheet metal in the plane z = 0 with a hole in the middle and a bead at either side of it",
       {{"size_x_m", "edge along x", 0.4},
        {"size_y_m", "edge along y", 0.3},
        {"hole_x_m", "width of the hole", 0.12},
        {"hole_y_m", "height of the hole", 0.08},
        {"hole_corner_radius_m", "radius of its corners", 0.02},
        {"bead_height_m", "height of the beads, negative for sunk ones", 0.005},
        {"bead_width_m", "width of the beads", 0.02},
        triangles_parameter(4000)}},
      [](const Values& v) {
        SheetMetal sheet;
        sheet.size = {v.at("size_x_m"), v.at("size_y_m")};
        const Eigen::Vector2d hole(v.at("hole_x_m"), v.at("hole_y_m"));
        const double width = v.at("bead_width_m");
        sheet.holes.push_back({Eigen::Vector2d::Zero(), hole, v.at("hole_corner_radius_m")});
        for (const double side : {-1.0, 1.0}) {
          const Eigen::Vector2d center(side * (sheet.size.x() + hole.x()) / 4, 0);
          sheet.beads.push_back({{center, {width, 0.7 * sheet.size.y()}, width / 2}, v.at("bead_height_m"), width / 5});
        }
        return make_sheet(sheet, triangles_of(v));
      }};
}

Entry sphere_entry() {
  return {{"sphere", "sphere about the origin", {{"radius_m", "radius", 0.05}, triangles_parameter(2000)}},
          [](const Values& v) { return geometry::make_sphere(v.at("radius_m"), triangles_of(v)); }};
}

Entry torus_entry() {
  return {{"torus",
           "torus about z",
           {{"major_radius_m", "radius of the circle the tube follows", 0.1},
            {"minor_radius_m", "radius of the tube", 0.03},
            triangles_parameter(2000)}},
          [](const Values& v) {
            return geometry::make_torus(v.at("major_radius_m"), v.at("minor_radius_m"), triangles_of(v));
          }};
}

Entry tube_entry() {
  return {{"tube",
           "cylinder shell about z without thickness, open at both ends",
           {{"radius_m", "radius", 0.05}, {"length_m", "length", 0.2}, triangles_parameter(2000)}},
          [](const Values& v) { return geometry::make_tube(v.at("radius_m"), v.at("length_m"), triangles_of(v)); }};
}

std::vector<Entry> surface_and_part_entries() {
  return {box_entry(),
          bumpy_plate_entry(),
          suite_entry("car_body", "body of a car, 4 m long, in sheet metal, with its seats", &make_car_body),
          door_part("door_hose", "hose of the car door", &make_door_hose),
          door_part("door_impact_tube", "side-impact tube of the car door", &make_door_impact_tube),
          door_part("door_inner_panel", "inner panel of the car door with its access hole", &make_door_inner_panel),
          suite_entry("door_lock", "lock of a car door, 0.13 m wide, its mechanism in a housing", &make_door_lock),
          door_part("door_outer_panel", "outer panel of the car door", &make_door_outer_panel),
          suite_entry("engine_hose", "bellows hose of a car engine, 0.6 m long, with clamps and flanges",
                      &make_engine_hose),
          suite_entry("headlight", "car headlight, 0.52 m wide, with its lamps and housing", &make_headlight),
          hose_entry(),
          hyperboloid_entry(),
          plate_entry(),
          sheet_entry(),
          sphere_entry(),
          torus_entry(),
          tube_entry(),
          door_part("window_motor", "window motor of the car door in its own frame", &make_window_motor)};
}

std::vector<Entry> household_entries() {
  std::vector<Entry> entries;
  for (const HouseholdObject& object : household_objects()) {
    entries.push_back({{object.name, object.description, {{"edge_m", "longest edge of round surfaces", 0.006}}},
                       [make = object.make](const Values& values) { return make(values.at("edge_m")); }});
  }
  return entries;
}

/// In alphabetical order.
const std::vector<Entry>& entries() {
  static const std::vector<Entry> kEntries = [] {
    std::vector<Entry> all = surface_and_part_entries();
    std::ranges::copy(machine_element_entries(), std::back_inserter(all));
    std::ranges::copy(household_entries(), std::back_inserter(all));
    std::ranges::sort(all, {}, [](const Entry& entry) { return entry.shape.name; });
    return all;
  }();
  return kEntries;
}

template <class Items, class NameOf>
std::string joined_names(const Items& items, NameOf name_of) {
  std::string names;
  for (const auto& item : items) {
    names += (names.empty() ? "" : ", ") + name_of(item);
  }
  return names;
}

}  // namespace

const std::vector<Shape>& shape_catalog() {
  static const std::vector<Shape> kCatalog = [] {
    std::vector<Shape> shapes;
    for (const Entry& entry : entries()) {
      shapes.push_back(entry.shape);
    }
    return shapes;
  }();
  return kCatalog;
}

geometry::TriangleMesh make_shape(const std::string& name, const std::map<std::string, double>& parameters) {
  const auto entry =
      std::find_if(entries().begin(), entries().end(), [&](const Entry& e) { return e.shape.name == name; });
  if (entry == entries().end()) {
    throw std::invalid_argument("There is no shape '" + name + "'; known are " +
                                joined_names(entries(), [](const Entry& e) { return e.shape.name; }) + ".");
  }
  Values values;
  for (const ShapeParameter& parameter : entry->shape.parameters) {
    values[parameter.name] = parameter.default_value;
  }
  for (const auto& [key, value] : parameters) {
    if (!values.contains(key)) {
      throw std::invalid_argument(
          "The shape '" + name + "' has no parameter '" + key + "'; known are " +
          joined_names(entry->shape.parameters, [](const ShapeParameter& p) { return p.name; }) + ".");
    }
    values[key] = value;
  }
  try {
    return entry->make(values);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("The shape '" + name + "' cannot be made: " + error.what());
  }
}

}  // namespace glissade::shapes
