#pragma once
// Numbers written as formulas of named sizes: "width/2 - sqrt(r*r - h*h)".

#include <map>
#include <string>

namespace adit::io {

/// + - * / and brackets, sqrt, and sin, cos, tan of degrees. Throws Error (what is wrong, no place) for names that are
/// not in `values`, other letters, roots of negative numbers, divisions by zero, and nesting deeper than 50.
double evaluate(const std::string& formula, const std::map<std::string, double>& values);

}  // namespace adit::io
