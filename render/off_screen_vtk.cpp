#include "render/off_screen_vtk.h"

#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkOpenGLState.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace adit::render {
namespace {

// VTK asks by events whether the context that is current is its own: here it always is.
void answer_yes(vtkObject*, unsigned long, void*, void* call) {
  *static_cast<bool*>(call) = true;
}

}  // namespace

void begin_off_screen(vtkGenericOpenGLRenderWindow& window) {
  vtkNew<vtkCallbackCommand> yes;
  yes->SetCallback(answer_yes);
  window.AddObserver(vtkCommand::WindowIsCurrentEvent, yes);
  window.AddObserver(vtkCommand::WindowSupportsOpenGLEvent, yes);
  window.SetReadyForRendering(true);
  window.InitializeFromCurrentContext();
  window.SetMultiSamples(0);
  window.SetShowWindow(false);
  window.SetUseOffScreenBuffers(true);
}

void draw_off_screen(vtkGenericOpenGLRenderWindow& window) {
  window.GetState()->Reset();
  window.Render();
}

std::vector<std::uint8_t> off_screen_rgb(vtkGenericOpenGLRenderWindow& window) {
  const int width = window.GetSize()[0], height = window.GetSize()[1];
  vtkNew<vtkUnsignedCharArray> from_below;
  window.GetPixelData(0, 0, width - 1, height - 1, 0, from_below, 0);
  const auto row = 3 * static_cast<std::size_t>(width);
  std::vector<std::uint8_t> rgb(row * static_cast<std::size_t>(height));
  for (std::size_t v = 0; v < static_cast<std::size_t>(height); ++v)
    std::copy_n(from_below->GetPointer(0) + (static_cast<std::size_t>(height) - 1 - v) * row, row,
                rgb.data() + v * row);
  return rgb;
}

}  // namespace adit::render
