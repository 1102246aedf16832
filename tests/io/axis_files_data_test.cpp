// Axes of others that are no LandXML, against what the same files say elsewhere.
#include <gtest/gtest.h>

#include <cmath>

#include "io/kof.h"
#include "io/read_axis.h"
#include "tests/real_data.h"

namespace adit::io {
namespace {

AxisFile read(const std::string& file) {
  return read_axis(tests::real_data() / "alignments" / "bsi_infra_unit_test" / file);
}

void expect_same_plan(const Alignment& a, const Alignment& b, double within_m) {
  const double from = std::max(a.horizontal().from_m(), b.horizontal().from_m());
  const double to = std::min(a.horizontal().to_m(), b.horizontal().to_m());
  ASSERT_GT(to, from + 100);
  double worst = 0.0;
  for (double s = from; s < to; s += 1.37)
    worst = std::max(worst, (a.horizontal().at(s).position - b.horizontal().at(s).position).norm());
  EXPECT_LT(worst, within_m);
}

TEST(IfcAxisData, TheSameAxisAsItsLandXml) {
  ADIT_NEED_REAL_DATA();
  const Alignment one = *read("Alignment-Aplitop-1/UT-Alignment-Aplitop-1.IFC").axes[0].axis;
  const Alignment one_xml = *read("Alignment-Aplitop-1/UT-Alignment-Aplitop-1.xml").axes[0].axis;
  expect_same_plan(one, one_xml, 1e-5);
  for (double s = 0; s < 507; s += 3.1)
    EXPECT_NEAR(one.vertical().at(s).elevation_m, one_xml.vertical().at(s).elevation_m, 1e-4);
  expect_same_plan(*read("Alignment-Aplitop-2/Alignment-Aplitop-2.IFC").axes[0].axis,
                   *read("Alignment-Aplitop-2/Alignment-Aplitop-2.XML").axes[0].axis, 1e-3);
  const Alignment feet = *read("Alignment-INDOT/PR_Twin_Branch_section_alignment.ifc").axes[0].axis;
  const Alignment feet_xml = *read("Alignment-INDOT/PR_Twin_Branch_section_alignment.xml").axes[0].axis;
  expect_same_plan(feet, feet_xml, 1e-5);
  for (double s = feet_xml.from_m(); s < feet_xml.to_m(); s += 5.0)
    EXPECT_NEAR(feet.vertical().at(s).elevation_m, feet_xml.vertical().at(s).elevation_m, 1e-4);
}

TEST(IfcAxisData, EveryFileIsReadWithoutDoubt) {
  ADIT_NEED_REAL_DATA();
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(tests::real_data() / "alignments")) {
    std::string ending = entry.path().extension().string();
    if (ending != ".ifc" && ending != ".IFC") continue;
    const AxisFile file = read_axis(entry.path());
    ASSERT_EQ(file.axes.size(), 1U) << entry.path();
    EXPECT_TRUE(file.axes[0].axis.has_value()) << entry.path();
    for (const Finding& finding : file.axes[0].findings)
      EXPECT_EQ(finding.severity, Severity::note) << entry.path() << finding.words;
    ++files;
  }
  EXPECT_EQ(files, 14);
}

TEST(KofData, EveryFileIsRead) {
  ADIT_NEED_REAL_DATA();
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(tests::real_data() / "control" / "kof_ngi")) {
    if (entry.path().extension() != ".kof") continue;
    const KofFile kof = read_kof(entry.path());
    for (const KofPoint& point : kof.points) EXPECT_GT(point.plan.y(), point.plan.x()) << entry.path() << point.name;
    ++files;
  }
  EXPECT_EQ(files, 12);
}

TEST(PointAxisData, APublishedAxisOfPointsEveryHalfMetre) {
  ADIT_NEED_REAL_DATA();
  const AxisFile file = read_axis(tests::real_data() / "rings" / "wriggle_metro_bangkok" / "derived_axis.csv");
  const Alignment axis = choose_alignment(file, "");
  EXPECT_NEAR(axis.from_m(), 9842.0, 1e-9);
  EXPECT_NEAR(axis.to_m(), 13454.297, 1e-9);
  EXPECT_EQ(axis.vertical().points().size(), 7226U);
  const Eigen::Vector3d at = axis.to_site({9843.5, 0.0, 0.0});
  EXPECT_NEAR(at.x(), 671700.28427878721, 1e-6);
  EXPECT_NEAR(at.y(), 1507392.8387558025, 1e-6);
}

}  // namespace
}  // namespace adit::io
