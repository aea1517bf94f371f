// Point sampling by Open VKL 2 (doc/api.md of its sources), fixed steps as for the others.
//
// Debian 12 has no Open VKL: this has NOT been compiled or run against the library here, only read
// against its documentation. Its interval iterators, with which empty space could be left out, are
// not used: all peers that sample are given the same samples.

// In this order, as documented.
// clang-format off
#include <openvkl/openvkl.h>
#include <openvkl/device/openvkl.h>
// clang-format on

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "plume/mesh/error.h"
#include "plume/tests/bench/fixed_step.h"
#include "plume/tests/bench/peer.h"

namespace plume::bench {
namespace {

// An unstructured volume on the CPU device. What is outside of it is NaN, the default background.
class Volume {
 public:
  explicit Volume(const Mesh& tetrahedra) {
    const std::size_t cells = tetrahedra.cells.connectivity.size() / 4;
    tetrahedra.points.visit([&](auto values) {
      for (const auto value : values) positions_.push_back(static_cast<float>(value));
    });
    tetrahedra.fields.front().values.visit([&](auto values) {
      for (const auto value : values) scalars_.push_back(static_cast<float>(value));
    });
    tetrahedra.cells.connectivity.visit([&](auto ids) {
      for (const auto id : ids) ids_.push_back(static_cast<std::uint32_t>(id));
    });
    for (std::size_t cell = 0; cell < cells; ++cell)
      starts_.push_back(static_cast<std::uint32_t>(4 * cell));
    types_.assign(cells, static_cast<std::uint8_t>(CellType::tetrahedron));

    vklInit();
    device_ = vklNewDevice("cpu");
    if (!device_) throw Error("Open VKL has no CPU device");
    vklCommitDevice(device_);
    volume_ = vklNewVolume(device_, "unstructured");
    set("vertex.position", positions_.size() / 3, VKL_VEC3F, positions_.data());
    set("vertex.data", scalars_.size(), VKL_FLOAT, scalars_.data());
    set("index", ids_.size(), VKL_UINT, ids_.data());
    set("cell.index", starts_.size(), VKL_UINT, starts_.data());
    set("cell.type", types_.size(), VKL_UCHAR, types_.data());
    vklCommit(volume_);
    sampler_ = vklNewSampler(volume_);
    vklCommit(sampler_);
  }
  ~Volume() {
    vklRelease(sampler_);
    vklRelease(volume_);
    vklReleaseDevice(device_);
  }
  Volume(const Volume&) = delete;
  Volume& operator=(const Volume&) = delete;

  float operator()(const std::array<double, 3>& place) const {
    const vkl_vec3f at{static_cast<float>(place[0]), static_cast<float>(place[1]),
                       static_cast<float>(place[2])};
    return vklComputeSample(&sampler_, &at, 0, 0.0f);
  }

 private:
  // Reads the array where it is.
  void set(const char* name, std::size_t count, VKLDataType type, const void* values) {
    VKLData data = vklNewData(device_, count, type, values, VKL_DATA_SHARED_BUFFER, 0);
    vklSetData(volume_, name, data);
    vklRelease(data);
  }

  std::vector<float> positions_, scalars_;
  std::vector<std::uint32_t> ids_, starts_;
  std::vector<std::uint8_t> types_;
  VKLDevice device_;
  VKLVolume volume_;
  VKLSampler sampler_;
};

}  // namespace

std::vector<PeerWay> openvkl_ways(const PeerScene& scene, bool quick) {
  const auto volume = std::make_shared<const Volume>(scene.tetrahedra);
  return marching_ways(
      scene, "Open VKL sampling", "vklComputeSample" + scene.on_tetrahedra() + ": ", quick,
      [volume] { return [volume](const std::array<double, 3>& p) { return (*volume)(p); }; });
}

}  // namespace plume::bench
