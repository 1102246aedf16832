// adit convert IN OUT: between scan formats.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command_line/command.h"
#include "core/foundation/error.h"
#include "io/scan_formats.h"

namespace adit::app {
namespace {

/// A scan is evidence: its file is never replaced by what was made of it.
void check_another_file(const std::string& in, const std::string& out) {
  std::error_code ignored;
  if (std::filesystem::equivalent(in, out, ignored))
    throw Error("this is the file that is read; a scan is not overwritten", out, "choose another name for OUT");
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

}  // namespace

Action declare_convert(CLI::App& command) {
  struct Arguments {
    std::string in;
    std::string out;
    io::ReadOptions read;
    io::WriteOptions write;
    std::size_t scan = 0;
  };
  auto arguments = std::make_shared<Arguments>();
  command.add_option("IN", arguments->in, "a scan (" + joined(io::readable_endings()) + ")")
      ->required()
      ->check(some_name);
  command.add_option("OUT", arguments->out, "its new file (" + joined(io::writable_endings()) + ")")
      ->required()
      ->check(some_name);
  command.add_option("--variant", arguments->write.variant, "PLY: ascii, little, big; PCD: ascii, binary, compressed");
  command.add_option("--scan", arguments->scan, "which scan of a file that holds several, from 1")
      ->check(CLI::Range(1, 1000000));
  command.add_flag("--drop-invalid", arguments->read.drop_invalid, "leave out points that are not finite");
  return [arguments](const CommonOptions& common, Progress& progress) {
    check_another_file(arguments->in, arguments->out);
    Progress reading = progress.part(0.6, "reading " + arguments->in);
    std::vector<io::ScanData> scans = io::read_scans(arguments->in, arguments->read, reading);
    if (arguments->scan > scans.size())
      throw Error(
          "there is no scan " + std::to_string(arguments->scan) + "; the file holds " + std::to_string(scans.size()),
          arguments->in, "choose another with --scan");
    if (arguments->scan > 0) scans = {std::move(scans[arguments->scan - 1])};
    std::size_t points = 0;
    for (const auto& scan : scans) points += scan.cloud.size();
    Progress writing = progress.part(0.4, "writing " + arguments->out);
    io::write_scans(arguments->out, scans, arguments->write, writing);
    if (common.json)
      std::printf("%s\n", nlohmann::ordered_json{{"file", arguments->out}, {"points", points}, {"scans", scans.size()}}
                              .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
                              .c_str());
    else if (!common.quiet)
      std::printf("%s: %zu points in %zu scan%s\n", arguments->out.c_str(), points, scans.size(),
                  scans.size() == 1 ? "" : "s");
    return exit_good;
  };
}

}  // namespace adit::app
