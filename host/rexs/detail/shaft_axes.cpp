#include "rexs/detail/shaft_axes.hpp"

#include <array>
#include <cmath>

namespace gearsweep {
namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

std::optional<Vector> vector_of(const RexsComponent& component, const char* name,
                                RexsLookup* lookup) {
  const auto numbers = lookup->numbers(component, name, RexsQuantity::length, 3);
  if (!numbers) return std::nullopt;
  return Vector{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

}  // namespace

std::optional<double> distance_of_axes(const RexsComponent& first, const RexsComponent& second,
                                       RexsLookup* lookup) {
  constexpr double kParallel = 1e-6;
  const char* const frame = "reference_component_for_position";
  if (lookup->text(first, frame) != lookup->text(second, frame)) return std::nullopt;
  const auto from = vector_of(first, "support_vector", lookup);
  const auto to = vector_of(second, "support_vector", lookup);
  const auto along = vector_of(first, "u_axis_vector", lookup);
  const auto other = vector_of(second, "u_axis_vector", lookup);
  if (!from || !to || !along || !other) return std::nullopt;
  const double length = std::sqrt(dot(*along, *along));
  const double cosine = dot(*along, *other) / (length * std::sqrt(dot(*other, *other)));
  if (!(std::fabs(cosine) > 1.0 - kParallel)) return std::nullopt;
  const Vector way = {(*to)[0] - (*from)[0], (*to)[1] - (*from)[1], (*to)[2] - (*from)[2]};
  const double ahead = dot(way, *along) / length;
  return std::sqrt(std::max(0.0, dot(way, way) - ahead * ahead));
}

}  // namespace gearsweep
