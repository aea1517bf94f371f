/// The three surfaces that a walker of grids may take a face for: which crossings it has, and
/// where. Each walks without a hole, as both cells at a face take it for the same surface.
#pragma once

#include "plume/traverse/measure_quad.h"

namespace plume {

/// Two triangles, cut along a diagonal that both cells agree on: pure Plücker, after Garrity (1990)
/// and the thesis' section 6.4.2.1. Differs from the bilinear patch by up to half of the distance
/// between the middles of its diagonals; the scalar has a crease along the cut.
struct TriangleFaces {
  static constexpr bool kGrazed = true;
  static constexpr bool kAsksIfPlanar = false;
  static QuadCrossings crossings(const Quad& quad, int winding, bool) {
    return triangle_crossings(quad, winding);
  }
  static Crossing measure(const Quad& quad, const QuadCrossings&, int rank, bool) {
    return measure_half(quad, rank);
  }
};

/// The thesis' hybrid (section 6.4.2.2): edges decide, bilinear patches measure. A twisted face
/// that is grazed counts as missed: what is behind it is seen as part of the cell in front. The
/// thesis tries up to three patches a cell; here edges decide for good, and one is measured.
struct PatchFaces {
  static constexpr bool kGrazed = false;
  static constexpr bool kAsksIfPlanar = false;
  static QuadCrossings crossings(const Quad&, int winding, bool) {
    return planar_crossings(winding);
  }
  static Crossing measure(const Quad& quad, const QuadCrossings& crossings, int rank, bool) {
    return measure_patch(quad, crossings.direction[rank], false);
  }
};

/// Ours: bilinear patches with all their crossings where they are twisted; planar faces cannot be
/// grazed, and take the cheap path.
struct PlanarOrPatchFaces {
  static constexpr bool kGrazed = true;
  static constexpr bool kAsksIfPlanar = true;
  static QuadCrossings crossings(const Quad& quad, int winding, bool planar) {
    return planar ? planar_crossings(winding) : patch_crossings(quad, winding);
  }
  static Crossing measure(const Quad& quad, const QuadCrossings& crossings, int rank, bool planar) {
    if (planar) return measure_planar(quad, crossings.direction[rank]);
    return measure_patch(quad, crossings.direction[rank], crossings.grazed());
  }
};

}  // namespace plume
