// How large a result file will be, before there is any result.
#pragma once

#include <cstddef>

#include "result/result_file.hpp"
#include "study/study.hpp"

namespace gearsweep {

struct ResultSize {
  double file = 0.0;    // bytes that it never exceeds, as if nothing could be compressed
  double memory = 0.0;  // bytes that write_result() takes beside the result itself
};

ResultSize size_of_result(const Study& study, const Provenance& provenance);

// Points whose samples are a chunk of the file: rows and columns of the map. A chunk is compressed
// at once and read at once; of about a mebibyte, one point can be read without the rest, and what
// the file takes for each chunk does not count.
struct SampleBlock {
  std::size_t rows = 1, columns = 1;
};

SampleBlock block_of_samples(const Study& study);

}  // namespace gearsweep
