// How large a result file will be, before there is any result.
#pragma once

#include "study/study.hpp"

namespace gearsweep {

struct ResultSize {
  double file = 0.0;    // bytes, as if nothing could be compressed
  double memory = 0.0;  // bytes that write_result() takes beside the result itself
};

ResultSize size_of_result(const Study& study);

}  // namespace gearsweep
