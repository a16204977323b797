#include "cli/cli.hpp"

int main(int argc, char** argv) { return gearsweep::run_cli(argc, argv); }
