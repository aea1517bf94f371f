/// Walking the cells of a rectilinear grid from plane to plane: J. Amanatides, A. Woo, "A Fast
/// Voxel Traversal Algorithm for Ray Tracing" (Eurographics 1987), for planes at any distances.
///
/// Where the ray crosses a plane is computed from the plane's own coordinate, never added up. A
/// rounded difference times a rounded factor is monotone in the coordinate, so the planes of an
/// axis are crossed in their order, whatever the rounding, and merging three such sequences needs
/// no epsilon. A walk ends where the first axis runs out of planes, which is one of those very
/// numbers.
///
/// A tie (a ray through a vertex or an edge of the grid, or in one of its planes) is resolved as if
/// the ray had been moved by an infinitesimal amount in +x, a smaller one in +y and a still smaller
/// one in +z, whatever its direction. So a ray in a plane runs through the cells on that plane's
/// side of larger coordinates; one in the last plane of an axis misses, and of two grids that meet
/// there exactly one is seen. Through a vertex or an edge the ray passes cells on a segment of
/// length zero, and a reversed ray the same ones in reverse. None of these comes first or last: a
/// ray that does no more than touch the grid's boundary misses.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "plume/mesh/walkable_rectilinear.h"
#include "plume/traverse/ray.h"

namespace plume {

/// Made for one mesh; start() places it in the first cell of a ray. The mesh must outlive it.
class RectilinearWalker {
 public:
  using Mesh = WalkableRectilinear;

  /// One axis as the ray sees it: planes, cells and points are counted along the ray.
  struct Axis {
    double t_next;         // where the ray crosses the plane ahead
    double t_after;        // and the one after that
    double t_behind;       // where it has crossed the one behind; 0 for an axis across the ray
    double rate;           // weight per t; 0 for an axis across the ray
    double base;           // weight of an axis across the ray, else 0
    double origin;         // the ray's origin
    double per_direction;  // 1 / direction; infinite for an axis across the ray
    double speed;          // |direction|
    const double* plane;   // the coordinate of the plane after the one ahead, or of the last
    const double* last;
    const double* per_width;
    std::ptrdiff_t step;   // from a plane to the next in memory: 1 or -1
    std::uint32_t number;  // of the mesh's axes
    std::uint32_t planes;
    std::uint32_t cell_step, point_step;  // modulo 2^32, as they may be negative
    bool across;                          // the ray runs along this axis' planes

    // How far between the planes behind and ahead: 0 to 1. Rounding may take it above 1, not below
    // 0, as t is not less than t_behind.
    double weight(double t) const { return std::min(1.0, base + (t - t_behind) * rate); }
  };

  explicit RectilinearWalker(const WalkableRectilinear& mesh) : mesh_(mesh) {}

  /// Goes to the cell that the ray is in at t_min, or where it comes into the grid behind that.
  /// False where it is in no cell between t_min and t_max, and for a direction that is zero (or has
  /// no component above 1e-308) or not finite.
  bool start(const Ray& ray) {
    if (!set_directions(ray)) return false;
    double enter = -kInfinity, leave = kInfinity;
    for (const Axis& axis : axes_) {
      enter = std::max(enter, t_of(axis, 0));
      leave = std::min(leave, t_of(axis, axis.planes - 1));
    }
    const double begin = std::max(enter, ray.t_min);
    end_ = std::min(leave, ray.t_max);
    if (!(begin < end_)) return false;
    cell_ = 0;
    near_ = 0;
    for (Axis& axis : axes_) place(axis, begin);
    entry_ = 0;
    for (std::size_t a = 1; a < 3; ++a)
      if (behind(axes_[a]) > behind(axes_[entry_])) entry_ = a;
    t_in_ = behind(axes_[entry_]);
    find_exit();
    return true;
  }

  std::uint32_t cell() const { return cell_; }

  /// Where the ray comes into the cell and where it goes out, in world units; the one may lie
  /// before the ray's t_min, the other behind its t_max.
  double t_in() const { return t_in_; }
  double t_out() const { return axes_[exit_].t_next; }
  /// The least of t_max and of where the ray leaves the grid: the cell with t_out() >= end() is the
  /// last.
  double end() const { return end_; }

  /// The scalar there, bilinear in the face's four values. Requires values on points.
  float entry_scalar() const { return face_scalar(entry_, near_, t_in_); }
  float exit_scalar() const {
    return face_scalar(exit_, near_ + axes_[exit_].point_step, axes_[exit_].t_next);
  }
  /// The scalar at t_in() <= t <= t_out(), trilinear in the cell's eight values: along the ray a
  /// cubic. Requires values on points.
  float scalar(double t) const {
    const Axis& axis = axes_[0];
    const double near = face_value(0, near_, t), far = face_value(0, near_ + axis.point_step, t);
    return static_cast<float>(near + axis.weight(t) * (far - near));
  }

  /// Goes through the exit. Requires t_out() < end().
  void advance() {
    Axis& axis = axes_[exit_];
    cell_ += axis.cell_step;
    near_ += axis.point_step;
    t_in_ = axis.t_behind = axis.t_next;
    axis.t_next = axis.t_after;
    axis.per_width += axis.step;
    axis.rate = axis.speed * *axis.per_width;
    look_ahead(axis);
    entry_ = exit_;
    find_exit();
  }

  /// The cell's index along each of the mesh's axes.
  std::array<std::uint32_t, 3> indices() const {
    std::array<std::uint32_t, 3> indices;
    for (const Axis& axis : axes_) indices[axis.number] = index_of(axis);
    return indices;
  }
  /// The axis, in the mesh's order, whose plane was crossed last.
  std::size_t entry_axis() const { return axes_[entry_].number; }
  /// The cell's index along it.
  std::uint32_t entry_index() const { return index_of(axes_[entry_]); }

  /// Goes on until a cell's index along some axis is no longer below `end` nor at least `begin`, of
  /// that axis of the mesh: where advance(), again and again, would be, bit for bit. False, and
  /// nowhere, where the walk ends before. Requires that the cell's indices are between them.
  bool skip(const std::array<std::uint32_t, 3>& begin, const std::array<std::uint32_t, 3>& end) {
    // The far plane of each axis; of crossings at the same place, the first in the axes' order.
    std::array<std::uint32_t, 3> left;  // cells from this one to the far plane
    std::size_t first = 0;
    double t_out = kInfinity;
    for (std::size_t a = 0; a < 3; ++a) {
      const Axis& axis = axes_[a];
      const std::uint32_t index = index_of(axis);
      left[a] = axis.step > 0 ? end[axis.number] - index : index - begin[axis.number] + 1;
      const double t = axis.across ? kInfinity : t_ahead(axis, left[a]);
      if (t < t_out) t_out = t, first = a;
    }
    if (!(t_out < end_)) return false;
    for (std::size_t a = 0; a < 3; ++a) {
      if (a == first) {
        cross(axes_[a], left[a]);
      } else if (!axes_[a].across) {
        // Planes at the same place are crossed before where the axis comes before.
        const std::uint32_t crossed = a < first ? planes_ahead<true>(axes_[a], left[a], t_out)
                                                : planes_ahead<false>(axes_[a], left[a], t_out);
        if (crossed > 0) cross(axes_[a], crossed);
      }
    }
    t_in_ = t_out;
    entry_ = first;
    find_exit();
    return true;
  }

  /// What packets take over of a walk: the axes in the order in which ties are resolved, the plane
  /// ahead along each, and the cell's corner that is behind along all of them.
  const std::array<Axis, 3>& axes() const { return axes_; }
  const double* plane_ahead(const Axis& axis) const {
    const WalkableRectilinear::Axis& given = mesh_.axes[axis.number];
    return given.coordinates.data() + (axis.per_width - given.per_width.data()) +
           (axis.step > 0 ? 1 : 0);
  }
  std::uint32_t near_corner() const { return near_; }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  // The axes in the order in which a ray through a vertex crosses their planes: moved by +e, it
  // crosses a plane earlier by e / direction. So axes along which it goes up come first, the one
  // with the largest shift before the others; those along which it goes down come last, the one
  // with the largest shift after the others. Hence x before y before z, then z before y before x.
  bool set_directions(const Ray& ray) {
    const auto& d = ray.direction;
    const auto& o = ray.origin;
    // Zero times what is not finite is no number.
    if (!(0 * d[0] + 0 * d[1] + 0 * d[2] + 0 * o[0] + 0 * o[1] + 0 * o[2] == 0)) return false;
    std::size_t first = 0, last = 2;
    bool any = false;
    for (std::size_t a = 0; a < 3; ++a) {
      const double per_direction = 1 / d[a];
      const bool across = !std::isfinite(per_direction);
      const bool up = across || d[a] > 0;
      any = any || !across;
      set(axes_[up ? first++ : last--], a, o[a], across ? kInfinity : per_direction,
          across ? 0 : std::abs(d[a]), up);
    }
    return any;
  }

  void set(Axis& axis, std::size_t a, double origin, double per_direction, double speed, bool up) {
    const WalkableRectilinear::Axis& given = mesh_.axes[a];
    axis.origin = origin;
    axis.per_direction = per_direction;
    axis.speed = speed;
    axis.across = speed == 0;
    axis.number = static_cast<std::uint32_t>(a);
    axis.planes = mesh_.points(a);
    const bool forwards = up == given.ascending();
    axis.step = forwards ? 1 : -1;
    axis.plane = given.coordinates.data() + (forwards ? 0 : axis.planes - 1);
    axis.last = given.coordinates.data() + (forwards ? axis.planes - 1 : 0);
    axis.per_width = given.per_width.data() + (forwards ? 0 : axis.planes - 2);
    axis.cell_step = axis.point_step = 1;
    for (std::size_t b = 0; b < a; ++b) {
      axis.cell_step *= mesh_.points(b) - 1;
      axis.point_step *= mesh_.points(b);
    }
    if (!forwards) {
      axis.cell_step = 0 - axis.cell_step;
      axis.point_step = 0 - axis.point_step;
    }
  }

  // Where the ray crosses the axis' i-th plane, while `plane` is still the first. Across the ray:
  // before or behind everything.
  static double t_of(const Axis& axis, std::uint32_t i) {
    const double distance = axis.plane[static_cast<std::ptrdiff_t>(i) * axis.step] - axis.origin;
    if (axis.across) return distance > 0 ? kInfinity : -kInfinity;
    return distance * axis.per_direction;
  }

  // The last plane that is crossed at `begin` or before; not the last of all. It is looked for from
  // where it would be if all widths were the same, in steps that double, then in halves.
  static std::uint32_t last_crossed(const Axis& axis, double begin) {
    std::uint32_t crossed = 0, open = axis.planes - 1;
    auto is_crossed = [&](std::uint32_t i) { return t_of(axis, i) <= begin; };
    const double first = axis.across ? *axis.plane : t_of(axis, 0);
    const double last = axis.across ? *axis.last : t_of(axis, open);
    const double place = ((axis.across ? axis.origin : begin) - first) / (last - first) * open;
    // Whatever rounding made of it: no number becomes 0.
    const auto guess = static_cast<std::uint32_t>(std::min(open - 1.0, std::max(0.0, place)));
    if (is_crossed(guess) & !is_crossed(guess + 1)) return guess;  // at once, as a rule
    if (is_crossed(guess)) {
      crossed = guess;
      for (std::uint32_t step = 1; step < open - crossed; step *= 2) {
        if (!is_crossed(crossed + step)) {
          open = crossed + step;
          break;
        }
        crossed += step;
      }
    } else {
      open = guess;
      for (std::uint32_t step = 1; step < open - crossed; step *= 2) {
        if (is_crossed(open - step)) {
          crossed = open - step;
          break;
        }
        open -= step;
      }
    }
    while (open - crossed > 1) {
      const std::uint32_t middle = crossed + (open - crossed) / 2;
      (is_crossed(middle) ? crossed : open) = middle;
    }
    return crossed;
  }

  // Puts the axis between the last plane that is crossed at `begin` or before and the next one.
  // There are both: the first plane is crossed by then and the last one is not.
  void place(Axis& axis, double begin) {
    const std::uint32_t crossed = last_crossed(axis, begin), open = crossed + 1;
    axis.t_behind = axis.across ? 0 : t_of(axis, crossed);
    axis.t_next = t_of(axis, open);
    const std::ptrdiff_t cells = static_cast<std::ptrdiff_t>(crossed) * axis.step;
    axis.plane += cells;
    axis.per_width += cells;
    axis.rate = axis.speed * *axis.per_width;
    axis.base = axis.across ? std::min(1.0, (axis.origin - *axis.plane) * *axis.per_width) : 0;
    axis.plane += axis.step;
    look_ahead(axis);
    // Where the ray goes down in memory, its first point and cell are the last ones there.
    const bool forwards = axis.step > 0;
    near_ += axis.point_step * (crossed - (forwards ? 0 : axis.planes - 1));
    cell_ += axis.cell_step * (crossed - (forwards ? 0 : axis.planes - 2));
  }

  // Computes where the ray crosses the plane after the next one, so that nobody waits for it when
  // the next one is crossed. Behind the last plane there is none, and nobody asks.
  static void look_ahead(Axis& axis) {
    axis.plane += axis.plane == axis.last ? 0 : axis.step;
    axis.t_after = (*axis.plane - axis.origin) * axis.per_direction;
  }

  std::uint32_t index_of(const Axis& axis) const {
    return static_cast<std::uint32_t>(axis.per_width - mesh_.axes[axis.number].per_width.data());
  }

  // Where the ray crosses the n-th plane ahead, n > 0.
  double t_ahead(const Axis& axis, std::uint32_t n) const {
    if (n == 1) return axis.t_next;
    const double* const plane = plane_ahead(axis) + static_cast<std::ptrdiff_t>(n - 1) * axis.step;
    return (*plane - axis.origin) * axis.per_direction;
  }

  // How many planes ahead, less than `limit`, are crossed before t, or at it where kOrAt.
  template <bool kOrAt>
  std::uint32_t planes_ahead(const Axis& axis, std::uint32_t limit, double t) const {
    auto is_crossed = [&](std::uint32_t n) {
      const double place = t_ahead(axis, n);
      return kOrAt ? place <= t : place < t;
    };
    std::uint32_t crossed = 0, open = limit;
    for (std::uint32_t step = 1; crossed + step < open; step *= 2) {
      if (!is_crossed(crossed + step)) {
        open = crossed + step;
        break;
      }
      crossed += step;
    }
    while (open - crossed > 1) {
      const std::uint32_t middle = crossed + (open - crossed) / 2;
      (is_crossed(middle) ? crossed : open) = middle;
    }
    return crossed;
  }

  // Crosses the next n planes, n > 0, of which the last is not the last of all.
  void cross(Axis& axis, std::uint32_t n) {
    const std::ptrdiff_t cells = static_cast<std::ptrdiff_t>(n) * axis.step;
    const double* const reached = plane_ahead(axis) + (cells - axis.step);
    axis.t_behind = t_ahead(axis, n);
    axis.t_next = t_ahead(axis, n + 1);
    axis.per_width += cells;
    axis.rate = axis.speed * *axis.per_width;
    axis.plane = reached + axis.step;
    look_ahead(axis);
    cell_ += axis.cell_step * n;
    near_ += axis.point_step * n;
  }

  static double behind(const Axis& axis) { return axis.across ? -kInfinity : axis.t_behind; }

  // Of crossings at the same place, the first in the axes' order.
  void find_exit() {
    const double t0 = axes_[0].t_next, t1 = axes_[1].t_next, t2 = axes_[2].t_next;
    const std::size_t first = t1 < t0 ? 1 : 0;
    exit_ = t2 < (t1 < t0 ? t1 : t0) ? 2 : first;
  }

  double face_value(std::size_t across, std::uint32_t corner, double t) const {
    const Axis& u = axes_[across == 0 ? 1 : 0];
    const Axis& v = axes_[across == 2 ? 1 : 2];
    const float* const values = mesh_.point_values.data();
    const double s00 = values[corner], s10 = values[corner + u.point_step];
    const double s01 = values[corner + v.point_step];
    const double s11 = values[corner + u.point_step + v.point_step];
    const double along_u = u.weight(t), along_v = v.weight(t);
    const double s0 = s00 + along_u * (s10 - s00), s1 = s01 + along_u * (s11 - s01);
    return s0 + along_v * (s1 - s0);
  }
  float face_scalar(std::size_t across, std::uint32_t corner, double t) const {
    return static_cast<float>(face_value(across, corner, t));
  }

  const WalkableRectilinear& mesh_;
  std::array<Axis, 3> axes_;
  std::uint32_t cell_ = 0;
  std::uint32_t near_ = 0;  // the cell's corner that is behind along all axes
  std::size_t entry_ = 0, exit_ = 0;
  double t_in_ = 0, end_ = 0;
};

}  // namespace plume
