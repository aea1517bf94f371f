#include "plume/mesh/closed_cell.h"

#include <algorithm>
#include <array>

#include "plume/mesh/explicit_cells.h"

namespace plume {
namespace {

struct Edge {
  std::uint32_t low, high;
  std::uint32_t face;
  bool forward;  // walked from low to high
  bool operator<(const Edge& other) const {
    return low != other.low ? low < other.low : high < other.high;
  }
  bool same_place(const Edge& other) const { return low == other.low && high == other.high; }
};

std::vector<Edge> edges_of(const CellFaces& faces) {
  std::vector<Edge> edges;
  edges.reserve(faces.ids.size());
  std::size_t at = 0;
  for (std::uint32_t f = 0; f < faces.sizes.size(); ++f) {
    const std::uint32_t size = faces.sizes[f];
    for (std::uint32_t i = 0; i < size; ++i) {
      const std::uint32_t a = faces.ids[at + i];
      const std::uint32_t b = faces.ids[at + (i + 1) % size];
      edges.push_back({std::min(a, b), std::max(a, b), f, a < b});
    }
    at += size;
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

void reverse_loops(CellFaces& faces, const std::vector<std::uint8_t>& turned) {
  auto at = faces.ids.begin();
  for (std::size_t f = 0; f < faces.sizes.size(); ++f) {
    if (turned[f]) std::reverse(at, at + faces.sizes[f]);
    at += faces.sizes[f];
  }
}

}  // namespace

void drop_repeated_points(CellFaces& faces) {
  std::size_t read = 0, write = 0, kept = 0;
  for (const std::uint32_t size : faces.sizes) {
    const std::size_t begin = write;
    for (std::size_t i = 0; i < size; ++i) {
      const std::uint32_t id = faces.ids[read + i];
      if (write == begin || faces.ids[write - 1] != id) faces.ids[write++] = id;
    }
    read += size;
    while (write > begin + 1 && faces.ids[write - 1] == faces.ids[begin]) --write;
    if (write - begin < 3)
      write = begin;
    else
      faces.sizes[kept++] = static_cast<std::uint32_t>(write - begin);
  }
  faces.ids.resize(write);
  faces.sizes.resize(kept);
}

bool is_closed(const CellFaces& faces) {
  const auto edges = edges_of(faces);
  for (auto group = edges.begin(); group != edges.end();) {
    int balance = 0;
    const auto first = group;
    for (; group != edges.end() && group->same_place(*first); ++group)
      balance += group->forward ? 1 : -1;
    if (balance != 0) return false;
  }
  return true;
}

bool close_and_orient(const Mesh& mesh, CellFaces& faces) {
  const auto edges = edges_of(faces);
  // Neighbours across each edge; agreeing ones walk it in opposite directions.
  struct Link {
    std::uint32_t face;
    bool agree;
  };
  std::vector<std::vector<Link>> links(faces.sizes.size());
  for (auto edge = edges.begin(); edge != edges.end(); edge += 2) {
    const auto next = edge + 1;
    if (next == edges.end() || !next->same_place(*edge)) return false;
    if (next + 1 != edges.end() && (next + 1)->same_place(*edge)) return false;
    const bool agree = edge->forward != next->forward;
    links[edge->face].push_back({next->face, agree});
    links[next->face].push_back({edge->face, agree});
  }
  constexpr std::uint8_t kUnseen = 2;
  std::vector<std::uint8_t> turned(faces.sizes.size(), kUnseen);
  std::vector<std::uint32_t> queue;
  for (std::uint32_t seed = 0; seed < turned.size(); ++seed) {
    if (turned[seed] != kUnseen) continue;
    turned[seed] = 0;
    queue.assign(1, seed);
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (const Link& link : links[queue[i]]) {
        const auto wanted =
            static_cast<std::uint8_t>(link.agree ? turned[queue[i]] : !turned[queue[i]]);
        if (turned[link.face] == kUnseen) {
          turned[link.face] = wanted;
          queue.push_back(link.face);
        } else if (turned[link.face] != wanted) {
          return false;
        }
      }
    }
  }
  reverse_loops(faces, turned);
  if (signed_volume(mesh, faces.sizes, faces.ids) < 0)
    reverse_loops(faces, std::vector<std::uint8_t>(faces.sizes.size(), 1));
  return true;
}

}  // namespace plume
