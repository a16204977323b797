// From where to where the values of a picture go.
#pragma once

#include <string>
#include <vector>

#include "plot/style.hpp"

namespace gearsweep {

struct ValueRange {
  double min = 0.0, max = 1.0;
  bool clipped = false;  // outliers were left out
};

// Whether there are values below a range, and above it.
struct Beyond {
  bool below = false, above = false;
};
Beyond beyond(const ValueRange& range, const std::vector<double>& values);

// Ends that were asked for in place of the range's own. Throws InputError when nothing is left
// between them; `option`: its name, for messages.
ValueRange limited(const ValueRange& range, const Limits& limits, const std::string& option);

// The same of the range of `values`, with all ends above zero when it is logarithmic. Throws
// InputError when those that were asked for are not, or no value is.
ValueRange scale_range(const ValueRange& range, const std::vector<double>& values,
                       const Limits& limits, bool is_log, const std::string& option);

// Never empty. Where a few outliers would take all contrast from the rest, it leaves out one value
// in a thousand at either end, and is then `clipped`.
ValueRange colour_range(const std::vector<double>& values);

// The range of signed values reaches to zero, which the middle of a diverging map of colours stands
// for.
ValueRange with_middle(const std::string& colormap, const std::string& quantity,
                       const ValueRange& range);

// The range of all values, with a margin, so that nothing touches the frame.
ValueRange padded_range(const std::vector<double>& values);

}  // namespace gearsweep
