#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/command.h>
#include <glissade/apps/commands/size_warnings.h>
#include <glissade/apps/progress.h>
#include <glissade/apps/report/html_report.h>
#include <glissade/apps/run/stop_signal.h>
#include <glissade/apps/say.h>
#include <glissade/apps/study/study_report.h>
#include <glissade/apps/study/study_workers.h>
#include <glissade/apps/study/worker_process.h>
#include <glissade/apps/text.h>
#include <glissade/apps/usage.h>
#include <glissade/apps/view/session_view.h>
#include <glissade/study/slide_row.h>
#include <glissade/study/slide_runner.h>
#include <glissade/study/study.h>
#include <glissade/study/study_results.h>

namespace glissade::apps {

namespace {

constexpr const char* kStudyDescription =
    "Run an assembly study: thousands of slides, each with other tolerances, paths or rules";

constexpr const char* kStudyFooter =
    "A study file is YAML. It names a scene, a part, its trajectory, and the parameters that vary from slide to "
    "slide:\n"
    "  scene: square_peg.yaml\n"
    "  part: peg\n"
    "  trajectory: square_peg_script.csv\n"
    "  parameters:\n"
    "    - {vary: path.x_m, uniform: [-0.0005, 0.0005]}\n"
    "    - {vary: path.roll_deg, normal: [0, 0.2]}\n"
    "  slides: 1000\n"
    "All keys: docs/studies.md in the sources.\n"
    "\n"
    "Each slide is one run of 'glissade slide', offline and deterministic. The values of its parameters depend on the\n"
    "seed of the study and on the number of the slide only. So the results are the same to the byte for any number of\n"
    "processes and in any order.\n"
    "\n"
    "Output, in the folder --out: slides.csv with one row per slide, slides.jsonl with the same rows as JSON,\n"
    "study.json with the success rate, and the page index.html with a map, a table and the replays of the worst\n"
    "slides. If a run is stopped, the same command goes on where it ended. If the study, its meshes or the version of\n"
    "Glissade have changed, the slides are run again.\n"
    "\n"
    "With --view, a browser shows the page during the run, and the replay of any slide. The command then goes on "
    "until\n"
    "Ctrl-C.\n"
    "\n"
    "Several machines: with --shard 0/4, a run does each fourth slide, beginning with slide 0. When all shards are in\n"
    "the folder, the command without --shard makes the tables.\n"
    "\n"
    "Problems: if a slide is impossible, for example because the part starts inside an object, its row says why, in "
    "the\n"
    "column 'problem'. The same applies to slides that crash or take longer than --longest-s.\n"
    "\n"
    "Examples, with the files of 'glissade example':\n"
    "  glissade study square_peg_study.yaml --out peg_results\n"
    "  glissade study square_peg_study.yaml --slide 7 --report slide_7";

struct StudyOptions {
  std::string file;
  std::string folder;
  int workers = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::string shard = "0/1";
  double longest_s = 600.0;
  std::optional<std::int64_t> slide;
  std::string report;
  std::optional<std::uint16_t> view_port;
  bool is_worker = false;
  std::string worker_pages;
};

study::Shard parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  const std::optional<double> part = parse_number(text.substr(0, slash));
  const std::optional<double> parts = slash == std::string::npos ? part : parse_number(text.substr(slash + 1));
  const auto is_whole = [](double value) { return value == static_cast<double>(static_cast<std::int64_t>(value)); };
  constexpr double kMostShards = 1e6;
  if (slash != std::string::npos && part && parts && is_whole(*part) && is_whole(*parts) && *part >= 0.0 &&
      *part < *parts && *parts <= kMostShards) {
    return {static_cast<std::int64_t>(*part), static_cast<std::int64_t>(*parts)};
  }
  throw std::invalid_argument("--shard: must be PART/PARTS with 0 <= PART < PARTS, such as 0/4, not " +
                              in_quotes(text));
}

/// "1200 of 10000 slides, 53 per second, 166 s left".
AmountText slides_and_rate(std::int64_t done_before) {
  const auto start = std::chrono::steady_clock::now();
  return [start, done_before](std::int64_t done, std::int64_t total) {
    const double elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double rate = static_cast<double>(done - done_before) / std::max(elapsed_s, 1e-3);
    std::string text = std::to_string(done) + " of " + std::to_string(total) + " slides";
    if (rate > 0.0) {
      text += ", " + rounded_text(rate) + " per second, " + fixed_text(static_cast<double>(total - done) / rate, 0) +
              " s left";
    }
    return text;
  };
}

/// The slides of a shard that have no row yet.
class MissingSlides {
 public:
  MissingSlides(const study::StudyResults& files, const study::Shard& shard, std::int64_t slides)
      : files_(files), step_(shard.parts), slides_(slides), next_(shard.part) {}

  std::optional<std::int64_t> operator()() {
    while (next_ < slides_ && files_.has(next_))
      next_ += step_;
    if (next_ >= slides_) return std::nullopt;
    return std::exchange(next_, next_ + step_);
  }

 private:
  const study::StudyResults& files_;
  std::int64_t step_;
  std::int64_t slides_;
  std::int64_t next_;
};

/// Without slides.
StudyWork work_of(const StudyOptions& options) {
  return {.study_file = options.file,
          .workers = options.workers,
          .longest = std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 * options.longest_s)),
          .next = {},
          .take = {},
          .should_stop = StopSignal::requested};
}

/// Runs what is missing.
void run_missing(const StudyOptions& options, const study::Study& study, const study::SlideRunner& runner,
                 const study::Shard& shard, study::StudyResults& files, std::mutex& rows_mutex) {
  MissingSlides missing(files, shard, study.slides);
  ProgressBar progress("sliding", study.slides, slides_and_rate(files.count()));
  StudyWork work = work_of(options);
  work.next = [&missing] { return missing(); };
  work.take = [&](std::int64_t slide, const std::string& json) {
    const std::scoped_lock lock(rows_mutex);
    files.add(slide, json);
    progress.update(files.count());
  };
  run_slides(study, runner, work);
}

std::string percent(double share) {
  return fixed_text(100.0 * share, 2) + " %";
}

void tell(const study::Study& study, const study::StudyCounts& counts, const std::string& folder) {
  const study::Rate& rate = counts.rate;
  std::cout << counts.successes << " of " << counts.rows << " slides succeed: ";
  if (study.strata != nullptr) std::cout << "with the weights of their strata, ";
  std::cout << percent(rate.share);
  if (study.sampling != study::Sampling::kGrid)
    std::cout << " (95 % interval: " << percent(rate.least) << " to " << percent(rate.greatest) << ')';
  if (counts.problems > 0) std::cout << "; " << counts.problems << " could not be run, see the column 'problem'";
  std::cout << "\nresults: " << folder << "/slides.csv" << std::endl;
}

/// The text as one word of a shell.
std::string in_shell(const std::string& text) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string word = "'";
  for (const char c : text)
    word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

/// Prints a row, and writes its page.
void run_one(const StudyOptions& options, const study::Study& study, const study::SlideRunner& runner) {
  if (*options.slide < 0 || *options.slide >= study.slides) {
    throw std::invalid_argument("--slide: the study has the slides 0 to " + std::to_string(study.slides - 1) +
                                ", not " + std::to_string(*options.slide));
  }
  if (options.report.empty()) {
    std::cout << study::json_of(study, runner.run(*options.slide)) << '\n';
    return;
  }
  prepare_report_folder(options.report);
  std::cout << write_slide_page(study, runner, *options.slide, options.report) << '\n';
}

std::unique_ptr<viewer::PageServer> open_pages(std::uint16_t port, StudyReport& report) {
  try {
    auto server =
        std::make_unique<viewer::PageServer>(port, [&report](std::string_view path) { return report.find(path); });
    say("glissade study: open " + server->url());
    return server;
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string("--view: ") + error.what() +
                                "; choose another port, or any free one with --view 0");
  }
}

/// Runs the slides that are missing, and writes tables and pages.
int run_all(const StudyOptions& options, const study::Study& study, const study::SlideRunner& runner) {
  const study::Shard shard = parse_shard(options.shard);
  const StopSignal stop;
  study::StudyResults files(options.folder, study, runner, shard);
  if (files.outdated() > 0) {
    warn(options.folder + ": " + std::to_string(files.outdated()) +
         " rows belong to other inputs or another version, and are not used");
  }
  if (shard.is_all()) prepare_report_folder(options.folder);
  std::mutex rows_mutex;
  StudyReport report({.study = study,
                      .runner = runner,
                      .results = files,
                      .rows_mutex = rows_mutex,
                      .folder = options.folder,
                      .command = "glissade study " + in_shell(options.file) + " --out " + in_shell(options.folder),
                      .work = work_of(options)});
  const auto server = options.view_port ? open_pages(*options.view_port, report) : nullptr;
  run_missing(options, study, runner, shard, files, rows_mutex);
  const std::string done = std::to_string(files.count()) + " of " + std::to_string(study.slides) + " slides are done";
  if (StopSignal::requested()) {
    say("glissade: stopped: " + done + "; the same command goes on");
    return 1;
  }
  if (!shard.is_all()) {
    std::cout << "shard " << options.shard << ": " << done << " in " << options.folder << '\n';
    return 0;
  }
  const study::StudyCounts counts = [&] {
    const std::scoped_lock lock(rows_mutex);
    return files.finish();
  }();
  tell(study, counts, options.folder);
  if (!report.write()) {
    say("glissade: stopped: some replays are missing; the same command makes them");
    return 1;
  }
  std::cout << "page: " << report_page(options.folder) << std::endl;
  constexpr std::chrono::milliseconds kPollPeriod{50};
  while (server && !StopSignal::requested())
    std::this_thread::sleep_for(kPollPeriod);
  return 0;
}

int run(const StudyOptions& options) {
  const study::Study study = study::read_study(options.file);
  if (!options.is_worker) {
    for (const std::string& sentence : doubtful_objects(study.scene))
      warn(sentence);
  }
  const study::SlideRunner runner(study);
  if (options.is_worker) {
    const std::string& pages = options.worker_pages;
    serve_slides([&](std::int64_t slide) {
      return pages.empty() ? study::json_of(study, runner.run(slide))
                           : write_slide_page(study, runner, slide, page_folder(pages, slide));
    });
    return 0;
  }
  if (!options.slide) return run_all(options, study, runner);
  run_one(options, study, runner);
  return 0;
}

}  // namespace

void add_study_command(CLI::App& app, Command& chosen) {
  const auto options = std::make_shared<StudyOptions>();
  CLI::App* command = app.add_subcommand("study", kStudyDescription);
  command->footer(kStudyFooter);
  command->add_option("STUDY", options->file, "Study file (YAML)")->required();
  command->add_option(
      "--out", options->folder,
      "Folder for the results; default: the name of the study file without its extension, and _results");
  constexpr int kMostWorkers = 1024;
  command->add_option("--workers", options->workers, "Processes that run slides; default: one per processor")
      ->check(CLI::Range(1, kMostWorkers));
  CLI::Option* shard =
      command->add_option("--shard", options->shard, "Do a share of the slides only, such as 0/4, see above");
  constexpr double kShortest_s = 1e-3;
  constexpr double kLongest_s = 1e8;  // some years, and no overflow of nanoseconds
  command->add_option("--longest-s", options->longest_s, "A slide that takes more seconds is given up")
      ->check(CLI::Range(kShortest_s, kLongest_s))
      ->capture_default_str();
  CLI::Option* slide = command->add_option("--slide", options->slide, "Run this slide only, and print its row as JSON");
  command->add_option("--report", options->report, "Folder for a page, index.html, with the replay of the slide")
      ->needs(slide);
  add_view_option(*command, options->view_port)->excludes(slide)->excludes(shard);
  command->add_flag(WorkerProcess::kOption, options->is_worker)->group("");
  command->add_option(WorkerProcess::kPagesOption, options->worker_pages)->group("");
  add_quiet_option(*command);
  command->callback([options, &chosen] {
    chosen = [options] {
      StudyOptions of_run = *options;
      if (of_run.folder.empty())
        of_run.folder = std::filesystem::path(of_run.file).replace_extension().string() + "_results";
      return run(of_run);
    };
  });
}

}  // namespace glissade::apps
