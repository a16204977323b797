#include "plot/labels.hpp"

#include "plot/detail/mathtext.hpp"
#include "plot/detail/text.hpp"

namespace gearsweep {

std::string axis_mathtext(const ResultAxis& axis) { return mathtext_of(axis_label(axis)); }

std::string quantity_mathtext(const std::string& name, const std::string& unit) {
  return mathtext_of(quantity_label(name, unit));
}

std::string quantity_html(const std::string& name) { return html_of(quantity_label(name, "1")); }

std::string literal_mathtext(std::string_view text) { return mathtext_of(literal(text)); }

std::string typeset_mathtext(std::string_view text) { return mathtext_of(typeset(text)); }

}  // namespace gearsweep
