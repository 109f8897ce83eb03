#include "delaunay/base/memory.h"
#include "experiments/program.h"

int main(int argc, char** argv) {
  deliso::give_back_large_arrays_at_once();
  return static_cast<int>(deliso::run_program(argc, argv));
}
