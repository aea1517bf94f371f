#include "old_methods.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "cell_soup.h"
#include "plume/mesh/validate.h"
#include "plume/tests/bench/plucker_walker.h"
#include "plume/traverse/boundary.h"

namespace plume::atlas {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Place minus(const Place& a, const Place& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Place& a, const Place& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Place cross(const Place& a, const Place& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Place along(const Ray& ray, double t) {
  return {ray.origin[0] + t * ray.direction[0], ray.origin[1] + t * ray.direction[1],
          ray.origin[2] + t * ray.direction[2]};
}

// Where a ray hits a triangle, and the weights of its corners there.
struct Hit {
  double t, u, v, w;
};
using Intersect = std::optional<Hit> (*)(const CellSoup&, const CellSoup::Triangle&, const Ray&);

double scalar_at(const CellSoup& soup, const CellSoup::Triangle& triangle, const Hit& hit) {
  return hit.u * soup.scalars[triangle.points[0]] + hit.v * soup.scalars[triangle.points[1]] +
         hit.w * soup.scalars[triangle.points[2]];
}

std::optional<Hit> moeller_trumbore(const CellSoup& soup, const CellSoup::Triangle& triangle,
                                    const Ray& ray) {
  constexpr double kEpsilon = 1e-6;  // the paper's
  const Place& a = soup.points[triangle.points[0]];
  const Place e1 = minus(soup.points[triangle.points[1]], a);
  const Place e2 = minus(soup.points[triangle.points[2]], a);
  const Place p = cross(ray.direction, e2);
  const double det = dot(e1, p);
  if (det > -kEpsilon && det < kEpsilon) return std::nullopt;
  const Place s = minus(ray.origin, a);
  const double u = dot(s, p) / det;
  if (u < 0 || u > 1) return std::nullopt;
  const Place q = cross(s, e1);
  const double v = dot(ray.direction, q) / det;
  if (v < 0 || u + v > 1) return std::nullopt;
  return Hit{dot(e2, q) / det, 1 - u - v, u, v};
}

// Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection" (JCGT 2013), without its fallback
// to double precision.
std::optional<Hit> watertight(const CellSoup& soup, const CellSoup::Triangle& triangle,
                              const Ray& ray) {
  std::size_t z = 0;
  for (std::size_t a = 1; a < 3; ++a)
    if (std::abs(ray.direction[a]) > std::abs(ray.direction[z])) z = a;
  const std::size_t x = (z + 1) % 3, y = (z + 2) % 3;
  const auto dz = static_cast<float>(ray.direction[z]);
  const float sx = static_cast<float>(ray.direction[x]) / dz;
  const float sy = static_cast<float>(ray.direction[y]) / dz, sz = 1 / dz;
  float px[3], py[3], pz[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const Place& point = soup.points[triangle.points[i]];
    const auto relative = [&](std::size_t a) {
      return static_cast<float>(point[a]) - static_cast<float>(ray.origin[a]);
    };
    px[i] = relative(x) - sx * relative(z);
    py[i] = relative(y) - sy * relative(z);
    pz[i] = sz * relative(z);
  }
  const float u = px[2] * py[1] - py[2] * px[1], v = px[0] * py[2] - py[0] * px[2];
  const float w = px[1] * py[0] - py[1] * px[0];
  if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return std::nullopt;
  const float det = u + v + w;
  if (det == 0) return std::nullopt;
  const float t = (u * pz[0] + v * pz[1] + w * pz[2]) / det;
  return Hit{static_cast<double>(t), static_cast<double>(u / det), static_cast<double>(v / det),
             static_cast<double>(w / det)};
}

// The nearest triangle of the boundary beyond t: where a ray comes in.
std::optional<CellSoup::BoundaryTriangle> next_entry(const CellSoup& soup, const Ray& ray,
                                                     Intersect intersect, double beyond,
                                                     Hit& nearest) {
  std::optional<CellSoup::BoundaryTriangle> found;
  nearest.t = kInfinity;
  for (const auto& face : soup.boundary) {
    const auto hit = intersect(soup, soup.cells[face.cell].triangles[face.triangle], ray);
    if (hit && hit->t > beyond && hit->t < nearest.t) {
      nearest = *hit;
      found = face;
    }
  }
  return found;
}

std::size_t most_steps(const CellSoup& soup) { return 64 * soup.cells.size() + 64; }

// Only what lies beyond t_min is seen.
void add(AtlasWalk& walk, const Ray& ray, Span span) {
  if (span.t_out < ray.t_min) return;
  span.t_in = std::max(span.t_in, ray.t_min);
  walk.spans.push_back(span);
}

// Cell by cell, by whatever `leave(cell, from, t_in, s_in)` finds: the triangle by which the ray
// leaves the cell and where, or nothing. `from` is the cell that it comes from.
struct Exit {
  std::uint32_t neighbor;
  double t, scalar;
};
template <class Leave>
AtlasWalk walk_cells(const CellSoup& soup, const Ray& ray, Intersect enter, double step_over,
                     const Leave& leave) {
  AtlasWalk walk;
  const std::size_t most = most_steps(soup);
  std::size_t steps = 0;
  double t = -kInfinity;
  Hit hit{};
  while (const auto entry = next_entry(soup, ray, enter, t, hit)) {
    t = hit.t;
    double scalar = scalar_at(soup, soup.cells[entry->cell].triangles[entry->triangle], hit);
    std::uint32_t cell = entry->cell, from = CellSoup::kNobody;
    // A boundary triangle that is left through is hit like one that is entered: nothing lies
    // behind.
    bool first = true;
    while (cell != CellSoup::kNobody) {
      if (++steps > most) {
        walk.looping = true;
        return walk;
      }
      const std::optional<Exit> exit = leave(cell, from, t);
      if (!exit) {
        walk.lost = !first;
        if (walk.lost) return walk;
        break;
      }
      first = false;
      add(walk, ray, {cell, t, exit->t, scalar, exit->scalar});
      t = exit->t;
      scalar = exit->scalar;
      from = std::exchange(cell, exit->neighbor);
    }
    t += step_over;
  }
  return walk;
}

AtlasWalk walk_ray_triangle(const CellSoup& soup, const Ray& ray) {
  constexpr double kBeyond = 1e-6;
  return walk_cells(soup, ray, moeller_trumbore, kBeyond,
                    [&](std::uint32_t cell, std::uint32_t, double t_in) {
                      std::optional<Exit> exit;
                      for (const auto& triangle : soup.cells[cell].triangles) {
                        const auto hit = moeller_trumbore(soup, triangle, ray);
                        if (hit && hit->t > t_in + kBeyond && (!exit || hit->t < exit->t))
                          exit = {triangle.neighbor, hit->t, scalar_at(soup, triangle, *hit)};
                      }
                      return exit;
                    });
}

// A plane has no inside: the weights are those of the place in the plane.
std::optional<Hit> in_plane(const CellSoup& soup, const CellSoup::Triangle& triangle,
                            const Ray& ray, double t) {
  const Place& a = soup.points[triangle.points[0]];
  const Place e1 = minus(soup.points[triangle.points[1]], a);
  const Place e2 = minus(soup.points[triangle.points[2]], a);
  const Place normal = cross(e1, e2), at = minus(along(ray, t), a);
  const double area2 = dot(normal, normal);
  const double v = dot(cross(at, e2), normal) / area2, w = dot(cross(e1, at), normal) / area2;
  return Hit{t, 1 - v - w, v, w};
}

// The smallest weight, so that hits in the triangle are told without an epsilon.
std::optional<Hit> plane_hit(const CellSoup& soup, const CellSoup::Triangle& triangle,
                             const Ray& ray) {
  const Place& a = soup.points[triangle.points[0]];
  const Place normal =
      cross(minus(soup.points[triangle.points[1]], a), minus(soup.points[triangle.points[2]], a));
  const double slope = dot(normal, ray.direction);
  if (slope == 0) return std::nullopt;
  const auto hit = in_plane(soup, triangle, ray, dot(normal, minus(a, ray.origin)) / slope);
  if (!(hit->u >= 0 && hit->v >= 0 && hit->w >= 0)) return std::nullopt;
  return hit;
}

AtlasWalk walk_planes(const CellSoup& soup, const Ray& ray) {
  return walk_cells(soup, ray, plane_hit, 0,
                    [&](std::uint32_t cell, std::uint32_t from, double t_in) {
                      std::optional<Exit> exit;
                      for (const auto& triangle : soup.cells[cell].triangles) {
                        if (triangle.neighbor == from && from != CellSoup::kNobody) continue;
                        const Place& a = soup.points[triangle.points[0]];
                        Place normal = cross(minus(soup.points[triangle.points[1]], a),
                                             minus(soup.points[triangle.points[2]], a));
                        if (dot(normal, minus(soup.cells[cell].center, a)) > 0)
                          for (double& n : normal) n = -n;
                        const double slope = dot(normal, ray.direction);
                        if (!(slope > 0)) continue;
                        const double t = std::max(t_in, dot(normal, minus(a, ray.origin)) / slope);
                        if (!exit || t < exit->t)
                          exit = {triangle.neighbor, t,
                                  scalar_at(soup, triangle, *in_plane(soup, triangle, ray, t))};
                      }
                      return exit;
                    });
}

// Barycentric coordinates along the ray: at + t * slope.
struct Barycentric {
  std::array<double, 4> at, slope;

  Barycentric(const CellSoup& soup, const CellSoup::Cell& cell, const Ray& ray) {
    for (std::size_t i = 0; i < 4; ++i) {
      const Place& a = soup.points[cell.corners[(i + 1) % 4]];
      const Place normal = cross(minus(soup.points[cell.corners[(i + 2) % 4]], a),
                                 minus(soup.points[cell.corners[(i + 3) % 4]], a));
      const double height = dot(normal, minus(soup.points[cell.corners[i]], a));
      at[i] = dot(normal, minus(ray.origin, a)) / height;
      slope[i] = dot(normal, ray.direction) / height;
    }
  }
  double of(std::size_t i, double t) const { return at[i] + t * slope[i]; }
  bool holds(double t, double tolerance) const {
    for (std::size_t i = 0; i < 4; ++i)
      if (!(of(i, t) >= -tolerance)) return false;
    return true;
  }
};

AtlasWalk walk_barycentric(const CellSoup& soup, const Ray& ray) {
  constexpr double kTolerance = 1e-6;
  const double beyond = kTolerance * soup.size;
  return walk_cells(
      soup, ray, moeller_trumbore, beyond,
      [&](std::uint32_t cell, std::uint32_t, double t_in) -> std::optional<Exit> {
        const auto& corners = soup.cells[cell].corners;
        const Barycentric inside(soup, soup.cells[cell], ray);
        double t_out = kInfinity;
        std::size_t behind = 4;
        for (std::size_t i = 0; i < 4; ++i) {
          if (!(inside.slope[i] < 0)) continue;
          const double t = (-kTolerance - inside.at[i]) / inside.slope[i];
          if (t < t_out) {
            t_out = t;
            behind = i;
          }
        }
        if (behind == 4 || !(t_out > t_in)) return std::nullopt;
        double scalar = 0;
        for (std::size_t i = 0; i < 4; ++i)
          scalar += inside.of(i, t_out) * soup.scalars[corners[i]];
        // The neighbour across the face that leaves out that corner, else any around this cell.
        std::uint32_t next = CellSoup::kNobody;
        bool outside = false;
        for (const auto& triangle : soup.cells[cell].triangles)
          if (std::find(triangle.points.begin(), triangle.points.end(), corners[behind]) ==
              triangle.points.end()) {
            next = triangle.neighbor;
            outside = next == CellSoup::kNobody;
          }
        if (outside) return Exit{next, t_out, scalar};
        auto takes = [&](std::uint32_t c) {
          return c != CellSoup::kNobody &&
                 Barycentric(soup, soup.cells[c], ray).holds(t_out + beyond, kTolerance);
        };
        if (takes(next)) return Exit{next, t_out, scalar};
        for (const auto& triangle : soup.cells[cell].triangles)
          if (takes(triangle.neighbor)) return Exit{triangle.neighbor, t_out, scalar};
        return Exit{next, t_out, scalar};
      });
}

// What the rays of ConnectivityTracer do, one after the other.
AtlasWalk walk_bumped(const CellSoup& soup, const Ray& ray) {
  AtlasWalk walk;
  constexpr std::size_t kMostBumps = 4000;  // through twice the longest diagonal
  const double bump = 1e-3 * soup.size;
  const std::size_t most = most_steps(soup);
  std::size_t steps = 0;

  struct InOut {
    Hit in{kInfinity, 0, 0, 0}, out{-kInfinity, 0, 0, 0};
    const CellSoup::Triangle *first = nullptr, *last = nullptr;
  };
  auto intersect = [&](std::uint32_t cell) {
    InOut both;
    for (const auto& triangle : soup.cells[cell].triangles) {
      const auto hit = watertight(soup, triangle, ray);
      if (!hit) continue;
      if (hit->t < both.in.t) {
        both.in = *hit;
        both.first = &triangle;
      }
      if (hit->t > both.out.t) {
        both.out = *hit;
        both.last = &triangle;
      }
    }
    return both;
  };
  // A cell that holds the place, by the number of triangles that a ray of its own direction
  // crosses.
  auto locate = [&](double t) {
    Ray probe = ray;
    probe.origin = along(ray, t);
    for (std::uint32_t c = 0; c < soup.cells.size(); ++c) {
      double before = -kInfinity, after = kInfinity;
      int hits = 0;
      for (const auto& triangle : soup.cells[c].triangles)
        if (const auto hit = watertight(soup, triangle, probe)) {
          ++hits;
          (hit->t <= 0 ? before : after) = hit->t;
        }
      if (hits >= 2 && before > -kInfinity && after < kInfinity) return c;
    }
    return CellSoup::kNobody;
  };

  double t = -kInfinity;
  Hit hit{};
  while (const auto entry = next_entry(soup, ray, watertight, t, hit)) {
    std::uint32_t cell = entry->cell;
    t = hit.t;
    double reached = t;
    while (cell != CellSoup::kNobody) {
      if (++steps > most) {
        walk.looping = true;
        return walk;
      }
      const InOut both = intersect(cell);
      if (both.first == nullptr || both.out.t <= reached || both.in.t == both.out.t) {
        // Lost: moved on until another cell, or none, holds the place. Beyond the mesh there is
        // none, but for rounding.
        const std::uint32_t old = cell;
        double query = reached + bump;
        std::size_t bumps = 0;
        do {
          query += bump;
          cell = locate(query);
        } while (cell == old && ++bumps < kMostBumps);
        if (cell == old) {
          walk.looping = true;
          return walk;
        }
        reached = query;
        continue;
      }
      add(walk, ray,
          {cell, std::max(both.in.t, -kInfinity), both.out.t, scalar_at(soup, *both.first, both.in),
           scalar_at(soup, *both.last, both.out)});
      reached = both.out.t;
      cell = both.last->neighbor;
    }
    t = reached + 1e-5 * soup.size;
  }
  return walk;
}

// --- Plücker products

struct PluckerAudit : bench::CountingAudit {
  std::vector<std::uint32_t> cells;
  void come_to(std::uint32_t cell) { cells.push_back(cell); }
};
struct SpanConsumer {
  static constexpr bool kMeasures = true;
  std::vector<Span> spans;
  bool add(float t_in, float t_out, float s_in, float s_out) {
    spans.push_back({0, t_in, t_out, s_in, s_out});
    return true;
  }
};

MethodWalks plucker_walks(const SceneMesh& scene) {
  MethodWalks made{"Plücker products", false, false, Surface::faces, 0, {}};
  const Bounds bounds = check_structure(scene.mesh);
  const ScalarField field = select_field(scene.mesh);
  const WalkableTets tets = make_walkable_tets(scene.mesh, field, bounds, true);
  const bench::PluckerMesh mesh =
      bench::make_plucker_mesh(scene.mesh, find_tet_adjacency(scene.mesh, field, bounds));
  const BoundaryIndex<TetWalker> boundary(tets);
  for (const Ray& ray : scene.rays) {
    AtlasWalk& walk = made.walks.emplace_back();
    ShearedFrame frame;
    if (!frame.set(ray, tets.frame)) continue;
    const TetWalker walker(tets, frame);
    Entries<TetWalker> entries;
    for (auto entry = entries.first(boundary, walker, frame); entry;
         entry = entries.next(boundary, walker, frame)) {
      SpanConsumer consumer;
      PluckerAudit audit;
      const bench::PluckerWalk result = bench::walk_plucker<bench::PluckerProducts::thesis>(
          mesh, bench::PluckerRay(ray, mesh.frame), tets.boundary[entry->boundary], consumer,
          audit);
      for (std::size_t i = 0; i < consumer.spans.size(); ++i) {
        consumer.spans[i].cell = tets.original_cell(audit.cells[i]);
        add(walk, ray, consumer.spans[i]);
      }
      if (result.lost) (result.cells >= bench::kPluckerLongest ? walk.looping : walk.lost) = true;
    }
    // A loop's spans are of no use.
    if (walk.looping) walk.spans.clear();
  }
  return made;
}

bool has_direction(const Ray& ray) {
  double length2 = 0;
  for (const double d : ray.direction) length2 += d * d;
  return length2 > 0 && std::isfinite(length2);
}

}  // namespace

std::vector<MethodWalks> old_walks(const SceneMesh& scene) {
  std::vector<MethodWalks> all;
  const CellSoup soup(scene.mesh);
  auto run = [&](const char* name, AtlasWalk (*walk)(const CellSoup&, const Ray&)) {
    MethodWalks made{name, false, false, Surface::fans, 0, {}};
    for (const Ray& ray : scene.rays)
      made.walks.push_back(has_direction(ray) ? walk(soup, ray) : AtlasWalk{});
    all.push_back(std::move(made));
  };
  if (soup.only_tetrahedra) all.push_back(plucker_walks(scene));
  run("ray-triangle test", walk_ray_triangle);
  run("face planes", walk_planes);
  if (soup.only_tetrahedra) run("barycentric, tolerance", walk_barycentric);
  run("bump", walk_bumped);
  return all;
}

}  // namespace plume::atlas
