#include "plume/tests/bench/segment_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/tests/bench/segment_lanes.cpp"
// clang-format off
#include "hwy/foreach_target.h"  // before all that is compiled for each instruction set
#include "hwy/contrib/math/math-inl.h"
// clang-format on
#include "plume/lib/composite_by-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// Calls visit(first segment of a vector of lanes) ray by ray, as many rays side by side as there
// are lanes; begin() before the first of each.
template <class Begin, class Visit>
void ForEachVector(const bench::LaneSegments& segments, const Begin& begin, const Visit& visit) {
  const std::size_t lanes = hn::Lanes(DF());
  for (std::size_t ray = 0; ray < bench::LaneSegments::rays; ray += lanes) {
    begin(ray);
    for (std::size_t at = ray; at < segments.size(); at += bench::LaneSegments::rays) visit(at);
  }
}

template <class Pieces>
void ClosedFormBy(const Pieces& pieces, const PieceTable& table,
                  const bench::LaneSegments& segments, bench::LaneColors& colors) {
  const DF d;
  const DU du;
  VU piece = hn::Zero(du);
  ForEachVector(
      segments,
      [&](std::size_t ray) {
        HWY_ALIGN std::uint32_t first[kMaxLanes];
        for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane)
          first[lane] = static_cast<std::uint32_t>(table.piece_at(segments.s_in[ray + lane]));
        piece = hn::Load(du, first);
      },
      [&](std::size_t at) {
        const VF zero = hn::Zero(d), one = hn::Set(d, 1.0f);
        optics::Sums sums{zero, zero, zero, one};
        optics::Composite(pieces, hn::LoadU(d, &segments.s_in[at]),
                          hn::LoadU(d, &segments.s_out[at]), hn::LoadU(d, &segments.length[at]),
                          piece, sums);
        hn::StoreU(sums.r, d, &colors.r[at]);
        hn::StoreU(sums.g, d, &colors.g[at]);
        hn::StoreU(sums.b, d, &colors.b[at]);
        hn::StoreU(hn::Sub(one, sums.transmittance), d, &colors.alpha[at]);
      });
}

void ClosedFormLanes(const PieceTable& table, const bench::LaneSegments& segments,
                     bench::LaneColors& colors) {
  WithTable(table.pieces,
            [&](const auto& pieces) { ClosedFormBy(pieces, table, segments, colors); });
}

void TableLanes(const PreintegratedTable& table, const bench::LaneSegments& segments,
                bench::LaneColors& colors) {
  const DF d;
  const DU du;
  const optics::DI di;
  const auto n = static_cast<std::uint32_t>(table.scalar_axis().count);
  const float* const entries = table.entries().data()->values.data();
  const VF zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  auto locate = [&](VF value, const TableAxis& axis, VF& weight) {
    const VF last = hn::Set(d, static_cast<float>(axis.count - 2));
    const VF position =
        hn::Max(zero, hn::Mul(hn::Sub(value, hn::Set(d, static_cast<float>(axis.low))),
                              hn::Set(d, static_cast<float>(axis.density))));
    const VF first = hn::Min(hn::ConvertTo(d, hn::ConvertTo(di, position)), last);
    weight = hn::Min(one, hn::Sub(position, first));
    return hn::BitCast(du, hn::ConvertTo(di, first));
  };
  ForEachVector(
      segments, [](std::size_t) {},
      [&](std::size_t at) {
        const VF length = hn::LoadU(d, &segments.length[at]);
        VF front_weight, back_weight, level_weight;
        const VU front =
            locate(hn::LoadU(d, &segments.s_in[at]), table.scalar_axis(), front_weight);
        const VU back = locate(hn::LoadU(d, &segments.s_out[at]), table.scalar_axis(), back_weight);
        const VU level = locate(hn::Log2(d, length), table.length_axis(), level_weight);
        // An entry is two pairs of floats.
        const VU rows = hn::Add(hn::Mul(level, hn::Set(du, n)), back);
        const VU first = hn::Add(hn::Mul(rows, hn::Set(du, 2 * n)), hn::Add(front, front));
        VF r = zero, g = zero, b = zero, mean = zero;
        auto add = [&](std::uint32_t offset, VF weight) {
          HWY_ALIGN std::uint32_t pairs[kMaxLanes];
          hn::Store(hn::Add(first, hn::Set(du, 2 * offset)), du, pairs);
          const FourFloats entry = LoadFour(entries, pairs);
          r = hn::MulAdd(weight, entry.a, r);
          g = hn::MulAdd(weight, entry.b, g);
          b = hn::MulAdd(weight, entry.c, b);
          mean = hn::MulAdd(weight, entry.d, mean);
        };
        auto add_two = [&](std::uint32_t offset, VF weight) {
          const VF second = hn::Mul(weight, front_weight);
          add(offset, hn::Sub(weight, second));
          add(offset + 1, second);
        };
        const VF far = level_weight, near = hn::Sub(one, far);
        const VF near_high = hn::Mul(near, back_weight), far_high = hn::Mul(far, back_weight);
        add_two(0, hn::Sub(near, near_high));
        add_two(n, near_high);
        add_two(n * n, hn::Sub(far, far_high));
        add_two(n * n + n, far_high);
        const VF alpha =
            hn::Sub(one, hn::Exp(d, hn::Neg(hn::Min(hn::Mul(mean, length), hn::Set(d, 80.0f)))));
        const VF scale = hn::IfThenElseZero(hn::Gt(mean, zero), hn::Div(alpha, mean));
        hn::StoreU(hn::Mul(r, scale), d, &colors.r[at]);
        hn::StoreU(hn::Mul(g, scale), d, &colors.g[at]);
        hn::StoreU(hn::Mul(b, scale), d, &colors.b[at]);
        hn::StoreU(alpha, d, &colors.alpha[at]);
      });
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(ClosedFormLanes);
HWY_EXPORT(TableLanes);

namespace bench {

void closed_form_by_lanes(const PieceTable& pieces, const LaneSegments& segments,
                          LaneColors& colors) {
  HWY_DYNAMIC_DISPATCH(ClosedFormLanes)(pieces, segments, colors);
}

void table_by_lanes(const PreintegratedTable& table, const LaneSegments& segments,
                    LaneColors& colors) {
  HWY_DYNAMIC_DISPATCH(TableLanes)(table, segments, colors);
}

}  // namespace bench
}  // namespace plume
#endif  // HWY_ONCE
