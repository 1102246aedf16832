// adit target print: targets on paper.

#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/command_line/target.h"
#include "app/version.h"
#include "core/georeference/coded_pattern.h"
#include "io/atomic_file.h"
#include "io/text_file.h"
#include "render/target_sheet.h"

namespace adit::app {
namespace {

struct Arguments {
  std::string out;
  std::string ids = "1-40";
  std::string size = "150mm";
  std::string paper = "A4";
  std::string board;
};

std::pair<int, int> board_of(const std::string& words) {
  int columns = 0, rows = 0;
  char rest = 0;
  if (std::sscanf(words.c_str(), "%dx%d%c", &columns, &rows, &rest) != 2 || columns < 3 || rows < 3 || columns > 30 ||
      rows > 30)
    throw Error("\"" + words + "\" is no board", "--board", "write columns x rows, for instance 7x5, 3 to 30 each");
  return {columns, rows};
}

std::string csv_of(const render::TargetBoard& board, const std::vector<int>& ids) {
  std::string csv = "id,east,north,elevation\n";
  char row[80];
  for (std::size_t i = 0; i < board.centres_mm.size(); ++i) {
    std::snprintf(row, sizeof row, "%d,%.4f,%.4f,0\n", ids[i], 1e-3 * board.centres_mm[i].x(),
                  1e-3 * board.centres_mm[i].y());
    csv += row;
  }
  return csv;
}

int print_board(const Arguments& arguments, const std::vector<int>& ids, double diameter_mm,
                const render::PaperSize& paper, const render::DocumentTitle& title, const CommonOptions& common) {
  const auto [columns, rows] = board_of(arguments.board);
  const render::TargetBoard board = with_place("--board", [&, across = columns, down = rows] {
    return render::target_board(ids, across, down, diameter_mm, paper, title);
  });
  const std::string table = std::filesystem::path(arguments.out).replace_extension(".csv").string();
  const std::string csv = csv_of(board, ids);
  // A name that nobody has typed must take the place of nothing.
  if (std::filesystem::exists(table) && io::read_text_file(table) != csv)
    throw Error("this is there already and holds something else; the board's table would take its place", table,
                "choose another name for OUT, or remove it");
  io::write_file_atomically(arguments.out, board.pdf);
  io::write_file_atomically(table, csv);
  if (!common.quiet)
    std::fprintf(stderr,
                 "adit: %s, and where its targets are in %s [m]; measure the print, and scale the table if it is off\n",
                 arguments.out.c_str(), table.c_str());
  return exit_good;
}

}  // namespace

Action declare_target_print(CLI::App& command) {
  auto arguments = std::make_shared<Arguments>();
  command.add_option("OUT", arguments->out, "the PDF to write")->required()->check(some_name);
  command.add_option("--ids", arguments->ids, "which targets: 1-40,57 (1-40); low ids differ most from one another");
  command.add_option("--size", arguments->size, "diameter of the ring of segments, with its unit (150mm)");
  command.add_option("--paper", arguments->paper, "A5 to A0, Letter, Legal, Tabloid (A4)");
  command.add_option("--board", arguments->board,
                     "a board for calibration instead: columns x rows, of the first ids; writes its table beside it");
  return [arguments](const CommonOptions& common, Progress&) {
    const std::vector<int> ids = ids_of(arguments->ids);
    const double diameter_mm = 1e3 * length_m_of(arguments->size, "--size");
    if (diameter_mm < 5.0) throw Error("a target of less than 5 mm", "--size", "state its unit, for instance 150mm");
    if (std::filesystem::path(arguments->out).extension() != ".pdf")
      throw Error("targets are printed to a PDF", arguments->out, "write a name that ends with .pdf");
    const render::PaperSize paper = with_place("--paper", [&] { return render::paper_size(arguments->paper); });
    const render::DocumentTitle title{"Adit coded targets", std::string("Adit ") + version, "2000-01-01T00:00:00Z"};
    if (!arguments->board.empty()) return print_board(*arguments, ids, diameter_mm, paper, title, common);
    io::write_file_atomically(
        arguments->out, with_place("--size", [&] { return render::target_pages(ids, diameter_mm, paper, title); }));
    if (!common.quiet && ids.back() > codes_differing_in(4))
      std::fprintf(stderr, "adit: ids above %d differ from others in fewer than four segments; lower ones are safer\n",
                   codes_differing_in(4));
    return exit_good;
  };
}

}  // namespace adit::app
