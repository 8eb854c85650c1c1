// A wall that one can feel, in C#: a hand of this program presses a box on a plate. Its driver is a thread of its own,
// and a renderer reads the poses in Unity's frame.
using System;
using System.Threading;
using static Glissade;

static class Wall {
  static double greatest_N;
  static volatile bool ends;

  // The driver of a device: it tells where the hand is, and would exert the force. This one goes down by 8 mm.
  static void Drive(GlissadeGlove glove) {
    GlissadeGloveState state;
    GlissadeGloveCommand command;
    Check(glissade_glove_state_default(out state));
    while (!ends) {
      state.X_WH.z = Math.Max(-0.008, state.X_WH.z - 20e-6);
      state.time_ns = glissade_now_ns();
      Check(glissade_glove_put(glove, ref state));
      Check(glissade_glove_command(glove, out command));
      greatest_N = Math.Max(greatest_N, command.force_N[2]);
      Thread.Sleep(1);
    }
  }

  static void Main() {
    GlissadeScene scene;
    Check(glissade_scene_new(out scene));
    Check(glissade_scene_add_shape(scene, "wall", "plate", null, null, 0, null));
    var edges = new[] { "size_x_m", "size_y_m", "size_z_m" };
    var above = new[] { new GlissadePose { z = 0.022, qw = 1.0 } };  // 2 mm above the plate
    Check(glissade_scene_add_shape(scene, "box", "box", edges, new[] { 0.04, 0.04, 0.04 }, 3, above));
    Check(glissade_scene_set_movable(scene, "box", 1));
    Check(glissade_scene_use_real_time_rules(scene));

    GlissadeSimulation simulation;
    Check(glissade_simulation_new(scene, out simulation));
    GlissadeDevice device;
    Check(glissade_device_default(out device));
    device.max_force_N = 20.0;
    device.max_stiffness_N_per_m = 1000.0;
    device.max_rotational_stiffness_Nm_per_rad = 5.0;
    device.damping_Ns_per_m = 5.0;
    device.update_rate_Hz = 200.0;
    GlissadeGlove glove;
    Check(glissade_glove_new("C#", ref device, out glove));
    GlissadeServer server;
    Check(glissade_server_start(simulation, new[] { glove }, 1, out server));
    var driver = new Thread(() => Drive(glove));
    driver.Start();

    GlissadeFrame frame = new GlissadeFrame();
    for (int i = 0; i < 120; ++i) {  // two seconds of frames
      Thread.Sleep(16);
      Check(glissade_server_frame(server, out frame));
    }
    GlissadePose box;
    Check(glissade_pose_to_engine(GlissadeEngine.Unity, ref frame.parts[0].X_WV, out box));
    ends = true;
    driver.Join();
    Check(glissade_server_check(server));
    Check(glissade_server_free(server));
    Check(glissade_glove_free(glove));
    Check(glissade_simulation_free(simulation));
    Check(glissade_scene_free(scene));
    Console.WriteLine("The box lies at y = {0:F2} mm in Unity, and the hand feels up to {1:F1} N.", box.y * 1e3, greatest_N);
  }
}
