#pragma once
#include <cstdint>
#include <memory>

namespace firmtouch::tools {

enum class QueueKind { kTree, kHeap };

/// Edges in the order of their keys (least first; of equal keys the lower edge), so that both kinds
/// give the same collapses.
class CollapseQueue {
 public:
  virtual ~CollapseQueue() = default;
  /// Puts an edge in, or moves it to its new key.
  virtual void put(uint32_t edge, double key) = 0;
  virtual void remove(uint32_t edge) = 0;  // of one that is not there: nothing
  virtual bool has(uint32_t edge) const = 0;
  virtual bool is_empty() const = 0;
  virtual uint32_t pop() = 0;

  uint64_t comparisons = 0;  // of keys, in all

 protected:
  bool before(double key_a, uint32_t a, double key_b, uint32_t b) {
    ++comparisons;
    return key_a < key_b || (!(key_b < key_a) && a < b);
  }
};

/// For edges 0 to `edges` - 1. kTree: the standard library's ordered tree (red-black, as in the
/// paper); kHeap: a binary heap that knows where each edge lies.
std::unique_ptr<CollapseQueue> make_queue(QueueKind kind, uint32_t edges);

}  // namespace firmtouch::tools
