// What is built once is built once, and never given out for another transfer function.

#include "plume/preint/integrator_cache.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <set>
#include <thread>
#include <vector>

#include "plume/tests/preint/transfer_functions.h"

namespace plume {
namespace {

IntegratorSettings small_table() {
  IntegratorSettings settings;
  settings.kind = IntegratorKind::table;
  settings.table = {16, 8};
  return settings;
}

TEST(IntegratorCache, builds_anew_only_where_something_changed) {
  IntegratorCache cache;
  const TransferFunction function = tests::smooth_function();
  const auto first = cache.get(function, small_table());
  EXPECT_EQ(cache.get(tests::smooth_function(), small_table()), first);
  TransferFunction other = function;
  other.knots[3].optics.color[1] += 1e-6f;
  const auto second = cache.get(other, small_table());
  EXPECT_NE(second, first);
  IntegratorSettings larger = small_table();
  larger.table.scalar_count = 17;
  const auto third = cache.get(other, larger);
  EXPECT_NE(third, second);
  // What has no table does not drive it out.
  EXPECT_TRUE(std::holds_alternative<ClosedForm>(*cache.get(function, {})));
  EXPECT_EQ(cache.get(other, larger), third);
  // What was given out is alive.
  EXPECT_EQ(std::get<PreintegratedTable>(*first).bytes(), 16u * 16 * 8 * 16);
  EXPECT_EQ(std::get<PreintegratedTable>(*third).bytes(), 17u * 17 * 8 * 16);
}

TEST(IntegratorCache, gives_every_thread_what_it_asked_for) {
  IntegratorCache cache;
  const std::vector<TransferFunction> functions{tests::smooth_function(), tests::step_function()};
  std::vector<std::thread> threads;
  std::vector<int> wrong(4, 0);
  for (std::size_t t = 0; t < wrong.size(); ++t)
    threads.emplace_back([&, t] {
      for (std::size_t i = 0; i < 20; ++i) {
        const TransferFunction& function = functions[(t + i / 5) % 2];
        const auto integrator = cache.get(function, small_table());
        const float expected = ClosedForm(function).optical_depth(0.1f, 0.9f, 1);
        const auto& table = std::get<PreintegratedTable>(*integrator);
        if (table.optical_depth(0.1f, 0.9f, 1) != expected) ++wrong[t];
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

TEST(IntegratorCache, may_be_asked_from_tasks_of_the_library_that_builds) {
  // While a thread waits for its table, it must not take up a task that asks for another.
  IntegratorCache cache;
  const std::vector<TransferFunction> functions{tests::smooth_function(), tests::step_function()};
  tbb::parallel_for(0, 64, [&](int i) {
    const auto integrator = cache.get(functions[static_cast<std::size_t>(i % 2)], small_table());
    ASSERT_TRUE(std::holds_alternative<PreintegratedTable>(*integrator));
  });
}

}  // namespace
}  // namespace plume
