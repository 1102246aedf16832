// adit convert IN OUT: between scan formats.

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command_line/command.h"
#include "core/foundation/error.h"
#include "io/atomic_file.h"
#include "io/scan_formats.h"
#include "io/scan_losses.h"
#include "io/scan_offset.h"

namespace adit::app {
namespace {

/// A scan is evidence: its file is never replaced by what was made of it.
void check_another_file(const std::string& in, const std::string& out) {
  std::error_code ignored;
  if (std::filesystem::equivalent(in, out, ignored))
    throw Error("this is the file that is read; a scan is not overwritten", out, "choose another name for OUT");
}

/// Hands on one scan of a file (0: all of them) and counts those that it sees.
class ChosenScan : public io::ScanSink {
 public:
  ChosenScan(io::ScanSink& to, std::size_t number) : to_(to), number_(number) {}
  bool begin(const io::ScanHeader& scan) override {
    ++seen_;
    if (number_ != 0 && number_ != seen_) return false;
    io::expect_metres(scan);
    return to_.begin(scan);
  }
  void take(io::PointBlock& block) override { to_.take(block); }
  void end(std::uint64_t no_returns) override { to_.end(no_returns); }
  std::size_t seen() const { return seen_; }

 private:
  io::ScanSink& to_;
  std::size_t number_;
  std::size_t seen_ = 0;
};

/// A wrong unit or column shows here; later no scan with such points would be read.
void expect_near_each_other(const io::ScanFacts& scan) {
  if (scan.box.isEmpty()) return;
  const std::array<Eigen::Vector3d, 2> corners = {scan.box.min(), scan.box.max()};
  io::expect_near_offset(scan.box, io::offset_for(corners, scan.header.where), scan.header.where);
}

struct Arguments {
  std::string in;
  std::string out;
  io::ReadOptions read;
  io::WriteOptions write;
  std::size_t scan = 0;
};

std::vector<io::ScanFacts> facts_of(const Arguments& arguments, Progress& progress) {
  io::FactsSink facts;
  ChosenScan chosen(facts, arguments.scan);
  io::stream_scans(arguments.in, arguments.read, chosen, progress);
  if (arguments.scan > chosen.seen())
    throw Error(
        "there is no scan " + std::to_string(arguments.scan) + "; the file holds " + std::to_string(chosen.seen()),
        arguments.in, "choose another with --scan");
  for (const io::ScanFacts& scan : facts.scans) expect_near_each_other(scan);
  return std::move(facts.scans);
}

/// Twice through the file, for a header stands before the points: no memory grows with it.
std::vector<io::ScanFacts> convert(const Arguments& arguments, Progress& progress) {
  Progress looking = progress.part(0.4, "reading " + arguments.in);
  std::vector<io::ScanFacts> facts = facts_of(arguments, looking);
  const auto writer = io::make_scan_writer(arguments.out, facts, arguments.write);
  Progress writing = progress.part(0.6, "writing " + arguments.out);
  ChosenScan chosen(*writer, arguments.scan);
  io::stream_scans(arguments.in, arguments.read, chosen, writing);
  writer->commit();
  return facts;
}

/// What the new file says less than the old one.
std::vector<std::string> losses_of(const Arguments& arguments, const std::vector<io::ScanFacts>& scans,
                                   const io::ScanFileSummary& source) {
  std::vector<std::string> losses = io::losses_of_writing(arguments.out, scans);
  const bool has_system = std::any_of(source.header.begin(), source.header.end(), [](const io::HeaderFact& fact) {
    return fact.name == "coordinate_system" || fact.name == "epsg";
  });
  if (has_system) losses.emplace_back("the name of the coordinate system is left out");
  if (source.format.starts_with("LAS") || source.format.starts_with("LAZ"))
    losses.emplace_back("classes, numbers of returns and times are left out");
  return losses;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

}  // namespace

Action declare_convert(CLI::App& command) {
  auto arguments = std::make_shared<Arguments>();
  command.add_option("IN", arguments->in, "a scan (" + joined(io::readable_endings()) + ")")
      ->required()
      ->check(some_name);
  command.add_option("OUT", arguments->out, "its new file (" + joined(io::writable_endings()) + ")")
      ->required()
      ->check(some_name);
  command.add_option("--variant", arguments->write.variant,
                     "PLY: ascii, little, big; PCD: ascii, binary, compressed; E57: scaled, double");
  command.add_option("--scan", arguments->scan, "which scan of a file that holds several, from 1")
      ->check(CLI::Range(1, 1000000));
  command.add_flag("--drop-invalid", arguments->read.drop_invalid, "leave out points that are not finite");
  return [arguments](const CommonOptions& common, Progress& progress) {
    check_another_file(arguments->in, arguments->out);
    io::remove_leftovers(std::filesystem::absolute(arguments->out).parent_path());
    io::expect_writable(arguments->out, arguments->write);
    const io::ScanFileSummary source = io::summarise_scan_file(arguments->in, progress);
    const std::vector<io::ScanFacts> scans = convert(*arguments, progress);
    const std::vector<std::string> losses = losses_of(*arguments, scans, source);
    std::uint64_t points = 0;
    for (const io::ScanFacts& scan : scans) points += scan.points;
    if (common.json)
      std::printf("%s\n",
                  nlohmann::ordered_json{
                      {"file", arguments->out}, {"points", points}, {"scans", scans.size()}, {"changes", losses}}
                      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
                      .c_str());
    else if (!common.quiet)
      std::printf("%s: %llu points in %zu scan%s\n", arguments->out.c_str(), static_cast<unsigned long long>(points),
                  scans.size(), scans.size() == 1 ? "" : "s");
    if (!common.json && !common.quiet)
      for (const std::string& loss : losses) std::printf("  %s\n", loss.c_str());
    return exit_good;
  };
}

}  // namespace adit::app
