#include "reproduce/detail/pictures.hpp"

#include <fmt/format.h>

#include "model/version.hpp"
#include "plot/plot.hpp"
#include "result/result_file.hpp"

namespace gearsweep {
namespace {

// Pictures under headings.
class Gallery {
 public:
  explicit Gallery(std::string folder) : folder_(std::move(folder)) {}

  void heading(const std::string& text) { markdown_ += fmt::format("### {}\n\n", text); }

  // results: names in the folder, without .nc. The rest as for plot_files().
  void add(const std::string& picture, const std::vector<std::string>& results,
           const std::string& quantity, const std::string& caption,
           std::optional<std::size_t> periods = std::nullopt,
           std::optional<double> orders = std::nullopt) {
    PlotRequest request;
    request.style.has_units = true;  // as the papers are, in the model's units
    for (const std::string& result : results) request.paths.push_back(path(result + ".nc"));
    request.quantity = quantity;
    request.output_path = path(picture + ".png");
    request.periods = periods;
    request.orders = orders;
    plot_files(request);
    markdown_ += fmt::format("![{0}]({1}.png)\n\n{0}\n\n", caption, picture);
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

void plot_figures(Gallery* gallery) {
  gallery->heading("Figure 4");
  gallery->add("fig4-rms", {"fig4", "fig4-friction"}, "x1_rms", "RMS of x1");
  gallery->add("fig4-force", {"fig4", "fig4-friction"}, "dmf_max", "Largest meshing force");
  for (const std::string figure : {"fig5", "fig6"}) {
    gallery->heading(figure == "fig5" ? "Figure 5: omega = 0.1" : "Figure 6: omega = 0.7");
    const double orders = figure == "fig5" ? 12.0 : 3.0;
    gallery->add(figure + "-time", {figure + "-trace"}, "time", "x1 in time");
    gallery->add(figure + "-spectrum", {figure + "-even-trace"}, "spectrum", "Spectrum of x1",
                 std::nullopt, orders);
  }
  gallery->heading("Figure 7: constant backlash");
  gallery->add("fig7", {"fig7"}, "poincare,x1_rms,dmf_max",
               "Section, RMS and largest force over the half backlash");
  gallery->heading("Figure 8");
  const std::vector<const char*> b = {"0.39", "0.70", "0.90", "1.20"};
  for (std::size_t i = 0; i < b.size(); ++i) {
    gallery->add(fmt::format("fig8-{}", i + 1), {fmt::format("fig8-trace-{}", i + 1)}, "phase",
                 fmt::format("Phase portrait at b = {}", b[i]));
  }
  gallery->add("fig8-late", {"fig8-late-trace-1"}, "phase", "At b = 0.39 after 1500 periods");
  gallery->heading("Figure 9");
  gallery->add("fig9", {"fig9"}, "poincare,x1_rms,dmf_max", "Constant backlash");
  gallery->add("fig9-dynamic", {"fig9-dynamic"}, "poincare,x1_rms,dmf_max", "Dynamic backlash");
  gallery->heading("Figure 10: dynamic backlash");
  gallery->add("fig10", {"fig10"}, "poincare,x1_rms,dmf_max",
               "Section, RMS and largest force over the half backlash");
  gallery->heading("Figure 11");
  gallery->add("fig11-velocity", {"fig11-trace"}, "time:v1", "Velocity of x1 in time", 4);
  gallery->add("fig11-force", {"fig11-trace"}, "force", "Meshing force in time", 4);
}

void plot_beyond(const MeasuredFigures& measured, Gallery* gallery) {
  gallery->heading("Beyond the paper");
  gallery->add("fig9-directions", {"fig9-forward", "fig9-backward"}, "x1_rms",
               "RMS of x1, each point from its neighbour's last state");
  for (const auto& [figure, jumps] : measured.jumps) {
    for (const std::string side : {"below", "above"}) {
      const std::string map = fmt::format("{}-basins-{}", figure, side);
      gallery->add(
          map, {map}, "attractor",
          fmt::format("Basins just {} the first jump of figure {}", side, figure.substr(3)));
    }
  }
  write_difference(measured.maps.at("omega-b-constant"), measured.maps.at("omega-b-dynamic"),
                   gallery->path("omega-b-difference.nc"));
  for (const std::string law : {"constant", "dynamic"}) {
    gallery->add(law + "-exponent", {"omega-b-" + law}, "lyapunov_max",
                 fmt::format("Largest Lyapunov exponent, {} backlash", law));
    gallery->add(law + "-period", {"omega-b-" + law}, "period",
                 fmt::format("Period, {} backlash", law));
  }
  gallery->add("difference-exponent", {"omega-b-difference"}, "lyapunov_max",
               "Largest Lyapunov exponent, dynamic less constant backlash");
}

}  // namespace

std::string plot_pictures(const MeasuredFigures& measured, const std::string& folder) {
  Gallery gallery(folder);
  plot_figures(&gallery);
  plot_beyond(measured, &gallery);
  return gallery.markdown();
}

}  // namespace gearsweep
