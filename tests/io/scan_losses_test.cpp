#include "io/scan_losses.h"

#include "tests/io/scan_samples.h"

namespace adit::io {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

ScanFacts rich_facts() {
  ScanFacts facts;
  facts.header.attributes = {true, true, true, true};
  facts.header.file_pose = tests::sample_pose();
  facts.header.points = 110;
  facts.points = 100;
  facts.no_returns = 7;
  facts.least_intensity = -10.0F;
  facts.greatest_intensity = 30.0F;
  return facts;
}

TEST(ScanLosses, WhatAFormatCannotHoldIsSaid) {
  EXPECT_THAT(losses_of_writing("a.e57", {rich_facts()}), ElementsAre("3 points that are not finite are left out"));
  EXPECT_THAT(losses_of_writing("a.las", {rich_facts()}),
              ElementsAre("normals are left out", "rows and columns of the raster are left out",
                          "7 places without a return are left out", "3 points that are not finite are left out",
                          "the pose is left out; the points are moved by it",
                          "intensities are written as (value - -10) * 1638.375"));
  EXPECT_THAT(losses_of_writing("a.ptx", {rich_facts()}),
              ElementsAre("normals are left out", "3 points that are not finite are left out",
                          "intensities of all scans are written as (value - -10) * 0.025"));
  EXPECT_THAT(losses_of_writing("a.ply", {ScanFacts{}}), IsEmpty());
}

TEST(ScanLosses, OfEveryFormatThatIsWritten) {
  for (const std::string& ending : writable_endings())
    EXPECT_THAT(losses_of_writing("a" + ending, {ScanFacts{}}), IsEmpty());
}

}  // namespace
}  // namespace adit::io
