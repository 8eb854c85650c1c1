#include "query_case.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>

namespace glissade::bench {
namespace {

using collision::QueryCounters;
using Eigen::Isometry3d;

// The models of both meshes, one for each kind, and a query for each subject.
class Contest {
 public:
  Contest(const QueryCase& query_case, const std::vector<Subject>& subjects) {
    const bool same = &query_case.mesh_A == &query_case.mesh_B;
    for (const Subject& subject : subjects) {
      auto& [model_A, model_B] = models_[subject.model];
      if (!model_A) model_A = subject.build(query_case.mesh_A);
      if (!model_B && !same) model_B = subject.build(query_case.mesh_B);
      queries_.push_back(subject.query(*model_A, same ? *model_A : *model_B));
      contestants_.push_back({queries_.back().get(), subject.slow});
    }
  }

  const std::vector<Contestant>& contestants() const { return contestants_; }

 private:
  std::map<std::string, std::pair<std::unique_ptr<Model>, std::unique_ptr<Model>>> models_;
  std::vector<std::unique_ptr<Query>> queries_;
  std::vector<Contestant> contestants_;
};

struct Answers {
  std::vector<double> of_pose;
  QueryCounters counters;  // sums
  bool counts = false;
};

double answer(Query& query, const Isometry3d& X_AB, Operation operation) {
  if (operation == Operation::kIntersects) return query.intersects(X_AB) ? 1.0 : 0.0;
  if (operation == Operation::kCountPairs) return static_cast<double>(query.count_pairs(X_AB));
  return std::max(0.0, query.distance(X_AB));
}

Answers answers(const Contestant& contestant, const QueryCase& query_case) {
  Query& query = *contestant.query;
  Answers result;
  query.start();
  for (const std::vector<Isometry3d>& part : parts_for(contestant, query_case.poses)) {
    for (const Isometry3d& X_AB : part) {
      result.of_pose.push_back(answer(query, X_AB, query_case.operation));
      if (const auto counters = query.counters()) {
        result.counts = true;
        result.counters.node_tests += counters->node_tests;
        result.counters.realignments += counters->realignments;
        result.counters.triangle_tests += counters->triangle_tests;
      }
    }
  }
  return result;
}

// Verdicts and counts are whole numbers; distances may differ by a rounding.
std::int64_t differences(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double kRounding = 1e-6;
  std::int64_t count = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    count += std::abs(a[i] - b[i]) <= kRounding ? 0 : 1;
  return count;
}

double sum(const std::vector<double>& values) {
  double total = 0.0;
  for (const double value : values)
    total += value;
  return total;
}

// Adds the rows, subject by subject.
class Reporter {
 public:
  Reporter(const QueryCase& query_case, Results& results) : case_(query_case), results_(results) {}

  void add(const Subject& subject, const PassTimes& times, const Answers& ours, const Answers& reference) {
    if (!subject.slow) row(subject, "time", times.all_ns, "ns");
    for (std::size_t i = 0; i < std::min(times.part_ns.size(), case_.part_names.size()); ++i)
      row(subject, "time_" + case_.part_names[i], times.part_ns[i], "ns");
    const auto poses = static_cast<double>(ours.of_pose.size());
    if (ours.counts) {
      row(subject, "node_tests", static_cast<double>(ours.counters.node_tests) / poses, "1");
      row(subject, "realignments", static_cast<double>(ours.counters.realignments) / poses, "1");
      row(subject, "triangle_tests", static_cast<double>(ours.counters.triangle_tests) / poses, "1");
    }
    if (case_.operation == Operation::kCountPairs) add_pairs(subject, times, sum(ours.of_pose), poses);
    if (&ours == &reference) {
      row(subject, "poses", poses, "1");
      row(subject, "triangles", static_cast<double>(case_.mesh_A.triangles.size()), "1");
      if (case_.operation == Operation::kIntersects) row(subject, "colliding", sum(ours.of_pose), "1");
    } else {
      row(subject, "disagreements", static_cast<double>(differences(ours.of_pose, reference.of_pose)), "1");
    }
  }

 private:
  void add_pairs(const Subject& subject, const PassTimes& times, double pairs, double poses) {
    row(subject, "pairs", pairs / poses, "1");
    if (pairs > 0.0) row(subject, "time_per_pair", times.all_ns * poses / pairs, "ns");
  }

  void row(const Subject& subject, const std::string& metric, double value, const std::string& unit) {
    results_.add({case_.bench, case_.name, subject.name, metric, value, unit});
  }

  const QueryCase& case_;
  Results& results_;
};

void say(const QueryCase& query_case, const std::vector<Subject>& subjects, const std::vector<PassTimes>& times,
         const std::vector<Answers>& all) {
  std::fprintf(stderr, "%s %s:", query_case.bench.c_str(), query_case.name.c_str());
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    std::fprintf(stderr, " %s %.3g us", subjects[i].name.c_str(), 1e-3 * times[i].all_ns);
    const double ours_ns = subjects[i].slow ? times[0].part_ns[0] : times[0].all_ns;
    if (i > 0) std::fprintf(stderr, " (%.1fx)", times[i].all_ns / ours_ns);
    if (const auto wrong = differences(all[i].of_pose, all[0].of_pose); wrong > 0) {
      std::fprintf(stderr, " [%lld of %zu answers differ]", static_cast<long long>(wrong), all[i].of_pose.size());
    }
  }
  std::fputc('\n', stderr);
}

}  // namespace

PoseParts with_sample(const std::vector<Isometry3d>& poses, std::size_t series, std::size_t every) {
  PoseParts parts(2);
  for (std::size_t i = 0; i < poses.size(); ++i)
    parts[(i / series) % every == 0 ? 0 : 1].push_back(poses[i]);
  return parts;
}

void run_query_case(const QueryCase& query_case, const std::vector<Subject>& subjects, const PassLimits& limits,
                    Results& results) {
  if (query_case.poses.empty() || query_case.poses[0].empty()) {
    std::fprintf(stderr, "%s %s: left out, no such poses were found\n", query_case.bench.c_str(),
                 query_case.name.c_str());
    return;
  }
  const Contest contest(query_case, subjects);
  std::vector<Answers> all;
  for (const Contestant& contestant : contest.contestants())
    all.push_back(answers(contestant, query_case));
  const std::vector<PassTimes> times =
      interleaved_passes(contest.contestants(), query_case.poses, query_case.operation, limits);
  Reporter reporter(query_case, results);
  for (std::size_t i = 0; i < subjects.size(); ++i)
    reporter.add(subjects[i], times[i], all[i], all[0]);
  say(query_case, subjects, times, all);
}

}  // namespace glissade::bench
