#include "plume/tests/bench/bench_views.h"

#include "plume/lib/camera.h"

namespace plume::bench {
namespace {

// Every second bit of a number, from the lowest on.
std::uint32_t even_bits(std::uint64_t number) {
  std::uint32_t bits = 0;
  for (unsigned b = 0; b < 32; ++b) bits |= static_cast<std::uint32_t>(number >> (2 * b) & 1) << b;
  return bits;
}

}  // namespace

BenchView make_view(const BenchMesh& mesh, const BoundaryIndex<TetWalker>& boundary,
                    std::string name, const std::vector<Ray>& rays) {
  BenchView view{std::move(name), {}, {}};
  for (const Ray& ray : rays) {
    ShearedFrame frame;
    if (!frame.set(ray, mesh.tets.frame)) continue;
    const TetWalker walker(mesh.tets, frame);
    const auto number = static_cast<std::uint32_t>(view.rays.size());
    Entries<TetWalker> entries;
    auto entry = entries.first(boundary, walker, frame);
    if (entry) view.rays.push_back(ray);
    for (; entry; entry = entries.next(boundary, walker, frame))
      view.passages.push_back({number, *entry});
  }
  return view;
}

std::vector<BenchView> make_views(const BenchMesh& mesh, int resolution, std::uint64_t tiles) {
  const BoundaryIndex<TetWalker> boundary(mesh.tets);
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

}  // namespace plume::bench
