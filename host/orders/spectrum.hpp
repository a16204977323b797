// Amplitude spectra of samples and of traces.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/trace.hpp"

namespace gearsweep {

// Re 1 unit of the amplitude: 20 log10(amplitude).
double decibels(double amplitude);

// What samples are weighted with: nothing, which shows lines at whole bins alone and as they are,
// or Hann's window, which keeps what lies between bins from spreading.
enum class SpectrumWindow { none, hann };

struct Spectrum {
  double order_step = 0.0;  // between bins, in multiples of the forcing frequency
  double mean = 0.0;        // of the samples; it is taken away first
  // [bin] in the samples' unit, for the orders bin * order_step up to half the sampling rate. A
  // sine of a whole bin between the ends shows its amplitude there, and with Hann's window half of
  // it in either bin beside.
  std::vector<double> amplitude;
};

// samples: evenly spaced over so many whole forcing periods, the next period's first left out. Of
// Hann's window, amplitudes are corrected for its mean of 1/2; the squares of a sine's amplitudes,
// halved, add up to 1.5 times its mean square: the noise bandwidth of the window, in bins. Throws
// InputError for fewer than four samples. Not to be used by two threads at once: FFTW's planner
// cannot be.
Spectrum amplitude_spectrum(const std::vector<double>& samples, std::size_t periods,
                            SpectrumWindow window = SpectrumWindow::hann);

// The spectrum of a channel over the last whole forcing periods of a trace, all of them when
// `periods` is 0. Orders are then multiples of the mesh frequency. Throws InputError when its
// moments are not evenly spaced, a whole number to the period, or it has not one whole period.
Spectrum amplitude_spectrum(const Trace& trace, std::size_t channel, std::size_t periods);

}  // namespace gearsweep
