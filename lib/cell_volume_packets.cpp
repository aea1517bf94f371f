#include "plume/lib/volume_packets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/lib/cell_volume_packets.cpp"
#include "hwy/foreach_target.h"
#include "plume/lib/composite_by-inl.h"
#include "plume/traverse/cell_steps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

void CompositeCell(const WalkableCells& mesh, const PacketOptics& optics, int axis,
                   PacketFeeder& feeder) {
  CompositeBy(optics, mesh.cell_values,
              [&](auto& consumer) { Walk(mesh, axis, consumer, feeder); });
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(CompositeCell);

void composite_packets(const WalkableCells& mesh, const PacketOptics& optics, int axis,
                       PacketFeeder& feeder) {
  HWY_DYNAMIC_DISPATCH(CompositeCell)(mesh, optics, axis, feeder);
}

}  // namespace plume
#endif  // HWY_ONCE
