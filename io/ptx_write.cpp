#include "core/foundation/error.h"
#include "core/foundation/options.h"
#include "io/atomic_file.h"
#include "io/intensity_range.h"
#include "io/ptx.h"
#include "io/text_row.h"

namespace adit::io {
namespace {

/// A raster with fewer points is taken as no raster: its empty places would fill the disk.
constexpr std::uint64_t most_places_per_point = 100;

/// What the lines of a scan are: the places of its raster, column by column, or the points alone in one column.
struct Lines {
  std::uint64_t columns = 1;
  std::uint64_t rows = 0;
  bool is_raster = false;
};

Lines lines_of(const ScanFacts& scan) {
  const std::uint64_t places = std::uint64_t{scan.rows} * scan.columns;
  if (scan.header.attributes.grid && scan.column_by_column && places / most_places_per_point <= scan.points)
    return {scan.columns, scan.rows, true};
  return {1, scan.points, false};
}

std::string numbers_line(const Eigen::RowVectorXd& numbers) {
  TextLine line;
  for (const double value : numbers) line.add(short_number(value));
  return line.ended();
}

std::string header_text(const Lines& lines, const Pose& pose) {
  const Eigen::Matrix4d rows = pose.matrix().transpose();  // PTX multiplies rows
  std::string text =
      std::to_string(lines.columns) + "\n" + std::to_string(lines.rows) + "\n" + numbers_line(rows.row(3).head<3>());
  for (Eigen::Index i = 0; i < 3; ++i) text += numbers_line(rows.row(i).head<3>());
  for (Eigen::Index i = 0; i < 4; ++i) text += numbers_line(rows.row(i));
  return text;
}

/// One for all scans of the file, so that they stay comparable.
IntensityRange ptx_intensity_range(const std::vector<ScanFacts>& scans) {
  return intensity_range(all_intensities(scans), 1.0, false);
}

class PtxWriter : public ScanWriter {
 public:
  PtxWriter(const std::filesystem::path& path, const std::vector<ScanFacts>& scans)
      : scans_(scans), file_(path), range_(ptx_intensity_range(scans)) {}

  bool begin(const ScanHeader&) override {
    lines_ = lines_of(scan());
    written_ = 0;
    file_.append(header_text(lines_, scan().header.file_pose.value_or(Pose::Identity())));
    return true;
  }

  void take(PointBlock& block) override {
    for (std::size_t i = 0; i < block.size(); ++i) {
      if (lines_.is_raster) fill_up_to(block.grid[i].column * lines_.rows + block.grid[i].row);
      append(block, i);
    }
  }

  void end(std::uint64_t) override {
    fill_up_to(lines_.columns * lines_.rows);
    ++next_;
  }
  void commit() override { file_.commit(); }

 private:
  const ScanFacts& scan() const { return scans_.at(next_); }

  /// Places without a return, up to the given one.
  void fill_up_to(std::uint64_t place) {
    if (place < written_ || place > lines_.columns * lines_.rows)
      throw Error("the raster changed while it was being read", scan().header.where, "try again");
    const std::string_view line = scan().header.attributes.colour ? "0 0 0 0.5 0 0 0\n" : "0 0 0 0.5\n";
    for (; written_ < place; ++written_) file_.append(line);
  }

  void append(const PointBlock& block, std::size_t i) {
    line_.clear();
    add_position(line_, block.positions[i], scan().coordinates_are_float32);
    line_.add(block.intensity.empty() ? 0.5F : static_cast<float>(range_(block.intensity[i])));
    if (!block.colour.empty()) add_colour(line_, block.colour[i]);
    file_.append(line_.ended());
    ++written_;
  }

  std::vector<ScanFacts> scans_;
  AtomicFile file_;
  IntensityRange range_;
  std::size_t next_ = 0;
  Lines lines_;
  std::uint64_t written_ = 0;  ///< lines of the present scan
  TextLine line_;
};

}  // namespace

std::unique_ptr<ScanWriter> make_ptx_writer(const std::filesystem::path& path, const std::vector<ScanFacts>& scans,
                                            const WriteOptions&) {
  return std::make_unique<PtxWriter>(path, scans);
}

}  // namespace adit::io
