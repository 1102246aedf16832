#pragma once
// The exchange text of IFC (ISO 10303-21): instances by number, with their arguments.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/foundation/error.h"

namespace adit::io {

/// One argument: nothing ($ or *), a number, a text, an .ENUMERATION., a #reference, or a list.
struct IfcValue {
  enum class Kind { none, number, text, enumeration, reference, list };
  Kind kind = Kind::none;
  double number = 0.0;
  std::uint64_t reference = 0;
  std::string text;             ///< of text and enumeration
  std::vector<IfcValue> items;  ///< of a list
};

/// #12 = NAME(arguments). A typed argument, NAME(5.), stands as its value.
struct IfcInstance {
  std::uint64_t number = 0;
  std::string name;  ///< upper case
  std::vector<IfcValue> arguments;
  std::string place;  ///< file and line

  /// Throws Error with the place unless argument i is what is asked for.
  double number_at(std::size_t i) const;
  double number_or(std::size_t i, double otherwise) const;
  std::string word_at(std::size_t i) const;         ///< text or enumeration; empty when it is none
  std::uint64_t reference_at(std::size_t i) const;  ///< 0 when it is none
  std::vector<std::uint64_t> references_at(std::size_t i) const;
  std::vector<double> numbers_at(std::size_t i) const;

  [[noreturn]] void fail(const std::string& what, const std::string& mend) const { throw Error(what, place, mend); }
};

/// A file, with the instances whose names begin with one of those wanted.
struct IfcText {
  std::string file;
  std::string schema;  ///< as FILE_SCHEMA names it: "IFC4X3"
  std::map<std::uint64_t, IfcInstance> instances;

  /// Throws Error when there is none of that number.
  const IfcInstance& at(std::uint64_t number, const IfcInstance& asked_by) const;
  std::vector<const IfcInstance*> named(const std::string& name) const;
};

/// Throws Error with file and line when the file is no such text, larger than 256 MiB, cut off, or an instance that is
/// wanted is broken; deeper lists than 32 are refused.
IfcText read_ifc_text(const std::filesystem::path& file, const std::vector<std::string>& wanted);

}  // namespace adit::io
