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
  AxisFile read(const std::string& text) { return read_landxml(folder_.write("axis.xml", text)); }
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
      const AxisFile file = read(landxml(alignment(spiral(k0, k1, inf))));
      ASSERT_TRUE(file.axes[0].axis.has_value()) << file.axes[0].refusal->what();
      EXPECT_TRUE(file.axes[0].findings.empty());
      const HorizontalElement& read_back = file.axes[0].axis->horizontal().elements()[0];
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
      const AxisFile file = read(landxml(alignment(spiral(k0, k1, "INF", name, kind))));
      ASSERT_TRUE(file.axes[0].axis.has_value()) << file.axes[0].refusal->what();
      EXPECT_TRUE(file.axes[0].findings.empty()) << name << file.axes[0].findings[0].words;
      EXPECT_EQ(file.axes[0].axis->horizontal().elements()[0].kind, kind);
      EXPECT_NEAR(file.axes[0].axis->horizontal().elements()[0].azimuth_rad, 0.3, 1e-9);
    }
    const AxisFile other = read(landxml(alignment(spiral(0.0, 0.02, "INF", "clothoid", kind))));
    EXPECT_FALSE(other.axes[0].axis && other.axes[0].findings.empty()) << name;  // another curve: it shows
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
  expect_words(refusal(landxml(alignment(first_line + "<Bezier/>"))), {"Bezier 2", "axis.xml:6", "not supported"});
  const std::string other =
      "<Profile><ProfAlign><PVI>0 10</PVI>\n<SplineCurve>20 11</SplineCurve><PVI>50 10</PVI></ProfAlign></Profile>";
  const AxisFile file = read(landxml(alignment(first_line, other)));
  ASSERT_TRUE(file.axes[0].axis.has_value());  // the plan stays usable
  EXPECT_TRUE(file.axes[0].axis->vertical().empty());
  expect_words(error_of([&] { choose_alignment(file, ""); }), {"axis.xml:8", "SplineCurve", "chainage 20"});

  const AxisFile listed = read(landxml(alignment(first_line, grade + "<AlignPIs/><CrossSects/><CrossSects/>")));
  EXPECT_TRUE(has_finding(listed.axes[0].findings, Severity::note, "not honoured: AlignPIs (1), CrossSects (2)"));
}

TEST_F(LandXml, UnsymmetricalParabolas) {
  const std::string unsymmetrical =
      "<Profile><ProfAlign><PVI>0 10</PVI><UnsymParaCurve lengthIn=\"30\" lengthOut=\"20\">50 12</UnsymParaCurve>"
      "<PVI>100 10</PVI></ProfAlign></Profile>";
  const Alignment axis = chosen(landxml(alignment(first_line, unsymmetrical)));
  EXPECT_NEAR(axis.vertical().at(50).elevation_m, 12 - 0.08 * 30 * 20 / 100, 1e-12);
  EXPECT_NEAR(axis.vertical().at(20).grade, 0.04, 1e-12);
}

TEST_F(LandXml, IrregularLinesAndChainsAreStraightPieces) {
  const std::string irregular =
      "<IrregularLine><Start>2100 1000</Start><End>2150 1010</End>"
      "<PntList2D>2100 1000 2130 1002 2150 1010</PntList2D></IrregularLine>";
  const AxisFile file = read(landxml(alignment(first_line + irregular)));
  const HorizontalAlignment& plan = file.axes[0].axis->horizontal();
  ASSERT_EQ(plan.elements().size(), 3U);
  EXPECT_NEAR(plan.to_m(), 100 + std::hypot(30, 2) + std::hypot(20, 8), 1e-9);
  EXPECT_TRUE(has_finding(file.axes[0].findings, Severity::warning, "2 straight pieces"));
  const std::string points =
      "<CgPoints><CgPoint name=\"A\">2100 1000 5</CgPoint><CgPoint name=\"B 2\">9 9</CgPoint>"
      "<CgPoint name=\"B\">2150 1000</CgPoint></CgPoints>";
  std::string chained = landxml(alignment(first_line + "<Chain>A B</Chain>"));
  chained.insert(chained.find("\n<Alignments>"), points);
  EXPECT_NEAR(chosen(chained).horizontal().to_m(), 150, 1e-9);
  std::string referenced =
      landxml(alignment("<Line><Start>2000 1000</Start><End pntRef=\"A\"/></Line><Line><Start pntRef=\"A\"/><End>2150 "
                        "1000</End></Line>"));
  referenced.insert(referenced.find("\n<Alignments>"), points);
  EXPECT_NEAR(chosen(referenced).horizontal().to_m(), 150, 1e-9);

  expect_words(refusal(landxml(alignment(first_line + "<Chain>A B</Chain>"))), {"Chain 2", "no CgPoint \"A\""});
  expect_words(refusal(landxml(alignment("<Chain/>"))), {"Chain 1", "fewer than two"});
  expect_words(refusal(landxml(alignment(first_line + "<IrregularLine/>"))), {"IrregularLine 2", "axis.xml:6"});
  const std::string short_list =
      "<IrregularLine><Start>2100 1000</Start><End>2150 1010</End><PntList2D>2100 1000 2130 1002</PntList2D>"
      "</IrregularLine>";
  expect_words(refusal(landxml(alignment(first_line + short_list))), {"does not meet its End"});
}

TEST_F(LandXml, StationEquationsGiveDisplayedStations) {
  const std::string equations =
      "<StaEquation staBack=\"30\" staInternal=\"30\" staAhead=\"50\"/>"
      "<StaEquation staInternal=\"60\" staAhead=\"70\"/>";
  const AxisFile file = read(landxml(alignment(first_line, grade + equations)));
  const Alignment axis = choose_alignment(file, "");
  EXPECT_DOUBLE_EQ(axis.stations().displayed_m(20), 20);
  EXPECT_DOUBLE_EQ(axis.stations().displayed_m(40), 60);
  EXPECT_DOUBLE_EQ(axis.stations().displayed_m(61), 71);
  EXPECT_TRUE(has_finding(file.axes[0].findings, Severity::note, "stations 30 to 50 do not occur"));
  EXPECT_TRUE(has_finding(file.axes[0].findings, Severity::warning, "goes back: stations 70 to 80 occur twice"));
  const std::string off = "<StaEquation staBack=\"31\" staInternal=\"30\" staAhead=\"50\"/>";
  EXPECT_TRUE(has_finding(read(landxml(alignment(first_line, grade + off))).axes[0].findings, Severity::warning,
                          "states a station back of 31"));
  const std::string back =
      "<StaEquation staInternal=\"60\" staAhead=\"50\"/><StaEquation staInternal=\"30\" staAhead=\"70\"/>";
  expect_words(refusal(landxml(alignment(first_line, grade + back))), {"at chainage 30 goes back"});
  expect_words(refusal(landxml(alignment(first_line, grade + "<StaEquation/>"))), {"staInternal"});
}

TEST_F(LandXml, CantAboutEveryPivotAndSuperelevation) {
  const auto cant = [](const std::string& pivot, const std::string& more = "") {
    return grade + "<Cant name=\"c\" gauge=\"1.5\" rotationPoint=\"" + pivot +
           "\"><CantStation station=\"0\" appliedCant=\"0\" curvature=\"cw\"/>"
           "<CantStation station=\"50\" appliedCant=\"90\" curvature=\"cw\"" +
           more + "/></Cant>";
  };
  for (const auto& [pivot, rise] : {std::pair{"center", 0.0},
                                    {"insideRail", 0.045},
                                    {"outsideRail", -0.045},
                                    {"leftRail", -0.045},
                                    {"rightRail", 0.045}}) {
    const CantAt at = chosen(landxml(alignment(first_line, cant(pivot)))).cant().at(50);
    EXPECT_NEAR(at.cant_m, 0.09, 1e-12) << pivot;
    EXPECT_NEAR(at.rise_m, rise, 1e-12) << pivot;
  }
  EXPECT_NEAR(chosen(landxml(alignment(first_line, cant("center", " adverse=\"true\"")))).cant().at(50).cant_m, -0.09,
              1e-12);
  std::string in_metres = cant("center");
  in_metres.replace(in_metres.find("\"90\""), 4, "\"0.09\"");
  EXPECT_TRUE(read(landxml(alignment(first_line, in_metres))).axes[0].cant_refusal.has_value());
  const AxisFile unknown = read(landxml(alignment(first_line, cant("middle"))));
  EXPECT_TRUE(unknown.axes[0].cant_refusal.has_value());
  EXPECT_TRUE(has_finding(unknown.axes[0].findings, Severity::warning, "its cant is not honoured"));

  const std::string super =
      "<Superelevation><BeginRunoutSta>95</BeginRunoutSta><BeginRunoffSta>100</BeginRunoffSta><FullSuperSta>120"
      "</FullSuperSta><FullSuperelev>6</FullSuperelev><RunoffSta>150</RunoffSta><StartofRunoutSta>170"
      "</StartofRunoutSta></Superelevation>";
  const Alignment road = chosen(landxml(alignment(first_line + right_arc, grade + super)));
  EXPECT_NEAR(road.cant().at(110).cant_m, 0.03, 1e-12);
  EXPECT_NEAR(road.cant().at(130).turn_rad, std::asin(0.06), 1e-12);  // down to the right, into the curve
  EXPECT_NEAR(road.cant().at(130).rise_m, 0.0, 1e-12);
  const AxisFile straight = read(landxml(alignment(first_line, grade + super)));
  EXPECT_TRUE(straight.axes[0].cant_refusal.has_value());
}

TEST_F(LandXml, StationsCantAndUnsymmetricalCurvesSurviveWriting) {
  VerticalPoint crest{1050, 405, VerticalCurveKind::unsymmetrical_parabola, 50, 0, 20};
  const HorizontalAlignment plan({{HorizontalKind::line, "", {500, 700}, 0.3, 100, 0, 0}}, 1000.0);
  const Alignment axis("CL", plan, VerticalAlignment({{1000, 400}, crest, {1100, 401}}),
                       StationEquations({{1030, 2000, false}, {1060, 1500, true}}),
                       Cant({{1000, 0, 0, HorizontalKind::bloss}, {1040, 0.1, 0}, {1090, 0, 0.05}}, 1.5));
  const Alignment back = chosen(landxml_text(axis));
  for (double s = 1000; s <= 1100; s += 0.7) {
    EXPECT_NEAR(back.vertical().at(s).elevation_m, axis.vertical().at(s).elevation_m, 1e-8);
    EXPECT_NEAR(back.stations().displayed_m(s), axis.stations().displayed_m(s), 1e-8);
    EXPECT_NEAR(back.cant().at(s).cant_m, axis.cant().at(s).cant_m, 1e-9);
    EXPECT_NEAR(back.cant().at(s).rise_m, axis.cant().at(s).rise_m, 1e-9);
  }
}

TEST_F(LandXml, OneBadAlignmentLeavesTheOthersReadable) {
  const std::string text = landxml(alignment(first_line, grade, "good") + alignment("<Chain/>", grade, "bad"));
  EXPECT_EQ(chosen(text, "good").name(), "good");
  expect_words(error_of([&] { chosen(text, "bad"); }), {"axis.xml:9", "Chain 1"});
  expect_words(error_of([&] { chosen(text); }), {"several alignments", "\"good\", \"bad\""});
  expect_words(error_of([&] { chosen(text, "other"); }), {"no alignment \"other\"", "\"good\", \"bad\""});
}

TEST_F(LandXml, WithoutGradeLineOnlyThePlanIsOffered) {
  const AxisFile file = read(landxml(alignment(first_line, "")));
  EXPECT_NEAR(file.axes[0].axis->horizontal().to_m(), 100, 1e-12);
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
  const AxisFile file = read(landxml(alignment(lines_alone)));
  EXPECT_TRUE(has_finding(file.axes[0].findings, Severity::warning, "easting northing"));
}

TEST_F(LandXml, DirectionsMayCountEitherWayAndAreOnlyCompared) {
  for (const char* dir : {"30", "-30", "330"}) {
    const std::string line = std::string("<Line dir=\"") + dir + "\"><Start>0 0</Start><End>86.60254 50</End></Line>";
    EXPECT_TRUE(read(landxml(alignment(line))).axes[0].findings.empty()) << dir;
  }
  const std::string wrong = R"(<Line dir="77"><Start>0 0</Start><End>86.60254 50</End></Line>)";
  EXPECT_TRUE(has_finding(read(landxml(alignment(wrong))).axes[0].findings, Severity::note, "first Line 1, differ"));
}

TEST_F(LandXml, GapsAreReportedInMillimetresAndLargeOnesRefused) {
  const auto line_from = [](const char* northing) {
    return std::string("<Line><Start>") + northing + " 1000</Start><End>2200 1000</End></Line>";
  };
  EXPECT_TRUE(read(landxml(alignment(first_line + line_from("2100.0008")))).axes[0].findings.empty());
  EXPECT_TRUE(has_finding(read(landxml(alignment(first_line + line_from("2100.0023")))).axes[0].findings,
                          Severity::warning,
                          "alignment axis, Line 1: its computed end lies 2.3 mm from the Start of Line 2"));
  expect_words(refusal(landxml(alignment(first_line + line_from("2100.06")))), {"Line 1", "0.06 m"});
}

TEST_F(LandXml, KinksAndStatedLengthsAndRadiiAreReported) {
  const std::string kinked =
      first_line + R"(<Line length="100.02"><Start>2100 1000</Start><End>2200 1000.1</End></Line>)";
  const Findings findings = read(landxml(alignment(kinked))).axes[0].findings;
  EXPECT_TRUE(has_finding(findings, Severity::warning,
                          "Line 2: its direction differs from the end of Line 1 by 0.0573 degrees"));
  EXPECT_TRUE(has_finding(findings, Severity::warning, "states a length of 100.02 m, its points give 100"));
  std::string arc = right_arc;
  arc.replace(arc.find("radius=\"50\""), 11, "radius=\"51\"");
  EXPECT_TRUE(has_finding(read(landxml(alignment(arc))).axes[0].findings, Severity::warning, "radius of 51 m"));
  std::string whole = alignment(first_line);
  whole.replace(whole.find("staStart"), 0, "length=\"99\" ");
  EXPECT_TRUE(has_finding(read(landxml(whole)).axes[0].findings, Severity::warning,
                          "states a length of 99 m, its elements sum to 100 m"));
}

TEST_F(LandXml, ElementsWithoutLengthAreLeftOut) {
  const std::string nothing =
      R"(<Curve rot="cw" length="0"><Start>2100 1000</Start><Center>2100 1050</Center><End>2100 1000</End></Curve>)";
  const AxisFile file = read(landxml(alignment(first_line + nothing + right_arc)));
  EXPECT_EQ(file.axes[0].axis->horizontal().elements().size(), 2U);
  EXPECT_TRUE(has_finding(file.axes[0].findings, Severity::note, "Curve 2: has no length"));
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
  const AxisFile file = read(landxml(alignment(first_line, curved)));
  const VerticalAlignment& line = file.axes[0].axis->vertical();
  EXPECT_NEAR(line.at(30).elevation_m, 11 + (-0.025 - 1.0 / 30) * 20 / 8, 1e-12);
  EXPECT_EQ(line.points()[2].radius_m, 300);
  EXPECT_TRUE(has_finding(file.axes[0].findings, Severity::warning,
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
  EXPECT_EQ(read(landxml(alignment(first_line, grade, "T\xFCr"))).axes[0].name, "T\xC3\xBCr");
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
  const AxisFile file = read(landxml_text(axis));
  ASSERT_EQ(file.axes.size(), 1U);
  for (const Finding& finding : file.axes[0].findings) EXPECT_EQ(finding.severity, Severity::note) << finding.words;
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
