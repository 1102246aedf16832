#include "io/pcd_pcl.h"

#include <pcl/PCLPointCloud2.h>
#include <pcl/common/io.h>
#include <pcl/console/print.h>
#include <pcl/io/lzf.h>
#include <pcl/io/pcd_io.h>

#include <exception>
#include <mutex>
#include <utility>

#include "core/foundation/error.h"

namespace adit::io {
namespace {

/// PCL prints what it finds wrong; here the Error says it. The level is PCL's own global, so one at a time.
class SilentPcl {
 public:
  SilentPcl() : lock_(mutex()), level_(pcl::console::getVerbosityLevel()) {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  }
  ~SilentPcl() { pcl::console::setVerbosityLevel(level_); }
  SilentPcl(const SilentPcl&) = delete;
  SilentPcl& operator=(const SilentPcl&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex only_one;
    return only_one;
  }
  std::lock_guard<std::mutex> lock_;
  pcl::console::VERBOSITY_LEVEL level_;
};

/// A cloud as PCL's own header reader would leave it: described, with memory for the points.
pcl::PCLPointCloud2 described(const PcdHeader& header) {
  pcl::PCLPointCloud2 cloud;
  for (const PcdField& field : header.fields) {
    pcl::PCLPointField pcl_field;
    pcl_field.name = field.name;
    pcl_field.offset = static_cast<pcl::uindex_t>(field.offset);
    pcl_field.datatype = static_cast<std::uint8_t>(pcl::getFieldType(static_cast<int>(field.size), field.type));
    pcl_field.count = static_cast<pcl::uindex_t>(field.count);
    cloud.fields.push_back(std::move(pcl_field));
  }
  cloud.width = static_cast<pcl::uindex_t>(header.width);
  cloud.height = static_cast<pcl::uindex_t>(header.height);
  cloud.point_step = static_cast<pcl::uindex_t>(header.point_bytes);
  cloud.row_step = static_cast<pcl::uindex_t>(header.point_bytes * header.width);
  cloud.data.resize(static_cast<std::size_t>(header.points * header.point_bytes));
  return cloud;
}

}  // namespace

std::vector<std::uint8_t> pcd_records(const InputFile& file, const PcdHeader& header) {
  const bool compressed = header.encoding == PcdEncoding::compressed;
  for (const PcdField& field : header.fields)
    if (compressed && field.name == "_")
      throw Error("a compressed file with padding fields (_)", file.name(), "export it as binary");
  const std::uint64_t size = compressed ? file.size() - header.body_offset : header.points * header.point_bytes;
  const auto body = file.read(header.body_offset, static_cast<std::size_t>(size), "the points");
  const SilentPcl silent;
  try {
    pcl::PCLPointCloud2 cloud = described(header);
    const std::size_t expected = cloud.data.size();
    const int failed = pcl::PCDReader().readBodyBinary(reinterpret_cast<const unsigned char*>(body.data()), cloud,
                                                       pcl::PCDReader::PCD_V7, compressed, 0);
    if (failed == 0 && cloud.data.size() == expected) return std::move(cloud.data);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    // falls through to the Error: the words of PCL name neither file nor mend
  }
  throw Error("the points cannot be unpacked", file.at_byte(header.body_offset),
              "the file is damaged; copy or export it again");
}

std::string lzf_packed(std::string_view bytes) {
  std::string packed(bytes.size() + bytes.size() / 16 + 64, '\0');
  const unsigned size = pcl::lzfCompress(bytes.data(), static_cast<unsigned>(bytes.size()), packed.data(),
                                         static_cast<unsigned>(packed.size()));
  packed.resize(size);
  return packed;
}

}  // namespace adit::io
