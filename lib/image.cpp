#include "plume/lib/image.h"

#include <algorithm>

namespace plume {

const Channel* Image::channel(const std::string& name) const {
  const auto found = std::find_if(channels.begin(), channels.end(),
                                  [&](const Channel& channel) { return channel.name == name; });
  return found == channels.end() ? nullptr : &*found;
}

}  // namespace plume
