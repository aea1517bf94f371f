#include "plume/tests/traverse/inner_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/tests/traverse/inner_lanes.cpp"
#include "hwy/foreach_target.h"
#include "plume/traverse/inner_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

template <std::size_t kCount, class Mesh>
void AskFor(const Mesh& mesh, int axis, std::span<const test::InnerQuery> queries,
            std::vector<test::InnerAnswer>& answers) {
  const DF d;
  const std::size_t lanes = hn::Lanes(d);
  InnerLanes<Mesh> inside(mesh, axis);
  for (std::size_t first = 0; first < queries.size(); first += lanes) {
    HWY_ALIGN float z_out[kMaxLanes] = {}, on[kMaxLanes] = {};
    HWY_ALIGN std::uint32_t cell[kMaxLanes] = {};
    for (std::size_t lane = 0; lane < lanes && first + lane < queries.size(); ++lane) {
      const test::InnerQuery& query = queries[first + lane];
      PacketStart start;
      start.line = query.frame->line();
      start.z = query.z_in;
      inside.begin(0, lane, start);
      z_out[lane] = query.z_out;
      cell[lane] = query.cell;
      on[lane] = 1;
    }
    inside.ends_at(0, hn::Load(d, z_out));
    VF inner[kCount];
    const MF known = inside.template At<kCount>(0, hn::Gt(hn::Load(d, on), hn::Zero(d)),
                                                hn::Load(DU(), cell), inner);
    const unsigned bits = BitsOf(known);
    HWY_ALIGN float values[kCount][kMaxLanes];
    for (std::size_t i = 0; i < kCount; ++i) hn::Store(inner[i], d, values[i]);
    for (std::size_t lane = 0; lane < lanes && first + lane < queries.size(); ++lane) {
      test::InnerAnswer& answer = answers[first + lane];
      answer.known = (bits >> lane & 1u) != 0;
      for (std::size_t i = 0; i < kCount; ++i) answer.inner[i] = values[i][lane];
    }
  }
}

template <class Mesh>
void AskFor(const Mesh& mesh, int axis, std::span<const test::InnerQuery> queries,
            ScalarOrder order, std::vector<test::InnerAnswer>& answers) {
  if (order == ScalarOrder::quadratic)
    AskFor<1>(mesh, axis, queries, answers);
  else
    AskFor<2>(mesh, axis, queries, answers);
}

void AskGrid(const WalkableGrid& mesh, int axis, std::span<const test::InnerQuery> queries,
             ScalarOrder order, std::vector<test::InnerAnswer>& answers) {
  AskFor(mesh, axis, queries, order, answers);
}
void AskCells(const WalkableCells& mesh, int axis, std::span<const test::InnerQuery> queries,
              ScalarOrder order, std::vector<test::InnerAnswer>& answers) {
  AskFor(mesh, axis, queries, order, answers);
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(AskGrid);
HWY_EXPORT(AskCells);

namespace test {

std::vector<InnerAnswer> ask_lanes(const WalkableGrid& mesh, int axis,
                                   std::span<const InnerQuery> queries, ScalarOrder order) {
  std::vector<InnerAnswer> answers(queries.size());
  HWY_DYNAMIC_DISPATCH(AskGrid)(mesh, axis, queries, order, answers);
  return answers;
}
std::vector<InnerAnswer> ask_lanes(const WalkableCells& mesh, int axis,
                                   std::span<const InnerQuery> queries, ScalarOrder order) {
  std::vector<InnerAnswer> answers(queries.size());
  HWY_DYNAMIC_DISPATCH(AskCells)(mesh, axis, queries, order, answers);
  return answers;
}

}  // namespace test
}  // namespace plume
#endif  // HWY_ONCE
