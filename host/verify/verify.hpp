// The self-test of a machine, an OpenCL driver or a build: a handful of strong checks that take
// less than a minute. The answers come from elsewhere: closed forms, published numbers, outside
// integrations, the host's own arithmetic, the reference engine.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/result.hpp"
#include "opencl/device.hpp"
#include "sweep/sweep_options.hpp"
#include "verify/compared.hpp"

namespace gearsweep {

// What is under test.
struct Subject {
  std::function<SweepResult(const Study&)> compute;  // with the engine that the study names
  bool fp64 = true;                                  // it can compute in fp64
  bool is_cpu = true;
};

// The device, with sweeps that these options ask for; one that is stopped throws RunError.
Subject make_subject(const DeviceInfo& device, const SweepOptions& options);

// `compare` throws what the sweep throws.
struct Check {
  std::string name, what;
  bool needs_fp64 = true;
  std::vector<Compared> (*compare)(const Subject& subject);
  bool is_at_files = false;  // it writes and reads a NetCDF file, so no other thread may be at one
};

// In the order in which a fault is best understood: simple things first.
const std::vector<Check>& checks();

enum class Verdict { pass, fail, skipped };

struct Outcome {
  Verdict verdict = Verdict::skipped;
  std::size_t numbers = 0, failed = 0;  // compared, and those of them that do not hold
  std::optional<Compared> worst;        // the first that takes the largest share of its tolerance
  std::string reason;                   // why it was skipped, or could not be carried out
};

Outcome judge(const std::vector<Compared>& compared);

// A check that throws RunError has failed; other errors pass through.
Outcome carry_out(const Check& check, const Subject& subject);

// A check that was carried out, and how long it took.
struct CheckReport {
  const Check* check = nullptr;
  Outcome outcome;
  double seconds = 0.0;
};

CheckReport carry_out_timed(const Check& check, const Subject& subject);

// "pass", "FAIL", "skipped".
const char* word_of(Verdict verdict);

// Why there is none, or how many numbers were compared and the one that comes nearest its limit.
std::string figures_of(const Outcome& outcome);

// "pass: 13 checks, 1 skipped"
std::string verdict_of(const std::vector<CheckReport>& reports);

}  // namespace gearsweep
