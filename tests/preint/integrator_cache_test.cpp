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

TEST(IntegratorCache, keeps_both_of_two_that_are_asked_for_in_turns) {
  IntegratorCache cache;
  IntegratorSettings larger = small_table(), second = small_table();
  larger.table.scalar_count = 24;
  second.kind = IntegratorKind::second_order_table;
  second.second_order_table = {8, 4, {}, {}, {}};
  for (int turn = 0; turn < 5; ++turn)
    for (const auto& function : {tests::smooth_function(), tests::step_function()})
      for (const IntegratorSettings& settings : {larger, second}) {
        const auto given = cache.get(function, settings);
        const auto again = cache.get(function, settings);
        EXPECT_EQ(given, again);
        // Neither is given out for another.
        const bool is_second = std::holds_alternative<SecondOrderTable>(*given);
        EXPECT_EQ(is_second, settings.kind == IntegratorKind::second_order_table);
      }
  EXPECT_EQ(cache.built(), 4u);
}

TEST(IntegratorCache, drops_the_one_that_was_not_used_for_longest) {
  IntegratorCache cache;
  auto size = [](int count) {
    IntegratorSettings settings = small_table();
    settings.table.scalar_count = count;
    return settings;
  };
  const TransferFunction function = tests::smooth_function();
  for (const int count : {8, 9, 10, 11}) cache.get(function, size(count));
  cache.get(function, size(8));   // used again
  cache.get(function, size(12));  // in the place of 9
  EXPECT_EQ(cache.built(), 5u);
  for (const int count : {8, 10, 11, 12}) cache.get(function, size(count));
  EXPECT_EQ(cache.built(), 5u);
  cache.get(function, size(9));
  EXPECT_EQ(cache.built(), 6u);
}

TEST(IntegratorCache, holds_no_more_than_64_megabytes_besides_the_last) {
  IntegratorCache cache;
  auto size = [](int count) {
    IntegratorSettings settings = small_table();
    settings.table = {count, 32, {}, {}, {}};
    return settings;
  };
  const TransferFunction function = tests::smooth_function();
  // 33.5 MB each: one besides the last.
  std::weak_ptr<const Integrator> first = cache.get(function, size(256));
  std::weak_ptr<const Integrator> second = cache.get(function, size(255));
  EXPECT_FALSE(first.expired());
  cache.get(function, size(254));
  EXPECT_TRUE(first.expired());
  EXPECT_FALSE(second.expired());
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
