#include "plume/lib/scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "plume/lib/camera.h"
#include "plume/lib/fitted_map.h"
#include "plume/lib/scene_body.h"
#include "plume/mesh/cell_to_point.h"
#include "plume/mesh/connected_parts.h"
#include "plume/mesh/error.h"
#include "plume/mesh/gradients.h"
#include "plume/mesh/put_scalars.h"
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
double fitted_unit_distance(const Scene& scene, const ColorMap& map) {
  constexpr int kAcross = 12;  // rays along each side, from each of three directions
  constexpr double kWanted = 4;
  const ClosedForm optics(to_transfer_function(map, 1));
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

// A field of the user's mesh, and what of it does not depend on how the mesh is walked.
struct ReadField {
  ScalarField field;
  bool averaged = false;
  std::vector<Finding> findings;
  std::vector<float> gradients;  // of the user's points, where they are wanted
};

ReadField read_field(const Mesh& mesh, const FieldRequest& request, const SceneOptions& options) {
  ReadField read;
  ScalarField& field = read.field;
  field = select_field(mesh, request);
  if (field.association == Association::cell && options.cell_data == CellData::averaged) {
    if (field.not_finite > 0)
      read.findings.push_back(
          {fmt::format("values of '{}' are NaN or infinite; the averages leave them out",
                       field.name),
           field.not_finite,
           {}});
    field = average_to_points(mesh, field);
    read.averaged = true;
  }
  if (field.not_finite > 0)
    read.findings.push_back(
        {fmt::format("values of '{}' are NaN or infinite; they are transparent", field.name),
         field.not_finite,
         {}});
  if (options.keep_gradients) {
    if (field.association == Association::cell)
      throw Error(fmt::format(
          "gradients of '{}': its values are constant in each cell; average them to the points "
          "(--cell-data averaged)",
          field.name));
    read.gradients = point_gradients(mesh, field);
  }
  return read;
}

// All but the values.
void take_words(Scene::Body& body, ReadField& read) {
  const ScalarField& field = read.field;
  body.field = {field.name, field.association, {}, field.low, field.high, field.not_finite};
  body.cell_data_averaged = read.averaged;
  auto& all = body.findings;
  all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(body.findings_of_field));
  body.findings_of_field = read.findings.size();
  all.insert(all.begin(), std::make_move_iterator(read.findings.begin()),
             std::make_move_iterator(read.findings.end()));
}

// What the local frame is made of.
Bounds bounds_for_frame(const Bounds& own, const SceneOptions& options) {
  if (!options.frame_bounds) return own;
  const Bounds all = united(own, *options.frame_bounds);
  if (all.low != options.frame_bounds->low || all.high != options.frame_bounds->high)
    throw Error(fmt::format(
        "frame_bounds from ({}) to ({}): they must contain the mesh, which reaches from ({}) to "
        "({}); give bounds of all meshes that are shown together",
        fmt::join(options.frame_bounds->low, ", "), fmt::join(options.frame_bounds->high, ", "),
        fmt::join(own.low, ", "), fmt::join(own.high, ", ")));
  return all;
}

const char* kind_of(Association association) {
  return association == Association::point ? "on points" : "constant in each cell";
}

}  // namespace

Bounds united(const Bounds& a, const Bounds& b) {
  Bounds bounds = a;
  for (std::size_t i = 0; i < 3; ++i) {
    bounds.low[i] = std::min(a.low[i], b.low[i]);
    bounds.high[i] = std::max(a.high[i], b.high[i]);
  }
  return bounds;
}

Scene::Scene(const Mesh& mesh, const SceneOptions& options) : body_(std::make_unique<Body>()) {
  body_->bounds = check_structure(mesh);
  body_->options = options;
  body_->user_points = mesh.point_count();
  body_->user_cells = mesh.cell_count();
  ReadField read = read_field(mesh, options.field, options);
  const ScalarField& field = read.field;
  const bool on_points = field.association == Association::point;
  const bool keep_points = on_points && (options.keep_field_order || options.keep_gradients);
  const Bounds frame_bounds = bounds_for_frame(body_->bounds, options);
  const bool keep_cells = options.keep_cell_numbers || (!on_points && options.keep_field_order);

  body_->sample = sample_for_map(field.values);
  take_words(*body_, read);
  auto take = [&](auto walkable) {
    auto& found = walkable->mesh.findings;
    std::move(found.begin(), found.end(), std::back_inserter(body_->findings));
    found.clear();
    if (options.keep_gradients) {
      body_->gradients.emplace(walkable->mesh, std::move(read.gradients));
      if constexpr (requires { walkable->mesh.point_numbers; })
        if (!options.keep_field_order) walkable->mesh.point_numbers = {};
    }
    body_->walkable = std::move(walkable);
  };
  if (mesh.is_rectilinear())
    take(std::make_unique<Walkable<RectilinearWalker>>(
        make_walkable_rectilinear(mesh, std::move(read.field))));
  else if (mesh.is_grid())
    take(std::make_unique<Walkable<GridWalker>>(make_walkable_grid(mesh, field, frame_bounds)));
  else if (all_tetrahedra(mesh))
    take(std::make_unique<Walkable<TetWalker>>(
        make_walkable_tets(mesh, field, frame_bounds, keep_cells, keep_points,
                           options.compact_tetrahedra ? TetLinks::compact : TetLinks::whole)));
  else {
    WalkableCells cells = make_walkable_cells(mesh, field, frame_bounds, keep_cells, keep_points);
    prepare_packets(cells);
    take(std::make_unique<Walkable<CellWalker>>(std::move(cells)));
  }
  read.field.values = {};
  set_transfer_function(to_transfer_function(default_color_map(), default_unit_distance()));
}

void Scene::set_field(const Mesh& mesh, const FieldRequest& request) {
  Body& body = *body_;
  if (!body.options.keep_field_order)
    throw Error(
        "the scene does not know the order of its field's values; set "
        "SceneOptions::keep_field_order where it is made");
  if (mesh.point_count() != body.user_points || mesh.cell_count() != body.user_cells)
    throw Error(fmt::format(
        "a mesh of {} points and {} cells for a scene made of {} and {}: a field can be set from "
        "the same mesh alone; make a scene anew",
        mesh.point_count(), mesh.cell_count(), body.user_points, body.user_cells));
  ReadField read = read_field(mesh, request, body.options);
  if (read.field.association != body.field.association)
    throw Error(fmt::format(
        "field '{}' is {} and the scene was made of one that is {}; make a scene anew",
        read.field.name, kind_of(read.field.association), kind_of(body.field.association)));

  body.sample = sample_for_map(read.field.values);
  body.default_map.reset();
  body.unit_distance.reset();
  body.plans.scene_changed();
  body.hierarchy.reset();
  body.clusters.reset();
  body.ranges.reset();
  take_words(body, read);
  std::visit(
      [&](const auto& walkable) {
        if (body.gradients) body.gradients->put(walkable->mesh, std::move(read.gradients));
        put_scalars(walkable->mesh, std::move(read.field));
      },
      body.walkable);
}

Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

const Bounds& Scene::bounds() const { return body_->bounds; }
const ScalarField& Scene::field() const { return body_->field; }
bool Scene::cell_data_averaged() const { return body_->cell_data_averaged; }
const std::vector<Finding>& Scene::findings() const { return body_->findings; }
const TransferFunction& Scene::transfer_function() const { return body_->transfer_function; }

const ColorMap& Scene::default_color_map() const {
  const std::lock_guard lock(body_->fitting);
  if (!body_->default_map) {
    body_->default_map = fitted_color_map(body_->sample, body_->options.color_range);
    body_->sample = {};
  }
  return *body_->default_map;
}

double Scene::default_unit_distance() const {
  const ColorMap& map = default_color_map();
  const std::lock_guard lock(body_->fitting);
  if (!body_->unit_distance) body_->unit_distance = fitted_unit_distance(*this, map);
  return *body_->unit_distance;
}

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

const std::string& Scene::name() const { return body_->options.name; }

bool Scene::has_gradients() const { return body_->gradients.has_value(); }

void Scene::add_surface(OpaqueSurface surface) {
  if (const auto problem = surface.problem()) throw Error(*problem);
  if (surface.triangles.empty()) return;
  body_->plans.scene_changed();
  body_->surfaces.push_back({OpaqueTriangles(surface.points, surface.triangles), surface.color,
                             std::move(surface.point_colors), std::move(surface.point_normals)});
}

void Scene::remove_surfaces() {
  body_->plans.scene_changed();
  body_->surfaces.clear();
}

std::size_t Scene::surface_triangle_count() const {
  std::size_t count = 0;
  for (const SceneSurface& surface : body_->surfaces) count += surface.index.triangles().size();
  return count;
}

Bounds Scene::visible_bounds() const {
  Bounds bounds = body_->bounds;
  for (const SceneSurface& surface : body_->surfaces)
    bounds = united(bounds, surface.index.bounds());
  return bounds;
}

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
