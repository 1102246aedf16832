#pragma once
// Tables: a header, right-aligned numbers, rows as high as their text, split where the paper ends.

#include <cstddef>
#include <string>
#include <vector>

#include "render/canvas.h"

namespace adit::render {

struct TableColumn {
  std::string heading;
  double width_mm = 20.0;
  bool number = false;  ///< right-aligned, never wrapped
};

struct TableCell {
  std::string text;
  Colour colour = colours::black;
  bool bold = false;

  TableCell() = default;
  TableCell(std::string words, Colour c = colours::black, bool is_bold = false)
      : text(std::move(words)), colour(c), bold(is_bold) {}
  TableCell(const char* words) : text(words) {}
};

struct Table {
  std::vector<TableColumn> columns;
  std::vector<std::vector<TableCell>> rows;  ///< a row may be shorter than the columns
  double text_mm = 2.4;
};

/// Sets the widths so that the table is `width_mm` wide, in the proportions they have.
void stretch_to(Table& table, double width_mm);

/// Height [mm] of the header and of one row.
double header_height(const Canvas& canvas, const Table& table);
double row_height(const Canvas& canvas, const Table& table, std::size_t row);

/// Draws the header and the rows from first_row on that fit into room_mm. Returns the first row not drawn and the
/// height used. At least one row is drawn when room is too small for it and `force` is set.
struct TablePart {
  std::size_t next_row = 0;
  double height_mm = 0.0;
};
TablePart draw_table(Canvas& canvas, const PaperPoint& at, const Table& table, std::size_t first_row, double room_mm,
                     bool force = false);

}  // namespace adit::render
