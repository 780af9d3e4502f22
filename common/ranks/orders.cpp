#include "common/ranks/orders.hpp"

#include <fmt/format.h>

#include <exception>

#include "common/core/log.hpp"

namespace fsi {

namespace {

constexpr int leave = 0;

}  // namespace

void Foreman::let_go(double received) noexcept {
  if (alone() || broken_) return;
  try {
    std::vector<double> order = OrderWriter(leave).take();
    ranks_->broadcast(order);
    const Ranks::Sent& sent = ranks_->sent();
    log_info(fmt::format("rank 0 of {} sent {} messages with {} numbers; {} numbers came to it",
                         ranks_->size(), sent.messages, sent.values, received));
    ranks_->leave();
  } catch (const std::exception& failure) {
    log_warning(failure.what());
  }
}

void obey_orders(Ranks& ranks, const std::function<void(int word, OrderReader& order)>& obey) {
  std::vector<double> values;
  for (;;) {
    ranks.broadcast(values);
    OrderReader order(values);
    const int word = order.whole();
    if (word == leave) break;
    try {
      obey(word, order);
    } catch (const Diverged&) {
      continue;
    }
  }
  ranks.leave();
}

}  // namespace fsi
