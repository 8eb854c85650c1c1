#include "pressing_hand.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "glissade_program.h"

namespace glissade::test_support {

namespace {

std::string scene_of(const PressingHandOptions& options) {
  return "objects:\n"
         "  - {name: plate, shape: {type: plate, size_x_m: 1, size_y_m: 1, triangles: " +
         std::to_string(options.plate_triangles) +
         "}}\n"
         "  - name: box\n"
         "    movable: true\n"
         "    shape: {type: box, size_x_m: 0.1, size_y_m: 0.06, size_z_m: 0.04, triangles: " +
         std::to_string(options.box_triangles) +
         "}\n"
         "    pose: {position_m: [0, 0, 0.03]}\n" +
         options.more_objects;
}

void wait_until(const std::string& what, const std::function<bool()>& holds) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error("waited too long until " + what);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

}  // namespace

GloveRecord::GloveRecord(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  for (const CsvRow& row : rows_of(text.str())) {
    const auto number = [&](const char* column) { return std::strtod(row.at(column).c_str(), nullptr); };
    const auto reason = row.find("reason");
    periods_.push_back({number("t_s"),
                        {number("fx_N"), number("fy_N"), number("fz_N")},
                        {number("tx_Nm"), number("ty_Nm"), number("tz_Nm")},
                        reason == row.end() ? "" : reason->second});
  }
}

std::vector<GlovePeriod> GloveRecord::between(std::chrono::nanoseconds first, std::chrono::nanoseconds last) const {
  const std::chrono::duration<double> low = first;
  const std::chrono::duration<double> high = last;
  std::vector<GlovePeriod> result;
  std::copy_if(periods_.begin(), periods_.end(), std::back_inserter(result),
               [&](const GlovePeriod& period) { return low.count() <= period.t && period.t <= high.count(); });
  return result;
}

double greatest_force(const std::vector<GlovePeriod>& periods) {
  double greatest = 0.0;
  for (const GlovePeriod& period : periods)
    greatest = std::max(greatest, period.f_W.norm());
  return greatest;
}

double greatest_sideways(const std::vector<GlovePeriod>& periods) {
  double greatest = 0.0;
  for (const GlovePeriod& period : periods)
    greatest = std::max(greatest, period.f_W.head<2>().norm());
  return greatest;
}

PressingHand::PressingHand(const PressingHandOptions& options) : options_(options) {
  folder_.write("scene.yaml", scene_of(options));
  glove_ = start_glove(0.0, folder_.path("record.csv"));
  server_ = start_server();
  wait_until("the server holds the glove",
             [this] { return server_->standard_error().find("holds") != std::string::npos; });
  // No fixed time would do: any process may wait for a processor, and the force fades then.
  const auto held = std::chrono::steady_clock::now();
  wait_until("the hand presses", [this] { return relay_.force() > kPressing_N; });
  EXPECT_LT(std::chrono::steady_clock::now() - held, std::chrono::seconds(2)) << "the hand may be at rest by now";
  std::this_thread::sleep_for(std::chrono::milliseconds(600));  // until it rests
}

std::unique_ptr<Process> PressingHand::start_server() const {
  std::vector<std::string> arguments{GLISSADE_PROGRAM, "run", folder_.path("scene.yaml"), "--lcm", kServerUrl};
  if (!options_.preload.empty())
    arguments.insert(arguments.begin(), {"/usr/bin/env", "LD_PRELOAD=" + options_.preload});
  return std::make_unique<Process>(arguments);
}

std::unique_ptr<Process> PressingHand::start_glove(double x_m, const std::string& record,
                                                   const std::string& device) const {
  const std::string x = std::to_string(x_m);
  std::string rows = options_.motion;
  if (rows.empty()) rows = "0.3," + x + ",0,-0.01,1,0,0,0\n60," + x + ",0,-0.01,1,0,0,0\n";
  const std::string script =
      folder_.write("hand_" + x + ".csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0," + x + ",0,0.03,1,0,0,0\n" + rows);
  std::vector<std::string> arguments{GLISSADE_PROGRAM, "glove",    "--lcm", kGloveUrl,  "--script",
                                     script,           "--record", record,  "--device", device};
  arguments.insert(arguments.end(), options_.glove_options.begin(), options_.glove_options.end());
  return std::make_unique<Process>(arguments);
}

GloveRecord PressingHand::end_glove() {
  glove_->signal(SIGINT);
  EXPECT_EQ(glove_->wait().exit_code, 0);
  return GloveRecord(folder_.path("record.csv"));
}

std::string PressingHand::end_server() {
  server_->signal(SIGINT);
  const ProgramResult result = server_->wait();
  EXPECT_EQ(result.exit_code, 0) << result.standard_error;
  return result.standard_error;
}

}  // namespace glissade::test_support
