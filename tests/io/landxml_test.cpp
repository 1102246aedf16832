#include "io/landxml.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/foundation/angle.h"
#include "tests/io/error_words.h"
#include "tests/temporary_folder.h"

namespace adit::io {
namespace {

using tests::error_of;
using tests::expect_words;

const std::string metric = R"(<Units><Metric linearUnit="meter" directionUnit="decimal degrees"/></Units>)";
const std::string grade = R"(<Profile><ProfAlign><PVI>0 10</PVI><PVI>1000 20</PVI></ProfAlign></Profile>)";
const std::string first_line =
    R"(<Line length="100"><Start>2000 1000</Start><End>2100 1000</End></Line>)";  // due north
/// A quarter turn to the right, R = 50, behind first_line.
const std::string right_arc = R"(<Curve rot="cw" crvType="arc" radius="50" length="78.539816">
<Start>2100 1000</Start><Center>2100 1050</Center><End>2150 1050</End></Curve>)";

std::string alignment(const std::string& geometry, const std::string& rest = grade, const std::string& name = "axis") {
  return "<Alignment name=\"" + name + "\" staStart=\"0\">\n<CoordGeom>\n" + geometry + "\n</CoordGeom>" + rest +
         "</Alignment>";
}
std::string landxml(const std::string& alignments, const std::string& units = metric) {
  return "<?xml version=\"1.0\"?>\n<LandXML version=\"1.2\">\n" + units + "\n<Alignments>" + alignments +
         "</Alignments>\n</LandXML>\n";
}

class LandXml : public ::testing::Test {
 protected:
  LandXmlFile read(const std::string& text) { return read_landxml(folder_.write("axis.xml", text)); }
  Alignment chosen(const std::string& text, const std::string& name = "") { return choose_alignment(read(text), name); }
  std::string refusal(const std::string& text) {
    return error_of([&] { chosen(text); });
  }
  tests::TemporaryFolder folder_;
};

/// True when one of the findings has the severity and holds the words.
bool has_finding(const Findings& findings, Severity severity, const std::string& words) {
  for (const Finding& f : findings) {
    if (f.severity == severity && (f.subject + ": " + f.words).find(words) != std::string::npos) return true;
  }
  return false;
}

TEST_F(LandXml, PointsAreNorthingEastingAndTangentsComeFromThem) {
  const Alignment axis = chosen(landxml(alignment(first_line + right_arc)));
  EXPECT_NEAR(axis.horizontal().to_m(), 100 + 25 * pi, 1e-9);
  const PlanPoint end = axis.horizontal().at(axis.horizontal().to_m());
  EXPECT_NEAR(end.position.x(), 1050, 1e-9);  // east
  EXPECT_NEAR(end.position.y(), 2150, 1e-9);  // north
  EXPECT_NEAR(end.azimuth_rad, pi / 2, 1e-12);
  EXPECT_NEAR(end.curvature_per_m, 1.0 / 50, 1e-12);
  EXPECT_NEAR(axis.to_site({50, 2, 1}).x(), 1002, 1e-9);
  EXPECT_NEAR(axis.to_site({50, 2, 1}).z(), 11.5, 1e-9);
}

TEST_F(LandXml, AnArcOfMoreThanHalfACircleAndAFullOne) {
  const std::string three_quarters =
      R"(<Curve rot="ccw" length="235.619449"><Start>0 50</Start><Center>0 0</Center><End>-50 0</End></Curve>)";
  // From east of the centre, against the clock: north, west, south.
  const Alignment axis = chosen(landxml(alignment(three_quarters)));
  EXPECT_NEAR(axis.horizontal().to_m(), 75 * pi, 1e-9);
  EXPECT_NEAR(axis.horizontal().at(25 * pi).position.y(), 50, 1e-9);
  const std::string full =
      R"(<Curve rot="cw" length="314.159265"><Start>0 50</Start><Center>0 0</Center><End>0 50</End></Curve>)";
  EXPECT_NEAR(chosen(landxml(alignment(full))).horizontal().to_m(), 100 * pi, 1e-9);
}

/// A clothoid as an element of a file, placed by our own integration, INF in the spelling given.
std::string spiral(double k0, double k1, const std::string& inf, const std::string& type = "clothoid",
                   HorizontalKind kind = HorizontalKind::clothoid) {
  const HorizontalElement e{kind, "", {500, 700}, 0.3, 60, k0, k1};
  const PlanPoint end = element_point(e, 60);
  const Eigen::Vector2d chord = end.position - e.start;
  const Eigen::Vector2d t0(std::sin(0.3), std::cos(0.3)), t1 = end.tangent();
  const Eigen::Vector2d meet =
      e.start + (chord.x() * t1.y() - chord.y() * t1.x()) / (t0.x() * t1.y() - t0.y() * t1.x()) * t0;
  const auto radius = [&](double k) { return k == 0 ? inf : std::to_string(1 / std::abs(k)); };
  char text[500];
  std::snprintf(text, sizeof text,
                "<Spiral length=\"60\" radiusStart=\"%s\" radiusEnd=\"%s\" rot=\"%s\" spiType=\"%s\">"
                "<Start>%.8f %.8f</Start><PI>%.8f %.8f</PI><End>%.8f %.8f</End></Spiral>",
                radius(k0).c_str(), radius(k1).c_str(), k0 + k1 > 0 ? "cw" : "ccw", type.c_str(), e.start.y(),
                e.start.x(), meet.y(), meet.x(), end.position.y(), end.position.x());
  return text;
}

TEST_F(LandXml, ClothoidsBetweenAnyRadiiInBothSensesAndAnySpellingOfInfinity) {
  for (const char* inf : {"INF", "-INF", "inf", "Infinity"}) {
    for (const auto& [k0, k1] : {std::pair{0.0, 0.01}, {0.01, 0.0}, {0.0, -0.01}, {-0.004, -0.02}, {0.02, 0.004}}) {
      const LandXmlFile file = read(landxml(alignment(spiral(k0, k1, inf))));
      ASSERT_TRUE(file.alignments[0].axis.has_value()) << file.alignments[0].refusal->what();
      EXPECT_TRUE(file.alignments[0].findings.empty());
      const HorizontalElement& read_back = file.alignments[0].axis->horizontal().elements()[0];
      EXPECT_NEAR(read_back.azimuth_rad, 0.3, 1e-9);
      EXPECT_NEAR(read_back.start_curvature_per_m, k0, 1e-9);
      EXPECT_NEAR(read_back.end_curvature_per_m, k1, 1e-9);
    }
  }
}

TEST_F(LandXml, ASpiralWithoutPiTakesItsDirectionFromTheChord) {
  std::string text = spiral(0.0, 0.01, "INF");
  const auto from = text.find("<PI>");
  text.erase(from, text.find("</PI>") + 5 - from);
  EXPECT_NEAR(chosen(landxml(alignment(text))).horizontal().elements()[0].azimuth_rad, 0.3, 1e-8);
}

TEST_F(LandXml, OtherSpiralTypesAreRefusedByNameAndLine) {
  expect_words(refusal(landxml(alignment(first_line + "\n" + spiral(0.0, 0.01, "INF", "radioid")))),
               {"axis.xml:7", "Spiral 2", "\"radioid\"", "not supported"});
}

TEST_F(LandXml, EveryTransitionThatIsHonouredIsReadByItsName) {
  for (const auto& [name, kind] : {std::pair{"bloss", HorizontalKind::bloss},
                                   {"revBloss", HorizontalKind::bloss},
                                   {"cosine", HorizontalKind::cosine},
                                   {"Sinusoid", HorizontalKind::sinusoid},
                                   {"biquadratic", HorizontalKind::biquadratic}}) {
    for (const auto& [k0, k1] : {std::pair{0.0, 0.01}, {-0.01, 0.0}, {0.004, 0.02}}) {
      const LandXmlFile file = read(landxml(alignment(spiral(k0, k1, "INF", name, kind))));
      ASSERT_TRUE(file.alignments[0].axis.has_value()) << file.alignments[0].refusal->what();
      EXPECT_TRUE(file.alignments[0].findings.empty()) << name << file.alignments[0].findings[0].words;
      EXPECT_EQ(file.alignments[0].axis->horizontal().elements()[0].kind, kind);
      EXPECT_NEAR(file.alignments[0].axis->horizontal().elements()[0].azimuth_rad, 0.3, 1e-9);
    }
    const LandXmlFile other = read(landxml(alignment(spiral(0.0, 0.02, "INF", "clothoid", kind))));
    EXPECT_FALSE(other.alignments[0].axis && other.alignments[0].findings.empty()) << name;  // another curve: it shows
  }
}

TEST_F(LandXml, ACubicParabolaByWhicheverRadiusItsWriterMeant) {
  // x = 80, y = x^3 / 96000: y'' = 1/200 at the end, the true radius there is 200 * 1.04^1.5.
  const char* format =
      "<Spiral length=\"80.318\" radiusStart=\"INF\" radiusEnd=\"%.4f\" rot=\"cw\" spiType=\"cubic\">"
      "<Start>0 0</Start><PI>%.9f 0</PI><End>80 %.9f</End></Spiral>";
  const double y = 80.0 * 80.0 * 80.0 / 96000.0;
  char text[400];
  for (const double radius : {200.0, 200.0 * std::pow(1.04, 1.5), 199.6}) {
    std::snprintf(text, sizeof text, format, radius, 80.0 - y / 0.2, y);
    const Alignment axis = chosen(landxml(alignment(text)));
    const HorizontalAlignment& plan = axis.horizontal();
    EXPECT_NEAR(plan.to_m(), 80.31825, 0.00001) << radius;
    EXPECT_NEAR(plan.at(plan.to_m()).position.x(), y, 1e-6);
    EXPECT_NEAR(plan.at(plan.to_m()).position.y(), 80.0, 1e-6);
    EXPECT_NEAR(plan.at(plan.to_m()).azimuth_rad, std::atan(0.2), 1e-7);
  }
  std::snprintf(text, sizeof text, format, 260.0, 80.0 - y / 0.2, y);
  expect_words(refusal(landxml(alignment(text))), {"Spiral 1", "cubic parabola"});
}

TEST_F(LandXml, GeometryThatIsNotReadIsRefusedTheRestIsListed) {
  expect_words(refusal(landxml(alignment(first_line + "<IrregularLine/>"))), {"IrregularLine 2", "axis.xml:6"});
  expect_words(refusal(landxml(alignment("<Chain/>"))), {"Chain 1"});
  const std::string unsymmetrical =
      "<Profile><ProfAlign><PVI>0 10</PVI>\n<UnsymParaCurve lengthIn=\"5\" lengthOut=\"9\">20 "
      "11</UnsymParaCurve><PVI>50 10</PVI></ProfAlign></Profile>";
  const LandXmlFile file = read(landxml(alignment(first_line, unsymmetrical)));
  ASSERT_TRUE(file.alignments[0].axis.has_value());  // the plan stays usable
  EXPECT_TRUE(file.alignments[0].axis->vertical().empty());
  expect_words(error_of([&] { choose_alignment(file, ""); }), {"axis.xml:8", "UnsymParaCurve", "chainage 20"});

  const LandXmlFile listed = read(landxml(alignment(first_line, grade + "<Cant/><StaEquation/><StaEquation/>")));
  EXPECT_TRUE(has_finding(listed.alignments[0].findings, Severity::note, "not honoured: Cant (1), StaEquation (2)"));
}

TEST_F(LandXml, OneBadAlignmentLeavesTheOthersReadable) {
  const std::string text = landxml(alignment(first_line, grade, "good") + alignment("<Chain/>", grade, "bad"));
  EXPECT_EQ(chosen(text, "good").name(), "good");
  expect_words(error_of([&] { chosen(text, "bad"); }), {"Chain 1 of alignment bad"});
  expect_words(error_of([&] { chosen(text); }), {"several alignments", "\"good\", \"bad\""});
  expect_words(error_of([&] { chosen(text, "other"); }), {"no alignment \"other\"", "\"good\", \"bad\""});
}

TEST_F(LandXml, WithoutGradeLineOnlyThePlanIsOffered) {
  const LandXmlFile file = read(landxml(alignment(first_line, "")));
  EXPECT_NEAR(file.alignments[0].axis->horizontal().to_m(), 100, 1e-12);
  expect_words(error_of([&] { choose_alignment(file, "axis"); }), {"no grade line"});
}

TEST_F(LandXml, SwappedCoordinatesAreRefused) {
  const std::string swapped_arc = R"(<Curve rot="cw" length="78.539816">
<Start>1000 2100</Start><Center>1050 2100</Center><End>1050 2150</End></Curve>)";
  expect_words(refusal(landxml(alignment(swapped_arc))), {"Curve 1", "northing easting"});
  const std::string arc_without_length =
      R"(<Curve rot="cw"><Start>1000 2100</Start><Center>1050 2100</Center><End>1050 2150</End></Curve>)";
  const std::string swapped_line = R"(<Line><Start>1000 2000</Start><End>1000 2100</End></Line>)";
  expect_words(refusal(landxml(alignment(swapped_line + arc_without_length))), {"turns back", "northing easting"});
  const std::string lines_alone = R"(<Line dir="30"><Start>0 0</Start><End>50 86.60254</End></Line>)";
  const LandXmlFile file = read(landxml(alignment(lines_alone)));
  EXPECT_TRUE(has_finding(file.alignments[0].findings, Severity::warning, "easting northing"));
}

TEST_F(LandXml, DirectionsMayCountEitherWayAndAreOnlyCompared) {
  for (const char* dir : {"30", "-30", "330"}) {
    const std::string line = std::string("<Line dir=\"") + dir + "\"><Start>0 0</Start><End>86.60254 50</End></Line>";
    EXPECT_TRUE(read(landxml(alignment(line))).alignments[0].findings.empty()) << dir;
  }
  const std::string wrong = R"(<Line dir="77"><Start>0 0</Start><End>86.60254 50</End></Line>)";
  EXPECT_TRUE(
      has_finding(read(landxml(alignment(wrong))).alignments[0].findings, Severity::note, "first Line 1, differ"));
}

TEST_F(LandXml, GapsAreReportedInMillimetresAndLargeOnesRefused) {
  const auto line_from = [](const char* northing) {
    return std::string("<Line><Start>") + northing + " 1000</Start><End>2200 1000</End></Line>";
  };
  EXPECT_TRUE(read(landxml(alignment(first_line + line_from("2100.0008")))).alignments[0].findings.empty());
  EXPECT_TRUE(has_finding(read(landxml(alignment(first_line + line_from("2100.0023")))).alignments[0].findings,
                          Severity::warning,
                          "alignment axis, Line 1: its computed end lies 2.3 mm from the Start of Line 2"));
  expect_words(refusal(landxml(alignment(first_line + line_from("2100.06")))), {"Line 1", "0.06 m"});
}

TEST_F(LandXml, KinksAndStatedLengthsAndRadiiAreReported) {
  const std::string kinked =
      first_line + R"(<Line length="100.02"><Start>2100 1000</Start><End>2200 1000.1</End></Line>)";
  const Findings findings = read(landxml(alignment(kinked))).alignments[0].findings;
  EXPECT_TRUE(has_finding(findings, Severity::warning,
                          "Line 2: its direction differs from the end of Line 1 by 0.0573 degrees"));
  EXPECT_TRUE(has_finding(findings, Severity::warning, "states a length of 100.02 m, its points give 100"));
  std::string arc = right_arc;
  arc.replace(arc.find("radius=\"50\""), 11, "radius=\"51\"");
  EXPECT_TRUE(has_finding(read(landxml(alignment(arc))).alignments[0].findings, Severity::warning, "radius of 51 m"));
  std::string whole = alignment(first_line);
  whole.replace(whole.find("staStart"), 0, "length=\"99\" ");
  EXPECT_TRUE(has_finding(read(landxml(whole)).alignments[0].findings, Severity::warning,
                          "states a length of 99 m, its elements sum to 100 m"));
}

TEST_F(LandXml, ElementsWithoutLengthAreLeftOut) {
  const std::string nothing =
      R"(<Curve rot="cw" length="0"><Start>2100 1000</Start><Center>2100 1050</Center><End>2100 1000</End></Curve>)";
  const LandXmlFile file = read(landxml(alignment(first_line + nothing + right_arc)));
  EXPECT_EQ(file.alignments[0].axis->horizontal().elements().size(), 2U);
  EXPECT_TRUE(has_finding(file.alignments[0].findings, Severity::note, "Curve 2: has no length"));
}

TEST_F(LandXml, FeetAndSurveyFeetBecomeMetres) {
  const auto units = [](const std::string& unit) { return "<Units><Imperial linearUnit=\"" + unit + "\"/></Units>"; };
  EXPECT_NEAR(chosen(landxml(alignment(first_line), units("foot"))).horizontal().to_m(), 30.48, 1e-9);
  EXPECT_NEAR(chosen(landxml(alignment(first_line), units("USSurveyFoot"))).horizontal().to_m(), 100 * 1200.0 / 3937,
              1e-9);
  EXPECT_NEAR(chosen(landxml(alignment(first_line), units("foot"))).vertical().at(0).elevation_m, 3.048, 1e-9);
  expect_words(refusal(landxml(alignment(first_line), units("cubit"))), {"axis.xml:3", "\"cubit\""});
  expect_words(refusal(landxml(alignment(first_line), "")), {"units"});
}

TEST_F(LandXml, GradeLinesWithParabolasAndCircles) {
  const std::string curved = R"(<Profile><ProfAlign><PVI>0 10</PVI><ParaCurve length="20">30 11</ParaCurve>
<CircCurve length="9.9" radius="-300">70 10</CircCurve><PVI>100 10.5</PVI></ProfAlign></Profile>)";
  const LandXmlFile file = read(landxml(alignment(first_line, curved)));
  const VerticalAlignment& line = file.alignments[0].axis->vertical();
  EXPECT_NEAR(line.at(30).elevation_m, 11 + (-0.025 - 1.0 / 30) * 20 / 8, 1e-12);
  EXPECT_EQ(line.points()[2].radius_m, 300);
  EXPECT_TRUE(has_finding(file.alignments[0].findings, Severity::warning,
                          "vertical curve at chainage 70: the file states a length of 9.9 m"));
  const std::string overlapping =
      R"(<Profile><ProfAlign><PVI>0 10</PVI><ParaCurve length="70">30 11</ParaCurve><PVI>100 10.5</PVI></ProfAlign></Profile>)";
  expect_words(refusal(landxml(alignment(first_line, overlapping))), {"alignment axis", "overlap"});
}

TEST_F(LandXml, PrefixesAndOtherNamespacesDoNotMatter) {
  std::string text = landxml(alignment(first_line));
  for (const char* tag : {"Alignment ", "Line ", "Start>", "PVI>"}) {
    for (std::size_t at = 0; (at = text.find(tag, at)) != std::string::npos; at += std::string(tag).size() + 3) {
      text.insert(at, "im:");
    }
  }
  for (const char* tag : {"Alignment>", "Line>"}) {
    for (std::size_t at = 0; (at = text.find(std::string("</") + tag, at)) != std::string::npos; at += 8)
      text.insert(at + 2, "im:");
  }
  EXPECT_NEAR(chosen(text).horizontal().to_m(), 100, 1e-12);
}

TEST_F(LandXml, TextWhereANumberBelongsIsRefusedWithLineAndColumn) {
  const std::string bad = "<Line>\n<Start>2000 10o0</Start><End>2100 1000</End></Line>";
  expect_words(refusal(landxml(alignment(bad))), {"axis.xml:7:13", "\"10o0\"", "a number is needed"});
  expect_words(refusal(landxml(alignment("<Line><Start>2000</Start><End>2100 1000</End></Line>"))),
               {"<Start> holds 1 numbers"});
  expect_words(refusal(landxml(alignment("<Line><End>2100 1000</End></Line>"))), {"lacks its <Start>"});
  std::string no_radius = spiral(0, 0.01, "nan");
  expect_words(refusal(landxml(alignment(no_radius))), {"radiusStart", "\"nan\""});
}

TEST_F(LandXml, FilesThatAreNone) {
  expect_words(error_of([&] { read_landxml(folder_ / "absent.xml"); }), {"absent.xml"});
  expect_words(error_of([&] { read("<LandXML>\n<Units>"); }), {"axis.xml:2", "well-formed"});
  expect_words(error_of([&] { read("<svg/>"); }), {"no LandXML", "<svg>"});
  expect_words(error_of([&] { read(""); }), {"axis.xml"});
  expect_words(refusal(landxml("")), {"holds no alignment"});
}

TEST_F(LandXml, ANameInLatin1BecomesUtf8) {
  EXPECT_EQ(read(landxml(alignment(first_line, grade, "T\xFCr"))).alignments[0].name, "T\xC3\xBCr");
}

TEST_F(LandXml, WhatIsWrittenIsReadBackToAMicrometre) {
  std::vector<HorizontalElement> elements;
  double k = 0.0;
  PlanPoint at{{2683026.06027, 1251466.93025}, 5.4, 0};
  constexpr HorizontalKind kinds[] = {HorizontalKind::bloss, HorizontalKind::cosine, HorizontalKind::sinusoid,
                                      HorizontalKind::biquadratic, HorizontalKind::clothoid};
  for (const double next : {0.0, 1 / 300.0, 1 / 300.0, 1 / 120.0, 0.0, -1 / 80.0, -1 / 80.0, 0.0}) {
    const HorizontalElement e{kinds[elements.size() % 5], "", at.position, at.azimuth_rad, 47.25, k, next};
    at = element_point(e, e.length_m);
    elements.push_back(e);
    k = next;
  }
  elements.push_back({HorizontalKind::cubic_parabola, "", at.position, at.azimuth_rad, 47.25, 0.0, 1 / 200.0});
  const VerticalAlignment vertical({{1500, 400, VerticalCurveKind::none, 0, 0},
                                    {1600, 404, VerticalCurveKind::parabola, 60, 0},
                                    {1700, 402, VerticalCurveKind::circle, 0, 900},
                                    {1900, 405, VerticalCurveKind::none, 0, 0}});
  const Alignment axis("tube <1> & \"2\"", HorizontalAlignment(elements, 1500.5), vertical);
  const LandXmlFile file = read(landxml_text(axis));
  ASSERT_EQ(file.alignments.size(), 1U);
  EXPECT_TRUE(file.alignments[0].findings.empty());
  const Alignment back = choose_alignment(file, axis.name());
  EXPECT_NEAR(back.from_m(), axis.from_m(), 1e-9);
  EXPECT_NEAR(back.to_m(), axis.to_m(), 1e-6);
  for (double s = axis.from_m(); s < axis.to_m() - 1e-5; s += 3.1) {
    EXPECT_LT((back.to_site({s, 5, 2}) - axis.to_site({s, 5, 2})).norm(), 1e-6) << s;
  }
  const Alignment turning("a", HorizontalAlignment({{HorizontalKind::clothoid, "S", {0, 0}, 0, 50, -0.01, 0.01}}, 0),
                          {});
  expect_words(error_of([&] { landxml_text(turning); }), {"turning sense"});
}

}  // namespace
}  // namespace adit::io
