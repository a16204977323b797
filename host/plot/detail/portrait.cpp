// Several panels of traces on one page: what a portrait shows, and where the panels stand.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "plot/detail/text.hpp"
#include "plot/detail/trace.hpp"

namespace gearsweep {
namespace {

// Names of the layers, where they are several, then what the panels add to them.
std::vector<KeyEntry> key_of(const TracePicture& picture, const std::vector<TracePanel>& panels) {
  std::vector<KeyEntry> key;
  for (std::size_t i = 0; i < picture.layers.size() && picture.layers.size() > 1; ++i) {
    key.push_back(
        {panels.front().layer_kind, layer_colour(i), layer_dashes(i), picture.layers[i].name});
  }
  for (const TracePanel& panel : panels) key.insert(key.end(), panel.key.begin(), panel.key.end());
  return key;
}

// Markup above one of several panels: its letter, by which a text calls it, and unless the picture
// is for print its kind.
std::string caption_of(const Page& page, const TracePanel& panel, std::size_t number) {
  const std::string letter = fmt::format("({})", static_cast<char>('a' + number));
  return page.is_for_print() ? letter : fmt::format("{} {{/*0.8 {}}}", letter, panel.kind);
}

// The places of panels, row by row. Lengths in points.
struct Grid {
  std::size_t columns = 1;
  std::vector<double> left, bottom;  // room beside a column, below a row
  double caption = 0.0, gap = 0.0;   // above a row, between rows
  double width = 0.0, height = 0.0;  // of each frame

  Frame frame(const Page& page, double top, std::size_t panel) const {
    const std::size_t column = panel % columns, row = panel / columns;
    Frame frame;
    frame.left = left[0];
    for (std::size_t i = 1; i <= column; ++i) frame.left += width + edge_room(page) + left[i];
    frame.right = frame.left + width;
    frame.top = top - caption;
    for (std::size_t i = 1; i <= row; ++i) frame.top -= height + bottom[i - 1] + gap + caption;
    frame.bottom = frame.top - height;
    return frame;
  }
};

double sum(const std::vector<double>& lengths) {
  return std::accumulate(lengths.begin(), lengths.end(), 0.0);
}

}  // namespace

std::vector<TracePanel> portrait_panels(const Page& page, const TracePicture& picture,
                                        PlotScript* script) {
  TracePicture state = picture;
  state.channel = picture.across;
  TracePicture history = state;
  for (TraceLayer& layer : history.layers) layer.trace = last_periods(layer.trace, picture.recent);
  const Page other = page.with_other_axes(true, true);

  std::vector<TracePanel> panels = {time_panel(page, history, script),
                                    phase_panel(other, picture, script)};
  const ChannelInfo* force = force_of(picture.layers.front().trace);
  const auto has_force = [&](const TraceLayer& layer) {
    return force != nullptr && find_channel(layer.trace, force->name) >= 0 &&
           find_channel(layer.trace, "contact") >= 0;
  };
  if (std::all_of(picture.layers.begin(), picture.layers.end(), has_force)) {
    history.channel = *force;
    panels.push_back(force_panel(page.with_other_axes(false, true), history, script));
  } else if (picture.is_clockless) {
    history.channel = picture.channel;
    panels.push_back(time_panel(page.with_other_axes(false, true), history, script));
    panels.back().key.clear();  // as of the first history
  } else {
    panels.push_back(section_panel(other, picture, script));
  }
  panels.push_back(spectrum_panel(other, state, script));
  return panels;
}

void lay_out(const Page& page, const TracePicture& picture, const std::vector<TracePanel>& panels,
             PlotScript* script) {
  constexpr double kAspect = 0.7, kNarrowAspect = 2.1, kCaption = 1.25;
  const double em = page.em();
  const bool is_alone = panels.size() == 1;
  const std::vector<KeyEntry> key = key_of(picture, panels);
  const std::vector<std::string> heading =
      heading_lines(page, picture.title,
                    is_alone ? panels.front().subtitle : picture.across.meaning, picture.remark);
  // Two columns of a narrow page would have more letters than curves.
  constexpr double kNarrow = 33.0;  // em: 93 mm of 8 points
  const bool is_narrow = page.width() < kNarrow * em;
  const double own_aspect = is_alone || !is_narrow ? kAspect : kNarrowAspect;
  script->height = page.height_or(own_aspect * page.width() + key_height(page, key));
  const double foot = key_height(page, key);
  const double head = head_room(page, heading);

  Grid grid;
  grid.columns = is_alone || is_narrow ? 1 : 2;
  const std::size_t rows = (panels.size() + grid.columns - 1) / grid.columns;
  grid.bottom.resize(rows);
  grid.left.resize(grid.columns);
  grid.caption = is_alone ? 0.0 : kCaption * em;
  grid.gap = 0.4 * em;
  std::vector<PanelAxis> x, y;
  // A label may be as wide as its column: first with the whole column's width, from which the
  // frames' follows, then with what a frame and the room at the page's edge leave.
  const auto fit = [&](double label_width) {
    x.clear();
    y.clear();
    std::fill(grid.bottom.begin(), grid.bottom.end(), 0.0);
    std::fill(grid.left.begin(), grid.left.end(), 0.0);
    for (std::size_t i = 0; i < panels.size(); ++i) {
      const std::size_t row = i / grid.columns;
      x.push_back(panels[i].x);
      x.back().label = label_lines(page, panels[i].x.label.front(), label_width);
      grid.bottom[row] = std::max(grid.bottom[row], bottom_room(page, x.back()));
    }
    grid.height =
        (script->height - foot - head - sum(grid.bottom) -
         grid.caption * static_cast<double>(rows) - grid.gap * static_cast<double>(rows - 1)) /
        static_cast<double>(rows);
    for (std::size_t i = 0; i < panels.size(); ++i) {
      const std::size_t column = i % grid.columns;
      y.push_back(panels[i].y);
      y.back().label = label_lines(page, panels[i].y.label.front(), grid.height);
      grid.left[column] = std::max(grid.left[column], left_room(page, y[i], grid.height));
    }
    grid.width =
        (page.width() - sum(grid.left)) / static_cast<double>(grid.columns) - edge_room(page);
  };
  fit(page.width() / static_cast<double>(grid.columns));
  if (!is_alone) fit(grid.width + edge_room(page));

  const double top = script->height - head;
  script->text = "set multiplot\n";
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Frame frame = grid.frame(page, top, i);
    ensure_room(frame, page);
    script->text += panel_lines(page, frame, script->height, x[i], y[i]);
    if (i == 0) {
      Frame all = frame;
      all.right = page.width() - edge_room(page);
      all.top = top;
      script->text +=
          plot_heading(page, heading, all, script->height) + plot_key(page, key, script->height);
    }
    if (!is_alone) {
      script->text += page.label_at(frame.left, frame.top + 0.5 * grid.caption, script->height,
                                    caption_of(page, panels[i], i), "left");
    }
    script->text += panels[i].lines + "plot " + panels[i].elements + "\n";
  }
  script->text += "unset multiplot\n";
}

}  // namespace gearsweep
