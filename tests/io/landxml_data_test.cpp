// LandXML of others: what each file gives, to the millimetre.
#include <gtest/gtest.h>

#include <map>

#include "io/landxml.h"
#include "tests/io/error_words.h"
#include "tests/real_data.h"

namespace adit::io {
namespace {

using tests::error_of;
using tests::expect_words;

AxisFile read(const std::string& file) {
  return read_landxml(tests::real_data() / file);
}

std::size_t count(const Findings& findings, Severity severity) {
  std::size_t n = 0;
  for (const Finding& f : findings) n += f.severity == severity ? 1 : 0;
  return n;
}

/// Every computed end meets the next start, and the tangents agree: over all elements of an axis.
void expect_joined(const HorizontalAlignment& plan, double gap_m, double kink_rad) {
  for (std::size_t i = 0; i + 1 < plan.elements().size(); ++i) {
    const HorizontalElement& e = plan.elements()[i];
    const PlanPoint end = element_point(e, e.length_m);
    const PlanPoint next = element_point(plan.elements()[i + 1], 0.0);
    EXPECT_LT((end.position - next.position).norm(), gap_m) << e.name;
    EXPECT_LT((end.tangent() - next.tangent()).norm(), kink_rad) << e.name;
  }
}

TEST(RailwayAxisData, ElevenAlignmentsWholeAndJoined) {
  ADIT_NEED_REAL_DATA();
  const AxisFile file = read("axis-sbb.xml");
  ASSERT_EQ(file.axes.size(), 11U);
  std::map<HorizontalKind, int> kinds;
  std::size_t circles = 0;
  double length = 0.0;
  for (const AxisOfFile& alignment : file.axes) {
    ASSERT_TRUE(alignment.axis.has_value()) << alignment.name;
    const Alignment axis = choose_alignment(file, alignment.name);
    for (const auto& e : axis.horizontal().elements()) ++kinds[e.kind];
    for (const auto& p : axis.vertical().points()) circles += p.curve == VerticalCurveKind::circle ? 1 : 0;
    length += axis.horizontal().to_m() - axis.horizontal().from_m();
    expect_joined(axis.horizontal(), 1e-3, alignment.name == "A50115A" ? 4e-4 : 2e-4);
  }
  EXPECT_EQ(kinds[HorizontalKind::clothoid], 118);
  EXPECT_EQ(kinds[HorizontalKind::arc], 102);  // of 103: one has no length
  EXPECT_EQ(kinds[HorizontalKind::line], 65);
  EXPECT_EQ(circles, 237U);
  EXPECT_NEAR(length, 33886.0, 1.0);
}

TEST(RailwayAxisData, WhatIsWrongWithTheFileIsReported) {
  ADIT_NEED_REAL_DATA();
  const AxisFile file = read("axis-sbb.xml");
  std::map<std::string, std::string> warnings;
  for (const auto& alignment : file.axes) {
    for (const Finding& f : alignment.findings) {
      if (f.severity != Severity::note) warnings[f.subject] += f.words;
    }
  }
  ASSERT_EQ(warnings.size(), 2U);  // nothing else: all lengths, gaps and vertical curves agree
  expect_words(warnings["alignment A50034A"], {"14028.8338 m", "13946.345 m"});
  expect_words(warnings["alignment A50115A, Curve 2"], {"0.0213 degrees"});
  expect_words(error_of([&] { choose_alignment(file, ""); }), {"several alignments", "A50034A", "A50121A"});
}

TEST(RailwayAxisData, FeetOfPlacesBesideTheAxis) {
  ADIT_NEED_REAL_DATA();
  const Alignment axis = choose_alignment(read("axis-sbb.xml"), "A50034A");
  for (double s = axis.from_m() + 0.25; s < axis.to_m(); s += 7.75) {
    const auto back = axis.to_tunnel(axis.to_site({s, 3.5, 2.0}), s + 2.0);
    ASSERT_TRUE(back.has_value()) << s;
    EXPECT_NEAR(back->s_m, s, 1.1e-3);  // the file's gaps: up to 0.77 mm
    EXPECT_NEAR(back->x_m, 3.5, 1.1e-3);
    EXPECT_NEAR(back->z_m, 2.0, 1e-4);
  }
}

TEST(CorridorAxisData, IsReadWithoutAFinding) {
  ADIT_NEED_REAL_DATA();
  const AxisFile file = read("corridor/axis.xml");
  EXPECT_TRUE(file.findings.empty() && file.axes.at(0).findings.empty());
  const Alignment axis = choose_alignment(file, "");
  EXPECT_LT((axis.to_site({3, 0, 0}) - Eigen::Vector3d(3, 0.39, -0.95)).norm(), 1e-12);
}

struct Expected {
  const char* file;
  const char* alignment;
  double from_m;
  double to_m;
  std::size_t elements;
  std::size_t warnings;
  const char* refusal;  ///< when it is chosen; nullptr when it is given
};

TEST(OtherAxesData, AreReadOrRefusedWithTheirReason) {
  ADIT_NEED_REAL_DATA();
  const std::string bsi = "alignments/bsi_infra_unit_test/", crosssects = "alignments/landxml_crosssects/",
                    fi = "alignments/inframodel_fi/";
  const std::pair<std::string, Expected> table[] = {
      {bsi + "Alignment-Aplitop-1/", {"UT-Alignment-Aplitop-1.xml", "Horizontal", 0, 507.0668, 15, 0, nullptr}},
      {bsi + "Alignment-Aplitop-2/", {"Alignment-Aplitop-2.XML", "Alignment2", 0, 5651.0825, 9, 1, "no grade line"}},
      {bsi + "Alignment-INDOT/",
       {"PR_Twin_Branch_section_alignment.xml", "PR_Twin_Branch_section", 641.2153, 1493.6448, 3, 0, nullptr}},
      {bsi + "MCON-1/", {"TOI-M14334-0000A.XML", "Sammalniementie_u", 0, 616.4425, 7, 0, nullptr}},
      {bsi + "MCON-1/", {"TOI-Y3-0000A.XML", "Tie2 oikea", 0, 37.0431, 1, 0, nullptr}},
      {fi, {"M3_RS-CL.tg.xml", "M3_RS - CL", 0, 1266.2462, 15, 0, nullptr}},
      {fi, {"Y10_RS-CL.tg.xml", "Y10_RS - CL", 0, 37.3399, 3, 0, nullptr}},
      {fi, {"Y11_RS-CL.tg.xml", "Y11_RS - CL", 0, 48.6019, 5, 0, nullptr}},
      {crosssects, {"GSG_corridors.xml", "Basic_Road", 0, 505.5493, 5, 0, nullptr}},
      {crosssects, {"landxml_road_cl_sample.xml", "Main Road CL", 0, 960.0, 5, 0, "no grade line"}},
      {crosssects, {"landxml_road_sample.xml", "Main Road", 0, 748.4357, 8, 3, nullptr}},
      {crosssects, {"j_landxml_sample.xml", "○○路線", -90, 995.9462, 18, 1, nullptr}},
      {crosssects, {"MiddleCalmarRoad.xml", "TROUT RUN ROAD", 0, 281.6051, 6, 5, "overlap by 13.606 m"}},
      {crosssects, {"MiddleCalmarRoad.xml", "MIDDLE CALMAR ROAD", 0, 809.9012, 10, 9, "no grade line"}},
  };
  for (const auto& [folder, expected] : table) {
    SCOPED_TRACE(expected.file);
    const AxisFile file = read(folder + expected.file);
    const AxisOfFile* found = nullptr;
    for (const auto& a : file.axes) found = a.name == expected.alignment ? &a : found;
    ASSERT_NE(found, nullptr);
    ASSERT_TRUE(found->axis.has_value()) << found->refusal->what();
    const HorizontalAlignment& plan = found->axis->horizontal();
    EXPECT_NEAR(plan.from_m(), expected.from_m, 1e-4);
    EXPECT_NEAR(plan.to_m(), expected.to_m, 1e-4);
    EXPECT_EQ(plan.elements().size(), expected.elements);
    EXPECT_EQ(count(found->findings, Severity::warning), expected.warnings);
    expect_joined(plan, 1e-3, expected.warnings > 1 ? 0.2 : 2e-4);
    const std::string refusal = error_of([&] { choose_alignment(file, expected.alignment); });
    if (expected.refusal == nullptr)
      EXPECT_EQ(refusal, "");
    else
      expect_words(refusal, {expected.refusal});
  }
}

TEST(OtherAxesData, FilesWithoutPlanGeometrySaySo) {
  ADIT_NEED_REAL_DATA();
  const AxisFile points_only = read("alignments/landxml_crosssects/MntnRoad.xml");
  expect_words(error_of([&] { choose_alignment(points_only, ""); }), {"MntnRoad.xml:12", "AlignPIs"});
  const AxisFile surfaces = read("alignments/inframodel_fi/M3_Rockbed_survey.mm.xml");
  EXPECT_TRUE(surfaces.axes.empty());
  expect_words(surfaces.findings.at(0).words, {"Surfaces (1)"});
  expect_words(error_of([&] { choose_alignment(surfaces, ""); }), {"no alignment"});
}

}  // namespace
}  // namespace adit::io
