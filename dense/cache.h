// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>

namespace stucco {

// Keeps the most recently used values up to a number of bytes; what is dropped is loaded again when
// asked for. Thread-safe; two threads may load the same value at once.
template <typename Value>
class LruCache {
 public:
  using Pointer = std::shared_ptr<const Value>;

  LruCache(size_t max_bytes, std::function<Pointer(int)> load,
           std::function<size_t(const Value&)> size)
      : max_bytes_(max_bytes), load_(std::move(load)), size_(std::move(size)) {}

  Pointer Get(int key) {
    {
      const std::lock_guard lock(mutex_);
      const auto found = entries_.find(key);
      if (found != entries_.end()) {
        order_.splice(order_.begin(), order_, found->second.place);
        return found->second.value;
      }
    }
    Pointer value = load_(key);
    const std::lock_guard lock(mutex_);
    if (entries_.contains(key)) return entries_.at(key).value;
    order_.push_front(key);
    entries_[key] = {value, order_.begin()};
    bytes_ += size_(*value);
    while (bytes_ > max_bytes_ && order_.size() > 1) {
      const auto last = entries_.find(order_.back());
      bytes_ -= size_(*last->second.value);
      entries_.erase(last);
      order_.pop_back();
    }
    return value;
  }

 private:
  struct Entry {
    Pointer value;
    std::list<int>::iterator place;
  };
  size_t max_bytes_;
  std::function<Pointer(int)> load_;
  std::function<size_t(const Value&)> size_;
  std::mutex mutex_;
  std::list<int> order_;
  std::map<int, Entry> entries_;
  size_t bytes_ = 0;
};

}  // namespace stucco
