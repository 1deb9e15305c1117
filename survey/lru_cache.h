// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace stucco {

// Values that are loaded when they are first asked for, the least recently used dropped first so
// that together they stay near `max_bytes`. Thread-safe: what several threads ask for at once is
// loaded by one of them. What callers hold stays alive. An error in loading goes to who asked; the
// next one tries again.
template <typename Key, typename Value>
class LruCache {
 public:
  using Pointer = std::shared_ptr<const Value>;
  using Load = std::function<Pointer(const Key&)>;
  using Size = std::function<size_t(const Value&)>;  // in bytes

  LruCache(size_t max_bytes, Load load, Size size)
      : max_bytes_(max_bytes), load_(std::move(load)), size_(std::move(size)) {}

  Pointer Get(const Key& key) {
    const std::shared_ptr<Slot> slot = SlotOf(key);
    const std::lock_guard lock(slot->loading);
    if (!slot->value) {
      slot->value = load_(key);
      Account(key, slot);
    }
    return slot->value;
  }

  // Drops all.
  void Clear() {
    const std::lock_guard lock(mutex_);
    entries_.clear();
    recent_.clear();
    bytes_ = 0;
  }

  size_t bytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
  }

 private:
  struct Slot {
    std::mutex loading;
    Pointer value;
    size_t bytes = 0;
  };
  struct Entry {
    std::shared_ptr<Slot> slot;
    typename std::list<Key>::iterator place;
  };

  std::shared_ptr<Slot> SlotOf(const Key& key) {
    const std::lock_guard lock(mutex_);
    const auto [entry, added] = entries_.try_emplace(key);
    if (added) {
      recent_.push_front(key);
      entry->second = {std::make_shared<Slot>(), recent_.begin()};
    } else {
      recent_.splice(recent_.begin(), recent_, entry->second.place);
    }
    return entry->second.slot;
  }

  void Account(const Key& key, const std::shared_ptr<Slot>& slot) {
    const std::lock_guard lock(mutex_);
    const auto found = entries_.find(key);
    if (found == entries_.end() || found->second.slot != slot) return;  // dropped while it loaded
    slot->bytes = size_(*slot->value);
    bytes_ += slot->bytes;
    while (bytes_ > max_bytes_ && entries_.size() > 1 && recent_.back() != key) {
      const auto oldest = entries_.find(recent_.back());
      bytes_ -= oldest->second.slot->bytes;
      entries_.erase(oldest);
      recent_.pop_back();
    }
  }

  size_t max_bytes_;
  Load load_;
  Size size_;
  mutable std::mutex mutex_;
  size_t bytes_ = 0;
  std::list<Key> recent_;  // most recent first
  std::map<Key, Entry> entries_;
};

}  // namespace stucco
