#include <memory>

#include "plume/tests/bench/peer.h"
#include "plume/tests/bench/vtk_frames.h"

namespace plume::bench {

std::vector<PeerWay> vtk_ray_cast_ways(const PeerScene& scene) {
  const auto frames =
      std::make_shared<VtkFrames>(scene.tetrahedra, PeerScene::kField, scene.transfer_function);
  frames->set_threads(scene.threads);
  frames->look(scene.camera, scene.size);
  std::vector<PeerWay> ways;
  for (const std::string& name : VtkFrames::integrators())
    ways.push_back({"VTK ray cast", name + scene.on_tetrahedra(),
                    [frames, name] { frames->render(name); },
                    [frames] { return frames->picture(); }});
  return ways;
}

}  // namespace plume::bench
