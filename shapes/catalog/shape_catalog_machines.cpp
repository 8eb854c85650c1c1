#include <cmath>
#include <sstream>
#include <stdexcept>

#include <glissade/geometry/triangle_mesh.h>
#include <glissade/shapes/peg_and_hole.h>
#include <glissade/shapes/screw_thread.h>
#include <glissade/shapes/slide_in_unit.h>
#include <glissade/shapes/spur_gear.h>

#include "catalog/shape_entries.h"

namespace glissade::shapes {
namespace {

// A count that was given as a real number, rounded. The generators check its range.
int count_of(const ShapeValues& values, const std::string& name) {
  const double count = values.at(name);
  if (!(std::abs(count) <= 1e9)) {
    std::ostringstream message;
    message << name << " must be a count, but is " << count << ".";
    throw std::invalid_argument(message.str());
  }
  return static_cast<int>(std::lround(count));
}

ShapeParameter count_parameter(const std::string& name, const std::string& description, int default_value) {
  return {name, description, static_cast<double>(default_value)};
}

ShapeEntry peg_entry() {
  const PegShape d;
  return {{"peg",
           "round peg about z with chamfered ends, from z = 0 upwards",
           {{"radius_m", "radius of its facets", d.radius},
            {"length_m", "length", d.length},
            {"chamfer_m", "chamfer of both ends", d.chamfer},
            count_parameter("segments", "facets around", d.segments),
            count_parameter("rows", "cells along the wall", d.rows)}},
          [](const ShapeValues& v) {
            return make_peg(
                {v.at("radius_m"), v.at("length_m"), v.at("chamfer_m"), count_of(v, "segments"), count_of(v, "rows")});
          }};
}

ShapeEntry holed_plate_entry() {
  const HoledPlateShape d;
  return {{"holed_plate",
           "square plate with a round hole about z for a peg, its upper face at z = 0",
           {{"hole_radius_m", "radius of the hole's facets", d.hole_radius},
            {"size_m", "edge of the plate", d.size},
            {"thickness_m", "thickness", d.thickness},
            count_parameter("segments", "facets around the hole, a multiple of 8", d.segments),
            count_parameter("rows", "cells along the hole", d.rows)}},
          [](const ShapeValues& v) {
            return make_holed_plate({v.at("hole_radius_m"), v.at("size_m"), v.at("thickness_m"),
                                     count_of(v, "segments"), count_of(v, "rows")});
          }};
}

std::vector<ShapeParameter> thread_parameters(int turns) {
  const ThreadShape d;
  return {{"diameter_m", "outer diameter of the bolt", d.diameter},
          {"pitch_m", "pitch", d.pitch},
          count_parameter("turns", "turns of the thread", turns),
          count_parameter("segments", "steps per turn, a multiple of 12", d.segments)};
}

ThreadShape thread_of(const ShapeValues& v) {
  return {v.at("diameter_m"), v.at("pitch_m"), count_of(v, "turns"), count_of(v, "segments")};
}

ShapeEntry bolt_entry() {
  return {
      {"bolt", "metric thread of a bolt about z, right-handed, an open sheet", thread_parameters(ThreadShape{}.turns)},
      [](const ShapeValues& v) { return make_bolt(thread_of(v)); }};
}

ShapeEntry nut_entry() {
  std::vector<ShapeParameter> parameters = thread_parameters(5);
  parameters.push_back({"play_m", "free way along the axis on the bolt", 40e-6});
  return {{"nut", "hexagonal nut about z for the bolt of equally many segments", parameters},
          [](const ShapeValues& v) { return make_nut(thread_of(v), v.at("play_m")); }};
}

ShapeEntry spur_gear_entry() {
  const GearShape d;
  return {{"spur_gear",
           "spur gear about z with involute teeth and a bore, from z = 0 upwards",
           {count_parameter("teeth", "teeth", d.teeth),
            {"module_m", "pitch diameter per tooth", d.module},
            {"width_m", "width", d.width},
            {"bore_radius_m", "radius of the bore's facets", d.bore_radius},
            count_parameter("flank_points", "points on each flank", d.flank_points),
            count_parameter("rows", "cells along the width", d.rows)}},
          [](const ShapeValues& v) {
            GearShape gear{count_of(v, "teeth"), v.at("module_m"), v.at("width_m"), v.at("bore_radius_m")};
            gear.flank_points = count_of(v, "flank_points");
            gear.rows = count_of(v, "rows");
            return make_spur_gear(gear);
          }};
}

ShapeEntry gear_base_entry() {
  const GearBaseShape d;
  return {{"gear_base",
           "square base with a post about z, its seat at z = 0",
           {{"size_m", "edge of the base", d.size},
            {"thickness_m", "thickness of the base", d.thickness},
            {"post_radius_m", "radius of the post's facets", d.post_radius},
            {"post_height_m", "height of the post", d.post_height},
            {"chamfer_m", "chamfer at the end of the post", d.chamfer},
            count_parameter("segments", "facets around the post, a multiple of 8", d.segments)}},
          [](const ShapeValues& v) {
            return make_gear_base({v.at("size_m"), v.at("thickness_m"), v.at("post_radius_m"), v.at("post_height_m"),
                                   v.at("chamfer_m"), count_of(v, "segments")});
          }};
}

std::vector<ShapeParameter> slide_in_parameters() {
  const SlideInShape d;
  return {{"width_m", "width of the body, along x", d.width},
          {"height_m", "height of the body, along z", d.height},
          {"depth_m", "depth of the body, along y", d.depth},
          {"bezel_thickness_m", "thickness of the bezel", d.bezel_thickness},
          {"bezel_border_m", "how far bezel and flange reach beyond the body", d.bezel_border},
          {"clearance_m", "gap between body and bay", d.clearance},
          {"overlap_m", "overlap of each tongue with the seated unit", d.overlap},
          count_parameter("tongues_per_side", "tongues at each side", d.tongues_per_side),
          count_parameter("triangles", "approximate number of triangles", static_cast<int>(d.triangles))};
}

SlideInShape slide_in_of(const ShapeValues& v) {
  return {v.at("width_m"),         v.at("height_m"),    v.at("depth_m"),   v.at("bezel_thickness_m"),
          v.at("bezel_border_m"),  v.at("clearance_m"), v.at("overlap_m"), count_of(v, "tongues_per_side"),
          count_of(v, "triangles")};
}

ShapeEntry slide_in_unit_entry() {
  return {{"slide_in_unit", "unit that slides along +y into its bay, in the frame of the bay when seated",
           slide_in_parameters()},
          [](const ShapeValues& v) { return make_slide_in_unit(slide_in_of(v)); }};
}

ShapeEntry bay_entry() {
  return {{"bay", "bay of the slide-in unit, without its tongues", slide_in_parameters()},
          [](const ShapeValues& v) { return make_bay(slide_in_of(v)); }};
}

ShapeEntry bay_tongues_entry() {
  return {{"bay_tongues", "spring tongues of the bay of the slide-in unit", slide_in_parameters()},
          [](const ShapeValues& v) { return geometry::merge(make_bay_tongues(slide_in_of(v))); }};
}

}  // namespace

std::vector<ShapeEntry> machine_element_entries() {
  return {bay_entry(), bay_tongues_entry(), bolt_entry(),          gear_base_entry(), holed_plate_entry(),
          nut_entry(), peg_entry(),         slide_in_unit_entry(), spur_gear_entry()};
}

}  // namespace glissade::shapes
