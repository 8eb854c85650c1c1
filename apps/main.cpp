#include <glissade/apps/program.h>

int main(int argc, char** argv) {
  return glissade::apps::run_program(argc, argv);
}
