#include "plume/lib/mixed_ray.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace plume {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

MixedRay::MixedRay(std::size_t volumes, const MixedRaySettings& settings)
    : settings_(settings), queues_(volumes) {}

void MixedRay::begin() {
  for (Queue& queue : queues_) {
    queue.parts.clear();
    queue.next = 0;
  }
  at_ = -kInfinity;
  color_ = {};
  transmittance_ = 1;
  optical_depth_ = 0;
  first_extinction_ = kInfinity;
  first_hit_ = {};
}

bool MixedRay::go_to(double t) {
  for (;;) {
    const double start = next_start();
    if (!(start < t)) return true;
    at_ = start;
    if (!composite_thin(start) || !composite_media(start, t)) return false;
  }
}

// Where the next part begins or goes on; infinite where there is none.
double MixedRay::next_start() {
  double start = kInfinity;
  for (Queue& queue : queues_) {
    while (!queue.empty() && !queue.front().is_thin && queue.front().t_out <= at_) ++queue.next;
    if (!queue.empty()) start = std::min(start, std::max(queue.front().t_in, at_));
  }
  return start;
}

bool MixedRay::composite_thin(double at) {
  for (;;) {
    Queue* nearest = nullptr;
    auto before = [](const MixedPart& a, const MixedPart& b) {
      return std::tie(a.t_in, a.thin.alpha, a.thin.rgb) <
             std::tie(b.t_in, b.thin.alpha, b.thin.rgb);
    };
    for (Queue& queue : queues_)
      if (!queue.empty() && queue.front().is_thin && queue.front().t_in <= at &&
          (nearest == nullptr || before(queue.front(), nearest->front())))
        nearest = &queue;
    if (nearest == nullptr) return true;
    const MixedPart& part = nearest->front();
    ++nearest->next;
    if (!(part.thin.alpha > 0)) continue;
    meet(part);
    optical_depth_ -= std::log1p(-part.thin.alpha);
    if (!take(part.thin)) return false;
  }
}

// Of the stretch from `start` to where the next part begins or ends.
bool MixedRay::composite_media(double start, double horizon) {
  double end = horizon;
  for (const Queue& queue : queues_)
    if (!queue.empty())
      end = std::min(end, queue.front().t_in <= start && !queue.front().is_thin
                              ? queue.front().t_out
                              : std::max(queue.front().t_in, start));
  if (!(end > start)) return true;
  media_.clear();
  double depth = 0;
  for (const Queue& queue : queues_) {
    if (queue.empty() || queue.front().is_thin || queue.front().t_in > start) continue;
    const MixedPart& part = queue.front();
    auto share_of = [&](double t) { return (t - part.t_in) / (part.t_out - part.t_in); };
    media_.push_back(part.optics.part(part.t_in == start ? 0 : share_of(start),
                                      part.t_out == end ? 1 : share_of(end)));
    if (media_.back().mean_extinction() > 0) meet(part);
  }
  at_ = end;
  // More than two terms in another order make another sum.
  if (media_.size() > 2) std::sort(media_.begin(), media_.end());
  for (const LinearOptics& medium : media_) depth += medium.mean_extinction() * (end - start);
  if (!(depth > 0)) return true;
  first_extinction_ = std::min(first_extinction_, start);
  optical_depth_ += depth;
  return take(integrate_sum(media_, end - start));
}

void MixedRay::meet(const MixedPart& part) {
  if (!part.is_hit || part.hit.t > first_hit_.t) return;
  if (part.hit.t < first_hit_.t || part.hit.scalar < first_hit_.scalar) first_hit_ = part.hit;
}

bool MixedRay::take(const PreciseColor& color) {
  for (std::size_t c = 0; c < 3; ++c) color_.rgb[c] += transmittance_ * color.rgb[c];
  transmittance_ -= transmittance_ * color.alpha;
  color_.alpha = 1 - transmittance_;
  if (settings_.whole_ray) return true;
  if (settings_.first_only && (settings_.hits ? first_hit_.is_one() : true)) return false;
  return transmittance_ > settings_.early_termination;
}

}  // namespace plume
