#pragma once

/// The commands of the program. `add_<name>_command(app, chosen)` declares the options of a command. When the user
/// names the command, parsing sets `chosen` to its work, so all parsing ends before any work starts.

#include <functional>

namespace CLI {
class App;
}

namespace glissade::apps {

/// The work of a command; returns the exit code. Throws std::invalid_argument for bad input (exit code 2) and
/// anything else for a failure while running (exit code 1).
using Command = std::function<int()>;

/// Of --overwrite, which the commands have that record a run.
inline constexpr const char* kOverwriteHelp = "Replace an existing file with the recording";

/// `glissade info MESH [--json]`
void add_info_command(CLI::App& app, Command& chosen);

/// `glissade collide A B --poses FILE [--pairs] [--tolerance-m T] [--method M] [--out FILE]`
void add_collide_command(CLI::App& app, Command& chosen);

/// `glissade demo [--seconds S] [--scene FILE] [--offline] [--json] [--lcm URL] [--record LOG] [--report DIR]`
void add_demo_command(CLI::App& app, Command& chosen);

/// `glissade slide SCENE --part NAME --trajectory FILE [--metaphor M] [--out FILE]`
void add_slide_command(CLI::App& app, Command& chosen);

/// `glissade study STUDY [--out FOLDER] [--workers N] [--shard I/N] [--slide N]`
void add_study_command(CLI::App& app, Command& chosen);

/// `glissade grasp SCENE --hand-trajectory FILE [--hand FILE] [--out FILE] [--objects FILE] [--report DIR]`
void add_grasp_command(CLI::App& app, Command& chosen);

/// `glissade run SCENE [--lcm URL] [--device N] [--seconds S] [--rate-hz R] [--spin-us T] [--flight-recorder FILE]
/// [--json] [--report DIR]`
void add_run_command(CLI::App& app, Command& chosen);

/// `glissade record LOG SCENE`, and the options of `run`
void add_record_command(CLI::App& app, Command& chosen);

/// `glissade replay LOG [--scene FILE] [--lcm URL] [--view [PORT]] [--report DIR] [--json]`
void add_replay_command(CLI::App& app, Command& chosen);

/// `glissade log to-csv LOG FOLDER`, `glissade log to-mcap LOG FILE [--scene FILE]`
void add_log_command(CLI::App& app, Command& chosen);

/// `glissade export [SCENE] [--log LOG] [--at S] --out FILE`
void add_export_command(CLI::App& app, Command& chosen);

/// `glissade glove [--side left|right] [--device N] [--lcm URL] [--script FILE] [--frozen-ms T] [--record FILE]`
void add_glove_command(CLI::App& app, Command& chosen);

/// `glissade calibrate --out FILE [--user NAME] [--device N] [--pause-s T] [--hold-s T] [--flat-at-m X Y Z]`
void add_calibrate_command(CLI::App& app, Command& chosen);

/// `glissade bridge opengloves|dynamixel --port PORT [--check] [--list]`, `glissade bridge haply [--check] [--list]`
void add_bridge_command(CLI::App& app, Command& chosen);

/// `glissade emulate opengloves|dynamixel|haply|tracker [--seconds S]`, and the options of each device
void add_emulate_command(CLI::App& app, Command& chosen);

/// `glissade view [SCENE] [--lcm URL] [--port N] [--fingers]`
void add_view_command(CLI::App& app, Command& chosen);

/// `glissade example [FOLDER]`
void add_example_command(CLI::App& app, Command& chosen);

/// `glissade doctor [--json]`
void add_doctor_command(CLI::App& app, Command& chosen);

/// `glissade latency [--seconds S] [--json] [--report DIR]`
void add_latency_command(CLI::App& app, Command& chosen);

}  // namespace glissade::apps
