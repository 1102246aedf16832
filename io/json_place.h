#pragma once
// A value of a JSON file that knows where it stands, so that every refusal can name its key.

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace adit::io {

/// Text of a whole file as JSON. Throws Error with line and column for anything that is not JSON, and for a key that
/// stands twice in one object.
nlohmann::json parse_json_file(const std::filesystem::path& file);

class JsonPlace {
 public:
  JsonPlace(const nlohmann::json& value, std::string file, std::string key = {})
      : value_(&value), file_(std::move(file)), key_(std::move(key)) {}

  /// Throws Error "unknown key" for a member that is not listed, naming the ones that are.
  void only_keys(const std::vector<std::string>& known) const;
  bool has(const std::string& key) const;
  JsonPlace at(const std::string& key) const;  ///< throws Error when the key is missing
  std::vector<JsonPlace> items() const;        ///< of an array
  std::vector<std::string> keys() const;       ///< of an object

  double number() const;
  double number_between(double least, double most, const std::string& unit) const;
  std::int64_t whole_number() const;
  std::string text() const;
  bool yes_or_no() const;
  bool is_text() const { return value_->is_string(); }
  bool is_object() const { return value_->is_object(); }
  std::vector<double> numbers(std::size_t count) const;

  double number_or(const std::string& key, double otherwise) const { return has(key) ? at(key).number() : otherwise; }
  std::string text_or(const std::string& key, const std::string& otherwise) const {
    return has(key) ? at(key).text() : otherwise;
  }

  const std::string& key() const { return key_; }
  /// Throws an Error at this place.
  [[noreturn]] void refuse(const std::string& what_is_wrong, const std::string& mend) const;

 private:
  std::string found() const;
  const nlohmann::json* value_;
  std::string file_;
  std::string key_;
};

}  // namespace adit::io
