// The seam of all readers: whatever the arrays of a Mesh, Scene takes it or throws one Error; and
// of what it takes no ray is lost.

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "bytes.h"
#include "plume/lib/plume.h"
#include "plume/mesh/error.h"
#include "plume/mesh/validate.h"

namespace plume::fuzz {
namespace {

double number(Bytes& bytes) {
  switch (bytes.below(16)) {
    case 0:
      return bytes.take<double>();  // any bits
    case 1:
      return static_cast<double>(bytes.take<float>());
    case 2: {
      constexpr double kOdd[] = {0,      -0.0, 1e300,  -1e300,
                                 1e-300, 1e38, -1e-45, 1e-40,
                                 1.0,    4e9,  3.5e38, std::numeric_limits<double>::infinity()};
      return kOdd[bytes.below(std::size(kOdd))];
    }
    default:
      return bytes.coarse();
  }
}

Array numbers(Bytes& bytes, std::size_t count) {
  if (bytes.below(2) == 0) {
    std::vector<double> values(count);
    for (double& x : values) x = number(bytes);
    return Array::own(std::move(values));
  }
  std::vector<float> values(count);
  for (float& x : values) {
    const double wide = number(bytes);
    // Out of a float's range the conversion is undefined.
    x = std::abs(wide) <= 3e38 ? static_cast<float>(wide) : std::numeric_limits<float>::infinity();
  }
  return Array::own(std::move(values));
}

// Mostly within [0, limit), now and then not.
std::int64_t id(Bytes& bytes, std::size_t limit) {
  const std::uint8_t byte = bytes.take<std::uint8_t>();
  if (byte == 0xFF) return bytes.take<std::int64_t>();
  if (byte == 0xFE) return -1;
  return limit == 0 ? 0 : static_cast<std::int64_t>(byte % (limit + (byte >= 0xF0 ? 1 : 0)));
}

Array ids(Bytes& bytes, std::size_t count, std::size_t limit) {
  const bool wide = bytes.below(2) == 0;
  std::vector<std::int64_t> values(count);
  for (auto& x : values) x = id(bytes, limit);
  if (wide) return Array::own(std::move(values));
  std::vector<std::int32_t> narrow;
  for (const auto x : values) narrow.push_back(static_cast<std::int32_t>(x));
  return Array::own(std::move(narrow));
}

// As many as there should be, or nearly.
std::size_t about(Bytes& bytes, std::size_t count) {
  const std::uint8_t byte = bytes.take<std::uint8_t>();
  if (byte < 0xF0) return count;
  const std::size_t off = 1 + byte % 3;
  return byte % 2 == 0 ? count + off : count - std::min(count, off);
}

CellType type_of(Bytes& bytes) {
  constexpr CellType kTypes[] = {CellType::tetrahedron,     CellType::voxel,
                                 CellType::hexahedron,      CellType::wedge,
                                 CellType::pyramid,         CellType::pentagonal_prism,
                                 CellType::hexagonal_prism, CellType::polyhedron};
  const std::uint8_t byte = bytes.take<std::uint8_t>();
  if (byte == 0xFF) return static_cast<CellType>(bytes.take<std::uint8_t>());
  return kTypes[byte % std::size(kTypes)];
}

void explicit_cells(Bytes& bytes, Mesh& mesh) {
  const std::size_t points = bytes.below(20);
  mesh.points = numbers(bytes, about(bytes, 3 * points));
  const std::size_t cells = bytes.below(12);
  const bool one_type = bytes.below(2) == 0;
  std::vector<std::uint8_t> types;
  std::vector<std::int64_t> offsets{0}, locations, faces;
  std::size_t connectivity = 0;
  CellType type = type_of(bytes);
  bool polyhedra = false;
  for (std::size_t c = 0; c < cells; ++c) {
    if (!one_type) type = type_of(bytes);
    types.push_back(static_cast<std::uint8_t>(type));
    const int fixed = is_volume_cell_type(static_cast<int>(type)) ? points_per_cell(type) : 4;
    connectivity += fixed > 0 ? static_cast<std::size_t>(fixed) : bytes.below(9);
    offsets.push_back(static_cast<std::int64_t>(connectivity) + (bytes.below(64) == 63 ? 5 : 0));
    if (type == CellType::polyhedron) {
      polyhedra = true;
      locations.push_back(bytes.below(64) == 63 ? id(bytes, 50)
                                                : static_cast<std::int64_t>(faces.size()));
      const std::size_t count = bytes.below(8);
      faces.push_back(bytes.below(64) == 63 ? id(bytes, 9) : static_cast<std::int64_t>(count));
      for (std::size_t f = 0; f < count; ++f) {
        const std::size_t size = bytes.below(6);
        faces.push_back(bytes.below(64) == 63 ? id(bytes, 9) : static_cast<std::int64_t>(size));
        for (std::size_t p = 0; p < size; ++p) faces.push_back(id(bytes, points));
      }
    } else {
      locations.push_back(-1);
    }
  }
  if (one_type && !types.empty() && bytes.below(2) == 0) types.resize(1);
  mesh.cells.types = Array::own(std::move(types));
  if (!one_type || type == CellType::polyhedron || bytes.below(2) == 0) {
    if (bytes.below(32) == 31 && !offsets.empty()) offsets.pop_back();
    mesh.cells.offsets = Array::own(std::move(offsets));
  }
  mesh.cells.connectivity = ids(bytes, about(bytes, connectivity), points);
  if (polyhedra) {
    mesh.cells.polyhedron_locations = Array::own(std::move(locations));
    mesh.cells.polyhedron_faces = Array::own(std::move(faces));
  }
}

void grid(Bytes& bytes, Mesh& mesh) {
  std::size_t points = 1;
  for (auto& n : mesh.dimensions) {
    n = static_cast<std::int64_t>(1 + bytes.below(4));
    points *= static_cast<std::size_t>(n);
  }
  if (bytes.below(32) == 31) mesh.dimensions[bytes.below(3)] = bytes.take<std::int64_t>();
  mesh.points = numbers(bytes, about(bytes, 3 * points));
}

void rectilinear(Bytes& bytes, Mesh& mesh) {
  for (std::size_t a = 0; a < 3; ++a) {
    mesh.dimensions[a] = static_cast<std::int64_t>(1 + bytes.below(5));
    std::vector<double> axis;
    double x = bytes.coarse();
    const std::size_t count = about(bytes, static_cast<std::size_t>(mesh.dimensions[a]));
    for (std::size_t i = 0; i < count; ++i) {
      axis.push_back(x);
      x = bytes.below(16) == 15 ? number(bytes) : x + bytes.below(8) / 8.0;
    }
    mesh.axes[a] = Array::own(std::move(axis));
  }
  if (bytes.below(32) == 31) mesh.dimensions[bytes.below(3)] = bytes.take<std::int64_t>();
}

Mesh make_mesh(Bytes& bytes) {
  Mesh mesh;
  switch (bytes.below(4)) {
    case 0:
      grid(bytes, mesh);
      break;
    case 1:
      rectilinear(bytes, mesh);
      break;
    default:
      explicit_cells(bytes, mesh);
  }
  const auto size = [](std::size_t (Mesh::*count)() const, const Mesh& of) {
    const std::size_t n = (of.*count)();
    return n < 1000 ? n : 0;
  };
  if (mesh.is_grid() && bytes.below(3) == 0) {
    std::vector<std::uint8_t> hidden(about(bytes, size(&Mesh::cell_count, mesh)));
    for (auto& h : hidden) h = bytes.take<std::uint8_t>() & 1;
    mesh.hidden_cells = Array::own(std::move(hidden));
  }
  const std::size_t fields = bytes.below(3);
  for (std::size_t f = 0; f < fields; ++f) {
    const bool on_points = bytes.below(2) == 0;
    const int components = bytes.below(8) == 7 ? 3 : 1;
    const std::size_t count = size(on_points ? &Mesh::point_count : &Mesh::cell_count, mesh);
    mesh.fields.push_back(
        {std::string(1, static_cast<char>('a' + f)),
         on_points ? Association::point : Association::cell, components,
         numbers(bytes, about(bytes, count * static_cast<std::size_t>(components)))});
  }
  return mesh;
}

void look_at(const Scene& scene, Bytes& bytes) {
  const Bounds bounds = scene.bounds();
  for (int i = 0; i < 12; ++i) {
    Ray ray;
    for (std::size_t a = 0; a < 3; ++a) {
      const double size = bounds.high[a] - bounds.low[a];
      ray.origin[a] = bounds.center()[a] + bytes.coarse() * size;
      ray.direction[a] = bytes.coarse();
    }
    if (bytes.below(2) == 0) ray.t_min = -std::numeric_limits<double>::infinity();
    double until = ray.t_min;
    const ScalarOrder order = static_cast<ScalarOrder>(1 + i % 3);
    const TraceResult result = scene.trace(
        ray,
        [&](const Segment& s) {
          if (!(s.t_in <= s.t_out) || s.t_in < until) fail("segments go back");
          until = s.t_out;
          return true;
        },
        order);
    if (result.end != WalkEnd::left) fail("a ray is lost");
  }
}

}  // namespace
}  // namespace plume::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plume;
  if (size > 4096) return 0;
  fuzz::Bytes bytes(data, size);
  try {
    const Mesh mesh = fuzz::make_mesh(bytes);
    SceneOptions options;
    options.keep_cell_numbers = bytes.below(2) == 0;
    if (bytes.below(4) == 0) options.cell_data = CellData::averaged;
    options.keep_gradients = bytes.below(4) == 0;
    const Scene scene(mesh, options);
    find_poor_cells(mesh);
    scene.connected_part_count();
    fuzz::look_at(scene, bytes);
    RenderSettings settings;
    settings.width = settings.height = 4;
    settings.threads = 1;
    if (scene.bounds().diagonal() > 0) {
      const RenderResult result =
          render(scene, fitted_camera(scene.bounds(), {1, 0.5, 0.25}), settings);
      if (result.statistics.lost_rays > 0) fuzz::fail("a ray of a picture is lost");
      for (const float value : result.image.rgba)
        if (!std::isfinite(value)) fuzz::fail("a pixel is not a number");
    }
  } catch (const Error&) {
  }
  return 0;
}
