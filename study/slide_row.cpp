#include <cmath>
#include <limits>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include <glissade/files/hash.h>
#include <glissade/files/text.h>
#include <glissade/study/slide_row.h>

namespace glissade::study {
namespace {

using Json = nlohmann::ordered_json;

/// A column without a value is null.
Json number(double value) {
  return std::isfinite(value) ? Json(value + 0.0) : Json();  // + 0.0: no negative zero
}

Json value_of(const Parameter& parameter, double value) {
  const OneOf* one_of = parameter.distribution.as_one_of();
  if (one_of != nullptr && one_of->numbers.empty()) return one_of->names[static_cast<std::size_t>(value)];
  return number(value);
}

void add_jam(Json& json, const SlideRow& row) {
  const SlideMeasures& measures = row.measures;
  const bool jams = !row.problem && measures.jams();
  json["jam_at_s"] = jams ? number(measures.still_since_s) : Json();
  for (int axis = 0; axis < 3; ++axis) {
    json["jam_" + std::string(1, "xyz"[axis]) + "_m"] = jams ? number((*measures.p_Wpushed)[axis]) : Json();
  }
  json["jam_objects"] = jams ? Json(measures.pushed_by) : Json();
}

void add_last_pose(Json& json, const SlideRow& row) {
  const Eigen::Vector3d p = row.measures.X_WV_end.translation();
  Eigen::Quaterniond q(row.measures.X_WV_end.linear());
  if (q.w() < 0.0) q.coeffs() *= -1.0;
  const std::array<std::pair<const char*, double>, 7> values{{{"last_x_m", p.x()},
                                                              {"last_y_m", p.y()},
                                                              {"last_z_m", p.z()},
                                                              {"last_qw", q.w()},
                                                              {"last_qx", q.x()},
                                                              {"last_qy", q.y()},
                                                              {"last_qz", q.z()}}};
  for (const auto& [name, value] : values)
    json[name] = row.problem ? Json() : number(value);
}

Json json_object(const Study& study, const SlideRow& row) {
  const SlideMeasures& measures = row.measures;
  const auto measured = [&row](double value) { return row.problem ? Json() : number(value); };
  Json json;
  json["slide"] = row.slide;
  for (std::size_t p = 0; p < study.parameters.size(); ++p)
    json[study.parameters[p].name] = value_of(study.parameters[p], row.values[p]);
  if (study.strata != nullptr) {
    json["stratum"] = study.strata->index_of(row.slide);
    json["weight"] = study.strata->weight_of(row.slide);
  }
  json["success"] = row.outcome == "success" ? 1 : 0;
  json["outcome"] = row.outcome;
  json["goal_distance_m"] = measured(measures.goal_distance_m);
  json["goal_angle_deg"] = measured(measures.goal_angle_deg);
  if (study.has(Record::kForces)) {
    json["force_max_N"] = measured(measures.force_max_N);
    json["torque_max_Nm"] = measured(measures.torque_max_Nm);
  }
  if (study.has(Record::kClearance)) {
    json["clearance_min_m"] = measured(measures.clearance_min_m);
    const bool is_near = std::isfinite(measures.clearance_min_m);
    json["clearance_min_at_s"] = is_near ? measured(measures.clearance_min_at_s) : Json();
  }
  if (study.has(Record::kTime)) {
    json["duration_s"] = measured(measures.duration_s);
    json["contact_s"] = measured(measures.contact_s);
  }
  if (study.has(Record::kJam)) add_jam(json, row);
  if (study.has(Record::kWork)) json["work_J"] = measured(measures.work_J);
  if (study.has(Record::kLastPose)) add_last_pose(json, row);
  json["problem"] = row.problem ? Json(*row.problem) : Json();
  json["input_hash"] = files::hexadecimal(row.input_hash);
  return json;
}

/// A cell of CSV (RFC 4180).
std::string cell(const Json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return value.dump();
  const auto text = value.get<std::string>();
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace

std::uint64_t input_hash(std::uint64_t study_hash, const std::vector<double>& values) {
  files::Hash hash;
  hash.add(study_hash);
  for (const double value : values)
    hash.add(value);
  return hash.value();
}

std::string json_of(const Study& study, const SlideRow& row) {
  return json_object(study, row).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string too_long(double longest_s) {
  return "the slide did not end within " + files::rounded_text(longest_s) + " s";
}

std::vector<std::string> columns_of(const Study& study) {
  std::vector<std::string> names;
  const SlideRow row{.values = std::vector<double>(study.parameters.size()), .problem = ""};
  const Json json = json_object(study, row);  // outlives the loop
  for (const auto& [name, value] : json.items())
    names.push_back(name);
  return names;
}

std::string csv_of(std::string_view json) {
  const Json row = Json::parse(json, nullptr, false);
  if (!row.is_object()) throw std::invalid_argument("not a row of a study: " + files::in_quotes(json));
  std::vector<std::string> cells;
  for (const Json& value : row)
    cells.push_back(cell(value));
  return files::joined(cells, ",");
}

}  // namespace glissade::study
