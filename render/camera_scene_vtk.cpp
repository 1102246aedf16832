#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"
#include "render/camera_scene.h"
#include "render/off_screen_vtk.h"

namespace adit::render {
namespace {

unsigned char byte_of(double albedo) {
  return static_cast<unsigned char>(std::lround(255.0 * std::clamp(albedo, 0.0, 1.0)));
}

vtkSmartPointer<vtkActor> actor_of(vtkPolyData* shape) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(shape);
  mapper->SetStatic(1);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetDiffuse(1.0);
  actor->GetProperty()->SetAmbient(0.0);
  return actor;
}

vtkSmartPointer<vtkUnsignedCharArray> greys(std::size_t count) {
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(count));
  return array;
}

void set_grey(vtkUnsignedCharArray& array, std::size_t i, unsigned char value) {
  for (int k = 0; k < 3; ++k) array.SetTypedComponent(static_cast<vtkIdType>(i), k, value);
}

vtkSmartPointer<vtkActor> rock_actor(const CameraScene& scene) {
  vtkNew<vtkPoints> points;
  for (const Eigen::Vector3d& p : scene.rock.points) points->InsertNextPoint(p.data());
  vtkNew<vtkCellArray> triangles;
  for (const auto& t : scene.rock.triangles) triangles->InsertNextCell({t[0], t[1], t[2]});
  const auto albedo = greys(scene.rock.points.size());
  for (std::size_t i = 0; i < scene.rock.points.size(); ++i)
    set_grey(*albedo, i, byte_of(i < scene.rock_albedo.size() ? static_cast<double>(scene.rock_albedo[i]) : 0.4));
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  shape->SetPolys(triangles);
  shape->GetPointData()->SetScalars(albedo);
  auto actor = actor_of(shape);
  actor->GetProperty()->SetInterpolationToFlat();  // rock has edges
  return actor;
}

/// Triangles of all targets, with one normal a target.
struct TargetShapes {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkFloatArray> normals;
  std::vector<unsigned char> shades;  ///< of each point

  TargetShapes() { normals->SetNumberOfComponents(3); }

  vtkIdType add_point(const SceneTarget& target, double radius, double turn_rad, double above_m, unsigned char shade) {
    const double r = radius * target.radius_m;
    const Eigen::Vector3d at =
        target.site_from_target * Eigen::Vector3d(r * std::cos(turn_rad), r * std::sin(turn_rad), above_m);
    const Eigen::Vector3d normal = target.site_from_target.linear().col(2);
    normals->InsertNextTuple3(normal.x(), normal.y(), normal.z());
    shades.push_back(shade);
    return points->InsertNextPoint(at.data());
  }

  /// A piece of a ring, in steps of a degree.
  void add_piece(const SceneTarget& target, double inner, double outer, double from_deg, double to_deg, double above_m,
                 unsigned char shade) {
    const int steps = std::max(1, static_cast<int>(std::lround(to_deg - from_deg)));
    vtkIdType last_inner = -1, last_outer = -1;
    for (int i = 0; i <= steps; ++i) {
      const double turn = rad_from_deg(from_deg + (to_deg - from_deg) * i / steps);
      const vtkIdType a = add_point(target, inner, turn, above_m, shade);
      const vtkIdType b = add_point(target, outer, turn, above_m, shade);
      if (i > 0) {
        triangles->InsertNextCell({last_inner, last_outer, b});
        triangles->InsertNextCell({last_inner, b, a});
      }
      last_inner = a;
      last_outer = b;
    }
  }
};

vtkSmartPointer<vtkActor> targets_actor(const CameraScene& scene) {
  constexpr double paper_behind = 4e-3;  // over the radius: ink before paper at any depth of the z buffer
  TargetShapes shapes;
  const unsigned char paper = byte_of(scene.paper_albedo), ink = byte_of(scene.ink_albedo);
  for (const SceneTarget& target : scene.targets) {
    shapes.add_piece(target, 0.0, coded_pattern::clear_radius, 0.0, 360.0, -paper_behind * target.radius_m, paper);
    shapes.add_piece(target, 0.0, coded_pattern::disc_radius, 90.0, 360.0, 0.0, ink);
    for (int k = 0; k < coded_pattern::segments; ++k)
      if (is_black(target.code, k))
        shapes.add_piece(target, coded_pattern::ring_radius, 1.0, 30.0 * k, 30.0 * (k + 1), 0.0, ink);
  }
  const auto albedo = greys(shapes.shades.size());
  for (std::size_t i = 0; i < shapes.shades.size(); ++i) set_grey(*albedo, i, shapes.shades[i]);
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(shapes.points);
  shape->SetPolys(shapes.triangles);
  shape->GetPointData()->SetScalars(albedo);
  shape->GetPointData()->SetNormals(shapes.normals);
  return actor_of(shape);
}

}  // namespace

struct CameraSceneView::Stage {
  vtkNew<vtkGenericOpenGLRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkLight> lamp;
  std::vector<vtkSmartPointer<vtkActor>> actors;
};

CameraSceneView::CameraSceneView(const CameraScene& scene) : stage_(std::make_unique<Stage>()) {
  begin_off_screen(*stage_->window);
  stage_->window->AddRenderer(stage_->renderer);
  vtkRenderer& renderer = *stage_->renderer;
  renderer.SetBackground(0.0, 0.0, 0.0);
  renderer.AutomaticLightCreationOff();
  renderer.AddLight(stage_->lamp);
  if (!scene.rock.triangles.empty()) stage_->actors.push_back(rock_actor(scene));
  if (!scene.targets.empty()) stage_->actors.push_back(targets_actor(scene));
  for (const auto& actor : stage_->actors) renderer.AddActor(actor);
}

CameraSceneView::~CameraSceneView() {
  stage_->window->Finalize();
}

GreyPicture CameraSceneView::picture(const PinholeView& view) {
  vtkRenderer& renderer = *stage_->renderer;
  const Pose& pose = view.site_from_camera;
  vtkCamera& eye = *renderer.GetActiveCamera();
  const Eigen::Vector3d position = pose.translation(), ahead = pose.linear().col(2), up = -pose.linear().col(1);
  const Eigen::Vector3d focus = position + ahead;
  eye.SetPosition(position.data());
  eye.SetFocalPoint(focus.data());
  eye.SetViewUp(up.data());
  eye.SetViewAngle(deg_from_rad(2.0 * std::atan(0.5 * view.height / view.focal_px)));
  eye.SetClippingRange(0.05, 80.0);
  vtkLight& lamp = *stage_->lamp;
  const Eigen::Vector3d lamp_at = pose * view.lamp;
  lamp.SetLightTypeToSceneLight();
  lamp.PositionalOn();
  lamp.SetConeAngle(90.0);
  lamp.SetPosition(lamp_at.data());
  lamp.SetFocalPoint(focus.data());
  lamp.SetAttenuationValues(0.3, 0.0, 0.7 / (view.lamp_reach_m * view.lamp_reach_m));
  for (const auto& actor : stage_->actors) actor->GetProperty()->SetAmbient(view.ambient);
  vtkGenericOpenGLRenderWindow& window = *stage_->window;
  window.SetSize(view.width, view.height);
  draw_off_screen(window);
  const std::vector<std::uint8_t> rgb = off_screen_rgb(window);
  GreyPicture result(view.width, view.height);
  for (std::size_t i = 0; i < result.pixels.size(); ++i) result.pixels[i] = rgb[3 * i];
  return result;
}

}  // namespace adit::render
