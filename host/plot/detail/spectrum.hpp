// Amplitude spectra of traces.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/trace.hpp"

namespace gearsweep {

// Re 1 unit of the amplitude: 20 log10(amplitude).
double decibels(double amplitude);

struct Spectrum {
  double order_step = 0.0;  // between bins, in multiples of the forcing frequency
  double mean = 0.0;        // of the samples; it is taken away first
  // [bin] in the samples' unit, for the orders bin * order_step up to half the sampling rate. A
  // sine of a whole bin between the ends shows its amplitude there, and half of it in either bin
  // beside.
  std::vector<double> amplitude;
};

// samples: evenly spaced over so many whole forcing periods, the next period's first left out. Hann
// window, corrected for its mean of 1/2. The squares of a sine's amplitudes, halved, add up to 1.5
// times its mean square: the noise bandwidth of the window, in bins. Throws InputError for fewer
// than four samples. Not to be used by two threads at once: FFTW's planner cannot be.
Spectrum amplitude_spectrum(const std::vector<double>& samples, std::size_t periods);

// Of a channel over the last whole forcing periods of a trace, all of them when `periods` is 0.
// Orders are then multiples of the mesh frequency.
// Throws InputError when its moments are not evenly spaced, a whole number to the period, or it has
// not one whole period.
Spectrum amplitude_spectrum(const Trace& trace, std::size_t channel, std::size_t periods);

}  // namespace gearsweep
