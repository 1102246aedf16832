#pragma once
// Clicks by the names of widgets, for tests and for the pictures of the guide: a moved button breaks nothing.

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace adit::ui {

/// Where a widget stood in the last frame, in pixels from the upper left corner.
struct WidgetPlace {
  float left = 0.0F;
  float top = 0.0F;
  float right = 0.0F;
  float bottom = 0.0F;
  bool enabled = true;
};

/// Clicks are taken in order, one a frame at most; one that finds its widget absent or disabled waits for it.
class Script {
 public:
  void click(const std::string& widget) { steps_.push_back({widget, std::nullopt}); }
  /// Moves a slider.
  void set(const std::string& widget, double value) { steps_.push_back({widget, value}); }
  bool finished() const { return steps_.empty(); }
  /// Name of the widget the next step waits for; empty when finished.
  std::string waits_for() const { return steps_.empty() ? std::string() : steps_.front().widget; }

  /// For the window, after each frame.
  void end_frame();
  /// For widgets, after being drawn: notes the place and tells whether the script clicks here now.
  bool clicks(const std::string& widget, const WidgetPlace& place);
  /// Notes a place only.
  void note(const std::string& widget, const WidgetPlace& place) { being_drawn_[widget] = place; }
  /// As clicks(), for sliders.
  std::optional<double> sets(const std::string& widget, const WidgetPlace& place);

  /// Place of a widget drawn in the last frame; empty when it was not there.
  std::optional<WidgetPlace> place(const std::string& widget) const;

 private:
  struct Step {
    std::string widget;
    std::optional<double> value;
  };
  bool take(const std::string& widget, const WidgetPlace& place, bool with_value);

  std::deque<Step> steps_;
  std::map<std::string, WidgetPlace> places_;       ///< of the last whole frame
  std::map<std::string, WidgetPlace> being_drawn_;  ///< so far
  bool taken_ = false;
};

}  // namespace adit::ui
