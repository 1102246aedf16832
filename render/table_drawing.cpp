#include "render/table_drawing.h"

#include <algorithm>

namespace adit::render {
namespace {

constexpr double pad_x = 1.0;
constexpr double pad_y = 0.7;
constexpr double pad_after_number = 2.6;

double left_pad(const Table& table, std::size_t column) {
  return column > 0 && table.columns[column - 1].number ? pad_after_number : pad_x;
}

TextStyle cell_style(const Table& table, std::size_t column, bool heading) {
  const TableColumn& c = table.columns[column];
  TextStyle style{.size_mm = table.text_mm, .bold = heading, .across = c.number ? Across::right : Across::left};
  if (heading || !c.number) style.wrap_mm = c.width_mm - pad_x - (c.number ? pad_x : left_pad(table, column));
  return style;
}

void draw_cell(Canvas& canvas, const PaperPoint& corner, const Table& table, std::size_t column, const TableCell& cell,
               bool heading) {
  TextStyle style = cell_style(table, column, heading);
  style.colour = cell.colour;
  style.bold = heading || cell.bold;
  const double x = table.columns[column].number ? table.columns[column].width_mm - pad_x : left_pad(table, column);
  canvas.text(corner + PaperPoint(x, pad_y), cell.text, style);
}

double total_width(const Table& table) {
  double width = 0.0;
  for (const TableColumn& column : table.columns) width += column.width_mm;
  return width;
}

void draw_header(Canvas& canvas, const PaperPoint& at, const Table& table, double height) {
  canvas.fill(Rect{at.x(), at.y(), total_width(table), height}, {0.90, 0.93, 0.96});
  PaperPoint corner = at;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    draw_cell(canvas, corner, table, i, table.columns[i].heading, true);
    corner.x() += table.columns[i].width_mm;
  }
  canvas.line(at + PaperPoint(0.0, height), at + PaperPoint(total_width(table), height), {colours::ink_blue, 0.3, {}});
}

}  // namespace

void stretch_to(Table& table, double width_mm) {
  const double factor = width_mm / total_width(table);
  for (TableColumn& column : table.columns) column.width_mm *= factor;
}

double header_height(const Canvas& canvas, const Table& table) {
  double height = 0.0;
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    height = std::max(height, canvas.text_size(table.columns[i].heading, cell_style(table, i, true)).y());
  return height + 2.0 * pad_y;
}

double row_height(const Canvas& canvas, const Table& table, std::size_t row) {
  double height = canvas.text_size("0", {.size_mm = table.text_mm}).y();
  const std::size_t cells = std::min(table.rows[row].size(), table.columns.size());
  for (std::size_t i = 0; i < cells; ++i)
    if (!table.columns[i].number) {
      TextStyle style = cell_style(table, i, false);
      style.bold = table.rows[row][i].bold;
      height = std::max(height, canvas.text_size(table.rows[row][i].text, style).y());
    }
  return height + 2.0 * pad_y;
}

TablePart draw_table(Canvas& canvas, const PaperPoint& at, const Table& table, std::size_t first_row, double room_mm,
                     bool force) {
  TablePart part{first_row, header_height(canvas, table)};
  if (!force && part.height_mm > room_mm) return {first_row, 0.0};
  draw_header(canvas, at, table, part.height_mm);
  for (; part.next_row < table.rows.size(); ++part.next_row) {
    const double height = row_height(canvas, table, part.next_row);
    const bool must = force && part.next_row == first_row;
    if (!must && part.height_mm + height > room_mm) break;
    PaperPoint corner = at + PaperPoint(0.0, part.height_mm);
    const auto& row = table.rows[part.next_row];
    for (std::size_t i = 0; i < std::min(row.size(), table.columns.size()); ++i) {
      draw_cell(canvas, corner, table, i, row[i], false);
      corner.x() += table.columns[i].width_mm;
    }
    part.height_mm += height;
    canvas.line(at + PaperPoint(0.0, part.height_mm), at + PaperPoint(total_width(table), part.height_mm),
                {colours::light_grey, 0.1, {}});
  }
  return part;
}

}  // namespace adit::render
