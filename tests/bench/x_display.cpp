// Apart, for the macros of Xlib.h.
#include <X11/Xlib.h>

#include <cstdlib>
#include <string>

#include "plume/tests/bench/peer.h"

namespace plume::bench {

bool has_x_display() {
  // Kept: a server whose last client leaves starts anew, and refuses others meanwhile.
  static Display* const display = XOpenDisplay(nullptr);
  return display != nullptr;
}

void limit_rasterizer_threads(int threads) {
  // 0 draws in the calling thread; others are counted beside it.
  setenv("LP_NUM_THREADS", std::to_string(threads > 1 ? threads : 0).c_str(), 1);
}

}  // namespace plume::bench
