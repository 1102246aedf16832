#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTextureObject.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"
#include "render/off_screen_vtk.h"
#include "render/scene_view.h"

namespace adit::render {
namespace {

vtkSmartPointer<vtkActor> actor_of(vtkPolyData* shape) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(shape);
  mapper->SetStatic(1);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

void set_colour(vtkActor* actor, const Colour& c) {
  actor->GetProperty()->SetColor(c.red, c.green, c.blue);
  actor->GetProperty()->SetOpacity(c.alpha);
}

vtkSmartPointer<vtkUnsignedCharArray> colour_array(std::size_t count) {
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(count));
  array->SetName("colours");
  return array;
}

vtkSmartPointer<vtkActor> cloud_actor(const SceneCloud& cloud) {
  const auto count = static_cast<vtkIdType>(cloud.points.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  points->SetNumberOfPoints(count);
  vtkNew<vtkCellArray> vertices;
  vertices->AllocateExact(1, count);
  vertices->InsertNextCell(static_cast<int>(count));
  for (vtkIdType i = 0; i < count; ++i) {
    points->SetPoint(i, cloud.points[static_cast<std::size_t>(i)].cast<double>().eval().data());
    vertices->InsertCellPoint(i);
  }
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  shape->SetVerts(vertices);
  if (!cloud.points.empty() && cloud.colours.size() == cloud.points.size()) {
    const auto array = colour_array(cloud.points.size());
    std::copy_n(cloud.colours.front().data(), 3 * cloud.points.size(), array->GetPointer(0));
    shape->GetPointData()->SetScalars(array);
  }
  auto actor = actor_of(shape);
  set_colour(actor, cloud.colour);
  actor->GetProperty()->SetPointSize(static_cast<float>(cloud.point_px));
  actor->GetProperty()->LightingOff();
  return actor;
}

// One table entry for each class: deviations are interpolated inside a triangle, then looked up, so that only colours
// of the legend appear.
vtkSmartPointer<vtkLookupTable> class_table(const DeviationScale& scale) {
  const std::vector<double> bounds = scale.boundaries_m();
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(static_cast<vtkIdType>(bounds.size()) - 1);
  table->SetTableRange(bounds.front(), bounds.back());
  for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
    const Colour c = deviation_colour(scale, (bounds[i] + bounds[i + 1]) / 2.0);
    table->SetTableValue(static_cast<vtkIdType>(i), c.red, c.green, c.blue, 1.0);
  }
  const Colour unknown = deviation_colour(scale, std::nan(""));
  table->SetNanColor(unknown.red, unknown.green, unknown.blue, 1.0);
  return table;
}

void colour_by_deviation(vtkActor* actor, vtkPolyData* shape, const std::vector<float>& deviations_m,
                         const DeviationScale& scale) {
  vtkNew<vtkFloatArray> values;
  values->SetNumberOfTuples(static_cast<vtkIdType>(deviations_m.size()));
  std::copy(deviations_m.begin(), deviations_m.end(), values->GetPointer(0));
  shape->GetPointData()->SetScalars(values);
  vtkMapper* mapper = actor->GetMapper();
  mapper->SetLookupTable(class_table(scale));
  mapper->UseLookupTableScalarRangeOn();
  mapper->InterpolateScalarsBeforeMappingOn();
}

vtkSmartPointer<vtkActor> mesh_actor(const SceneMesh& mesh, const DeviationScale& scale) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  for (const Eigen::Vector3d& p : mesh.surface.points) points->InsertNextPoint(p.data());
  vtkNew<vtkCellArray> triangles;
  for (const auto& t : mesh.surface.triangles) triangles->InsertNextCell({t[0], t[1], t[2]});
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  shape->SetPolys(triangles);
  auto actor = actor_of(shape);
  if (mesh.deviations_m.size() == mesh.surface.points.size())
    colour_by_deviation(actor, shape, mesh.deviations_m, scale);
  set_colour(actor, mesh.colour);
  // Much ambient light: the colours must be those of the legend, the shading only hints at the form.
  actor->GetProperty()->SetAmbient(0.80);
  actor->GetProperty()->SetDiffuse(0.20);
  return actor;
}

vtkSmartPointer<vtkActor> line_actor(const SceneLine& line) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(static_cast<int>(line.points.size()));
  for (const Eigen::Vector3d& p : line.points) lines->InsertCellPoint(points->InsertNextPoint(p.data()));
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  shape->SetLines(lines);
  auto actor = actor_of(shape);
  set_colour(actor, line.colour);
  actor->GetProperty()->SetLineWidth(static_cast<float>(line.width_px));
  actor->GetProperty()->LightingOff();
  return actor;
}

}  // namespace

struct SceneView::Stage {
  vtkNew<vtkGenericOpenGLRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  bool drawn = false;
};

SceneView::SceneView(int width, int height) : stage_(std::make_unique<Stage>()) {
  auto& window = *stage_->window;
  begin_off_screen(window);
  window.SetSize(width, height);
  window.AddRenderer(stage_->renderer);
  stage_->renderer->SetNearClippingPlaneTolerance(0.0005);
}

SceneView::~SceneView() {
  stage_->window->Finalize();
}

void SceneView::set_scene(const Scene& scene) {
  auto& renderer = *stage_->renderer;
  renderer.RemoveAllViewProps();
  if (scene.dark) {
    renderer.SetBackground(0.09, 0.10, 0.12);
  } else {
    renderer.SetBackground(1.0, 1.0, 1.0);
  }
  for (const SceneMesh& mesh : scene.meshes)
    if (!mesh.surface.triangles.empty()) renderer.AddActor(mesh_actor(mesh, scene.scale.value_or(DeviationScale{})));
  for (const SceneCloud& cloud : scene.clouds)
    if (!cloud.points.empty()) renderer.AddActor(cloud_actor(cloud));
  for (const SceneLine& line : scene.lines)
    if (line.points.size() > 1) renderer.AddActor(line_actor(line));
}

void SceneView::set_camera(const Camera& camera) {
  vtkCamera& eye = *stage_->renderer->GetActiveCamera();
  eye.SetPosition(camera.position.data());
  eye.SetFocalPoint(camera.focal_point.data());
  eye.SetViewUp(camera.up.data());
  eye.SetParallelProjection(camera.orthographic);
  eye.SetParallelScale(camera.view_height_m / 2.0);
  eye.SetViewAngle(deg_from_rad(camera.view_angle_rad));
}

void SceneView::resize(int width, int height) {
  stage_->window->SetSize(width, height);
}
int SceneView::width() const {
  return stage_->window->GetSize()[0];
}
int SceneView::height() const {
  return stage_->window->GetSize()[1];
}

void SceneView::render() {
  stage_->renderer->ResetCameraClippingRange();
  draw_off_screen(*stage_->window);
  stage_->drawn = true;
}

unsigned int SceneView::texture() const {
  if (!stage_->drawn) return 0;
  return stage_->window->GetRenderFramebuffer()->GetColorAttachmentAsTextureObject(0)->GetHandle();
}

Picture SceneView::picture() const {
  Picture result = blank_picture(width(), height());
  const std::vector<std::uint8_t> rgb = off_screen_rgb(*stage_->window);
  for (std::size_t i = 0; i < rgb.size() / 3; ++i) std::copy_n(rgb.data() + 3 * i, 3, result.rgba.data() + 4 * i);
  return result;
}

}  // namespace adit::render
