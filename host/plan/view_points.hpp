// The points of a view of a map: a rectangle of its two axes at any depth.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "plan/point_source.hpp"
#include "study/study.hpp"

namespace gearsweep {

// Columns of cells along one axis. At depth d the axis is cut into 2^d steps of equal length (of
// equal ratio on a logarithmic axis); a cell stands at the beginning of its step. So a deeper view
// has the cells of one that is less deep, at coordinates that are equal to the bit: cell k at depth
// d is cell 2k at depth d + 1.
struct ViewSpan {
  std::uint64_t first = 0;  // cell
  std::size_t count = 0;
};

// The value of an axis at a share of its way, from 0 to 1. The first and the last value are the
// axis's own.
double value_at_share(const Axis& axis, double share);

struct View {
  std::size_t depth = 0;         // up to 52
  std::array<ViewSpan, 2> axes;  // x, y
};

// Point (ix, iy) of the view has index iy * nx + ix. Where `is_finer` is asked for, the points that
// the view one less deep has are left out: of a view that begins at even cells and has an even
// number of them three quarters remain, row by row.
class ViewPoints final : public PointSource {
 public:
  // study: with two axes that each sweep one parameter, and points that start on their own. Throws
  // InputError otherwise, and where the view reaches beyond the axes or has 2^32 points or more.
  ViewPoints(std::shared_ptr<const Study> study, const View& view, bool is_finer = false);

  std::size_t size() const override;
  std::string key() const override;
  const std::vector<std::size_t>& differing() const override { return differing_; }
  void set(std::size_t point, ModelSetting* setting) const override;
  std::vector<double> start(std::size_t point) const override;
  std::size_t row() const override { return is_finer_ ? 1 : view_.axes[0].count; }

  // The cell where a point stands, counted from the view's first one.
  std::array<std::size_t, 2> cell_of(std::size_t point) const;
  // The coordinates of a cell of the view on both axes.
  std::array<double, 2> place_of(const std::array<std::size_t, 2>& cell) const;

 private:
  const std::shared_ptr<const Study> study_;
  const View view_;
  const bool is_finer_;
  std::vector<std::size_t> differing_;
};

}  // namespace gearsweep
