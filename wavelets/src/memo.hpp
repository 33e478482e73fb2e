#pragma once

#include <map>
#include <mutex>

namespace wavebalance::wavelets::detail {

/// What was made once for a key, kept for as long as the memo lives: for values that depend on nothing but a
/// key from a small set, as families and orders of derivatives are. Thread-safe; references stay valid.
template <class Key, class Value>
class Memo {
 public:
  /// The value of `key`, by `make()` when it is asked for first. A throw of make() keeps nothing.
  template <class Make>
  const Value& get(const Key& key, const Make& make) {
    const std::lock_guard lock(mutex_);
    const auto found = values_.find(key);
    return found != values_.end() ? found->second : values_.emplace(key, make()).first->second;
  }

 private:
  std::mutex mutex_;
  std::map<Key, Value> values_;
};

}  // namespace wavebalance::wavelets::detail
