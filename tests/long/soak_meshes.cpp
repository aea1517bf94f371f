#include "plume/tests/long/soak_meshes.h"

#include <array>
#include <cmath>

#include "plume/datasets/generate.h"
#include "plume/mesh/explicit_cells.h"
#include "plume/tests/bench/bench_meshes.h"

namespace plume::test {
namespace {

using Place = std::array<double, 3>;

Mesh box(int size, double jitter) { return generate("box-tetrahedra", {size, jitter, 7}); }

// The mesh with each point put where `move` says.
template <class Move>
Mesh moved(Mesh mesh, const Move& move) {
  std::vector<double> points;
  points.reserve(mesh.points.size());
  for (std::size_t p = 0; p < mesh.point_count(); ++p)
    for (const double x : move(point_at(mesh, p))) points.push_back(x);
  mesh.points = Array::own(std::move(points));
  return mesh;
}

Mesh scaled(Mesh mesh, const Place& scale, double offset = 0) {
  return moved(std::move(mesh), [&](const Place& p) {
    return Place{p[0] * scale[0] + offset, p[1] * scale[1] + offset, p[2] * scale[2] + offset};
  });
}

// Pressed into a slab of this thickness on a plane that no axis lies in: seen along it, all that
// tells its edges apart is rounding.
Mesh leaning(Mesh mesh, double thickness) {
  return moved(std::move(mesh), [&](const Place& p) {
    return Place{p[0], p[1], 0.37 * p[0] + 0.61 * p[1] + thickness * p[2]};
  });
}

// Every second inner layer of points along z lies on the one below: cells of no volume between.
Mesh with_flat_layers(int size) {
  return moved(box(size, 0), [&](const Place& p) {
    const double layer = std::round(p[2] * size);
    const bool down = std::fmod(layer, 2) == 1 && layer < size;
    return Place{p[0], p[1], down ? (layer - 1) / size : p[2]};
  });
}

// Points on a coarse lattice: many coincide, many cells have no volume or are inside out.
Mesh snapped(Mesh mesh, double lattice) {
  return moved(std::move(mesh), [&](const Place& p) {
    Place q;
    for (std::size_t a = 0; a < 3; ++a) q[a] = std::round(p[a] * lattice) / lattice;
    return q;
  });
}

// Every second slab along x is taken away: rays leave and come in again.
Mesh slabs(int size, double jitter) {
  Mesh mesh = box(size, jitter);
  const Mesh clean = box(size, 0);
  std::vector<std::int32_t> kept;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    double x = 0;
    std::array<std::int32_t, 4> ids;
    for (std::size_t v = 0; v < 4; ++v) {
      ids[v] = mesh.cells.connectivity.at<std::int32_t>(4 * c + v);
      x += 0.25 * point_at(clean, static_cast<std::size_t>(ids[v]))[0];
    }
    if (static_cast<int>(x * size) % 2 == 0) kept.insert(kept.end(), ids.begin(), ids.end());
  }
  mesh.cells.connectivity = Array::own(std::move(kept));
  std::erase_if(mesh.fields, [](const Field& f) { return f.association == Association::cell; });
  return mesh;
}

template <class Make>
SoakSource made(const char* name, bool fills_bounds, const Make& make,
                const char* form = "tetrahedra") {
  return {name, form, fills_bounds, [make]() -> std::optional<Mesh> { return make(); }};
}

// Hexahedra of a curvilinear grid, other cells, cuboids.
SoakSource generated(const char* name, const char* form, const char* generator, int size,
                     double jitter, bool fills_bounds = true) {
  return {name, form, fills_bounds, [=]() -> std::optional<Mesh> {
            return generate(generator, {size, jitter, 7});
          }};
}

// Planes at uneven distances, 1e-6 to 1.
Mesh uneven(double scale, double offset) {
  Mesh mesh;
  for (std::size_t a = 0; a < 3; ++a) {
    std::vector<double> axis;
    for (const double x : {0.0, 0.1, 0.25, 0.250001, 0.5, 0.875, 1.0})
      axis.push_back(x * scale + offset);
    mesh.dimensions[a] = static_cast<std::int64_t>(axis.size());
    mesh.axes[a] = Array::own(std::move(axis));
  }
  mesh.fields = {
      {"zero", Association::point, 1, Array::own(std::vector<float>(mesh.point_count(), 0.0f))}};
  return mesh;
}

}  // namespace

const std::vector<SoakSource>& soak_sources() {
  static const std::vector<SoakSource> sources{
      made("clean, dyadic", true, [] { return box(8, 0); }),
      made("clean", true, [] { return box(5, 0); }),
      made("jittered", true, [] { return box(12, 0.2); }),
      made("jittered, finer", true, [] { return box(20, 0.25); }),
      made("inverted", true, [] { return box(10, 3); }),
      made("jittered, compact", true, [] { return box(12, 0.2); }),
      made("inverted, compact", true, [] { return box(10, 3); }),
      made("tangled", true, [] { return box(5, 10); }),
      made("slivers", true,
           [] {
             return scaled(box(10, 0.25), {1, 1, 1e-4});
           }),
      made("needles", true,
           [] {
             return scaled(box(10, 0.25), {1e-4, 1, 1e-4});
           }),
      made("flat layers", true, [] { return with_flat_layers(8); }),
      made("snapped", true, [] { return snapped(box(10, 0.4), 16); }),
      made("collapsed", false,
           [] {
             return scaled(box(6, 0.2), {1, 1, 0});
           }),
      made("leaning sheet", false, [] { return leaning(box(6, 0.2), 0); }),
      made("leaning slab", false, [] { return leaning(box(6, 0.2), 1e-6); }),
      made("shifted by 1e7", true,
           [] {
             return scaled(box(8, 0.2), {1, 1, 1}, 1e7);
           }),
      made("tiny, 1e-9", true,
           [] {
             return scaled(box(8, 0.2), {1e-9, 1e-9, 1e-9});
           }),
      made("slabs", false, [] { return slabs(8, 0.2); }),
      made("slabs, inverted", false, [] { return slabs(8, 2); }),
      made("ball", false,
           [] {
             return generate("ball-tetrahedra", {6, 0.2, 1});
           }),
      {"blunt fin", "tetrahedra", false, bench::mesh_sources().front().load},
      generated("grid, dyadic", "grid", "box-hexahedra", 8, 0),
      generated("grid", "grid", "box-hexahedra", 5, 0),
      generated("grid, jittered", "grid", "box-hexahedra", 10, 0.25),
      generated("grid, twisted", "grid", "twisted", 10, 0.2),
      generated("grid, inverted", "grid", "box-hexahedra", 8, 3),
      made(
          "grid, snapped", true,
          [] {
            return snapped(generate("box-hexahedra", {8, 0.6, 7}), 8);
          },
          "grid"),
      made(
          "grid, dented", true,
          [] {
            return moved(generate("box-hexahedra", {10, 0, 7}), [](const Place& p) {
              const bool here = std::hypot(p[0] - 0.5, p[1] - 0.5, p[2] - 0.5) < 0.01;
              return here ? Place{p[0] + 0.04, p[1] - 0.045, p[2] + 0.03} : p;
            });
          },
          "grid"),
      made(
          "grid, thin", true,
          [] {
            return scaled(generate("box-hexahedra", {8, 0.25, 7}), {1, 1, 1e-4});
          },
          "grid"),
      generated("grid, O", "grid", "o-grid", 5, 0.2, false),
      generated("grid, sphere", "grid", "sphere", 5, 0.2, false),
      generated("mixed, dyadic", "cells", "box-mixed", 8, 0),
      generated("mixed, jittered", "cells", "box-mixed", 8, 0.25),
      generated("mixed, inverted", "cells", "box-mixed", 6, 3),
      generated("wedges, jittered", "cells", "box-wedges", 8, 0.25),
      generated("two blocks", "cells", "two-blocks", 8, 0.2),
      generated("polyhedra, jittered", "cells", "box-polyhedra", 5, 0.25),
      generated("rectilinear, dyadic", "rectilinear", "box-rectilinear", 8, 0),
      made(
          "rectilinear, uneven", true, [] { return uneven(1, 0); }, "rectilinear"),
      made(
          "rectilinear, 1e-9", true, [] { return uneven(1e-9, 0); }, "rectilinear"),
      made(
          "rectilinear, far away", true, [] { return uneven(1, 1e7); }, "rectilinear"),
  };
  return sources;
}

}  // namespace plume::test
