#pragma once
// Box plots as statisticians draw them: median, quartiles, whiskers of at most 1.5 boxes, the rest as points.

#include <optional>
#include <string>
#include <vector>

#include "render/picture.h"

namespace adit::bench {

struct Sample {
  std::string name;
  std::vector<double> values;  ///< > 0
};

/// On a logarithmic axis; `mark` draws a dashed line, "good" below it.
render::Picture box_plot(const std::string& title, const std::string& axis, const std::vector<Sample>& samples,
                         std::optional<double> mark);

}  // namespace adit::bench
