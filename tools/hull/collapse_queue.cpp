#include "hull/collapse_queue.hpp"

#include <set>
#include <utility>

#include "surface/edges.hpp"

namespace firmtouch::tools {
namespace {

class TreeQueue : public CollapseQueue {
 public:
  explicit TreeQueue(uint32_t edges) : key_(edges, 0), is_in_(edges, false), order_(Before{this}) {}

  void put(uint32_t edge, double key) override {
    remove(edge);
    key_[edge] = key;
    is_in_[edge] = true;
    order_.insert(edge);
  }
  void remove(uint32_t edge) override {
    if (!is_in_[edge]) return;
    order_.erase(edge);
    is_in_[edge] = false;
  }
  bool has(uint32_t edge) const override { return is_in_[edge]; }
  bool is_empty() const override { return order_.empty(); }
  uint32_t pop() override {
    const uint32_t edge = *order_.begin();
    order_.erase(order_.begin());
    is_in_[edge] = false;
    return edge;
  }

 private:
  struct Before {
    TreeQueue* queue;
    bool operator()(uint32_t a, uint32_t b) const {
      return queue->before(queue->key_[a], a, queue->key_[b], b);
    }
  };
  std::vector<double> key_;
  std::vector<bool> is_in_;
  std::set<uint32_t, Before> order_;
};

class HeapQueue : public CollapseQueue {
 public:
  explicit HeapQueue(uint32_t edges) : key_(edges, 0), place_(edges, kNone) {}

  void put(uint32_t edge, double key) override {
    key_[edge] = key;
    if (place_[edge] == kNone) {
      place_[edge] = static_cast<uint32_t>(heap_.size());
      heap_.push_back(edge);
    }
    settle(place_[edge]);
  }
  void remove(uint32_t edge) override {
    const uint32_t hole = place_[edge];
    if (hole == kNone) return;
    const uint32_t last = heap_.back();
    heap_.pop_back();
    place_[edge] = kNone;
    if (last == edge) return;
    heap_[hole] = last;
    place_[last] = hole;
    settle(hole);
  }
  bool has(uint32_t edge) const override { return place_[edge] != kNone; }
  bool is_empty() const override { return heap_.empty(); }
  uint32_t pop() override {
    const uint32_t edge = heap_[0];
    remove(edge);
    return edge;
  }

 private:
  bool is_before(uint32_t at, uint32_t other) {
    const uint32_t a = heap_[at], b = heap_[other];
    return before(key_[a], a, key_[b], b);
  }
  void swap(uint32_t at, uint32_t other) {
    std::swap(heap_[at], heap_[other]);
    place_[heap_[at]] = at;
    place_[heap_[other]] = other;
  }
  void settle(uint32_t at) {
    while (at > 0 && is_before(at, (at - 1) / 2)) {
      swap(at, (at - 1) / 2);
      at = (at - 1) / 2;
    }
    for (;;) {
      uint32_t child = 2 * at + 1;
      if (child >= heap_.size()) return;
      if (child + 1 < heap_.size() && is_before(child + 1, child)) ++child;
      if (!is_before(child, at)) return;
      swap(at, child);
      at = child;
    }
  }

  std::vector<double> key_;
  std::vector<uint32_t> place_, heap_;
};

}  // namespace

std::unique_ptr<CollapseQueue> make_queue(QueueKind kind, uint32_t edges) {
  if (kind == QueueKind::kHeap) return std::make_unique<HeapQueue>(edges);
  return std::make_unique<TreeQueue>(edges);
}

}  // namespace firmtouch::tools
