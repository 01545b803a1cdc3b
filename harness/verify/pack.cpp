#include "harness/verify/pack.hpp"

#include <cstring>
#include <type_traits>

#include <pairsum/core/error.hpp>

namespace pairsum::harness {
namespace {

class packer {
 public:
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void put(const T& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); }
  void put(const std::string& text) {
    put(text.size());
    bytes += text;
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put(values.size());
    if constexpr (std::is_trivially_copyable_v<T>)
      bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    else
      for (const T& value : values) put(value);
  }

  std::string bytes;
};

class unpacker {
 public:
  explicit unpacker(const std::string& bytes) : bytes_(bytes) {}

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void get(T& value) { std::memcpy(&value, take(sizeof value), sizeof value); }
  void get(std::string& text) {
    std::size_t size = 0;
    get(size);
    text.assign(take(size), size);
  }
  template <class T>
  void get(std::vector<T>& values) {
    std::size_t size = 0;
    get(size);
    if constexpr (std::is_trivially_copyable_v<T>) {
      const char* const from = take(size, sizeof(T));
      values.resize(size);
      if (size > 0) std::memcpy(values.data(), from, size * sizeof(T));
    } else {
      if (size > bytes_.size()) take(size);  // before there is room made for them
      values.resize(size);
      for (T& value : values) get(value);
    }
  }

 private:
  const char* take(std::size_t count, std::size_t each = 1) {
    if (count > (bytes_.size() - at_) / each)
      throw error("the store that the processes of a study share holds a truncated record");
    const char* const from = bytes_.data() + at_;
    at_ += count * each;
    return from;
  }
  const std::string& bytes_;
  std::size_t at_ = 0;
};

/// Calls f with each field of an expectation, in the order in which they are packed.
template <class E, class F>
void each_field(E& e, F&& f) requires std::is_same_v<std::remove_const_t<E>, expectation> {
  f(e.names);
  f(e.ids);
  f(e.value);
  f(e.bound);
  f(e.magnitude);
  f(e.pairs_fluid_fluid);
  f(e.pairs_fluid_boundary);
}
template <class V, class F>
void each_field(V& v, F&& f) requires std::is_same_v<std::remove_const_t<V>, verdict> {
  f(v.ok);
  f(v.max_rel_err);
  f(v.bound);
  f(v.error);
  f(v.finite);
}

template <class T>
std::string packed(const T& all) {
  packer p;
  each_field(all, [&](const auto& field) { p.put(field); });
  return std::move(p.bytes);
}
template <class T>
T unpacked(const std::string& bytes) {
  unpacker u(bytes);
  T all;
  each_field(all, [&](auto& field) { u.get(field); });
  return all;
}

}  // namespace

std::string pack(const expectation& e) { return packed(e); }
expectation unpack_expectation(const std::string& bytes) { return unpacked<expectation>(bytes); }

std::string pack(const verdict& v) { return packed(v); }
verdict unpack_verdict(const std::string& bytes) { return unpacked<verdict>(bytes); }

std::string pack(const verdict_map& known) {
  packer p;
  p.put(known.size());
  for (const auto& [key, v] : known) {
    p.put(key.first.integrator);
    p.put(key.first.evaluation);
    p.put(key.second);
    p.put(v.max_rel_err);
    p.put(v.bound);
  }
  return std::move(p.bytes);
}

verdict_map unpack_verdicts(const std::string& bytes) {
  unpacker u(bytes);
  verdict_map known;
  std::size_t size = 0;
  u.get(size);
  for (std::size_t k = 0; k < size; ++k) {
    std::pair<verifier::moment, std::uint64_t> key;
    verdict v;
    u.get(key.first.integrator);
    u.get(key.first.evaluation);
    u.get(key.second);
    u.get(v.max_rel_err);
    u.get(v.bound);
    known.emplace(std::move(key), std::move(v));
  }
  return known;
}

}  // namespace pairsum::harness
