// Writes the kernel of gear5 for what compiles it on the host: write_kernel FILE.
#include <cstdio>
#include <exception>
#include <fstream>

#include "verify/whole_kernel.hpp"

int main(int count, char** arguments) try {
  if (count != 2) {
    std::fputs("write_kernel FILE\n", stderr);
    return 2;
  }
  std::ofstream out(arguments[1]);
  out << gearsweep::whole_kernel_model().kernel;
  out.close();
  return out ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
