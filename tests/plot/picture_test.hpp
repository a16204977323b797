// A folder with a picture of gnuplot's, for the tests of this folder.
#pragma once

#include <gmock/gmock.h>

#include <cstdlib>
#include <string>

#include "plot/plot.hpp"
#include "result/example_result.hpp"

namespace gearsweep::testing {

inline std::size_t count_of(const std::string& part, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++count;
  return count;
}

class PictureTest : public IoTest {
 protected:
  // The first bytes of the picture that the request plots.
  std::string plotted(PlotRequest request, const std::string& ending = ".png") const {
    request.output_path = in_folder("picture" + ending);
    plot_files(request);
    return content(request.output_path).substr(0, 200);
  }

  // The script of a picture; plotting it must make gnuplot say nothing.
  std::string script_of(PlotRequest request, const std::string& ending = ".png") const {
    request.script_path = in_folder("picture.gp");
    EXPECT_THAT(plotted(request, ending),
                ::testing::AnyOf(::testing::StartsWith("\x89PNG"), ::testing::HasSubstr("<svg")));
    const std::string said = in_folder("said.txt");
    const std::string command =
        "cd / && gnuplot '" + request.script_path + "' > '" + said + "' 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(content(said), "");
    return content(request.script_path);
  }
};

}  // namespace gearsweep::testing
