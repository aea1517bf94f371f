#include "plume/preint/classified_pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plume/preint/closed_form.h"
#include "plume/preint/pieces.h"

namespace plume {
namespace {

constexpr float kFloor = std::numeric_limits<float>::lowest();
constexpr float kTop = std::numeric_limits<float>::infinity();

// The first scalar above a bound.
float first_above(const ScalarRanges::Bound& bound) {
  return bound.equal_is_below ? std::nextafter(bound.scalar, kTop) : bound.scalar;
}

float slope(double from, double to, double width) {
  constexpr double kMost = std::numeric_limits<float>::max();
  return width > 0 && width < kMost
             ? static_cast<float>(std::clamp((to - from) / width, -kMost, kMost))
             : 0.0f;
}

// A place where a range is cut, and where that is on the axis of the optics from either side: the
// same but where several knots of a profile come to lie on one float.
struct Cut {
  float scalar;
  double before, behind;
};

}  // namespace

class ClassifiedPieces::Maker {
 public:
  Maker(ClassifiedPieces& table, const Classification& classification)
      : table_(table),
        classification_(classification),
        ranges_(classification),
        volume_(classification.volume.value_or(TransferFunction{{{0, {}}}})) {}

  void make() {
    for (std::size_t range = 0; range <= ranges_.bound_count(); ++range) {
      const std::int32_t interval = ranges_.interval_of(range);
      if (interval == ScalarRanges::kNothing)
        add_range(
            range, volume_, 0, kVolume, [](double knot) { return knot; },
            [](float scalar) { return scalar; });
      else
        add_interval(range, interval);
      if (range < ranges_.bound_count()) add_surface(ranges_.bound(range));
    }
  }

 private:
  void add_interval(std::size_t range, std::int32_t interval) {
    const auto& profile = classification_.intervals[static_cast<std::size_t>(interval)].profile;
    const double width =
        static_cast<double>(ranges_.high(interval)) - static_cast<double>(ranges_.low(interval));
    const float w_per_scalar = static_cast<float>(1 / width);
    // Below, pieces and their slopes would overflow or be lost to denormal numbers.
    if (!(width > 1e-30)) table_.in_single_precision_ = false;
    add_range(
        range, Pieces(profile), w_per_scalar, static_cast<float>(interval + 1),
        [&](double w) { return ranges_.scalar_of(interval, static_cast<float>(w)); },
        [&](float scalar) { return ranges_.w_of(interval, scalar); });
  }

  // A range whose optics are those of `optics`, whose axis to_scalar() and from_scalar() relate to
  // the scalar.
  template <class ToScalar, class FromScalar>
  void add_range(std::size_t range, const Pieces& optics, float w_per_scalar, float kind,
                 const ToScalar& to_scalar, const FromScalar& from_scalar) {
    const bool lowest = range == 0, highest = range == ranges_.bound_count();
    const float low = lowest ? kFloor : ranges_.bound(range - 1).scalar;
    const float high = highest ? kTop : ranges_.bound(range).scalar;
    const float first = lowest ? kFloor : first_above(ranges_.bound(range - 1));
    const float end = highest ? kTop : first_above(ranges_.bound(range));
    std::vector<Cut> cuts{{low, from_scalar(low), from_scalar(low)}};
    for (std::size_t k = 1; k + 1 < optics.knot_count(); ++k) {
      const float scalar = static_cast<float>(to_scalar(optics.scalar(k)));
      if (!(scalar > low && scalar < high)) continue;
      if (cuts.size() > 1 && cuts.back().scalar == scalar)
        cuts.back().behind = optics.scalar(k);
      else
        cuts.push_back({scalar, optics.scalar(k), optics.scalar(k)});
    }
    // Where there is no upper end, optics are constant.
    const double top = highest ? cuts.back().behind : from_scalar(high);
    cuts.push_back({high, top, top});
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const bool last = i + 2 == cuts.size();
      const PreciseOptics front = optics.at(cuts[i].behind);
      const PreciseOptics back =
          last && highest ? front
                          : optics.at(optics.piece_below(cuts[i + 1].before), cuts[i + 1].before);
      add({cuts[i].scalar, cuts[i + 1].scalar}, i == 0 ? first : cuts[i].scalar,
          last ? end : cuts[i + 1].scalar, w_per_scalar, kind, front, back);
    }
  }

  void add(const Ends& ends, float first, float end, float w_per_scalar, float kind,
           const PreciseOptics& front, const PreciseOptics& back) {
    const double width = static_cast<double>(ends.high) - ends.low;
    Piece piece{};
    piece.low = ends.low;
    piece.high = ends.high;
    piece.extinction = static_cast<float>(front.extinction);
    piece.extinction_slope = slope(front.extinction, back.extinction, width);
    piece.first = first;
    piece.end = end;
    piece.w_per_scalar = w_per_scalar;
    piece.kind = kind;
    for (std::size_t c = 0; c < 3; ++c) {
      piece.color[c] = static_cast<float>(front.color[c]);
      piece.color_slope[c] = slope(front.color[c], back.color[c], width);
    }
    table_.pieces.push_back(piece);
  }

  void add_surface(const ScalarRanges::Bound& bound) {
    if (bound.isosurface == ScalarRanges::kNothing) return;
    const Isosurface& surface =
        classification_.isosurfaces[static_cast<std::size_t>(bound.isosurface)];
    const PreciseOptics optics{surface.opacity,
                               {surface.color[0], surface.color[1], surface.color[2]}};
    add({bound.scalar, bound.scalar}, bound.scalar, bound.scalar, 0, kSurface, optics, optics);
  }

  ClassifiedPieces& table_;
  const Classification& classification_;
  const ScalarRanges ranges_;
  const Pieces volume_;
};

ClassifiedPieces::ClassifiedPieces(const Classification& classification) {
  Maker(*this, classification).make();
  for (const IntervalVolume& interval : classification.intervals) {
    ends.push_back({interval.low, interval.high});
    whole_intervals.push_back(ClosedForm(interval.profile).integrate(0, 1, 1));
  }
}

std::size_t ClassifiedPieces::piece_of(float scalar) const {
  const auto above = std::partition_point(pieces.begin(), pieces.end() - 1,
                                          [&](const Piece& piece) { return piece.end <= scalar; });
  return static_cast<std::size_t>(above - pieces.begin());
}

}  // namespace plume
