// What code does in a process of its own leaves this one as it is.
#include "plume/mesh/separate_process.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cassert>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

namespace plume::test {
namespace {

void nothing(ResultFile&) {}

TEST(SeparateProcess, BringsBackWhatWasWritten) {
  std::vector<int> numbers(3'000'000);
  std::iota(numbers.begin(), numbers.end(), 7);
  int changed = 1;
  const SeparateRun run = run_separately([&](ResultFile& file) {
    changed = 2;
    file.write(std::as_bytes(std::span(numbers)));
  });
  EXPECT_EQ(run.failure, "");
  EXPECT_EQ(changed, 1);
  ASSERT_EQ(run.result.size(), numbers.size() * sizeof(int));
  EXPECT_EQ(std::memcmp(run.result.data(), numbers.data(), run.result.size()), 0);
}

TEST(SeparateProcess, MayWriteNothing) {
  const SeparateRun run = run_separately(nothing);
  EXPECT_EQ(run.failure, "");
  EXPECT_TRUE(run.result.empty());
}

TEST(SeparateProcess, SurvivesWhateverHappens) {
  EXPECT_EQ(run_separately([](ResultFile&) { std::abort(); }).failure, "aborted");
  EXPECT_EQ(run_separately([](ResultFile&) { throw std::runtime_error("lost"); }).failure,
            "aborted");
  EXPECT_EQ(run_separately([](ResultFile&) { std::raise(SIGSEGV); }).failure,
            "ended by signal 11 (Segmentation fault)");
  EXPECT_EQ(run_separately([](ResultFile&) { std::_Exit(5); }).failure, "exited with status 5");
  EXPECT_EQ(run_separately([](ResultFile&) { std::_Exit(0); }).failure, "exited with status 0");
  const SeparateRun half = run_separately([](ResultFile& file) {
    file.write(std::as_bytes(std::span("half of it")));
    std::abort();
  });
  EXPECT_TRUE(half.result.empty());
}

TEST(SeparateProcess, KeepsWhatIsSaidFromTheHost) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  std::printf("of the host, ");  // in a buffer that is copied
  const SeparateRun run = run_separately([](ResultFile&) {
    std::printf("out ");
    std::fprintf(stderr, "err ");
    std::printf("end");
    std::abort();
  });
  std::printf("once\n");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "of the host, once\n");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(run.said, "out err end");
}

std::atomic<int> handled{0};

TEST(SeparateProcess, LeavesTheHostsSignalHandlersAlone) {
  const auto previous = std::signal(SIGABRT, [](int) { ++handled; });
  EXPECT_EQ(run_separately([](ResultFile&) { std::abort(); }).failure, "aborted");
  std::raise(SIGABRT);
  std::signal(SIGABRT, previous);
  EXPECT_EQ(handled, 1);
}

TEST(SeparateProcess, WorksInAHostThatIgnoresItsChildren) {
  const auto previous = std::signal(SIGCHLD, SIG_IGN);
  const SeparateRun good = run_separately(nothing);
  const SeparateRun bad = run_separately([](ResultFile&) { std::abort(); });
  std::signal(SIGCHLD, previous);
  EXPECT_EQ(good.failure, "");
  EXPECT_EQ(bad.failure, "ended in an unknown way");
}

TEST(SeparateProcess, WorksAmongThreadsThatAllocate) {
  std::atomic<bool> stop{false};
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i)
    threads.emplace_back([&] {
      while (!stop) std::vector<int>(10'000).swap(*std::make_unique<std::vector<int>>());
    });
  int good = 0;
  for (int i = 0; i < 50; ++i)
    good += run_separately([](ResultFile& file) {
              const std::vector<int> much(100'000, 1);
              try {
                throw 3;
              } catch (const int thrown) {
                file.write(std::as_bytes(std::span(&thrown, 1)));
              }
            }).failure.empty();
  stop = true;
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(good, 50);
}

}  // namespace
}  // namespace plume::test
