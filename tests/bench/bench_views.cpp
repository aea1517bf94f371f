#include "plume/tests/bench/bench_views.h"

#include <cmath>
#include <optional>
#include <utility>

#include "plume/lib/camera.h"

namespace plume::bench {
namespace {

// Every second bit of a number, from the lowest on.
std::uint32_t even_bits(std::uint64_t number) {
  std::uint32_t bits = 0;
  for (unsigned b = 0; b < 32; ++b) bits |= static_cast<std::uint32_t>(number >> (2 * b) & 1) << b;
  return bits;
}

// The way in through the same face that another walker finds; the nearest where there are two.
template <class Walker>
std::optional<Entry> same_way_in(const WalkableGrid& grid, const ShearedFrame& frame,
                                 const Entry& entry) {
  std::optional<Entry> found;
  auto distance = [&](double z) { return std::abs(z - entry.place.z); };
  Walker(grid, frame)
      .ways_in(grid.boundary[entry.boundary], [&](const Crossing& place, std::uint32_t rank) {
        if (!found || distance(place.z) < distance(found->place.z))
          found = Entry{place, entry.boundary, rank};
      });
  return found;
}

template <class Walker>
std::vector<BenchView> views_through(const BenchMesh& mesh, int resolution, std::uint64_t tiles) {
  const BoundaryIndex<Walker> boundary(form_of<typename Walker::Mesh>(mesh));
  std::vector<BenchView> views;
  for (const char* name : {"+x", "+y", "+z", "iso"}) {
    Camera camera = named_view(name, mesh.bounds);
    orbit(camera, 3, 2);
    const PixelRays pixel_rays(camera, resolution, resolution);
    std::vector<Ray> rays;
    std::uint64_t side = 1;
    while (side < static_cast<std::uint64_t>(resolution)) side *= 2;
    for (std::uint64_t place = 0; place < side * side; ++place) {
      if (place / (32 * 32) % tiles != 0) continue;
      const std::uint32_t x = even_bits(place), y = even_bits(place >> 1);
      if (x < static_cast<std::uint32_t>(resolution) && y < static_cast<std::uint32_t>(resolution))
        rays.push_back(pixel_rays(x + 0.5, y + 0.5));
    }
    views.push_back(make_view(mesh, boundary, name, rays));
  }
  return views;
}

}  // namespace

void BenchView::leave_out(std::span<const std::uint32_t> unwanted) {
  std::size_t kept = 0, next = 0;
  for (std::size_t i = 0; i < passages.size(); ++i) {
    if (next < unwanted.size() && unwanted[next] == i) {
      ++next;
      continue;
    }
    passages[kept] = passages[i];
    if (!triangle_entries.empty()) triangle_entries[kept] = triangle_entries[i];
    ++kept;
  }
  passages.resize(kept);
  if (!triangle_entries.empty()) triangle_entries.resize(kept);
}

template <class Walker>
BenchView make_view(const BenchMesh& mesh, const BoundaryIndex<Walker>& boundary, std::string name,
                    const std::vector<Ray>& rays) {
  const auto& form = form_of<typename Walker::Mesh>(mesh);
  BenchView view;
  view.name = std::move(name);
  for (const Ray& ray : rays) {
    ShearedFrame frame;
    if (!frame.set(ray, form.frame)) continue;
    const Walker walker(form, frame);
    const auto number = static_cast<std::uint32_t>(view.rays.size());
    Entries<Walker> entries;
    auto entry = entries.first(boundary, walker, frame);
    if (entry) view.rays.push_back(ray);
    for (; entry; entry = entries.next(boundary, walker, frame)) {
      if constexpr (std::is_same_v<Walker, GridWalker>) {
        const auto hybrid = same_way_in<HybridGridWalker>(form, frame, *entry);
        const auto triangle = same_way_in<PluckerGridWalker>(form, frame, *entry);
        if (!hybrid || hybrid->rank != entry->rank || !triangle) {
          ++view.left_out;
          continue;
        }
        view.triangle_entries.push_back(*triangle);
      }
      view.passages.push_back({number, *entry});
    }
  }
  return view;
}

template BenchView make_view(const BenchMesh&, const BoundaryIndex<TetWalker>&, std::string,
                             const std::vector<Ray>&);
template BenchView make_view(const BenchMesh&, const BoundaryIndex<GridWalker>&, std::string,
                             const std::vector<Ray>&);
template BenchView make_view(const BenchMesh&, const BoundaryIndex<CellWalker>&, std::string,
                             const std::vector<Ray>&);

std::vector<BenchView> make_views(const BenchMesh& mesh, int resolution, std::uint64_t tiles) {
  switch (mesh.family) {
    case Family::tetrahedra:
      return views_through<TetWalker>(mesh, resolution, tiles);
    case Family::hexahedra:
      return views_through<GridWalker>(mesh, resolution, tiles);
    case Family::cells:
      return views_through<CellWalker>(mesh, resolution, tiles);
  }
  return {};
}

}  // namespace plume::bench
