#include "reproduce/pictures.hpp"

#include <fmt/format.h>

#include "io/plot.hpp"
#include "io/result_file.hpp"
#include "model/version.hpp"

namespace gearsweep {
namespace {

// A section of the report: a heading and its pictures.
class Gallery {
 public:
  explicit Gallery(std::string folder) : folder_(std::move(folder)) {}

  void heading(const std::string& text) { markdown_ += fmt::format("### {}\n\n", text); }

  void map(const std::string& result, const std::string& quantity, const std::string& caption) {
    const std::string picture = fmt::format("{}-{}.png", result, quantity);
    plot_map({path(result + ".nc"), quantity, path(picture), "", std::nullopt});
    markdown_ += fmt::format("![{0}]({1})\n\n{0}\n\n", caption, picture);
  }

  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  const std::string& markdown() const { return markdown_; }

 private:
  std::string folder_, markdown_ = "## Pictures\n\n";
};

// The second map less the first, as a result of its own.
void write_difference(const SweepResult& from, const SweepResult& to, const std::string& path) {
  SweepResult difference = from;
  difference.study.title = "Dynamic less constant backlash";
  for (std::size_t i = 0; i < difference.values.size(); ++i) {
    for (std::size_t point = 0; point < difference.values[i].size(); ++point) {
      difference.values[i][point] = to.values[i][point] - from.values[i][point];
    }
  }
  write_result(difference, path, {"gearsweep reproduce", version(), source_hash()});
}

}  // namespace

std::string draw_pictures(const Measured& measured, const std::string& folder) {
  Gallery gallery(folder);
  gallery.heading("Beyond the paper: exponents and periods over omega and b");
  write_difference(measured.maps.at("omega-b-constant"), measured.maps.at("omega-b-dynamic"),
                   gallery.path("omega-b-difference.nc"));
  for (const char* law : {"constant", "dynamic"}) {
    gallery.map(fmt::format("omega-b-{}", law), "lyapunov_max",
                fmt::format("Largest Lyapunov exponent, {} backlash", law));
    gallery.map(fmt::format("omega-b-{}", law), "period", fmt::format("Period, {} backlash", law));
  }
  gallery.map("omega-b-difference", "lyapunov_max",
              "Largest Lyapunov exponent, dynamic less constant backlash");
  return gallery.markdown();
}

}  // namespace gearsweep
