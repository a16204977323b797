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

// The axes of all panels, with their labels, and the room that is left for frames.
class PanelGrid {
 public:
  // height: between the heading and the key.
  PanelGrid(const Page& page, const std::vector<TracePanel>& panels, Grid grid, double height)
      : page_(page), panels_(panels), grid_(std::move(grid)), height_(height) {
    // A label may be as wide as its column: first with the whole column's width, from which the
    // frames' follows, then with what a frame and the room at the page's edge leave.
    fit(page.width() / static_cast<double>(grid_.columns));
    if (panels.size() > 1) fit(grid_.width + edge_room(page));
  }

  const Grid& grid() const { return grid_; }
  const PanelAxis& x(std::size_t panel) const { return x_[panel]; }
  const PanelAxis& y(std::size_t panel) const { return y_[panel]; }

 private:
  void fit(double label_width) {
    const auto columns = static_cast<double>(grid_.columns);
    const std::size_t rows = (panels_.size() + grid_.columns - 1) / grid_.columns;
    x_.clear();
    y_.clear();
    grid_.bottom.assign(rows, 0.0);
    grid_.left.assign(grid_.columns, 0.0);
    for (std::size_t i = 0; i < panels_.size(); ++i) {
      const std::size_t row = i / grid_.columns;
      x_.push_back(panels_[i].x);
      x_.back().label = label_lines(page_, panels_[i].x.label.front(), label_width);
      grid_.bottom[row] = std::max(grid_.bottom[row], bottom_room(page_, x_.back()));
    }
    grid_.height = (height_ - sum(grid_.bottom) - grid_.caption * static_cast<double>(rows) -
                    grid_.gap * static_cast<double>(rows - 1)) /
                   static_cast<double>(rows);
    for (std::size_t i = 0; i < panels_.size(); ++i) {
      const std::size_t column = i % grid_.columns;
      y_.push_back(panels_[i].y);
      y_.back().label = label_lines(page_, panels_[i].y.label.front(), grid_.height);
      grid_.left[column] = std::max(grid_.left[column], left_room(page_, y_[i], grid_.height));
    }
    grid_.width = (page_.width() - sum(grid_.left)) / columns - edge_room(page_);
  }

  const Page& page_;
  const std::vector<TracePanel>& panels_;
  Grid grid_;
  double height_;
  std::vector<PanelAxis> x_, y_;
};

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
  const double head = head_room(page, heading);

  Grid empty;
  empty.columns = is_alone || is_narrow ? 1 : 2;
  empty.caption = is_alone ? 0.0 : kCaption * em;
  empty.gap = 0.4 * em;
  const PanelGrid placed(page, panels, empty, script->height - key_height(page, key) - head);
  const Grid& grid = placed.grid();
  const double top = script->height - head;

  script->text = "set multiplot\n";
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Frame frame = grid.frame(page, top, i);
    ensure_room(frame, page);
    script->text += panel_lines(page, frame, script->height, placed.x(i), placed.y(i));
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
