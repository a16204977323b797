// Pictures of made traces, and the scripts that make them.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "plot/picture_test.hpp"
#include "result/example_trace.hpp"
#include "result/trace_file.hpp"

namespace gearsweep::testing {

class PlotTraceTest : public PictureTest {
 protected:
  PlotTraceTest() : study_(read_study("[[axes]]\nname = 'omega'\nvalues = [0.5]\n", "test")) {
    study_.title = "two gears";
  }

  std::string write(const std::string& name, const std::vector<Trace>& traces,
                    const std::vector<std::string>& labels) const {
    write_traces(traces, labels, {}, study_, in_folder(name), kProvenance);
    return in_folder(name);
  }
  std::string write_one(std::size_t periods = 20, std::size_t per_period = 16) const {
    return write("one.nc", {made_trace(study_, periods, per_period)}, {"omega=0.5"});
  }

  PlotRequest request(const std::vector<std::string>& paths, const std::string& quantity) const {
    PlotRequest request;
    request.paths = paths;
    request.quantity = quantity;
    request.output_path = in_folder("picture.png");
    return request;
  }

  using PictureTest::script_of;
  std::string script_of(const std::vector<std::string>& paths, const std::string& quantity) const {
    return script_of(request(paths, quantity));
  }

  // The numbers that the script reads, from the first on.
  std::vector<double> data() const {
    const std::string bytes = content(in_folder("picture.dat"));
    std::vector<double> numbers(bytes.size() / sizeof(double));
    std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return numbers;
  }

  std::string refused(const std::vector<std::string>& paths, const std::string& quantity) const {
    return refusal([&] { plot_files(request(paths, quantity)); });
  }

  Study study_;
};

}  // namespace gearsweep::testing
