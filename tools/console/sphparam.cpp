// Apart from the program itself, which tests run in processes of their own making.

#include "console/program.h"

int main(int argc, char** argv) { return sphparam::cli::run_sphparam(argc, argv); }
