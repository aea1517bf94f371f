/// How much memory a stretch of a program takes.
#pragma once

#include <cstddef>

namespace plume::bench {

/// Counts the bytes that operator new has given out and operator delete has not yet taken back, in
/// programs that counted_memory.cpp is linked to: all that std::vector and std::make_unique take,
/// by all threads. What TBB's threads take for themselves is not counted.
std::size_t counted_bytes();

/// The highest that counted_bytes() was since the last call of forget_peak().
std::size_t counted_peak();

/// Starts a new peak, from what is counted now.
void forget_peak();

}  // namespace plume::bench
