#include <cstdio>
#include <cstdlib>

#include "bytes.h"

namespace plume::fuzz {

void fail(const char* what) {
  std::fprintf(stderr, "fuzz: %s\n", what);
  std::abort();
}

}  // namespace plume::fuzz
