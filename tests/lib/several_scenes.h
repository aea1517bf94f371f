/// Meshes cut in two and moved, for the tests of several scenes in one picture.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "plume/lib/plume.h"
#include "plume/mesh/explicit_cells.h"
#include "plume/tests/lib/interval_scenes.h"

namespace plume::test {

/// The cells about whose corners' mean `keep` says so, with the points that they use; the field
/// "value" goes with them.
inline Mesh cells_where(const Mesh& mesh, const std::function<bool(const Point&)>& keep) {
  const CellReader cells(mesh);
  const Array& all_values = mesh.fields[0].values;
  std::vector<std::int64_t> number(mesh.point_count(), -1), offsets{0}, connectivity;
  std::vector<std::uint8_t> types;
  std::vector<double> points, values;
  std::vector<std::uint32_t> ids;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    cells.points(cell, ids);
    Point middle{0, 0, 0};
    for (const std::uint32_t id : ids)
      for (std::size_t a = 0; a < 3; ++a)
        middle[a] += point_at(mesh, id)[a] / static_cast<double>(ids.size());
    if (!keep(middle)) continue;
    types.push_back(static_cast<std::uint8_t>(cells.type(cell)));
    for (const std::uint32_t id : ids) {
      if (number[id] < 0) {
        number[id] = static_cast<std::int64_t>(values.size());
        for (const double x : point_at(mesh, id)) points.push_back(x);
        values.push_back(all_values.at<double>(id));
      }
      connectivity.push_back(number[id]);
    }
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
  Mesh part;
  part.points = Array::own(std::move(points));
  part.cells.types = Array::own(std::move(types));
  part.cells.offsets = Array::own(std::move(offsets));
  part.cells.connectivity = Array::own(std::move(connectivity));
  part.fields = {{"value", Association::point, 1, Array::own(std::move(values))}};
  part.active_field = "value";
  return part;
}

/// Scaled, then moved.
inline Mesh moved(Mesh mesh, double scale, const Point& by) {
  std::vector<double> points;
  for (std::size_t p = 0; p < mesh.point_count(); ++p)
    for (std::size_t a = 0; a < 3; ++a) points.push_back(scale * point_at(mesh, p)[a] + by[a]);
  mesh.points = Array::own(std::move(points));
  return mesh;
}

/// Scenes and pointers to them, as render() takes them.
struct Scenes {
  std::vector<Scene> all;

  void add(const Mesh& mesh, const SceneOptions& options, const Classification& classification) {
    all.emplace_back(mesh, options);
    all.back().set_classification(classification);
  }
  std::vector<const Scene*> pointers() const {
    std::vector<const Scene*> list;
    for (const Scene& scene : all) list.push_back(&scene);
    return list;
  }
  std::vector<const Scene*> reversed() const {
    const auto list = pointers();
    return {list.rbegin(), list.rend()};
  }
};

/// A field that is linear nowhere.
inline double wavy(const Point& p) {
  return 3 + 2 * std::sin(5 * p[0] + 3 * p[1]) * std::cos(4 * p[2]);
}

/// Of four knots.
inline Classification volume_alone() {
  Classification volume;
  volume.volume = TransferFunction{{{0, {0.2f, {0, 0.1f, 1}}},
                                    {2, {1, {0.5f, 1, 0}}},
                                    {3, {4, {1, 0, 0}}},
                                    {5, {0, {1, 1, 1}}}}};
  return volume;
}

}  // namespace plume::test
