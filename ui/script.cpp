#include "ui/script.h"

#include <utility>

namespace adit::ui {

void Script::end_frame() {
  places_ = std::move(being_drawn_);
  being_drawn_.clear();
  taken_ = false;
}

bool Script::take(const std::string& widget, const WidgetPlace& place, bool with_value) {
  note(widget, place);
  if (taken_ || steps_.empty() || !place.enabled) return false;
  const Step& next = steps_.front();
  taken_ = next.widget == widget && next.value.has_value() == with_value;
  return taken_;
}

bool Script::clicks(const std::string& widget, const WidgetPlace& place) {
  if (!take(widget, place, false)) return false;
  steps_.pop_front();
  return true;
}

std::optional<double> Script::sets(const std::string& widget, const WidgetPlace& place) {
  if (!take(widget, place, true)) return std::nullopt;
  const std::optional<double> value = steps_.front().value;
  steps_.pop_front();
  return value;
}

std::optional<WidgetPlace> Script::place(const std::string& widget) const {
  const auto found = places_.find(widget);
  return found == places_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace adit::ui
