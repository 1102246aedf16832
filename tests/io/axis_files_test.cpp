// Axes that are no LandXML: tables of points, DXF, KOF, IFC.
#include <gtest/gtest.h>

#include <cmath>

#include "core/foundation/angle.h"
#include "io/kof.h"
#include "io/read_axis.h"
#include "io/read_control.h"
#include "tests/io/error_words.h"
#include "tests/temporary_folder.h"

namespace adit::io {
namespace {

using tests::error_of;
using tests::expect_words;

class AxisFiles : public ::testing::Test {
 protected:
  AxisFile read(const std::string& name, const std::string& text, std::optional<double> start = std::nullopt) {
    return read_axis(folder_.write(name, text), start);
  }
  std::string refusal(const std::string& name, const std::string& text, std::optional<double> start = std::nullopt) {
    return error_of([&] { named_axis(read(name, text, start), ""); });
  }
  tests::TemporaryFolder folder_;
};

TEST_F(AxisFiles, ATableInAnyOrderOfColumns) {
  const AxisFile file = read("axis.csv",
                             "POINT NO.,ELEVATION (M.),NORTHING (M.),EASTING (M.),CHAINAGE (M.)\n"
                             "1,10,2000,500,100\n2,11,2050,500,150\n3,12,2100,500,200\n");
  const Alignment axis = choose_alignment(file, "");
  EXPECT_EQ(axis.name(), "axis");
  EXPECT_NEAR(axis.to_site({125, 2, 1}).x(), 502, 1e-9);
  EXPECT_NEAR(axis.to_site({125, 2, 1}).y(), 2025, 1e-9);
  EXPECT_NEAR(axis.to_site({125, 2, 1}).z(), 11.5, 1e-9);
  ASSERT_EQ(file.findings.size(), 1U);
  expect_words(file.findings[0].words, {"not honoured", "point no."});
}

TEST_F(AxisFiles, ATableNeedsWhatItLacksAndNoMore) {
  const std::string bare = "east,north\n0,0\n0,50\n";
  expect_words(refusal("a.csv", bare), {"no chainages"});
  EXPECT_NEAR(named_axis(read("a.csv", bare, 70.0), "").axis->horizontal().to_m(), 120, 1e-12);
  expect_words(refusal("b.csv", "chainage,east,north\n0,0,0\n50,0,50\n", 10.0), {"leave the start chainage out"});
  expect_words(refusal("c.csv", "0,0,0\n50,0,50\n"), {"c.csv:1", "3 fields", "chainage,east,north,elevation"});
  expect_words(refusal("d.csv", "chainage,east,north\n0,0,word\n"), {"d.csv:2:5", "word"});
  expect_words(refusal("e.csv", "# nothing\n"), {"no points"});
  for (const char* header : {"chainage_ft,east_ft,north_ft", "chainage,east (mm),north (mm)", "km,east,north"})
    EXPECT_NE(refusal("u.csv", std::string(header) + "\n0,0,0\n10,10,0\n"), "") << header;
  expect_words(error_of([&] { choose_alignment(read("f.csv", "chainage,east,north\n0,0,0\n50,0,50\n"), ""); }),
               {"no grade line"});
  expect_words(refusal("g.las", ""), {"not from \".las\""});
}

TEST_F(AxisFiles, KofInBothOrdersWithTabsAndOldLetters) {
  const KofFile east =
      read_kof(folder_.write("e.kof",
                             " 01 EXP          31012022   2      22 0000 $22100000000           NN\n"
                             " 05 07-187     2418       594137.802 6589107.923        0           \n"));
  EXPECT_NEAR(east.points[0].plan.x(), 594137.802, 1e-9);
  EXPECT_NEAR(east.points[0].plan.y(), 6589107.923, 1e-9);
  EXPECT_EQ(east.points[0].name, "07-187");
  EXPECT_EQ(east.points[0].code, "2418");
  EXPECT_DOUBLE_EQ(*east.points[0].elevation_m, 0.0);
  EXPECT_TRUE(east.findings.empty());
  const KofFile tabs = read_kof(folder_.write("t.kof",
                                              " 01 Hopla        09112023   1      22      $11100000000\r\n"
                                              " 05 15 \t\t             7023231.981  599001.246    4.388\r\n"));
  EXPECT_NEAR(tabs.points[0].plan.x(), 599001.246, 1e-9);
  EXPECT_EQ(tabs.points[0].name, "15");
  for (const char* name : {"\xC3\x86\xC3\x98\xC3\x85", "\xC6\xD8\xC5"}) {  // UTF-8 and Latin-1
    const KofFile letters = read_kof(
        folder_.write("l.kof", std::string(" 05 ") + name + "1                6569635.303   624579.208   73.838\n"));
    EXPECT_EQ(letters.points[0].name,
              "\xC3\x86\xC3\x98\xC3\x85"
              "1");
    EXPECT_NEAR(letters.points[0].plan.y(), 6569635.303, 1e-9);
  }
}

TEST_F(AxisFiles, KofThatContradictsItselfIsReadByItsNumbersAndSaysSo) {
  const auto file = folder_.write("c.kof",
                                  " 01 X            31012022   2      22 0000 $22100000000           NN\n"
                                  " 05 4031                6644804.528  595870.665  50.029\n");
  const ControlFile control = read_control(file);
  EXPECT_NEAR(control.points[0].position.x(), 595870.665, 1e-9);
  ASSERT_EQ(control.findings.size(), 1U);
  EXPECT_EQ(control.findings[0].severity, Severity::warning);
  expect_words(control.findings[0].words, {"says east first", "1 points"});
  const std::string local = " 05 A                        120.000      80.000   5.000\n";
  EXPECT_NEAR(read_kof(folder_.write("n.kof", local)).points[0].plan.y(), 120.0, 1e-12);  // north first
}

TEST_F(AxisFiles, KofErrorsNameThePlace) {
  const std::string point = " 05 A                        120.000      80.000   5.000\n";
  expect_words(error_of([&] { read_control(folder_.write("d.kof", point + point)); }), {"d.kof:2", "given twice"});
  expect_words(
      error_of([&] { read_control(folder_.write("w.kof", " 05 A                        120.000      wo\n")); }),
      {"w.kof:1:", "wo"});
  expect_words(
      error_of([&] { read_control(folder_.write("z.kof", " 05 A                        120.000   80.000\n")); }),
      {"no elevation"});
  expect_words(error_of([&] { read_kof(folder_.write("e.kof", " 00 nothing\n")); }), {"no points"});
  expect_words(error_of([&] { read_kof(folder_.write("l.kof", " 09 91\n" + point)); }), {"does not end"});
  expect_words(refusal("p.kof", point, 0.0), {"no line"});
}

TEST_F(AxisFiles, AKofLineIsAnAxis) {
  std::string text = " 09 91\n";
  for (const char* north : {"100.000", "110.000", "120.000"})
    text += " 05 A            1          " + std::string(north) + "      80.000   5.000\n";
  text += " 09 99\n 05 B            1          " + std::string("300.000      80.000   5.000\n");
  const AxisFile file = read("line.kof", text, 40.0);
  ASSERT_EQ(file.axes.size(), 1U);
  EXPECT_NEAR(choose_alignment(file, "line 1").to_site({50, 1, 0}).y(), 110.0, 1e-9);
  expect_words(refusal("line.kof", text), {"no chainages"});
}

/// Entities of a drawing in metres.
std::string dxf(const std::string& entities) {
  return "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n6\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + entities +
         "0\nENDSEC\n0\nEOF\n";
}
std::string vertex(double x, double y, double z, double bulge = 0.0) {
  return "0\nVERTEX\n8\nCL\n10\n" + std::to_string(x) + "\n20\n" + std::to_string(y) + "\n30\n" + std::to_string(z) +
         "\n42\n" + std::to_string(bulge) + "\n";
}

TEST_F(AxisFiles, ADrawnPolylineWithABulge) {
  const double bulge = std::tan(pi / 8.0);  // a quarter turn to the left
  const std::string line = "0\nLWPOLYLINE\n8\nCL\n90\n3\n70\n0\n10\n0\n20\n0\n10\n0\n20\n100\n42\n" +
                           std::to_string(bulge) + "\n10\n-50\n20\n150\n";
  const AxisFile file = read("axis.dxf", dxf(line), 1000.0);
  const AxisOfFile& read_axis = named_axis(file, "CL");
  const HorizontalAlignment& plan = read_axis.axis->horizontal();
  EXPECT_NEAR(plan.to_m(), 1100 + 25 * pi, 1e-3);
  EXPECT_NEAR(plan.at(plan.to_m()).azimuth_rad, -pi / 2, 1e-5);
  EXPECT_NEAR(plan.at(1150).curvature_per_m, -1.0 / 50, 1e-7);
  EXPECT_TRUE(read_axis.findings.empty());
  expect_words(refusal("axis.dxf", dxf(line)), {"no chainages"});
  expect_words(error_of([&] { choose_alignment(file, ""); }), {"no grade line"});
}

TEST_F(AxisFiles, APolylineInSpaceCarriesItsGrade) {
  const std::string line = "0\nPOLYLINE\n8\nCL\n66\n1\n70\n8\n" + vertex(0, 0, 10) + vertex(0, 50, 12) +
                           vertex(0, 100, 11) + "0\nSEQEND\n8\nCL\n";
  const Alignment axis = choose_alignment(read("axis.dxf", dxf(line), 0.0), "");
  EXPECT_NEAR(axis.vertical().at(25).elevation_m, 11.0, 1e-9);
  EXPECT_NEAR(axis.vertical().at(75).grade, -0.02, 1e-9);
}

TEST_F(AxisFiles, AFlatPolylineLiesAtItsElevation) {
  const std::string light = "0\nLWPOLYLINE\n8\nCL\n90\n2\n70\n0\n38\n12.5\n10\n0\n20\n0\n10\n0\n20\n50\n";
  EXPECT_NEAR(choose_alignment(read("axis.dxf", dxf(light), 0.0), "").vertical().at(25).elevation_m, 12.5, 1e-9);
}

TEST_F(AxisFiles, LoosePiecesRunAsTheyWereDrawnOrAreRefused) {
  const auto piece = [](double y0, double y1) {
    return "0\nLINE\n8\nCL\n10\n0\n20\n" + std::to_string(y0) + "\n30\n0\n11\n0\n21\n" + std::to_string(y1) +
           "\n31\n0\n";
  };
  const AxisFile down = read("axis.dxf", dxf(piece(20, 10) + piece(10, 0)), 0.0);
  EXPECT_NEAR(named_axis(down, "").axis->horizontal().at(5).position.y(), 15.0, 1e-9);
  expect_words(refusal("axis.dxf", dxf(piece(20, 10) + piece(0, 10)), 0.0), {"different directions"});
  const std::string arc = "0\nARC\n8\nCL\n10\n0\n20\n0\n30\n0\n40\n100\n50\n0\n51\n90\n";  // from (100, 0) to (0, 100)
  const std::string into_it = "0\nLINE\n8\nCL\n10\n-50\n20\n100\n30\n0\n11\n0\n21\n100\n31\n0\n";
  const HorizontalAlignment right_hand = named_axis(read("axis.dxf", dxf(into_it + arc), 0.0), "").axis->horizontal();
  EXPECT_NEAR(right_hand.at(10).position.x(), -40.0, 1e-6);
  EXPECT_NEAR(right_hand.at(100).curvature_per_m, 0.01, 1e-9);
  expect_words(refusal("axis.dxf", dxf(arc), 0.0), {"arcs alone"});
  const std::string ring = "0\nCIRCLE\n8\nCL\n10\n0\n20\n0\n30\n0\n40\n5\n";
  expect_words(refusal("axis.dxf", dxf(ring), 0.0), {"no open line"});
}

/// A line, an arc of 150 m to the left, with a crest; units and more as given.
std::string ifc(const std::string& length_unit = "IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)", double unit_m = 1.0,
                const std::string& more = "", const std::string& kind = ".CIRCULARARC.",
                const std::string& schema = "IFC4X3_ADD2") {
  const auto n = [&](double metres) { return std::to_string(metres / unit_m); };
  return "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('" + schema + "'));\nENDSEC;\nDATA;\n#1=" + length_unit +
         ";\n#2=IFCUNITASSIGNMENT((#1));\n#3=IFCCARTESIANPOINT((0.,0.,0.));\n#4=IFCAXIS2PLACEMENT3D(#3,$,$);\n"
         "#5=IFCLOCALPLACEMENT($,#4);\n#10=IFCALIGNMENT('g',$,'Main; /* axis */ ''A''',$,$,#5,$,$);\n"
         "#11=IFCRELNESTS('g',$,$,$,#10,(#12,#13));\n#12=IFCALIGNMENTHORIZONTAL('g',$,$,$,$,#5,$);\n"
         "#13=IFCALIGNMENTVERTICAL('g',$,$,$,$,#5,$);\n#14=IFCRELNESTS('g',$,$,$,#12,(#15,#16,#17));\n"
         "#15=IFCALIGNMENTSEGMENT('g',$,$,$,$,#5,$,#20);\n#16=IFCALIGNMENTSEGMENT('g',$,$,$,$,#5,$,#21);\n"
         "#17=IFCALIGNMENTSEGMENT('g',$,$,$,$,#5,$,#22);\n#30=IFCCARTESIANPOINT((" +
         n(500) + "," + n(0) + "));\n#31=IFCCARTESIANPOINT((" + n(550) + "," + n(0) +
         "));\n#20=IFCALIGNMENTHORIZONTALSEGMENT($,$,#30,0.,0.,0.," + n(50) +
         ",$,.LINE.);\n#21=IFCALIGNMENTHORIZONTALSEGMENT($,$,#31,0.," + n(150) + "," + n(150) + "," + n(75 * pi) +
         ",$," + kind + ");\n#32=IFCCARTESIANPOINT((" + n(700) + "," + n(150) +
         "));\n#22=IFCALIGNMENTHORIZONTALSEGMENT($,$,#32,1.5707963268,0.,0.,0.,$,.LINE.);\n"
         "#40=IFCRELNESTS('g',$,$,$,#13,(#41,#42));\n#41=IFCALIGNMENTSEGMENT('g',$,$,$,$,#5,$,#43);\n"
         "#42=IFCALIGNMENTSEGMENT('g',$,$,$,$,#5,$,#44);\n#43=IFCALIGNMENTVERTICALSEGMENT($,$,0.," +
         n(100) + "," + n(10) + ",0.03,0.03,$,.CONSTANTGRADIENT.);\n#44=IFCALIGNMENTVERTICALSEGMENT($,$," + n(100) +
         "," + n(100) + "," + n(13) + ",0.03,-0.03,$,.PARABOLICARC.);\n" + more + "ENDSEC;\nEND-ISO-10303-21;\n";
}

TEST_F(AxisFiles, IfcCountsToTheLeftAndIsTurnedRound) {
  const AxisFile file = read("axis.ifc", ifc());
  ASSERT_EQ(file.axes.size(), 1U);
  ASSERT_TRUE(file.axes[0].axis.has_value()) << file.axes[0].refusal->what();
  const Alignment axis = choose_alignment(file, "Main; /* axis */ 'A'");
  EXPECT_NEAR(axis.horizontal().at(0).azimuth_rad, pi / 2, 1e-12);  // east
  EXPECT_NEAR(axis.horizontal().at(100).curvature_per_m, -1.0 / 150, 1e-12);
  const PlanPoint end = axis.horizontal().at(axis.horizontal().to_m());
  EXPECT_NEAR(end.position.x(), 700, 1e-5);
  EXPECT_NEAR(end.position.y(), 150, 1e-5);
  EXPECT_NEAR(axis.to_site({25, 2, 0}).y(), -2, 1e-9);  // right of an axis to the east lies south
  EXPECT_NEAR(axis.vertical().at(150).elevation_m, 13 + 0.75, 1e-9);
  EXPECT_NEAR(axis.vertical().at(150).grade, 0.0, 1e-9);
  ASSERT_EQ(file.axes[0].findings.size(), 1U);
  expect_words(file.axes[0].findings[0].words, {"grade line runs from 0 to 200, its plan from 0 to 285.619"});
}

TEST_F(AxisFiles, IfcInOtherUnitsAndOtherPlaces) {
  const std::string feet =
      "IFCCONVERSIONBASEDUNIT($,.LENGTHUNIT.,'foot',#50);\n#50=IFCMEASUREWITHUNIT(IFCLENGTHMEASURE(0.3048),#51);\n"
      "#51=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)";
  for (const auto& [unit, metres] :
       {std::pair{feet, 0.3048}, {std::string("IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.)"), 0.001}}) {
    const Alignment axis = choose_alignment(read("axis.ifc", ifc(unit, metres)), "");
    EXPECT_NEAR(axis.horizontal().at(axis.horizontal().to_m()).position.x(), 700, 1e-4);
    EXPECT_NEAR(axis.vertical().at(150).elevation_m, 13.75, 1e-4);
  }
  const std::string map = "#60=IFCMAPCONVERSION($,$,600000.,6700000.,400.,0.,1.,$);\n";  // x points north
  const Alignment placed = choose_alignment(read("axis.ifc", ifc("IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)", 1.0, map)), "");
  EXPECT_NEAR(placed.horizontal().at(0).position.x(), 600000, 1e-6);
  EXPECT_NEAR(placed.horizontal().at(0).position.y(), 6700500, 1e-6);
  EXPECT_NEAR(wrapped_rad(placed.horizontal().at(0).azimuth_rad), 0.0, 1e-12);
  EXPECT_NEAR(placed.vertical().at(0).elevation_m, 410, 1e-9);
}

TEST_F(AxisFiles, IfcStationsAndCant) {
  const std::string stationing =
      "#70=IFCREFERENT('g',$,'start',$,$,$,$,.STATION.);\n#71=IFCRELNESTS('g',$,$,$,#10,(#70,#80));\n"
      "#72=IFCPROPERTYSINGLEVALUE('Station',$,IFCLENGTHMEASURE(1000.),$);\n"
      "#73=IFCPROPERTYSET('g',$,'Pset_Stationing',$,(#72));\n#74=IFCRELDEFINESBYPROPERTIES('g',$,$,$,(#70),#73);\n"
      "#80=IFCREFERENT('g',$,'jump',$,$,#85,$,.STATION.);\n"
      "#82=IFCPROPERTYSINGLEVALUE('Station',$,IFCLENGTHMEASURE(2000.),$);\n"
      "#83=IFCPROPERTYSET('g',$,'Pset_Stationing',$,(#82));\n#84=IFCRELDEFINESBYPROPERTIES('g',$,$,$,(#80),#83);\n"
      "#85=IFCLINEARPLACEMENT($,#86,$);\n#86=IFCAXIS2PLACEMENTLINEAR(#87,$,$);\n"
      "#87=IFCPOINTBYDISTANCEEXPRESSION(IFCLENGTHMEASURE(100.),$,$,$,$);\n"
      "#90=IFCALIGNMENTCANT('g',$,$,$,$,#5,$,1.5);\n#91=IFCRELNESTS('g',$,$,$,#10,(#90));\n"
      "#92=IFCRELNESTS('g',$,$,$,#90,(#93));\n#93=IFCALIGNMENTSEGMENT('g',$,$,$,$,#5,$,#94);\n"
      "#94=IFCALIGNMENTCANTSEGMENT($,$,50.,20.,0.,0.,0.,0.1,.LINEARTRANSITION.);\n";
  const Alignment axis =
      choose_alignment(read("axis.ifc", ifc("IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)", 1.0, stationing)), "");
  EXPECT_NEAR(axis.from_m(), 1000, 1e-9);
  EXPECT_NEAR(axis.stations().displayed_m(1099), 1099, 1e-9);
  EXPECT_NEAR(axis.stations().displayed_m(1101), 2001, 1e-9);
  EXPECT_NEAR(axis.cant().at(1060).cant_m, -0.05, 1e-12);  // the right rail is raised
  EXPECT_NEAR(axis.cant().at(1060).rise_m, 0.025, 1e-12);
}

TEST_F(AxisFiles, IfcThatIsNotUnderstoodIsRefusedByPlace) {
  const std::string metre = "IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)";
  expect_words(refusal("a.ifc", ifc(metre, 1.0, "", ".VIENNESEBEND.")), {"a.ifc:", "VIENNESEBEND", "not supported"});
  expect_words(refusal("b.ifc", ifc(metre, 1.0, "", ".LINE.")), {"segment 2 ends"});
  expect_words(refusal("c.ifc", ifc(metre, 1.0, "", ".LINE.", "IFC2X3")), {"IFC2X3", "not IFC 4.3"});
  const std::string whole = ifc();
  expect_words(refusal("d.ifc", whole.substr(0, whole.size() / 2)), {"d.ifc:"});
  expect_words(refusal("e.ifc", "ISO-10303-21;\nDATA;\n#1=IFCRELNESTS(((((("), {"e.ifc:3"});
  expect_words(refusal("f.ifc", "no ifc"), {"ISO-10303-21"});
  expect_words(refusal("g.ifc", ifc(metre, 1.0, "#60=IFCMAPCONVERSION($,$,0.,0.,0.,1.,0.,0.9996);\n")), {"scales"});
  expect_words(refusal("h.ifc", ifc(), 5.0), {"leave the start chainage out"});
}

}  // namespace
}  // namespace adit::io
