#include "plume/tests/bench/counted_memory.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> counted = 0;
std::atomic<std::size_t> peak = 0;

void* allocate(std::size_t bytes) {
  void* const data = std::malloc(bytes > 0 ? bytes : 1);
  if (!data) throw std::bad_alloc();
  const std::size_t size = malloc_usable_size(data);
  const std::size_t now = counted.fetch_add(size, std::memory_order_relaxed) + size;
  std::size_t before = peak.load(std::memory_order_relaxed);
  while (before < now && !peak.compare_exchange_weak(before, now, std::memory_order_relaxed)) {
  }
  return data;
}

void release(void* data) {
  if (!data) return;
  counted.fetch_sub(malloc_usable_size(data), std::memory_order_relaxed);
  std::free(data);
}

}  // namespace

void* operator new(std::size_t bytes) { return allocate(bytes); }
void* operator new[](std::size_t bytes) { return allocate(bytes); }
void operator delete(void* data) noexcept { release(data); }
void operator delete[](void* data) noexcept { release(data); }
void operator delete(void* data, std::size_t) noexcept { release(data); }
void operator delete[](void* data, std::size_t) noexcept { release(data); }

namespace plume::bench {

std::size_t counted_bytes() { return counted.load(std::memory_order_relaxed); }
std::size_t counted_peak() { return peak.load(std::memory_order_relaxed); }
void forget_peak() { peak.store(counted_bytes(), std::memory_order_relaxed); }

}  // namespace plume::bench
