// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace dcharts {

/// A priority queue of items with a cost each: the cheapest first, of equally cheap ones the least item.
/// Equal pairs aside that is a total order: it does not show that this is a heap with four children per
/// node, half as deep as one with two; the least of four is found without a branch that is hard to guess.
template <class Item>
class CheapestFirst {
 public:
  struct Entry {
    double cost;
    Item item;
  };

  bool IsEmpty() const { return entries_.empty(); }
  const Entry& Top() const { return entries_.front(); }
  void Clear() { entries_.clear(); }

  void Push(const Entry& entry) {
    size_t k = entries_.size();
    entries_.push_back(entry);
    while (k > 0) {
      const size_t parent = (k - 1) / kChildren;
      if (!IsCheaper(entry, entries_[parent])) break;
      entries_[k] = entries_[parent];
      k = parent;
    }
    entries_[k] = entry;
  }

  void Pop() {
    const Entry last = entries_.back();
    entries_.pop_back();
    if (!entries_.empty()) ReplaceTop(last);
  }

  /// Pop and Push in one.
  void ReplaceTop(const Entry& entry) {
    Entry* const entries = entries_.data();
    const size_t count = entries_.size();
    size_t k = 0;
    for (size_t child = 1; child < count; child = kChildren * k + 1) {
      size_t least = child;
      if (child + kChildren <= count) {
        const size_t first = child + IsCheaper(entries[child + 1], entries[child]);
        const size_t second = child + 2 + IsCheaper(entries[child + 3], entries[child + 2]);
        least = IsCheaper(entries[second], entries[first]) ? second : first;
      } else {
        for (size_t other = child + 1; other < count; ++other)
          if (IsCheaper(entries[other], entries[least])) least = other;
      }
      if (!IsCheaper(entries[least], entry)) break;
      entries[k] = entries[least];
      k = least;
    }
    entries[k] = entry;
  }

 private:
  static constexpr size_t kChildren = 4;

  static bool IsCheaper(const Entry& a, const Entry& b) {
    return a.cost != b.cost ? a.cost < b.cost : a.item < b.item;
  }

  std::vector<Entry> entries_;
};

}  // namespace dcharts
