#include "experiments/commands/program.h"
#include "experiments/large_blocks.h"

int main(int argc, char** argv) {
  deliso::use_large_blocks();
  return static_cast<int>(deliso::run_program(argc, argv));
}
