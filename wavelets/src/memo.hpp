#pragma once

#include <map>
#include <mutex>

namespace wavebalance::wavelets::detail {

/// Values that are computed once per key and kept for the lifetime of the memo. Meant for keys from a small
/// set, such as families and orders of derivatives. Thread-safe; references stay valid.
template <class Key, class Value>
class Memo {
 public:
  /// The value of `key`, computed by `make()` at the first call. If make() throws, nothing is stored.
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
