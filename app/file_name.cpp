#include "app/file_name.h"

#include <cctype>

namespace adit::app {

std::string in_file_name(const std::string& name, std::size_t most) {
  std::string word = name.substr(0, most);
  for (char& c : word)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_') c = '_';
  return word;
}

}  // namespace adit::app
