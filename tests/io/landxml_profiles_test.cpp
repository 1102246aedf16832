#include "io/landxml_profiles.h"

#include <gtest/gtest.h>

#include "core/foundation/error.h"
#include "io/read_profile.h"
#include "tests/real_data.h"
#include "tests/temporary_folder.h"

namespace adit::io {
namespace {

constexpr const char* text = R"(<?xml version="1.0"?>
<LandXML xmlns="http://www.landxml.org/schema/LandXML-1.2" version="1.2">
<Units><Imperial linearUnit="foot" areaUnit="squareFoot" volumeUnit="cubicFeet" temperatureUnit="fahrenheit" pressureUnit="inHG"/></Units>
<Alignments><Alignment name="a" length="1000" staStart="0"><CrossSects>
<CrossSect sta="100">
 <DesignCrossSectSurf name="Lining" closedArea="true"><CrossSectPnt>-10 0</CrossSectPnt><CrossSectPnt>-10 20</CrossSectPnt>
  <CrossSectPnt>10 20</CrossSectPnt><CrossSectPnt>10 0</CrossSectPnt><CrossSectPnt>-10 0</CrossSectPnt></DesignCrossSectSurf>
 <DesignCrossSectSurf name="Kerb" side="left" closedArea="true"><CrossSectPnt>-10 0</CrossSectPnt><CrossSectPnt>-10 1</CrossSectPnt><CrossSectPnt>-9 0</CrossSectPnt></DesignCrossSectSurf>
 <DesignCrossSectSurf name="Kerb" side="right" closedArea="true"><CrossSectPnt>10 0</CrossSectPnt><CrossSectPnt>10 1</CrossSectPnt><CrossSectPnt>9 0</CrossSectPnt></DesignCrossSectSurf>
 <DesignCrossSectSurf name="Top"><CrossSectPnt>-10 20</CrossSectPnt><CrossSectPnt>10 20</CrossSectPnt></DesignCrossSectSurf>
</CrossSect>
<CrossSect sta="200">
 <DesignCrossSectSurf name="Lining" closedArea="true"><CrossSectPnt>-12 0</CrossSectPnt><CrossSectPnt>-12 20</CrossSectPnt>
  <CrossSectPnt>12 20</CrossSectPnt><CrossSectPnt>12 0</CrossSectPnt></DesignCrossSectSurf>
</CrossSect>
</CrossSects></Alignment></Alignments></LandXML>
)";

TEST(LandXmlProfiles, ClosedSurfacesOfANameBecomeProfilesAlongTheAxis) {
  const tests::TemporaryFolder folder;
  const auto file = folder.write("s.xml", text);
  constexpr double foot = 0.3048;
  const auto lining = read_landxml_profiles(file, "Lining");
  ASSERT_EQ(lining.size(), 2U);
  EXPECT_NEAR(lining[0].from_m, 100.0 * foot, 1e-9);
  EXPECT_NEAR(lining[0].profile.area_m2(), 20.0 * 20.0 * foot * foot, 1e-9);
  EXPECT_NEAR(lining[1].profile.area_m2(), 24.0 * 20.0 * foot * foot, 1e-9);
  EXPECT_EQ(read_landxml_profiles(file, "Kerb/left").size(), 1U);
  EXPECT_THROW(read_landxml_profiles(file, ""), Error) << "three closed surfaces in one section";
  EXPECT_THROW(read_landxml_profiles(file, "Kerb"), Error) << "left or right";
  EXPECT_THROW(read_landxml_profiles(file, "Top"), Error) << "open";
  const auto changing = read_profiles(file, "Lining", {}, -1e9, true);
  EXPECT_TRUE(changing.front().interpolated);
  EXPECT_THROW(read_profiles(file, "Lining", {}, 10.0, false), Error);
}

TEST(LandXmlProfilesData, SectionsOfACorridorMeetTheAreasTheFileStates) {
  const auto file = tests::real_data() / "alignments/landxml_crosssects/GSG_corridors.xml";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the real data are absent";
  const auto pavement = read_landxml_profiles(file, "Pave1/right");
  EXPECT_EQ(pavement.size(), 67U);
  constexpr double square_foot = 0.3048 * 0.3048;
  EXPECT_NEAR(pavement.front().profile.area_m2(), 8.039785 * square_foot, 1e-4);
}

}  // namespace
}  // namespace adit::io
