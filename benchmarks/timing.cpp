#include "timing.h"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace geovor::bench {
namespace {

// Long against the clock's grain, short against a time slice of the scheduler.
constexpr double kTurn = 2e5;  // ns
// Rounds: enough for a steady median, fewer where one pass of all contenders takes long.
constexpr int kMostRounds = 101, kLeastRounds = 11;
constexpr double kPatience = 5e8;  // ns

// In the process's own time: what others do on the machine does not count.
double run(const std::function<void()>& pass, int passes) {
  const std::clock_t start = std::clock();
  for (int i = 0; i < passes; ++i) pass();
  return 1e9 / CLOCKS_PER_SEC * static_cast<double>(std::clock() - start);
}

}  // namespace

std::vector<double> race(const std::vector<Contender>& contenders) {
  std::vector<int> passes;
  double round_time = 0.0;
  for (const Contender& c : contenders) {
    run(c.pass, 1);  // caches and page tables
    const double one = run(c.pass, 1);
    passes.push_back(std::max(1, static_cast<int>(std::lround(kTurn / std::max(one, 1e9 / CLOCKS_PER_SEC)))));
    round_time += passes.back() * one;
  }
  const int rounds = static_cast<int>(std::clamp(kPatience / round_time, 1.0 * kLeastRounds, 1.0 * kMostRounds));
  std::vector<std::vector<double>> times(contenders.size());
  for (int round = 0; round < rounds; ++round)
    for (size_t i = 0; i < contenders.size(); ++i)
      times[i].push_back(run(contenders[i].pass, passes[i]) / (passes[i] * contenders[i].calls));
  std::vector<double> medians;
  for (std::vector<double>& t : times) {
    std::nth_element(t.begin(), t.begin() + t.size() / 2, t.end());
    medians.push_back(t[t.size() / 2]);
  }
  return medians;
}

}  // namespace geovor::bench
