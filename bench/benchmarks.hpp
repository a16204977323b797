// What each benchmark program tells the main that they share (main.cpp).
#pragma once

namespace gearsweep::bench {

// Registers the program's benchmarks: a short choice of them, or `all`, each for medians of five.
void add_benchmarks(bool all);

}  // namespace gearsweep::bench
