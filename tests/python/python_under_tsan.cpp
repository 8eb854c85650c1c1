// Python with the runtime of the thread sanitizer, which must be in a program from its start.
#include <Python.h>

int main(int argc, char** argv) {
  return Py_BytesMain(argc, argv);
}
