#include "ui/script.h"

#include <gtest/gtest.h>

namespace adit::ui {
namespace {

TEST(Script, ClicksInOrderAndOneAFrame) {
  Script script;
  script.click("Run");
  script.click("Cancel");
  EXPECT_FALSE(script.clicks("Cancel", {}));
  EXPECT_TRUE(script.clicks("Run", {}));
  EXPECT_FALSE(script.clicks("Cancel", {})) << "a second click in the same frame";
  script.end_frame();
  EXPECT_EQ(script.waits_for(), "Cancel");
  EXPECT_TRUE(script.clicks("Cancel", {}));
  EXPECT_TRUE(script.finished());
}

TEST(Script, WaitsForADisabledWidget) {
  Script script;
  script.click("Run");
  EXPECT_FALSE(script.clicks("Run", {0.0F, 0.0F, 1.0F, 1.0F, false}));
  script.end_frame();
  EXPECT_TRUE(script.clicks("Run", {0.0F, 0.0F, 1.0F, 1.0F, true}));
}

TEST(Script, SetsSlidersOnlyByValue) {
  Script script;
  script.set("chainage", 12.0);
  EXPECT_FALSE(script.clicks("chainage", {}));
  EXPECT_EQ(script.sets("chainage", {}), 12.0);
  EXPECT_FALSE(script.sets("chainage", {}).has_value());
}

TEST(Script, KnowsWhereWidgetsStoodInTheLastFrame) {
  Script script;
  script.clicks("Run", {1.0F, 2.0F, 3.0F, 4.0F});
  EXPECT_FALSE(script.place("Run").has_value());
  script.end_frame();
  ASSERT_TRUE(script.place("Run").has_value());
  EXPECT_EQ(script.place("Run")->right, 3.0F);
  script.end_frame();
  EXPECT_FALSE(script.place("Run").has_value()) << "not drawn any more";
}

}  // namespace
}  // namespace adit::ui
