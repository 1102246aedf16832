#pragma once
// What the window shows without a job.

#include <string>

#include "ui/workspace.h"

namespace adit::ui {

/// A field for the path of a job.
class StartPanel {
 public:
  void draw(Workspace& workspace);

 private:
  std::string path_;
};

}  // namespace adit::ui
