// Apart, for the macros of Xlib.h.
#include <X11/Xlib.h>

#include <cstdlib>
#include <string>

#include "plume/tests/bench/peer.h"

namespace plume::bench {

bool has_x_display() {
  Display* const display = XOpenDisplay(nullptr);
  if (display == nullptr) return false;
  XCloseDisplay(display);
  return true;
}

void limit_rasterizer_threads(int threads) {
  // 0 draws in the calling thread; others are counted beside it.
  setenv("LP_NUM_THREADS", std::to_string(threads > 1 ? threads : 0).c_str(), 1);
}

}  // namespace plume::bench
