#include "plume/lib/several_volumes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "plume/lib/clip.h"
#include "plume/lib/pixel.h"
#include "plume/lib/scene_body.h"

namespace plume {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// How much a volume hides at least, whatever lies before it: by its volume and its isosurfaces. How
// much of an interval is seen may depend on the volume before.
class LeastDepth {
 public:
  explicit LeastDepth(const VolumeOfSeveral& volume)
      : volume_(volume), state_(volume.parts.ranges()) {}

  // The optical depth up to the end of the segment.
  double add(const Segment& segment, double gap) {
    if (segment.t_in - end_ > gap) state_.reset();
    end_ = segment.t_out;
    for_each_linear_part(segment, volume_.tolerance, [&](const Segment& piece) {
      const double length = piece.t_out - piece.t_in;
      return state_.add(piece.s_in, piece.s_out, [&](const ClassifiedPart& part) {
        if (part.kind == ClassifiedPart::Kind::volume)
          depth_ += volume_.parts.volume_depth(part, (part.share_to - part.share_from) * length);
        else if (part.kind == ClassifiedPart::Kind::surface)
          depth_ -= std::log1p(-volume_.parts.surface_alpha(part));
        return true;
      });
    });
    return depth_;
  }

 private:
  const VolumeOfSeveral& volume_;
  IntervalState state_;
  double end_ = -kInfinity, depth_ = 0;
};

bool same_look(const Scene& a, const Scene& b) {
  const Classification& x = a.classification();
  const Classification& y = b.classification();
  return a.field().name == b.field().name && x.volume == y.volume &&
         std::equal(x.intervals.begin(), x.intervals.end(), y.intervals.begin(), y.intervals.end(),
                    [](const IntervalVolume& i, const IntervalVolume& j) {
                      return i.low == j.low && i.high == j.high && i.profile == j.profile;
                    }) &&
         std::equal(x.isosurfaces.begin(), x.isosurfaces.end(), y.isosurfaces.begin(),
                    y.isosurfaces.end(), [](const Isosurface& i, const Isosurface& j) {
                      return i.value == j.value && i.opacity == j.opacity && i.color == j.color;
                    });
}

LinearOptics lit(LinearOptics optics, const Shading& shading) {
  for (PreciseOptics* end : {&optics.front, &optics.back})
    for (double& channel : end->color) channel = channel * shading.factor + shading.highlight;
  return optics;
}

PreciseColor lit(PreciseColor color, const Shading& shading) {
  for (double& channel : color.rgb)
    channel = channel * shading.factor + shading.highlight * color.alpha;
  return color;
}

}  // namespace

std::vector<VolumeOfSeveral> volumes_of(const Frame& frame) {
  std::vector<VolumeOfSeveral> volumes;
  for (const Scene* scene : frame.scenes()) {
    const ScalarField& field = scene->field();
    std::size_t look = 0;
    while (look < volumes.size() && !same_look(*volumes[look].scene, *scene)) ++look;
    volumes.push_back(
        {scene, LinearParts(scene->classification()), OpticalDepth(scene->transfer_function()),
         frame.settings().scalar_tolerance * (static_cast<double>(field.high) - field.low), look});
  }
  return volumes;
}

TraceResult follow(const VolumeOfSeveral& volume, const Frame& frame, const Ray& ray, bool bounds,
                   double& limit, RayThrough& through) {
  Ray clipped = ray;
  if (!clip(clipped, frame.settings().clip_planes)) return {};
  const double gap = frame.gap();
  const double enough = -std::log(frame.settings().early_termination / 2);
  LeastDepth depth(volume);
  return std::visit(
      [&](const auto& walkable) {
        return trace(walkable->mesh, walkable->boundary, clipped,
                     [&](const Segment& segment) {
                       through.add(segment, gap);
                       if (bounds && enough < kInfinity && depth.add(segment, gap) >= enough)
                         limit = std::min(limit, segment.t_out);
                       return segment.t_out <= limit;
                     },
                     {frame.settings().order, volume.tolerance});
      },
      volume.scene->body().walkable);
}

MixedVolumes::MixedVolumes(const Frame& frame, const std::vector<VolumeOfSeveral>& volumes,
                           bool hits)
    : frame_(frame),
      volumes_(volumes),
      mixed_(volumes.size(),
             {frame.settings().early_termination, frame.channels().whole_rays(),
              frame.settings().mode == Mode::depth && !frame.channels().whole_rays(), hits}) {
  for (const VolumeOfSeveral& volume : volumes)
    walks_.push_back({IntervalState(volume.parts.ranges()), 0, 0, {}});
}

const MixedRay& MixedVolumes::make(const Ray& ray, const std::vector<RayThrough>& throughs,
                                   Counts& counts) {
  ray_ = &ray;
  counts_ = &counts;
  mixed_.begin();
  for (std::size_t v = 0; v < walks_.size(); ++v)
    walks_[v] = {IntervalState(volumes_[v].parts.ranges()), -kInfinity, 0, {}};
  for (;;) {
    std::size_t nearest = walks_.size();
    double t = kInfinity;
    for (std::size_t v = 0; v < walks_.size(); ++v) {
      const auto& segments = throughs[v].segments;
      if (walks_[v].next == segments.size() || !(segments[walks_[v].next].t_in < t)) continue;
      nearest = v;
      t = segments[walks_[v].next].t_in;
    }
    if (!mixed_.go_to(t) || nearest == walks_.size()) return mixed_;
    take(nearest, throughs[nearest].segments[walks_[nearest].next++]);
  }
}

// A volume's passage begins at t.
void MixedVolumes::begin(std::size_t volume, double t) {
  Walk& walk = walks_[volume];
  const Walk* before = nullptr;
  for (std::size_t v = 0; v < walks_.size(); ++v)
    if (v != volume && volumes_[v].look == volumes_[volume].look &&
        std::abs(t - walks_[v].end) <= frame_.gap() &&
        (before == nullptr || walks_[v].end > before->end))
      before = &walks_[v];
  if (before != nullptr) {
    walk.state = before->state;
    walk.visit = before->visit;
  } else {
    walk.state.reset();
  }
}

void MixedVolumes::take(std::size_t volume, const Segment& segment) {
  Walk& walk = walks_[volume];
  if (segment.t_in - walk.end > frame_.gap()) begin(volume, segment.t_in);
  walk.end = segment.t_out;
  const double length = segment.t_out - segment.t_in;
  Piece piece{volume, segment.cell, segment.s_in, segment.s_out, segment.t_in, length};
  if (segment.order == ScalarOrder::linear) {
    take(piece, [&](const ClassifiedPart& part, float) {
      return segment.t_in + part.share_from * length;
    });
    return;
  }
  const ScalarPolynomial polynomial = polynomial_of(segment);
  polynomial.for_each_linear_piece(
      volumes_[volume].tolerance, [&](double u_in, double u_out, float s_in, float s_out) {
        piece.s_in = s_in;
        piece.s_out = s_out;
        piece.t_in = segment.t_in + u_in * length;
        piece.length = (u_out - u_in) * length;
        take(piece, [&](const ClassifiedPart& part, float scalar) {
          const bool at_value =
              part.kind == ClassifiedPart::Kind::surface || (part.first_of_visit && !part.clipped);
          return at_value ? segment.t_in + polynomial.place_of(scalar, u_in, u_out) * length
                          : piece.t_in + part.share_from * piece.length;
        });
        return true;
      });
}

// place_of(part, scalar) is where a part begins, on the scalar's own polynomial.
template <class PlaceOf>
void MixedVolumes::take(const Piece& piece, const PlaceOf& place_of) {
  const LinearParts& parts = volumes_[piece.volume].parts;
  walks_[piece.volume].state.add(piece.s_in, piece.s_out, [&](const ClassifiedPart& part) {
    const float scalar = part.kind == ClassifiedPart::Kind::interval
                             ? parts.ranges().scalar_of(part.index, part.from)
                             : part.from;
    put(piece, part, place_of(part, scalar));
    return true;
  });
}

void MixedVolumes::put(const Piece& piece, const ClassifiedPart& part, double place) {
  const LinearParts& parts = volumes_[piece.volume].parts;
  Walk& walk = walks_[piece.volume];
  const double from = piece.t_in + part.share_from * piece.length;
  const double length = (part.share_to - part.share_from) * piece.length;
  MixedPart mixed{};
  Shading shade;
  if (part.kind != ClassifiedPart::Kind::volume) {
    const float scalar = part.clipped ? piece.s_in
                         : part.kind == ClassifiedPart::Kind::interval
                             ? parts.ranges().scalar_of(part.index, part.from)
                             : part.from;
    mixed.is_hit = true;
    mixed.hit = {place, piece.volume, piece.cell, scalar};
    const auto& lighting = frame_.settings().lighting;
    if (part.kind == ClassifiedPart::Kind::surface) {
      ++counts_->surfaces;
      if (lighting) shade = shading(piece, place);
    } else {
      if (part.first_of_visit) {
        ++counts_->visits;
        walk.visit =
            lighting && lighting->intervals && !part.clipped ? shading(piece, place) : Shading{};
      }
      shade = walk.visit;
    }
  }
  if (LinearParts::is_thin(part, length)) {
    mixed.t_in = mixed.t_out = from;
    mixed.is_thin = true;
    mixed.thin = lit(parts.thin(part), shade);
    mixed_.add(piece.volume, mixed);
    return;
  }
  parts.for_each_piece(part, length, [&](const LinearOptics& optics, double begin, double end) {
    mixed.t_in = from + begin * length;
    mixed.t_out = from + end * length;
    mixed.optics = lit(optics, shade);
    mixed_.add(piece.volume, mixed);
  });
}

std::array<double, 3> MixedVolumes::gradient(std::size_t volume, std::uint32_t cell,
                                             double t) const {
  std::array<double, 3> place;
  for (std::size_t a = 0; a < 3; ++a) place[a] = ray_->origin[a] + t * ray_->direction[a];
  const Scene::Body& body = volumes_[volume].scene->body();
  return std::visit(
      [&](const auto& walkable) { return body.gradients->at(walkable->mesh, cell, place); },
      body.walkable);
}

Shading MixedVolumes::shading(const Piece& piece, double t) const {
  return shading_of(*frame_.settings().lighting, gradient(piece.volume, piece.cell, t),
                    ray_->direction);
}

std::array<double, 3> MixedVolumes::normal(const MixedHit& hit) const {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  if (!hit.is_one()) return {nan, nan, nan};
  const auto rise = gradient(hit.volume, hit.cell, hit.t);
  const double length = std::hypot(rise[0], rise[1], rise[2]);
  return {rise[0] / length, rise[1] / length, rise[2] / length};
}

}  // namespace plume
