/* A wall that one can feel, in C: a simulated hand presses a box on a plate for two seconds. */

#include <glissade/glissade.h>
#include <stdio.h>
#include <time.h>

static int failed(const char* what) {
  printf("%s: %s\n", what, glissade_last_error());
  return 1;
}

int main(void) {
  GlissadeScene scene;
  const GlissadePose above = {.z = 0.022, .qw = 1.0}; /* 2 mm above the plate */
  const char* edges[] = {"size_x_m", "size_y_m", "size_z_m"};
  const double edges_m[] = {0.04, 0.04, 0.04};
  if (glissade_scene_new(&scene) || glissade_scene_add_shape(scene, "wall", "plate", NULL, NULL, 0, NULL) ||
      glissade_scene_add_shape(scene, "box", "box", edges, edges_m, 3, &above) ||
      glissade_scene_set_movable(scene, "box", 1) || glissade_scene_use_real_time_rules(scene))
    return failed("the scene");

  GlissadeSimulation simulation;
  GlissadeGlove glove;
  GlissadeServer server;
  const double times_s[] = {0.0, 1.0};
  const GlissadePose hand[] = {{.z = 0.1, .qw = 1.0}, {.z = 0.08, .qw = 1.0}}; /* 18 mm deeper than the plate lets */
  if (glissade_simulation_new(scene, &simulation) || glissade_glove_new_simulated(times_s, hand, 2, &glove) ||
      glissade_server_start(simulation, &glove, 1, &server))
    return failed("the loop");

  /* The loop runs beside this thread, at 1000 Hz. Here is a renderer of 60 frames a second. */
  GlissadeFrame frame;
  GlissadeGloveCommand exerted;
  double greatest_N = 0.0;
  for (int i = 0; i < 120; ++i) {
    if (glissade_server_frame(server, &frame) || glissade_glove_command(glove, &exerted)) return failed("a frame");
    if (exerted.force_N[2] > greatest_N) greatest_N = exerted.force_N[2];
    nanosleep(&(struct timespec){.tv_nsec = 16666667}, NULL);
  }
  if (glissade_server_check(server)) return failed("the loop");
  printf("The box lies at z = %.2f mm, and the hand feels up to %.1f N.\n", frame.parts[0].X_WV.z * 1e3, greatest_N);

  glissade_server_free(server); /* the force fades */
  glissade_glove_free(glove);
  glissade_simulation_free(simulation);
  glissade_scene_free(scene);
  return 0;
}
