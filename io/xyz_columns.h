#pragma once
// How the columns of a text file are parted and named.

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "io/scan_stream.h"
#include "io/text_place.h"

namespace adit::io {

enum class XyzTarget { x, y, z, intensity, red, green, blue, nx, ny, nz };
inline constexpr std::size_t xyz_targets = 10;
inline constexpr char blanks = '\0';

/// Which column holds what; empty where the file does not have it.
struct XyzColumns {
  std::array<std::optional<std::size_t>, xyz_targets> of_target;
  std::size_t count = 0;  ///< columns of a line

  std::optional<std::size_t> operator[](XyzTarget target) const { return of_target[static_cast<std::size_t>(target)]; }
  Attributes attributes() const;
};

/// The separator of a line: ';' or a tab where there is one, ',' unless it stands for the decimal point, else blanks.
char separator_of(std::string_view line);

/// Fields of the present line, without empty ones at its end.
std::vector<Field> columns_of_line(LineReader& lines, char separator);

/// True when a line begins with a number (or what is meant to be one): it is a point, not names.
bool begins_with_number(const std::vector<Field>& fields);

/// Columns from names. Empty when x, y and z are not all among them. Error with place for a name that is there twice
/// and for a unit in brackets other than metres.
std::optional<XyzColumns> named_columns(const LineReader& lines, const std::vector<Field>& names);

/// x y z are the first three of `count` columns.
XyzColumns first_three_columns(std::size_t count);

}  // namespace adit::io
