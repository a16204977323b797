#include "plot/colours.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "model/error.hpp"
#include "model/names.hpp"

namespace gearsweep {
namespace {

// Colours at even steps; between them they are mixed.
struct Colormap {
  const char* name;
  bool is_diverging;
  const char* colours;
};

// viridis, plasma, inferno and magma: S. van der Walt and N. Smith, 2015 (CC0); cividis: J. Nunez,
// C. Anderton, R. Renslow, 2018 (CC0); turbo: A. Mikhailov, 2019 (Apache 2.0); coolwarm: K.
// Moreland, 2009; RdBu, PuOr, BrBG: C. Brewer, M. Harrower, The Pennsylvania State University, 2002
// (Apache 2.0). 17 colours of each. "signed" is this program's own: as dark at either end, so told
// apart with any colour vision.
constexpr Colormap kColormaps[] = {
    {"viridis", false,
     "#440154 #48186a #472d7b #424086 #3b528b #33638d #2c728e #26828e #21918c "
     "#1fa088 #28ae80 #3fbc73 #5ec962 #84d44b #addc30 #d8e219 #fde725"},
    {"plasma", false,
     "#0d0887 #310597 #4c02a1 #6600a7 #7e03a8 #9511a1 #aa2395 #bc3587 #cc4778 "
     "#da5a6a #e66c5c #f0804e #f89540 #fdac33 #fdc527 #f8df25 #f0f921"},
    {"inferno", false,
     "#000004 #0b0724 #210c4a #3d0965 #57106e #71196e #8a226a #a32c61 #bc3754 "
     "#d24644 #e45a31 #f1731d #f98e09 #fcac11 #f9cb35 #f2ea69 #fcffa4"},
    {"magma", false,
     "#000004 #0a0822 #1d1147 #36106b #51127c #6a1c81 #832681 #9c2e7f #b73779 "
     "#d0416f #e75263 #f56b5c #fc8961 #fea772 #fec488 #fde2a3 #fcfdbf"},
    {"cividis", false,
     "#00224e #002e6a #1a386f #32436d #434e6c #535a6d #61656f #6f7073 #7d7c78 "
     "#8c8878 #9b9476 #aba072 #bcae6c #cdbb63 #dec958 #f0d846 #fee838"},
    {"turbo", false,
     "#30123b #4040a2 #466be3 #4294ff #28bceb #18ddc2 #32f298 #6dfe62 #a4fc3c "
     "#cdec34 #eecf3a #fdac34 #fb7e21 #eb500e #d02f05 #a91601 #7a0403"},
    {"coolwarm", true,
     "#3b4cc0 #4e68d8 #6282ea #779af7 #8db0fe #a3c2fe #b9d0f9 #ccd9ed #dddcdc "
     "#ecd3c5 #f5c4ac #f7b093 #f4987a #eb7d62 #dd5f4b #ca3b37 #b40426"},
    {"RdBu", true,
     "#67001f #960f27 #bb2a34 #d25849 #e58368 #f5ac8b #fbceb7 #fbe6da #f6f7f7 "
     "#deebf2 #c0dceb #98c8e0 #68abd0 #3e8cbf #2870b1 #15508d #053061"},
    {"PuOr", true,
     "#7f3b08 #a04d07 #be630a #db7d12 #ef9e3c #fdbd6e #fed7a2 #fbe9cf #f6f6f7 "
     "#e3e4ef #cecde4 #b6b0d4 #988dbe #7967a6 #5d3790 #44176f #2d004b"},
    {"BrBG", true,
     "#543005 #774508 #995d13 #b97b29 #cfa256 #e2c787 #f1dfb3 #f6edd7 #f4f5f5 "
     "#d7eeeb #b4e2db #87d0c5 #58b0a7 #2d8f87 #0c7169 #01554b #003c30"},
    {"gray", false, "#000000 #ffffff"},
    {"signed", true,
     "#0b2f66 #1d4f8b #2f6fb0 #4c87bf #699fcd #86b8dc #a3c9e4 #bfdaed #ffffff "
     "#fbbd89 #f7ab74 #f39b60 #f08a4b #e0733c #d15b2c #c2441c #6b1d08"},
};

// How curves laid over one another differ: dark and bright by turns, and dashes, for print without
// colours.
struct LayerStyle {
  const char *colour, *dashes;
};
constexpr std::array<LayerStyle, 6> kLayers = {{{"#0072b2", "1"},
                                                {"#e69f00", "(10,7)"},
                                                {"#009e73", "(5,6)"},
                                                {"#000000", "(14,6,3,6)"},
                                                {"#cc79a7", "(20,8)"},
                                                {"#d55e00", "(2,5)"}}};

constexpr std::string_view kReversed = "_r";

// A map by its name, which may be that of its reverse; nullptr when there is none.
const Colormap* find(std::string_view name) {
  if (name.ends_with(kReversed)) name.remove_suffix(kReversed.size());
  for (const Colormap& map : kColormaps) {
    if (name == map.name) return &map;
  }
  return nullptr;
}

std::vector<std::string> colours_of(const std::string& name) {
  const Colormap* map = find(name);
  if (map == nullptr) throw std::logic_error("no colour map " + name);
  std::vector<std::string> colours = split_words(map->colours);
  if (name.ends_with(kReversed)) std::reverse(colours.begin(), colours.end());
  return colours;
}

}  // namespace

std::vector<std::string> colormap_names() {
  std::vector<std::string> names;
  for (const Colormap& map : kColormaps) names.emplace_back(map.name);
  for (const Colormap& map : kColormaps) names.push_back(map.name + std::string(kReversed));
  return names;
}

void ensure_colormap(const std::string& name) {
  if (find(name) != nullptr) return;
  throw InputError(fmt::format("there is no colour map '{}'; there are {}", name,
                               fmt::join(colormap_names(), ", ")));
}

bool is_diverging(const std::string& name) {
  const Colormap* map = find(name);
  return map != nullptr && map->is_diverging;
}

std::pair<std::string, std::string> end_colours(const std::string& name) {
  const std::vector<std::string> colours = colours_of(name);
  return {colours.front(), colours.back()};
}

bool is_signed(const std::string& quantity) {
  return quantity.starts_with("lyapunov") && quantity.find("error") == std::string::npos;
}

std::string usual_colormap(const std::string& quantity) {
  return is_signed(quantity) ? "signed" : "viridis";
}

std::vector<ColourAnchor> colour_anchors(const std::string& name, double min, double max) {
  const std::vector<std::string> colours = colours_of(name);
  const bool has_middle = is_diverging(name) && min <= 0.0 && max >= 0.0 && min < max;
  std::vector<ColourAnchor> anchors;
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(colours.size() - 1);
    double place = share;
    const bool is_of_side = share == 0.5 || (share < 0.5 ? min < 0.0 : max > 0.0);
    if (has_middle && !is_of_side) continue;
    if (has_middle) {
      place = share < 0.5 ? (1.0 - 2.0 * share) * min : (2.0 * share - 1.0) * max;
    }
    anchors.push_back({place, colours[i]});
  }
  return anchors;
}

std::string palette_line(const std::string& name, double min, double max) {
  std::vector<std::string> anchors;
  for (const ColourAnchor& anchor : colour_anchors(name, min, max)) {
    anchors.push_back(fmt::format("{:.6g} '{}'", anchor.place, anchor.colour));
  }
  return fmt::format("set palette defined ({})\n", fmt::join(anchors, ", "));
}

void ensure_tellable(std::size_t layers) {
  if (layers <= kLayers.size()) return;
  throw InputError(
      fmt::format("{} are too many to be told apart when laid over one another; at most {}", layers,
                  kLayers.size()));
}

std::string layer_colour(std::size_t index) { return kLayers.at(index).colour; }

std::string layer_dashes(std::size_t index) { return kLayers.at(index).dashes; }

std::string dot_colour(std::size_t layer, std::size_t layers) {
  return layers == 1 ? "#01325a" : layer_colour(layer);
}

}  // namespace gearsweep
