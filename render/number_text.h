#pragma once
// Numbers as people read them, the same on every machine.

#include <string>

namespace adit::render {

/// "62.14", with a true minus sign, never "-0.00"; an en dash where the value is not finite.
std::string fixed(double value, int decimals);

/// The same with a sign before positive values, too: "+0.42".
std::string with_sign(double value, int decimals);

/// "1,234,567"
std::string grouped(unsigned long long value);

/// A share as "97 %"; never "100 %" when something is missing.
std::string percent(double share, int decimals = 0);

}  // namespace adit::render
