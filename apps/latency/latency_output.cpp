#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <glissade/apps/latency/latency_output.h>
#include <glissade/apps/latency/machine_load.h>
#include <glissade/apps/report/html_report.h>
#include <glissade/apps/view/replay_maker.h>

namespace glissade::apps {

namespace {

using realtime::LatencyHistogram;

/// A row of the tables.
struct LatencyRow {
  const char* title;
  const char* key;
  std::function<const LatencyHistogram&(const LinkFigures&)> of;
};

const std::vector<LatencyRow>& latency_rows() {
  using Histogram = const LatencyHistogram&;
  static const std::vector<LatencyRow> rows{
      {"transport", "transport_us", [](const LinkFigures& link) -> Histogram { return link.stages.transport; }},
      {"wait for the tick", "wait_us", [](const LinkFigures& link) -> Histogram { return link.stages.wait; }},
      {"computation", "computation_us", [](const LinkFigures& link) -> Histogram { return link.stages.computation; }},
      {"way back", "way_back_us", [](const LinkFigures& link) -> Histogram { return link.stages.way_back; }},
      {"sample to force", "whole_us", [](const LinkFigures& link) -> Histogram { return link.stages.whole; }},
      {"haptic loop is late", "haptic_lateness_us",
       [](const LinkFigures& link) -> Histogram { return link.haptic_lateness; }},
      {"bare loop is late", "bare_lateness_us",
       [](const LinkFigures& link) -> Histogram { return link.bare_lateness; }},
  };
  return rows;
}

constexpr std::size_t kStages = 5;  // the first of these rows

double in_us(std::chrono::nanoseconds duration) {
  return static_cast<double>(duration.count()) / 1e3;  // 0.237 and not 0.23700000000000002
}

template <typename... Values>
std::string printed(const char* format, Values... values) {
  std::array<char, 200> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}

std::string cells_of(const LatencyHistogram& histogram) {
  return printed("  %8.1f %8.1f %8.1f", in_us(histogram.quantile(0.5)), in_us(histogram.quantile(0.99)),
                 in_us(histogram.max()));
}

std::string table_of(const LoadFigures& figures, const std::string& title) {
  std::string text = printed("%-20s", title.c_str());
  for (const LinkFigures& link : figures.links)
    text += printed("  %26s", std::string(link.link).c_str());
  text += printed("\n%-20s", "us");
  for (std::size_t i = 0; i < figures.links.size(); ++i)
    text += printed("  %8s %8s %8s", "p50", "p99", "max");
  for (const LatencyRow& row : latency_rows()) {
    text += printed("\n%-20s", row.title);
    for (const LinkFigures& link : figures.links)
      text += cells_of(row.of(link));
  }
  text += printed("\n%-20s", "samples (lost)");
  for (const LinkFigures& link : figures.links) {
    const std::string count = std::to_string(link.stages.whole.count()) + " (" + std::to_string(link.stages.lost) + ")";
    text += printed("  %26s", count.c_str());
  }
  return text + printed("\n%-20s", "UDP round trip") + cells_of(figures.round_trip) + '\n';
}

/// Names and values of the ratios, with targets.
std::vector<std::pair<std::string, std::string>> ratio_rows(const LoadFigures& figures, const std::string& load) {
  const LatencyRatios ratios = latency_ratios(figures);
  return {{"haptic loop to bare loop, lateness, " + load,
           printed("p50 %.2f (target %.1f), p99 %.2f (target %.1f)", ratios.lateness_p50, kLatencyTargets.lateness_p50,
                   ratios.lateness_p99, kLatencyTargets.lateness_p99)},
          {"udpm:// to UDP round trip and half a tick, " + load,
           printed("p50 %.2f (target %.1f)", ratios.udpm_p50, kLatencyTargets.udpm_p50)}};
}

std::vector<std::pair<std::string, std::string>> all_ratio_rows(const LatencyFigures& figures) {
  std::vector<std::pair<std::string, std::string>> rows = ratio_rows(figures.idle, "idle");
  for (auto& row : ratio_rows(figures.loaded, "loaded"))
    rows.push_back(std::move(row));
  return rows;
}

std::string scheduling_text(const LatencyFigures& figures) {
  return figures.has_fifo_scheduling ? "real-time (SCHED_FIFO)"
                                     : "ordinary (SCHED_FIFO was refused; see glissade doctor)";
}

nlohmann::ordered_json quantiles_json(const LatencyHistogram& histogram) {
  return {{"p50", in_us(histogram.quantile(0.5))},
          {"p99", in_us(histogram.quantile(0.99))},
          {"max", in_us(histogram.max())},
          {"count", histogram.count()}};
}

nlohmann::ordered_json load_json(const LoadFigures& figures) {
  nlohmann::ordered_json json{{"links", nlohmann::ordered_json::array()}};
  for (const LinkFigures& link : figures.links) {
    nlohmann::ordered_json entry{{"link", link.link}};
    for (const LatencyRow& row : latency_rows())
      entry[row.key] = quantiles_json(row.of(link));
    entry["lost"] = link.stages.lost;
    json["links"].push_back(std::move(entry));
  }
  json["udp_round_trip_us"] = quantiles_json(figures.round_trip);
  const LatencyRatios ratios = latency_ratios(figures);
  json["ratios"] = {
      {"lateness_p50", ratios.lateness_p50}, {"lateness_p99", ratios.lateness_p99}, {"udpm_p50", ratios.udpm_p50}};
  return json;
}

/// The histogram's bars up to `longest`, each from its begin, in percent of all durations.
PlotSeries bars_of(const LatencyHistogram& histogram, std::string name, std::chrono::nanoseconds longest) {
  constexpr int kBars = 100;
  PlotSeries series{std::move(name), {}, {}};
  std::uint64_t before = 0;
  for (int i = 0; i < kBars; ++i) {
    const std::uint64_t up_to_end = histogram.count_up_to(longest * (i + 1) / kBars);
    series.x.push_back(in_us(longest * i / kBars));
    series.y.push_back(100.0 * static_cast<double>(up_to_end - before) /
                       static_cast<double>(std::max<std::uint64_t>(1, histogram.count())));
    before = up_to_end;
  }
  series.x.push_back(in_us(longest));
  series.y.push_back(series.y.back());
  return series;
}

/// The histograms of the chosen rows of a link; its axis ends where the longest of 200 durations lies.
Plot plot_of(const LinkFigures& link, const std::string& title, std::size_t first_row, std::size_t end_row) {
  Plot plot{std::string(link.link) + ", " + title, "duration [us]", "share [%]", {}, false, true};
  std::chrono::nanoseconds longest{1000};
  for (std::size_t i = first_row; i < end_row; ++i)
    longest = std::max(longest, latency_rows()[i].of(link).quantile(0.995));
  for (std::size_t i = first_row; i < end_row; ++i)
    plot.series.push_back(bars_of(latency_rows()[i].of(link), latency_rows()[i].title, longest));
  return plot;
}

}  // namespace

std::string to_text(const LatencyFigures& figures) {
  std::string text = "from a sample of the glove to the force at the glove\n\n" + table_of(figures.idle, "idle") +
                     '\n' + table_of(figures.loaded, "loaded") + "\nload: " + machine_load_text() +
                     "\nscheduling: " + scheduling_text(figures) + '\n';
  for (const auto& [name, value] : all_ratio_rows(figures))
    text += name + ": " + value + '\n';
  return text;
}

nlohmann::ordered_json to_json(const LatencyFigures& figures) {
  return {{"fifo", figures.has_fifo_scheduling},
          {"load", machine_load_text()},
          {"idle", load_json(figures.idle)},
          {"loaded", load_json(figures.loaded)}};
}

std::string write_latency_report(const LatencyFigures& figures, const std::string& folder) {
  Report report{"glissade latency", all_ratio_rows(figures), {}};
  report.summary.emplace_back("load", machine_load_text());
  report.summary.emplace_back("scheduling", scheduling_text(figures));
  for (const auto& [load, name] : {std::pair(&figures.idle, "idle"), std::pair(&figures.loaded, "loaded")}) {
    for (const LinkFigures& link : load->links) {
      for (const LatencyRow& row : latency_rows()) {
        const LatencyHistogram& histogram = row.of(link);
        report.summary.emplace_back(std::string(link.link) + ", " + name + ": " + row.title,
                                    printed("p50 %.1f us, p99 %.1f us, max %.1f us", in_us(histogram.quantile(0.5)),
                                            in_us(histogram.quantile(0.99)), in_us(histogram.max())));
      }
      report.plots.push_back(plot_of(link, std::string(name) + ": stages", 0, kStages));
      report.plots.push_back(plot_of(link, std::string(name) + ": lateness", kStages, latency_rows().size()));
    }
  }
  if (figures.slice && figures.slice->size() > 0) {
    ReplayMaker replay(latency_view());
    for (std::size_t i = 0; i < figures.slice->size(); ++i)
      replay.add(figures.slice->state(i));
    report.summary.emplace_back("replay", "up to a second over the link in process, idle");
    report.replay = replay.finish();
  }
  return write_html_report(report, folder);
}

}  // namespace glissade::apps
