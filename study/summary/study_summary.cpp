#include "summary/study_summary.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <tuple>

#include <glissade/files/text.h>
#include <glissade/geometry/triangle_mesh.h>

namespace glissade::study {
namespace {

constexpr std::size_t kBins = 5;
constexpr std::size_t kMostWorst = 10;
constexpr std::size_t kMostJams = 20;
constexpr double kJamsOfPart = 0.05;  // jams nearer than this share of the part's size are one

double size_of_part(const Study& study) {
  return geometry::bounds_of(*study.scene.find(study.part).mesh).diagonal().norm();
}

}  // namespace

StudySummary::StudySummary(const Study& study)
    : study_(study),
      jam_distance_m_(kJamsOfPart * size_of_part(study)),
      values_(study.parameters.size()),
      names_(study.parameters.size()) {}

void StudySummary::add(const nlohmann::json& row) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t p = 0; p < values_.size(); ++p) {
    const nlohmann::json& value = row.at(study_.parameters[p].name);
    if (value.is_number()) {
      values_[p].push_back(value.get<double>());
    } else {
      const auto next = static_cast<double>(names_[p].size());
      values_[p].push_back(names_[p].try_emplace(value.get<std::string>(), next).first->second);
    }
  }
  slides_.push_back(row.at("slide").get<std::int64_t>());
  success_.push_back(row.at("success").get<int>() == 1);
  const auto outcome = row.at("outcome").get<std::string>();
  ++outcomes_[outcome];
  if (!row.at("problem").is_null()) {
    ++problems_;
  } else if (!success_.back()) {
    std::int64_t& first = first_failures_.try_emplace(outcome, slides_.back()).first->second;
    first = std::min(first, slides_.back());
  }
  const bool has_force = row.contains("force_max_N") && row["force_max_N"].is_number();
  forces_.push_back(has_force ? row["force_max_N"].get<double>() : unknown);
  if (!row.contains("jam_objects") || row["jam_objects"].is_null()) return;
  jams_.push_back({slides_.back(),
                   {row["jam_x_m"].get<double>(), row["jam_y_m"].get<double>(), row["jam_z_m"].get<double>()},
                   row["jam_objects"].get<std::string>()});
}

std::int64_t StudySummary::successes() const {
  return std::count(success_.begin(), success_.end(), true);
}

std::vector<std::int64_t> StudySummary::first_failures() const {
  std::vector<std::int64_t> slides;
  for (const auto& [outcome, slide] : first_failures_)
    slides.push_back(slide);
  return slides;
}

/// Of a stratified study.
std::vector<StratumCount> StudySummary::counts() const {
  std::vector<StratumCount> counts;
  for (const Stratum& stratum : study_.strata->all())
    counts.push_back({stratum.weight});
  for (std::size_t row = 0; row < slides_.size(); ++row) {
    StratumCount& count = counts[study_.strata->index_of(slides_[row])];
    ++count.slides;
    count.successes += success_[row] ? 1.0 : 0.0;
  }
  return counts;
}

/// By row. The slides of a stratified study stand for unequal shares of all values.
std::vector<double> StudySummary::weights() const {
  std::vector<double> weights(slides_.size(), 1.0);
  if (study_.strata == nullptr) return weights;
  const std::vector<StratumCount> strata = counts();
  for (std::size_t row = 0; row < slides_.size(); ++row) {
    const StratumCount& stratum = strata[study_.strata->index_of(slides_[row])];
    weights[row] = stratum.weight / static_cast<double>(stratum.slides);
  }
  return weights;
}

std::optional<Rate> StudySummary::rate() const {
  if (rows() == 0) return std::nullopt;
  if (study_.strata == nullptr) return success_rate(successes(), rows());
  const std::vector<StratumCount> strata = counts();
  if (std::any_of(strata.begin(), strata.end(), [](const StratumCount& count) { return count.slides == 0; }))
    return std::nullopt;
  return stratified_rate(strata);
}

/// Each text or number of a list is a bin. Other values are divided into bins of the same weight.
std::vector<StudySummary::Bin> StudySummary::bins(std::size_t parameter, const std::vector<double>& weights) const {
  const std::vector<double>& values = values_[parameter];
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  const bool is_list = study_.parameters[parameter].distribution.as_one_of() != nullptr;
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  constexpr double kRounding = 1e-9;
  std::vector<Bin> bins;
  double before = 0.0;  // weight of the slides so far
  for (std::size_t i = 0; i < order.size();) {
    const std::size_t begin = i;
    const double end = static_cast<double>(bins.size() + 1) * all / static_cast<double>(kBins) * (1.0 + kRounding);
    Bin& bin = bins.emplace_back();
    // Equal values are in one bin.
    while (i < order.size() && (i == begin || values[order[i]] == values[order[i - 1]] ||
                                (!is_list && before + weights[order[i]] <= end))) {
      const double weight = weights[order[i]];
      before += weight;
      bin.weight += weight;
      bin.success_weight += success_[order[i]] ? weight : 0.0;
      ++i;
    }
    bin.slides = static_cast<std::int64_t>(i - begin);
    bin.values = files::format_number(values[order[begin]]);
    if (!is_list) bin.values += " to " + files::format_number(values[order[i - 1]]);
    for (const auto& [name, number] : names_[parameter]) {
      if (number == values[order[begin]]) bin.values = name;
    }
  }
  return bins;
}

/// The share of the variance of success that the bins of the parameter explain: the first-order index of Sobol (1993),
/// estimated by bins. Without effect, it is about (bins − 1) / slides, if all slides have the same weight.
nlohmann::ordered_json StudySummary::sensitivity(std::size_t parameter, double mean,
                                                 const std::vector<double>& weights) const {
  double explained = 0.0;
  double all = 0.0;
  nlohmann::ordered_json json;
  json["name"] = study_.parameters[parameter].name;
  json["share_of_variance"] = 0.0;
  json["bins"] = nlohmann::ordered_json::array();
  for (const Bin& bin : bins(parameter, weights)) {
    const double rate = bin.success_weight / bin.weight;
    explained += bin.weight * (rate - mean) * (rate - mean);
    all += bin.weight;
    json["bins"].push_back({{"values", bin.values}, {"slides", bin.slides}, {"success_rate", rate}});
  }
  if (mean > 0.0 && mean < 1.0) json["share_of_variance"] = explained / all / (mean * (1.0 - mean));
  return json;
}

/// Jams at the same objects, each within a distance of the first one of its group, by number.
nlohmann::ordered_json StudySummary::jams() const {
  struct Group {
    Jam first;
    Eigen::Vector3d sum;
    std::int64_t count;
  };
  std::vector<Group> groups;
  for (const Jam& jam : jams_) {
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& known) {
      return known.first.objects == jam.objects && (known.first.p_W - jam.p_W).norm() <= jam_distance_m_;
    });
    if (group == groups.end()) {
      groups.push_back({jam, jam.p_W, 1});
    } else {
      group->sum += jam.p_W;
      ++group->count;
    }
  }
  std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) { return a.count > b.count; });
  if (groups.size() > kMostJams) groups.resize(kMostJams);
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Group& group : groups) {
    const Eigen::Vector3d mean = group.sum / static_cast<double>(group.count);
    json.push_back({{"objects", group.first.objects},
                    {"slides", group.count},
                    {"mean_m", {mean.x(), mean.y(), mean.z()}},
                    {"first_slide", group.first.slide}});
  }
  return json;
}

std::vector<std::int64_t> StudySummary::worst() const {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < slides_.size(); ++row) {
    if (!std::isnan(forces_[row])) rows.push_back(row);
  }
  const auto by_force = [&](std::size_t a, std::size_t b) {
    return std::pair(-forces_[a], slides_[a]) < std::pair(-forces_[b], slides_[b]);
  };
  const auto end = rows.begin() + static_cast<std::ptrdiff_t>(std::min(kMostWorst, rows.size()));
  std::partial_sort(rows.begin(), end, rows.end(), by_force);
  std::vector<std::int64_t> slides;
  std::transform(rows.begin(), end, std::back_inserter(slides), [&](std::size_t row) { return slides_[row]; });
  return slides;
}

nlohmann::ordered_json StudySummary::to_json() const {
  nlohmann::ordered_json json;
  json["slides"] = rows();
  json["successes"] = successes();
  json["problems"] = problems_;
  json["success_rate"] = nullptr;
  json["success_rate_95_percent"] = nullptr;  // the values of a grid are not random
  const std::optional<Rate> of_all = rate();
  if (of_all) json["success_rate"] = of_all->share;
  if (of_all && study_.sampling != Sampling::kGrid) {
    json["success_rate_95_percent"] = {of_all->least, of_all->greatest};
  }
  if (study_.strata != nullptr) json["strata"] = study_.strata->all().size();
  json["outcomes"] = outcomes_;
  const std::vector<double> of_rows = weights();
  std::vector<nlohmann::ordered_json> sensitivities;
  for (std::size_t p = 0; p < values_.size(); ++p)
    sensitivities.push_back(sensitivity(p, of_all ? of_all->share : 0.0, of_rows));
  std::stable_sort(sensitivities.begin(), sensitivities.end(), [](const auto& a, const auto& b) {
    return a.at("share_of_variance").template get<double>() > b.at("share_of_variance").template get<double>();
  });
  json["parameters"] = sensitivities;
  json["jams"] = jams();
  json["greatest_forces"] = worst();
  return json;
}

}  // namespace glissade::study
