#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "optics.h"
#include "plume/datasets/generate.h"
#include "plume/lib/classified_pixel.h"
#include "plume/lib/plume.h"
#include "plume/mesh/explicit_cells.h"
#include "plume/mesh/validate.h"
#include "plume/preint/closed_form.h"
#include "scene_rays.h"

namespace plume::atlas {
namespace {

constexpr std::size_t kRays = 400;

using Value = std::function<double(const test::Place&)>;

Mesh with_values(Mesh mesh, const Value& value) {
  std::vector<float> values;
  for (std::size_t p = 0; p < mesh.point_count(); ++p)
    values.push_back(static_cast<float>(value(point_at(mesh, p))));
  mesh.fields = {{"value", Association::point, 1, Array::own(std::move(values))}};
  mesh.active_field = "value";
  return mesh;
}

const char* const kForms[] = {"box-tetrahedra", "box-hexahedra", "box-mixed", "box-rectilinear"};

std::vector<Segment> segments_of(const Scene& scene, const Ray& ray) {
  std::vector<Segment> segments;
  scene.trace(ray, [&](const Segment& s) {
    segments.push_back(s);
    return true;
  });
  return segments;
}

struct Unlit {
  Shading operator()(const SurfaceHit&) const { return {}; }
};

// What a classification shows of a ray, as the renderer does it.
struct Seen {
  std::uint64_t surfaces;
  double alpha;
};
Seen seen(const Classification& classification, const std::vector<Segment>& segments) {
  const ClassifiedOptics optics(classification);
  const ClosedForm none(TransferFunction{{{}}});
  const Unlit unlit;
  ClassifiedPixelSettings settings{};
  settings.early_termination = 0;
  settings.tolerance = 1e-4;
  settings.gap = 1e-6;
  settings.whole_ray = true;
  ClassifiedPixel<ClosedForm, Unlit> pixel(optics, none, unlit, settings);
  for (const Segment& s : segments) pixel(s);
  return {pixel.surfaces, 1 - static_cast<double>(pixel.compositor.transmittance)};
}

// A cell is crossed where its ends are on two sides of the value.
std::uint64_t crossed(const std::vector<Segment>& segments, float value, bool ends_included) {
  std::uint64_t count = 0;
  for (const Segment& s : segments) {
    const float product = (s.s_in - value) * (s.s_out - value);
    if (s.t_out > s.t_in && (ends_included ? product <= 0 : product < 0)) ++count;
  }
  return count;
}

void compare(SurfaceRow& row, double found, double expected, double tolerance) {
  ++row.rays;
  if (std::isnan(found))
    ++row.not_a_number;
  else if (found < expected - tolerance)
    ++row.missed;
  else if (found > expected + tolerance)
    ++row.doubled;
}

// Isosurfaces of a field that does not fall along +x, +y and +z on lattices whose vertices have the
// isovalue: along a ray it is crossed once where the ray's ends are on two sides of it, a value
// equal to it counting as above, else not at all.
void isovalues(const char* name, float isovalue, const Value& value,
               std::vector<SurfaceRow>& rows) {
  SurfaceRow ours{name, "Plume", true}, with{name, "cell by cell, ends included", false},
      without{name, "cell by cell, ends excluded", false};
  Classification classification;
  classification.isosurfaces = {{isovalue, 0.5f, {1, 1, 1}}};
  for (const char* form : kForms) {
    const Mesh mesh = with_values(generate(form, {4, 0, 1}), value);
    const Scene scene(mesh);
    SceneRays make(mesh, check_structure(mesh), 9);
    for (Ray ray : make({Aim::inside, Aim::vertex, Aim::edge, Aim::in_face}, kRays)) {
      // Along +x, +y and +z, so that the field does not turn.
      bool rises = true;
      for (const double d : ray.direction) rises = rises && d >= 0;
      if (!rises) continue;
      const auto segments = segments_of(scene, ray);
      if (segments.empty()) continue;
      const bool crosses = (segments.front().s_in < isovalue) != (segments.back().s_out < isovalue);
      const double expected = crosses ? 1 : 0;
      compare(ours, static_cast<double>(seen(classification, segments).surfaces), expected, 0);
      compare(with, static_cast<double>(crossed(segments, isovalue, true)), expected, 0);
      compare(without, static_cast<double>(crossed(segments, isovalue, false)), expected, 0);
    }
  }
  for (const SurfaceRow& row : {ours, with, without}) rows.push_back(row);
}

// An interval whose bounds are values of vertices, crossed along x: every ray sees the same of it.
void interval(std::vector<SurfaceRow>& rows) {
  const char* const name = "an interval's bound is a vertex' value";
  SurfaceRow ours{name, "Plume", true}, steps{name, "fixed steps", false};
  Classification classification;
  classification.intervals = {{0.25f, 0.5f, even_profile(0.6f, {1, 1, 1})}};
  for (const char* form : kForms) {
    const Mesh mesh =
        with_values(generate(form, {4, 0, 1}), [](const test::Place& p) { return p[0]; });
    const Scene scene(mesh);
    SceneRays make(mesh, check_structure(mesh), 10);
    for (Ray ray : make({Aim::inside, Aim::vertex, Aim::edge, Aim::in_face}, kRays)) {
      const auto segments = segments_of(scene, ray);
      if (segments.empty()) continue;
      const float first = segments.front().s_in, last = segments.back().s_out;
      if (!(std::min(first, last) < 0.25f && std::max(first, last) > 0.5f)) continue;
      compare(ours, seen(classification, segments).alpha, 0.6, 1e-5);
      // As volume: extinction such that a ray along x would see 0.6, a sample each 200th of the
      // diagonal. Thickness shows, and so do the steps.
      const double step = std::sqrt(3.0) / 200, extinction = -std::log1p(-0.6) / 0.25;
      double depth = 0;
      for (double t = segments.front().t_in + 0.5 * step; t < segments.back().t_out; t += step) {
        const double x = ray.origin[0] + t * ray.direction[0];
        if (x >= 0.25 && x <= 0.5) depth += extinction * step;
      }
      compare(steps, -std::expm1(-depth), 0.6, 1e-2);
    }
  }
  rows.push_back(ours);
  rows.push_back(steps);
}

// One value of 27 is not finite: its cells are transparent, and all other cells are seen.
void not_finite(const char* name, float bad, std::vector<SurfaceRow>& rows) {
  SurfaceRow ours{name, "Plume", true}, plain{name, "cell by cell, values as they are", false};
  TransferFunction function;
  function.knots = {{0, {1, {1, 0.5f, 0}}}, {6, {2, {0, 0.5f, 1}}}};
  for (const char* form : kForms) {
    std::size_t number = 0;
    const Mesh mesh = with_values(generate(form, {4, 0, 1}), [&](const test::Place& p) {
      return ++number % 27 == 5 ? static_cast<double>(bad) : p[0] + 2 * p[1] + 3 * p[2];
    });
    Scene scene(mesh);
    scene.set_transfer_function(function);
    const ClosedForm optics(function);
    RenderSettings settings;
    settings.width = settings.height = 20;
    settings.early_termination = 0;
    const Camera camera = named_view("iso", scene.bounds());
    const Image image = render(scene, camera, settings).image;
    const PixelRays rays(camera, settings.width, settings.height);
    for (int y = 0; y < settings.height; ++y)
      for (int x = 0; x < settings.width; ++x) {
        double depth = 0, taken = 0;
        for (const Segment& s : segments_of(scene, rays(x + 0.5, y + 0.5))) {
          const double length = s.t_out - s.t_in;
          if (std::isfinite(s.s_in) && std::isfinite(s.s_out))
            depth += (1 + (0.5 * (static_cast<double>(s.s_in) + s.s_out)) / 6) * length;
          const float value = s.s_in != s.s_in || s.s_out != s.s_out ? bad : s.s_in;
          taken += (1 + (0.5 * (static_cast<double>(value) + value)) / 6) * length;
        }
        const float* rgba = image.pixel(x, y);
        const bool all_finite = std::isfinite(rgba[0] + rgba[1] + rgba[2]);
        const double alpha = static_cast<double>(rgba[3]);
        compare(ours, all_finite ? alpha : std::nan(""), -std::expm1(-depth), 1e-5);
        compare(plain, std::isinf(taken) ? std::nan("") : -std::expm1(-taken), -std::expm1(-depth),
                0.05);
      }
  }
  rows.push_back(ours);
  rows.push_back(plain);
}

}  // namespace

std::vector<SurfaceRow> run_surfaces() {
  std::vector<SurfaceRow> rows;
  isovalues(
      "the isovalue is that of vertices", 0.5f, [](const test::Place& p) { return p[0]; }, rows);
  isovalues(
      "constant at the isovalue, above beyond", 0.5f,
      [](const test::Place& p) { return std::max(0.5, p[0]); }, rows);
  isovalues(
      "constant at the isovalue, below before", 0.5f,
      [](const test::Place& p) { return std::min(0.5, p[0]); }, rows);
  isovalues(
      "constant everywhere, at the isovalue", 0.5f, [](const test::Place&) { return 0.5; }, rows);
  interval(rows);
  not_finite("values that are NaN", std::numeric_limits<float>::quiet_NaN(), rows);
  not_finite("values that are infinite", std::numeric_limits<float>::infinity(), rows);
  return rows;
}

std::string surface_table(const std::vector<SurfaceRow>& rows) {
  std::string table =
      "| scene | method | rays | see less | see more | not a number |\n|---|---|---|---|---|---|\n";
  std::string scene;
  for (const SurfaceRow& row : rows) {
    table += fmt::format("| {} | {} | {} | {} | {} | {} |\n", row.scene == scene ? "" : row.scene,
                         row.method, row.rays, row.missed, row.doubled, row.not_a_number);
    scene = row.scene;
  }
  return table;
}

std::vector<std::string> problems_of(const std::vector<SurfaceRow>& rows) {
  std::vector<std::string> problems;
  std::size_t old_failures = 0;
  for (const SurfaceRow& row : rows) {
    const std::size_t failures = row.missed + row.doubled + row.not_a_number;
    if (!row.ours) old_failures += failures;
    if (row.ours && (failures > 0 || row.rays < 100))
      problems.push_back(fmt::format("{}: of {} rays {} see less, {} more, {} are not a number",
                                     row.scene, row.rays, row.missed, row.doubled,
                                     row.not_a_number));
  }
  if (old_failures == 0) problems.push_back("no other method goes wrong at surfaces");
  return problems;
}

}  // namespace plume::atlas
