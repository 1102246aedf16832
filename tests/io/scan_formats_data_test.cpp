// Every scan beside the project: which are read, with how many points, and why the others are refused.

#include <map>
#include <set>

#include "tests/io/scan_samples.h"
#include "tests/real_data.h"

namespace adit::io {
namespace {

/// points of each scan in the file, or the words of the refusal.
struct Expected {
  std::vector<std::size_t> points;
  std::string refusal;
};
using Table = std::map<std::string, Expected>;

Expected read(std::size_t points) {
  return {{points}, {}};
}
Expected refused(const std::string& words) {
  return {{}, words};
}

void expect_as_in(const Table& table, const std::filesystem::path& folder) {
  std::set<std::string> seen;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = std::filesystem::relative(entry.path(), folder).string();
    if (!entry.is_regular_file() || entry.path().stem() == "LICENSE" ||
        entry.path().filename().string().starts_with("."))
      continue;
    seen.insert(name);
    const auto row = table.find(name);
    const std::string words = tests::refusal(entry.path());
    if (row == table.end()) {
      ADD_FAILURE() << name << " is not in the table: " << words;
      continue;
    }
    if (!row->second.refusal.empty()) {
      EXPECT_THAT(words, testing::HasSubstr(row->second.refusal)) << name;
      continue;
    }
    EXPECT_EQ(words, "(read)") << name;
    if (words != "(read)") continue;
    Progress progress;
    std::vector<std::size_t> points;
    for (const ScanData& scan : read_scans(entry.path(), {}, progress)) points.push_back(scan.cloud.size());
    EXPECT_EQ(points, row->second.points) << name;
    std::vector<std::size_t> summarised;
    for (const ScanSummary& scan : summarise_scan_file(entry.path(), progress).scans) summarised.push_back(scan.points);
    EXPECT_EQ(summarised.size(), points.size()) << name;
  }
  for (const auto& [name, expected] : table) EXPECT_TRUE(seen.contains(name)) << name << " is absent";
}

TEST(ScanFormatsData, Las) {
  ADIT_NEED_REAL_DATA();
  expect_as_in(
      {
          {"1.2-empty-geotiff-vlrs.las", read(43)},
          {"1.2-with-color-clipped.las", refused("the header says 1065 points, the file holds 1064")},
          {"1.2-with-color.las", read(1065)},
          {"100-points.las", read(100)},
          {"4_6_crop.las", read(23875)},
          {"autzen_trim.las", read(110000)},
          {"bad-geotiff-keys.las", read(10)},
          {"bad_vlr_count.las", read(10)},
          {"epsg_4326.las", read(5380)},
          {"extrabytes.las", read(1065)},
          {"garbage_nVariableLength.las", refused("the header says 719 points, the file holds 718")},
          {"gps-time-nan.las", read(1)},
          {"hextest.las", read(8)},
          {"interesting.las", read(1065)},
          {"lots_of_vlr.las", read(1)},
          {"mvk-thin.las", read(6280)},
          {"no-points.las", refused("the scan holds no points")},
          {"noise-clean.las", read(1065)},
          {"noise-dirty.las", read(1065)},
          {"permutations/1.0_0.las", read(1)},
          {"permutations/1.0_1.las", read(1)},
          {"permutations/1.1_0.las", read(1)},
          {"permutations/1.1_1.las", read(1)},
          {"permutations/1.2-no-points.las", refused("the header says 1065 points, the file holds 0")},
          {"permutations/1.2_0.las", read(1)},
          {"permutations/1.2_1.las", read(1)},
          {"permutations/1.2_2.las", read(1)},
          {"permutations/1.2_3.las", read(1)},
          {"prec3.las", read(110)},
          {"sample_c.las", read(14408)},
          {"sample_c_thin.las", read(2732)},
          {"sample_nc.las", read(14408)},
          {"simple.las", read(1065)},
          {"spec_3.las", read(10)},
          {"spurious.las", read(1065)},
          {"synthetic_test.las", read(1)},
          {"test1_4.las", read(1000)},
          {"test_epsg_4047.las", read(10)},
          {"test_epsg_4326.las", read(10)},
          {"test_epsg_4326_axis.las", read(10)},
          {"test_epsg_4326x3.las", read(30)},
          {"test_utm16.las", read(10)},
          {"test_utm17.las", read(10)},
          {"utm15.las", read(1)},
          {"utm17.las", read(10)},
          {"warsaw_small.las", read(3000)},
          {"wontcompress3.las", read(1000)},
      },
      tests::real_data() / "formats/las");
}

TEST(ScanFormatsData, LasBoxesAgreeWithTheirHeaders) {
  ADIT_NEED_REAL_DATA();
  Progress progress;
  for (const char* name :
       {"1.2-with-color.las", "autzen_trim.las", "sample_c.las", "wontcompress3.las", "extrabytes.las"}) {
    const auto file = tests::real_data() / "formats/las" / name;
    const ScanData scan = tests::read_one(file);
    BoundingBox box;
    for (const auto& p : scan.cloud.points) box.extend(p.cast<double>() + scan.offset);
    const BoundingBox said = summarise_scan_file(file, progress).scans.at(0).box;
    EXPECT_LT((box.min() - said.min()).norm(), 2e-4) << name;
    EXPECT_LT((box.max() - said.max()).norm(), 2e-4) << name;
  }
}

TEST(ScanFormatsData, Pcd) {
  ADIT_NEED_REAL_DATA();
  expect_as_in(
      {
          {"bun0.pcd", read(397)},
          {"bun01.pcd", read(200)},
          {"bunny.pcd", read(397)},
          {"car6.pcd", read(10031)},
          {"colored_cloud.pcd", read(1000)},
          {"cturtle.pcd", read(167198)},
          {"curve3d.pcd", read(110)},
          {"curve_close.pcd", read(110)},
          {"lamppost.pcd", read(1771)},
          {"milk_color.pcd", read(13704)},
          {"noisy_slice_displaced.pcd", read(3782)},
          {"octants.pcd", read(8)},
          {"office1.pcd", read(254456)},
          {"pcl_logo.pcd", read(12909)},
          {"sac_plane_test.pcd", read(3283)},
          {"table_scene_mug_stereo_textured.pcd", read(209280)},
      },
      tests::real_data() / "formats/pcd");
}

TEST(ScanFormatsData, OrganisedPcdCountsItsNoReturns) {
  ADIT_NEED_REAL_DATA();
  for (const char* name : {"office1.pcd", "table_scene_mug_stereo_textured.pcd"}) {
    const ScanData scan = tests::read_one(tests::real_data() / "formats/pcd" / name);
    EXPECT_EQ(scan.cloud.size() + scan.no_returns, 640U * 480U) << name;
    EXPECT_TRUE(scan.file_pose && scan.cloud.has_colour()) << name;
  }
}

TEST(ScanFormatsData, Ply) {
  ADIT_NEED_REAL_DATA();
  expect_as_in(
      {
          {"issue_2421.ply", read(1)},
          {"mesh.ply", read(4)},
          {"mesh_fixed.ply", read(4)},
          {"no_vertex.ply", refused("the file has no element vertex")},
          {"simple_binary.ply", read(3)},
          {"simple_text.ply", read(3)},
          {"sized_dims.ply", refused("the points have no z")},
          {"text_extradim.ply", read(1)},
          {"unsized_dims.ply", refused("the points have no z")},
      },
      tests::real_data() / "formats/ply");
}

TEST(ScanFormatsData, PtsAndPtx) {
  ADIT_NEED_REAL_DATA();
  expect_as_in(
      {
          {"autzen.pts", read(10)},
          {"bunny_8.pts", refused("bunny_8.pts:10: there are more points than the number above them says")},
          {"site_56_8.pts", read(8)},
          {"test.pts", read(19)},
      },
      tests::real_data() / "formats/pts");
  expect_as_in(
      {
          {"1.2-with-color.ptx", read(1065)},
          {"complex-transform.ptx", read(4)},
          {"multiple-and-transform.ptx", refused("multiple-and-transform.ptx:10: the transform above is not rigid")},
          {"no-color.ptx", read(15)},
      },
      tests::real_data() / "formats/ptx");
}

TEST(ScanFormatsData, TheSameSurveyInLasAndPtx) {
  ADIT_NEED_REAL_DATA();
  const ScanData las = tests::read_one(tests::real_data() / "formats/las/1.2-with-color.las");
  const ScanData ptx = tests::read_one(tests::real_data() / "formats/ptx/1.2-with-color.ptx");
  EXPECT_LT(tests::largest_distance_m(las, ptx), 1e-4);
  EXPECT_EQ(las.cloud.colour, ptx.cloud.colour);
}

TEST(ScanFormatsData, Xyz) {
  ADIT_NEED_REAL_DATA();
  expect_as_in(
      {
          {"TextWriterTest-geojson.json", refused("the ending names no scan format")},
          {"badheader.txt", refused("the column names x, y and z are needed")},
          {"crlf_test.txt", read(10)},
          {"crlf_test2.txt", read(10)},
          {"decimate_file_grid.txt", read(81)},
          {"duplicates-sorted.txt", read(7)},
          {"duplicates-unsorted.txt", read(7)},
          {"file1.txt", read(9)},
          {"file2.txt", read(9)},
          {"file3.txt", read(9)},
          {"largescan.txt", refused("km apart")},
          {"missingheader.txt", read(5)},
          {"numeric_dim.txt", read(5)},
          {"quoted.txt", read(9)},
          {"quoted2.txt", read(9)},
          {"text.txt", refused("the column names x, y and z are needed")},
          {"utm17_1.geojson", refused("the ending names no scan format")},
          {"utm17_1.txt", read(10)},
          {"utm17_2.txt", read(10)},
          {"utm17_3.txt", refused("utm17_3.txt:5: the line has 4 columns, 3 are expected")},
          {"with_edgeofflightline.txt", read(10000)},
      },
      tests::real_data() / "formats/xyz/pdal");
}

TEST(ScanFormatsData, RoomAndCorridor) {
  ADIT_NEED_REAL_DATA();
  expect_as_in({{"room_scan1.pcd", read(112586)}, {"room_scan2.pcd", read(112624)}}, tests::real_data() / "room");
  expect_as_in({{"S1.ply", read(81359)}, {"S2.ply", read(81359)}, {"S3.ply", read(81359)}},
               tests::real_data() / "corridor/scans");
}

}  // namespace
}  // namespace adit::io
