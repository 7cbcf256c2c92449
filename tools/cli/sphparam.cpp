// Apart from the program itself, which tests run in processes of their own making.

#include "cli/program.h"

int main(int argc, char** argv) { return sphparam::tools::run_sphparam(argc, argv); }
