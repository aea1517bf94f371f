#include "plume/lib/scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "plume/lib/camera.h"
#include "plume/lib/fitted_map.h"
#include "plume/lib/scene_body.h"
#include "plume/mesh/cell_to_point.h"
#include "plume/mesh/connected_parts.h"
#include "plume/mesh/error.h"
#include "plume/mesh/gradients.h"
#include "plume/mesh/validate.h"
#include "plume/preint/closed_form.h"

namespace plume {
namespace {

bool all_tetrahedra(const Mesh& mesh) {
  return mesh.cells.types.visit([](auto types) {
    return std::all_of(types.begin(), types.end(), [](auto type) {
      return static_cast<int>(type) == static_cast<int>(CellType::tetrahedron);
    });
  });
}

template <class Walkable>
std::size_t point_count_of(const Walkable& mesh) {
  return mesh.points.size();
}
std::size_t point_count_of(const WalkableRectilinear& mesh) { return mesh.point_count(); }

template <class Walkable>
std::size_t boundary_face_count_of(const Walkable& mesh) {
  return mesh.boundary.size();
}
std::size_t boundary_face_count_of(const WalkableRectilinear& mesh) {
  return mesh.boundary_face_count();
}

// See Scene::default_unit_distance().
double fitted_unit_distance(const Scene& scene) {
  constexpr int kAcross = 12;  // rays along each side, from each of three directions
  constexpr double kWanted = 4;
  const ClosedForm optics(to_transfer_function(scene.default_color_map(), 1));
  std::vector<double> depths;
  for (const char* view : {"+x", "+y", "+z"}) {
    Camera camera = named_view(view, scene.bounds());
    camera.parallel = true;
    const PixelRays rays(camera, kAcross, kAcross);
    for (int y = 0; y < kAcross; ++y)
      for (int x = 0; x < kAcross; ++x) {
        double depth = 0;
        scene.trace(rays(x + 0.5, y + 0.5), [&](const Segment& s) {
          depth += optics.optical_depth(s.s_in, s.s_out, static_cast<float>(s.t_out - s.t_in));
          return true;
        });
        if (depth > 0) depths.push_back(depth);
      }
  }
  const double diagonal = scene.bounds().diagonal();
  if (depths.empty()) return diagonal > 0 ? diagonal / 10 : 1;
  const auto fourth_fifth = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() * 4 / 5);
  std::nth_element(depths.begin(), fourth_fifth, depths.end());
  return *fourth_fifth / kWanted;
}

}  // namespace

Scene::Scene(const Mesh& mesh, const SceneOptions& options) : body_(std::make_unique<Body>()) {
  body_->bounds = check_structure(mesh);
  body_->field = select_field(mesh, options.field);
  if (body_->field.association == Association::cell && options.cell_data == CellData::averaged) {
    if (body_->field.not_finite > 0)
      body_->findings.push_back(
          {fmt::format("values of '{}' are NaN or infinite; the averages leave them out",
                       body_->field.name),
           body_->field.not_finite,
           {}});
    body_->field = average_to_points(mesh, body_->field);
    body_->cell_data_averaged = true;
  }
  const ScalarField& field = body_->field;
  body_->default_map = fitted_color_map(field.values);
  if (field.not_finite > 0)
    body_->findings.push_back(
        {fmt::format("values of '{}' are NaN or infinite; they are transparent", field.name),
         field.not_finite,
         {}});

  std::vector<float> gradients;
  if (options.keep_gradients) {
    if (field.association == Association::cell)
      throw Error(fmt::format(
          "gradients of '{}': its values are constant in each cell; average them to the points "
          "(--cell-data averaged)",
          field.name));
    gradients = point_gradients(mesh, field);
  }
  // What puts the gradients of the user's points where the walkable ones are.
  const bool keep_cells = options.keep_cell_numbers || options.keep_gradients;

  auto take = [&](auto walkable) {
    auto& found = walkable->mesh.findings;
    std::move(found.begin(), found.end(), std::back_inserter(body_->findings));
    found.clear();
    if (options.keep_gradients) {
      body_->gradients.emplace(walkable->mesh, mesh, std::move(gradients));
      if constexpr (requires { walkable->mesh.original_cells; })
        if (!options.keep_cell_numbers) walkable->mesh.original_cells = {};
    }
    body_->walkable = std::move(walkable);
  };
  if (mesh.is_rectilinear())
    take(std::make_unique<Walkable<RectilinearWalker>>(make_walkable_rectilinear(
        mesh, {field.name, field.association, std::move(body_->field.values)})));
  else if (mesh.is_grid())
    take(std::make_unique<Walkable<GridWalker>>(make_walkable_grid(mesh, field, body_->bounds)));
  else if (all_tetrahedra(mesh))
    take(std::make_unique<Walkable<TetWalker>>(
        make_walkable_tets(mesh, field, body_->bounds, keep_cells)));
  else {
    WalkableCells cells = make_walkable_cells(mesh, field, body_->bounds, keep_cells);
    cells.corner_cells = make_corner_cells(cells);
    take(std::make_unique<Walkable<CellWalker>>(std::move(cells)));
  }
  body_->field.values = {};
  body_->unit_distance = fitted_unit_distance(*this);
  set_transfer_function(to_transfer_function(body_->default_map, body_->unit_distance));
}

Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

const Bounds& Scene::bounds() const { return body_->bounds; }
const ScalarField& Scene::field() const { return body_->field; }
bool Scene::cell_data_averaged() const { return body_->cell_data_averaged; }
const std::vector<Finding>& Scene::findings() const { return body_->findings; }
const ColorMap& Scene::default_color_map() const { return body_->default_map; }
const TransferFunction& Scene::transfer_function() const { return body_->transfer_function; }

double Scene::default_unit_distance() const { return body_->unit_distance; }

void Scene::set_transfer_function(TransferFunction transfer_function) {
  if (const auto problem = transfer_function.problem())
    throw Error(fmt::format("transfer function: {}", *problem));
  body_->classification.volume = transfer_function;
  body_->transfer_function = std::move(transfer_function);
}

const Classification& Scene::classification() const { return body_->classification; }

void Scene::set_classification(Classification classification) {
  if (const auto problem = classification.problem())
    throw Error(fmt::format("classification: {}", *problem));
  if (classification.volume) body_->transfer_function = *classification.volume;
  body_->classification = std::move(classification);
}

const char* Scene::form() const {
  constexpr const char* kForms[] = {"tetrahedra", "grid", "cells", "rectilinear grid"};
  return kForms[body_->walkable.index()];
}

std::size_t Scene::cell_count() const {
  return std::visit([](const auto& w) { return w->mesh.cell_count(); }, body_->walkable);
}

std::size_t Scene::point_count() const {
  return std::visit([](const auto& w) { return point_count_of(w->mesh); }, body_->walkable);
}

std::size_t Scene::boundary_face_count() const {
  return std::visit([](const auto& w) { return boundary_face_count_of(w->mesh); }, body_->walkable);
}

std::size_t Scene::connected_part_count() const {
  return std::visit([](const auto& w) { return connected_parts(w->mesh); }, body_->walkable);
}

std::size_t Scene::bytes() const {
  return std::visit([](const auto& w) { return w->mesh.bytes(); }, body_->walkable);
}

bool Scene::has_gradients() const { return body_->gradients.has_value(); }

TraceResult Scene::trace(const Ray& ray, const std::function<bool(const Segment&)>& visit,
                         const ScalarRequest& request) const {
  return std::visit(
      [&](const auto& w) {
        auto renumbered = [&](Segment segment) {
          segment.cell = w->mesh.original_cell(segment.cell);
          return visit(segment);
        };
        return plume::trace(w->mesh, w->boundary, ray, renumbered, request);
      },
      body_->walkable);
}

}  // namespace plume
