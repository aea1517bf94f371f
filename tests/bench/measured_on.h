/// When and on what something was measured, for the head of a page.
#pragma once

#include <string>

namespace plume::bench {

/// "2026-11-22, AMD EPYC, 2 threads, AVX3, load 1.5": the date, the processor as Linux names it,
/// how many threads there are, the widest instructions of packets, and how many processes wanted to
/// run in the last minute, this one included.
std::string measured_on();

}  // namespace plume::bench
