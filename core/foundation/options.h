#pragma once
// Options are plain structs with defaults; one describe() beneath each struct tells every door about its members.
//
//   struct IcpOptions { double max_distance_m = 0.3; };
//   template <typename Visitor> void describe(Visitor& v, IcpOptions& o) {
//     v.number("max_distance_m", o.max_distance_m, "m", 0.01, 5.0, "farthest pair of points taken as the same place");
//   }
//
// A visitor has: number(name, double&, unit, least, most, help), count(name, int&, unit, least, most, help),
// flag(name, bool&, help), choice(name, std::string&, {words}, help). Reading JSON, writing JSON, hashing, the
// provenance page and the documentation table are such visitors.

#include <initializer_list>
#include <string>
#include <vector>

namespace adit {

/// Shows a value of an enumeration to a visitor as a choice among its names, in their order.
template <typename Visitor, typename Value>
void visit_choice(Visitor& v, const char* name, Value& value, std::initializer_list<const char*> words,
                  const char* help) {
  std::string word = words.begin()[static_cast<std::size_t>(value)];
  v.choice(name, word, words, help);
  for (std::size_t i = 0; i < words.size(); ++i)
    if (word == words.begin()[i]) value = static_cast<Value>(i);
}

/// One option as text, for pages and tables.
struct OptionRow {
  std::string group;
  std::string name;
  std::string value;
  std::string unit;
  std::string help;
};

/// Short decimal form of a number, the same on every machine ("0.1", "0.00002", "1e-12").
std::string short_number(double value);

/// The visitor that lists options with their present values.
class OptionRows {
 public:
  explicit OptionRows(std::string group) : group_(std::move(group)) {}

  void number(const char* name, double& value, const char* unit, double, double, const char* help) {
    rows.push_back({group_, name, short_number(value), unit, help});
  }
  void count(const char* name, int& value, const char* unit, int, int, const char* help) {
    rows.push_back({group_, name, std::to_string(value), unit, help});
  }
  void flag(const char* name, bool& value, const char* help) {
    rows.push_back({group_, name, value ? "yes" : "no", "", help});
  }
  void choice(const char* name, std::string& value, std::initializer_list<const char*>, const char* help) {
    rows.push_back({group_, name, value, "", help});
  }

  std::vector<OptionRow> rows;

 private:
  std::string group_;
};

/// Present values of one options struct as rows.
template <typename Options>
std::vector<OptionRow> option_rows(const std::string& group, const Options& options) {
  OptionRows visitor(group);
  Options copy = options;
  describe(visitor, copy);
  return visitor.rows;
}

}  // namespace adit
