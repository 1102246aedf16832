#include "io/checked_writer.h"

#include <array>
#include <utility>

#include "core/foundation/error.h"
#include "io/scan_offset.h"

namespace adit::io {
namespace {

/// The facts of the same scan once its pose is in its points.
ScanFacts moved_to_site(ScanFacts facts) {
  if (!facts.header.file_pose) return facts;
  facts.header.file_pose.reset();
  facts.box = facts.site_box;
  facts.coordinates_are_float32 = false;
  return facts;
}

void move(PointBlock& block, const Pose& site_from_file) {
  const Eigen::Matrix3f turn = site_from_file.linear().cast<float>();
  for (Eigen::Vector3d& p : block.positions) p = site_from_file * p;
  for (Eigen::Vector3f& n : block.normals) n = turn * n;
}

void expect_site_coordinates(const ScanFacts& facts) {
  const std::array<Eigen::Vector3d, 2> corners = {facts.box.min(), facts.box.max()};
  offset_for(corners, facts.header.where);
}

class CheckedWriter : public ScanWriter {
 public:
  CheckedWriter(std::vector<ScanFacts> source, const std::vector<ScanFacts>& written, PoseGoes pose_goes,
                std::unique_ptr<ScanWriter> writer)
      : pose_goes_(pose_goes), writer_(std::move(writer)) {
    for (std::size_t i = 0; i < source.size(); ++i) scans_.push_back({std::move(source[i]), written[i]});
  }

  bool begin(const ScanHeader&) override {
    if (next_ == scans_.size()) changed(scans_.back().source.header.where);
    points_ = 0;
    return writer_->begin(scans_[next_].written.header);
  }

  void take(PointBlock& block) override {
    const Scan& scan = scans_[next_];
    const ScanFacts& facts = scan.source;
    points_ += block.size();
    if (points_ > facts.points || !has_attributes(block, facts.header.attributes)) changed(facts.header.where);
    for (const Eigen::Vector3d& p : block.positions)
      if (!facts.box.contains(p)) changed(facts.header.where);
    if (pose_goes_ == PoseGoes::into_points && facts.header.file_pose) move(block, *facts.header.file_pose);
    writer_->take(block);
  }

  void end(std::uint64_t no_returns) override {
    if (points_ != scans_[next_].source.points) changed(scans_[next_].source.header.where);
    writer_->end(no_returns);
    ++next_;
  }

  void commit() override {
    if (next_ != scans_.size()) changed(scans_[next_].source.header.where);
    writer_->commit();
  }

 private:
  struct Scan {
    ScanFacts source;
    ScanFacts written;
  };

  static bool has_attributes(const PointBlock& block, const Attributes& has) {
    const auto fits = [&](std::size_t length, bool wanted) { return length == (wanted ? block.size() : 0); };
    return fits(block.intensity.size(), has.intensity) && fits(block.colour.size(), has.colour) &&
           fits(block.normals.size(), has.normals) && fits(block.grid.size(), has.grid);
  }

  [[noreturn]] static void changed(const std::string& where) {
    throw Error("the file changed while it was being read", where, "let the other program finish, then try again");
  }

  PoseGoes pose_goes_;
  std::unique_ptr<ScanWriter> writer_;
  std::vector<Scan> scans_;
  std::size_t next_ = 0;
  std::uint64_t points_ = 0;  ///< of the present scan, so far
};

}  // namespace

std::unique_ptr<ScanWriter> checked_writer(const std::filesystem::path& file, std::vector<ScanFacts> facts,
                                           PoseGoes pose_goes, const MakeWriter& make_writer) {
  std::vector<ScanFacts> written;
  for (const ScanFacts& scan : facts) {
    if (scan.points == 0)
      throw Error("a scan without points cannot be written", file.string(), "choose a scan with points");
    written.push_back(pose_goes == PoseGoes::into_points ? moved_to_site(scan) : scan);
    expect_site_coordinates(written.back());
  }
  std::unique_ptr<ScanWriter> writer = make_writer(written);
  return std::make_unique<CheckedWriter>(std::move(facts), written, pose_goes, std::move(writer));
}

}  // namespace adit::io
