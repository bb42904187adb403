// meninas COMMAND SCENE [options]
#include "cli/commands.h"

int main(int argc, char** argv) { return meninas::run_program(argc, argv); }
