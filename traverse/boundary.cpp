#include "plume/traverse/boundary.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "plume/mesh/error.h"
#include "plume/traverse/frame_lanes.h"
#include "plume/traverse/ways_in.h"

namespace plume {
namespace {

// Half-width, in local coordinates (the mesh fills [-1, 1]^3), by which boxes are widened. Rounding
// of the sheared vertices (|x| <= 3, three operations), of the edge products that are compared, and
// of Embree's ray (which starts at |x| <= 6) moves a face against the ray by less than 3e-6; this
// is 2^-17. Wider boxes cost time, never a decision.
constexpr float kMargin = 7.62939453125e-06f;

// visit(BoundaryLoop) for a face.
template <class Visit>
auto with_loop(const WalkableTets& mesh, const WalkableTets::Boundary& face, const Visit& visit) {
  std::array<const WalkablePoint*, 3> corners;
  for (std::size_t c = 0; c < 3; ++c) corners[c] = &mesh.points[face.loop[c]];
  return visit(BoundaryLoop{corners, FaceSurface::triangle});
}

template <class Visit>
auto with_loop(const WalkableGrid& mesh, BoundaryFace face, const Visit& visit) {
  const std::uint32_t step[3] = {1, mesh.dimensions[0], mesh.dimensions[0] * mesh.dimensions[1]};
  const std::uint32_t axis = face.face / 2;
  const auto index = mesh.cell_index(face.cell);
  const std::uint32_t a = step[(axis + 1) % 3], b = step[(axis + 2) % 3];
  const WalkablePoint* const first =
      &mesh.points[mesh.first_point(index) + (face.face % 2) * step[axis]];
  const std::array<const WalkablePoint*, 4> corners{first, first + a, first + a + b, first + b};
  const FaceSurface surface =
      mesh.is_planar(index, face.face) ? FaceSurface::planar : FaceSurface::patch;
  return visit(BoundaryLoop{corners, surface, (face.face % 2 == 1) != mesh.left_handed});
}

template <class Visit>
auto with_loop(const WalkableCells& mesh, BoundaryFace face, const Visit& visit) {
  thread_local std::vector<const WalkablePoint*> corners;
  const auto loop = mesh.loop(face.face);
  corners.resize(loop.size());
  for (std::size_t c = 0; c < loop.size(); ++c) corners[c] = &mesh.points[loop[c]];
  return visit(BoundaryLoop{corners, loop.size() == 3   ? FaceSurface::triangle
                                     : loop.size() == 4 ? FaceSurface::patch
                                                        : FaceSurface::other});
}

template <class Mesh>
void face_bounds(const RTCBoundsFunctionArguments* args) {
  const Mesh& mesh = *static_cast<const Mesh*>(args->geometryUserPtr);
  std::array<float, 3> low, high;
  low.fill(std::numeric_limits<float>::infinity());
  high.fill(-std::numeric_limits<float>::infinity());
  with_loop(mesh, mesh.boundary[args->primID], [&](const BoundaryLoop& loop) {
    for (const WalkablePoint* const corner : loop.corners)
      for (std::size_t a = 0; a < 3; ++a) {
        low[a] = std::min(low[a], corner->position[a]);
        high[a] = std::max(high[a], corner->position[a]);
      }
  });
  RTCBounds& box = *args->bounds_o;
  box.lower_x = low[0] - kMargin;
  box.lower_y = low[1] - kMargin;
  box.lower_z = low[2] - kMargin;
  box.upper_x = high[0] + kMargin;
  box.upper_y = high[1] + kMargin;
  box.upper_z = high[2] + kMargin;
}

// A ray of a query.
template <class Walker>
struct QueryRay {
  const Walker* walker = nullptr;
  const ShearedFrame* frame = nullptr;
  const Entry* previous = nullptr;
  EntryList* found = nullptr;
};

// Sixteen rays; each is made when a face asks for it first.
template <class Walker>
class SixteenRays {
 public:
  SixteenRays(const FrameLanes& lanes, std::span<EntryList, FrameLanes::kRays> found)
      : lanes_(lanes), found_(found) {}

  ~SixteenRays() {
    for (std::size_t i = 0; i < made_.size(); ++i)
      if (made_[i]) std::destroy_at(&rays_[i].made);
  }
  SixteenRays(const SixteenRays&) = delete;
  SixteenRays& operator=(const SixteenRays&) = delete;

  const FrameLanes& lanes() const { return lanes_; }
  EntryList& found(std::size_t number) const { return found_[number]; }
  QueryRay<Walker> ray(const typename Walker::Mesh& mesh, std::size_t number) {
    Made& ray = rays_[number].made;
    if (!made_[number]) {
      std::construct_at(&ray, lanes_, number, mesh);
      made_[number] = true;
    }
    return {&ray.walker, &ray.frame, nullptr, &found_[number]};
  }

 private:
  struct Made {
    Made(const FrameLanes& lanes, std::size_t number, const typename Walker::Mesh& mesh)
        : frame(frame_of(lanes, number)), walker(mesh, frame) {}
    static ShearedFrame frame_of(const FrameLanes& lanes, std::size_t number) {
      ShearedFrame frame;
      lanes.put(number, frame);
      return frame;
    }
    ShearedFrame frame;
    Walker walker;
  };
  // Room for one. (An array of empty std::optional is zeroed whole, each time: 1% of a frame.)
  union Place {
    Place() {}
    ~Place() {}
    Made made;
  };

  const FrameLanes& lanes_;
  const std::span<EntryList, FrameLanes::kRays> found_;
  std::bitset<FrameLanes::kRays> made_;
  std::array<Place, FrameLanes::kRays> rays_;
};

// One ray, or sixteen, which know their number by their id.
template <class Walker>
struct Query {
  RTCIntersectContext context;  // first: Embree hands it back, and so the whole
  QueryRay<Walker> one;
  SixteenRays<Walker>* sixteen;
};

bool before(const Entry& a, const Entry& b, int sign) {
  if (a.place.z != b.place.z) return sign > 0 ? a.place.z < b.place.z : a.place.z > b.place.z;
  return std::tie(a.boundary, a.rank) < std::tie(b.boundary, b.rank);
}

// Puts an entry into its place in the list; what falls off the end is found by the next query.
void insert(EntryList& list, const Entry& entry, int sign) {
  if (list.size == EntryList::kCapacity) {
    if (!before(entry, list.entries[list.size - 1], sign)) return;
    --list.size;
  }
  std::uint32_t place = list.size++;
  for (; place > 0 && before(entry, list.entries[place - 1], sign); --place)
    list.entries[place] = list.entries[place - 1];
  list.entries[place] = entry;
  list.more = list.size == EntryList::kCapacity;
}

// Calls visit(place, rank) for each way in through a boundary face.
template <class Walker, class Visit>
void for_each_way_in(const Walker& walker, const typename Walker::Boundary& face, int sign,
                     const Visit& visit) {
  if constexpr (std::is_same_v<Walker, TetWalker>) {
    // A triangle is crossed once or not at all.
    const int winding = walker.boundary_winding(face);
    if (winding * sign < 0) visit(walker.measure_boundary(face, winding), 0u);
  } else {
    walker.ways_in(face, visit);
  }
}

// Whether a walker takes quadrilaterals for what with_loop() says.
template <class Walker>
constexpr bool kAsLoopSays =
    !std::is_same_v<Walker, HybridGridWalker> && !std::is_same_v<Walker, PluckerGridWalker>;

// Takes a face's ways in; false where no list has become full.
template <class Walker>
bool take_ways_in(const QueryRay<Walker>& ray, const typename Walker::Boundary& face,
                  std::uint32_t number) {
  const int sign = ray.frame->sign();
  EntryList& list = *ray.found;
  bool found = false;
  for_each_way_in(*ray.walker, face, sign, [&](const Crossing& place, std::uint32_t rank) {
    const Entry entry{place, number, rank};
    if (ray.previous && !before(*ray.previous, entry, sign)) return;
    insert(list, entry, sign);
    found = true;
  });
  return found && list.more;
}

template <class Walker>
void face_intersect(const RTCIntersectFunctionNArguments* args) {
  auto& query = *reinterpret_cast<Query<Walker>*>(args->context);
  const auto& mesh = *static_cast<const typename Walker::Mesh*>(args->geometryUserPtr);
  const auto& face = mesh.boundary[args->primID];
  RTCRayN* const rays = RTCRayHitN_RayN(args->rayhit, args->N);
  RTCHitN* const hits = RTCRayHitN_HitN(args->rayhit, args->N);
  // Only what lies before the last of a full list matters any more; behind it there may be others,
  // which are not looked for. Another face may lie at the same place: the margin keeps its box in
  // sight.
  auto shorten = [&](unsigned i, const EntryList& list, int sign) {
    RTCRayN_tfar(rays, args->N, i) =
        ShearedFrame::parameter(list.entries[list.size - 1].place.z, sign) + kMargin;
    RTCHitN_geomID(hits, args->N, i) = args->geomID;
    RTCHitN_primID(hits, args->N, i) = args->primID;
  };
  if (query.sixteen == nullptr) {
    if (args->valid[0] != 0 && take_ways_in(query.one, face, args->primID))
      shorten(0, *query.one.found, query.one.frame->sign());
    return;
  }
  const FrameLanes& lanes = query.sixteen->lanes();
  WaysIn ways;
  with_loop(mesh, face, [&](const BoundaryLoop& loop) { find_ways_in(lanes, loop, ways); });
  if (!kAsLoopSays<Walker>) ways.once = 0;
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const unsigned id = RTCRayN_id(rays, args->N, i);
    const int sign = lanes.sign(id);
    EntryList& list = query.sixteen->found(id);
    bool is_full = false;
    if ((ways.once >> id & 1) != 0) {
      insert(list, {{ways.z[id], ways.scalar[id]}, args->primID, 0}, sign);
      is_full = list.more;
    } else if ((ways.maybe >> id & 1) != 0) {
      is_full = take_ways_in(query.sixteen->ray(mesh, id), face, args->primID);
    }
    if (is_full) shorten(i, list, sign);
  }
}

struct DeviceDeleter {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneDeleter {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

}  // namespace

template <class Walker>
struct BoundaryIndex<Walker>::Implementation {
  std::unique_ptr<RTCDeviceTy, DeviceDeleter> device;
  std::unique_ptr<RTCSceneTy, SceneDeleter> scene;
};

template <class Walker>
BoundaryIndex<Walker>::BoundaryIndex(const Mesh& mesh)
    : mesh_(&mesh), implementation_(std::make_unique<Implementation>()) {
  implementation_->device.reset(rtcNewDevice(nullptr));
  RTCDevice device = implementation_->device.get();
  if (device == nullptr)
    throw Error("Embree cannot start on this processor (error " +
                std::to_string(static_cast<int>(rtcGetDeviceError(nullptr))) + ")");
  implementation_->scene.reset(rtcNewScene(device));
  RTCScene scene = implementation_->scene.get();
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(mesh.boundary.size()));
  rtcSetGeometryUserData(geometry, const_cast<Mesh*>(&mesh));
  rtcSetGeometryBoundsFunction(geometry, face_bounds<Mesh>, nullptr);
  rtcSetGeometryIntersectFunction(geometry, face_intersect<Walker>);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE)
    throw Error("Embree could not index the " + std::to_string(mesh.boundary.size()) +
                " boundary faces (error " + std::to_string(static_cast<int>(error)) +
                (error == RTC_ERROR_OUT_OF_MEMORY ? ", out of memory)" : ")"));
}

template <class Walker>
BoundaryIndex<Walker>::~BoundaryIndex() = default;
template <class Walker>
BoundaryIndex<Walker>::BoundaryIndex(BoundaryIndex&&) noexcept = default;
template <class Walker>
BoundaryIndex<Walker>& BoundaryIndex<Walker>::operator=(BoundaryIndex&&) noexcept = default;

template <class Walker>
EntryList BoundaryIndex<Walker>::next_entries(const Walker& walker, const ShearedFrame& frame,
                                              const Entry* previous) const {
  EntryList found;
  Query<Walker> query{{}, {&walker, &frame, previous, &found}, nullptr};
  rtcInitIntersectContext(&query.context);
  RTCRayHit rayhit{};
  const auto start = frame.start();
  const auto step = frame.step();
  rayhit.ray.org_x = start[0];
  rayhit.ray.org_y = start[1];
  rayhit.ray.org_z = start[2];
  rayhit.ray.dir_x = step[0];
  rayhit.ray.dir_y = step[1];
  rayhit.ray.dir_z = step[2];
  rayhit.ray.tnear =
      previous ? std::max(0.0f, frame.parameter(previous->place.z) - 2 * kMargin) : 0.0f;
  rayhit.ray.tfar = std::numeric_limits<float>::infinity();
  rayhit.ray.mask = 0xFFFFFFFFu;
  rayhit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(implementation_->scene.get(), &query.context, &rayhit);
  return found;
}

template <class Walker>
void BoundaryIndex<Walker>::first_entries(const FrameLanes& frames,
                                          std::span<EntryList, FrameLanes::kRays> found) const {
  SixteenRays<Walker> sixteen(frames, found);
  alignas(64) std::array<int, FrameLanes::kRays> valid;
  RTCRayHit16 packet;  // aligned to 64 bytes by its type
  RTCRay16& ray = packet.ray;
  frames.lines({ray.org_x, ray.org_y, ray.org_z}, {ray.dir_x, ray.dir_y, ray.dir_z});
  for (std::size_t i = 0; i < FrameLanes::kRays; ++i) {
    found[i].clear();
    valid[i] = frames.is_valid(i) ? -1 : 0;
    ray.tnear[i] = ray.time[i] = 0;
    ray.tfar[i] = std::numeric_limits<float>::infinity();
    ray.mask[i] = 0xFFFFFFFFu;
    ray.id[i] = static_cast<unsigned>(i);
    ray.flags[i] = 0;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
  Query<Walker> query{{}, {}, &sixteen};
  rtcInitIntersectContext(&query.context);
  query.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid.data(), implementation_->scene.get(), &query.context, &packet);
}

template class BoundaryIndex<TetWalker>;
template class BoundaryIndex<GridWalker>;
template class BoundaryIndex<HybridGridWalker>;
template class BoundaryIndex<PluckerGridWalker>;
template class BoundaryIndex<CellWalker>;

}  // namespace plume
