#include "measure/flop_count.hpp"

#include <cstring>
#include <vector>

#include "measure/detail/counted.hpp"
// Some models need less work in fp32.
#define REAL_BITS (real::kBits)
#include "dialect.h"

namespace gearsweep {
namespace {

namespace fp64 {
using real = Counted<64>;
using scalar = real;
#include "measure/detail/counted_step.hpp"
}  // namespace fp64

namespace fp32 {
using real = Counted<32>;
using scalar = real;
#include "measure/detail/counted_step.hpp"
}  // namespace fp32

}  // namespace

double flops_per_step(const Study& study, std::size_t tangents) {
  return study.integrate.fp64 ? fp64::count_step(study.setting, study.integrate.events, tangents)
                              : fp32::count_step(study.setting, study.integrate.events, tangents);
}

}  // namespace gearsweep
