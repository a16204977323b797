#include "orders/spectrum.hpp"

#include <fftw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <numbers>
#include <numeric>

#include "model/error.hpp"

namespace gearsweep {
namespace {

struct Release {
  void operator()(void* memory) const { fftw_free(memory); }
};

// The squared moduli of the discrete Fourier transform, bins 0 to half the number of samples.
std::vector<double> squared_transform(const std::vector<double>& samples) {
  const std::size_t bins = samples.size() / 2 + 1;
  const std::unique_ptr<double, Release> in(fftw_alloc_real(samples.size()));
  const std::unique_ptr<fftw_complex, Release> out(fftw_alloc_complex(bins));
  if (!in || !out) throw std::bad_alloc();
  const fftw_plan plan =
      fftw_plan_dft_r2c_1d(static_cast<int>(samples.size()), in.get(), out.get(), FFTW_ESTIMATE);
  std::copy(samples.begin(), samples.end(), in.get());
  fftw_execute(plan);
  fftw_destroy_plan(plan);
  std::vector<double> squares;
  for (std::size_t bin = 0; bin < bins; ++bin) {
    const double* number = out.get()[bin];
    squares.push_back(number[0] * number[0] + number[1] * number[1]);
  }
  return squares;
}

// How many moments a period has, a whole number of any size. Files hold tau to rounding, so this is
// far below any step.
double samples_per_period(const Trace& trace) {
  constexpr double kTolerance = 1e-6;  // of a step
  const std::vector<double>& tau = trace.tau;
  const double step =
      tau.size() < 2 ? 0.0 : (tau.back() - tau.front()) / static_cast<double>(tau.size() - 1);
  const double count = step > 0.0 ? std::round(trace.period / step) : 0.0;
  bool is_even = count >= 1.0 && std::abs(trace.period / count - step) <= kTolerance * step;
  for (std::size_t i = 0; i < tau.size() && is_even; ++i) {
    is_even = std::abs(tau[i] - tau[0] - static_cast<double>(i) * step) <= kTolerance * step;
  }
  if (!is_even) {
    throw InputError(
        "a spectrum takes evenly spaced moments, a whole number of them in each period, and this "
        "trace has those of the integration steps: trace the point with --samples-per-period 256");
  }
  return count;
}

}  // namespace

double decibels(double amplitude) { return 20.0 * std::log10(amplitude); }

Spectrum amplitude_spectrum(const std::vector<double>& samples, std::size_t periods,
                            SpectrumWindow window) {
  // FFTW counts in int.
  constexpr std::size_t kFewest = 4, kMost = 1U << 30U;
  if (samples.size() < kFewest || samples.size() > kMost) {
    throw InputError(
        fmt::format("a spectrum takes {} to {} samples, not {}", kFewest, kMost, samples.size()));
  }
  const auto count = static_cast<double>(samples.size());
  Spectrum spectrum;
  spectrum.order_step = 1.0 / static_cast<double>(periods);
  spectrum.mean = std::accumulate(samples.begin(), samples.end(), 0.0) / count;
  std::vector<double> windowed;
  for (const double sample : samples) {
    const double turn = static_cast<double>(windowed.size()) / count;
    const double weight =
        window == SpectrumWindow::hann ? 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * turn) : 1.0;
    windowed.push_back(weight * (sample - spectrum.mean));
  }
  const double mean_weight = window == SpectrumWindow::hann ? 0.5 : 1.0;
  for (const double square : squared_transform(windowed)) {
    // All bins but the ends stand for a negative frequency, too.
    const std::size_t bin = spectrum.amplitude.size();
    const bool is_end = bin == 0 || 2 * bin == samples.size();
    spectrum.amplitude.push_back((is_end ? 1.0 : 2.0) * std::sqrt(square) / (count * mean_weight));
  }
  return spectrum;
}

Spectrum amplitude_spectrum(const Trace& trace, std::size_t channel, std::size_t periods) {
  const double samples = samples_per_period(trace);
  if (samples > static_cast<double>(trace.tau.size())) {
    throw InputError(fmt::format(
        "a spectrum takes a whole forcing period, and this trace has {} of its {:g} moments",
        trace.tau.size(), samples));
  }
  const auto per_period = static_cast<std::size_t>(samples);
  const std::size_t whole = trace.tau.size() / per_period;
  const std::size_t used = periods == 0 ? whole : std::min(periods, whole);
  const std::vector<double>& values = trace.values[channel];
  // Counted from the end of the last whole period, for the trace begins with a period.
  const auto end = values.begin() + static_cast<std::ptrdiff_t>(whole * per_period);
  Spectrum spectrum =
      amplitude_spectrum({end - static_cast<std::ptrdiff_t>(used * per_period), end}, used);
  spectrum.order_step /= trace.mesh_periods;
  return spectrum;
}

}  // namespace gearsweep
