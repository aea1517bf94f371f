/// Cells of any number of corners as packets of rays read them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace plume {

struct WalkableCells;

/// Each cell's corners and edges, each once, in numbers of the cell's own: a ray's step through a
/// cell shears each corner and decides each edge once, with vector instructions.
///
/// A cell's record, in words of 32 bits:
///   - the number of its corners, of its edges and of its faces, eight bits each from the lowest;
///   - a word a corner: twice the point's number; the last one again to make a multiple of four,
///   which
///     that number is;
///   - a word an edge: its two corners and the two faces that it lies between, eight bits each from
///     the lowest;
///   - a word a face, in the order of WalkableCells::faces_of(): a bit for each of its corners,
///   none
///     where the face is a triangle, which a ray crosses once or not at all.
struct EdgeCells {
  std::vector<std::uint32_t> begin;  ///< of each cell's record in `words`; kNone where it has none
  std::vector<std::uint32_t> words;  ///< and some more, so that vectors may be read beyond a record

  bool empty() const { return begin.empty(); }
  std::size_t bytes() const { return (begin.size() + words.size()) * sizeof(std::uint32_t); }
};

/// Corners, and faces, of a cell that has a record.
inline constexpr std::uint32_t kMostEdgeCellCorners = 32;

/// Records of the mesh's cells that are no CornerCell, of all where there are no corner_cells, in
/// parallel: 4 bytes a cell, 4 more a record, 4 for each corner, edge and face (158 a cell of a
/// honeycomb). None of
/// cells with more than kMostEdgeCellCorners corners or faces or more than 255 edges; empty where
/// no cell has one.
EdgeCells make_edge_cells(const WalkableCells& mesh);

}  // namespace plume
