#pragma once
// The visitors that carry described options between structs and JSON.

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include "io/json_place.h"

namespace adit::io {

/// Reads members that are present, refuses unknown keys and values out of range.
class OptionsFromJson {
 public:
  explicit OptionsFromJson(JsonPlace place) : place_(std::move(place)) {}

  void number(const char* name, double& value, const char* unit, double least, double most, const char*) {
    known_.emplace_back(name);
    if (place_.has(name)) value = place_.at(name).number_between(least, most, unit);
  }
  void count(const char* name, int& value, const char* unit, int least, int most, const char*) {
    known_.emplace_back(name);
    if (!place_.has(name)) return;
    static_cast<void>(place_.at(name).whole_number());
    value = static_cast<int>(place_.at(name).number_between(least, most, unit));
  }
  void flag(const char* name, bool& value, const char*) {
    known_.emplace_back(name);
    if (place_.has(name)) value = place_.at(name).yes_or_no();
  }
  void choice(const char* name, std::string& value, std::initializer_list<const char*> words, const char*) {
    known_.emplace_back(name);
    if (!place_.has(name)) return;
    const std::string word = place_.at(name).text();
    std::string list;
    for (const char* w : words) list += (list.empty() ? "" : ", ") + std::string(w);
    if (std::none_of(words.begin(), words.end(), [&](const char* w) { return word == w; }))
      place_.at(name).refuse("\"" + word + "\" is none of the choices", "one of: " + list);
    value = word;
  }

  /// Call after describe().
  void refuse_unknown() const {
    for (const std::string& key : place_.keys()) {
      if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
      std::string list;
      for (const auto& k : known_) list += (list.empty() ? "" : ", ") + k;
      place_.refuse("unknown key \"" + key + "\"", "known here: " + list);
    }
  }

 private:
  JsonPlace place_;
  std::vector<std::string> known_;
};

/// Writes every member.
class OptionsToJson {
 public:
  void number(const char* name, double& value, const char*, double, double, const char*) { json[name] = value; }
  void count(const char* name, int& value, const char*, int, int, const char*) { json[name] = value; }
  void flag(const char* name, bool& value, const char*) { json[name] = value; }
  void choice(const char* name, std::string& value, std::initializer_list<const char*>, const char*) {
    json[name] = value;
  }
  nlohmann::json json = nlohmann::json::object();
};

}  // namespace adit::io
