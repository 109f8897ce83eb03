#include "experiments/commands/program.h"

int main(int argc, char** argv) { return static_cast<int>(deliso::run_program(argc, argv)); }
