#pragma once
// Robust summaries of numbers. All take their own copy and give NaN for no numbers.

#include <vector>

namespace adit {

double quantile(std::vector<double> values, double share);
double median(std::vector<double> values);
/// 1.4826 times the median absolute deviation from the median: the standard deviation of normal data, deaf to outliers.
double robust_sigma(const std::vector<double>& values);
double root_mean_square(const std::vector<double>& values);

}  // namespace adit
