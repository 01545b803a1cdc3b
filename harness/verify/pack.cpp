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

}  // namespace

std::string pack(const expectation& e) {
  packer p;
  p.put(e.names);
  p.put(e.ids);
  p.put(e.value);
  p.put(e.bound);
  p.put(e.magnitude);
  p.put(e.pairs_fluid_fluid);
  p.put(e.pairs_fluid_boundary);
  return std::move(p.bytes);
}

expectation unpack_expectation(const std::string& bytes) {
  unpacker u(bytes);
  expectation e;
  u.get(e.names);
  u.get(e.ids);
  u.get(e.value);
  u.get(e.bound);
  u.get(e.magnitude);
  u.get(e.pairs_fluid_fluid);
  u.get(e.pairs_fluid_boundary);
  return e;
}

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

std::string pack(const verdict& v) {
  packer p;
  p.put(v.ok);
  p.put(v.max_rel_err);
  p.put(v.bound);
  p.put(v.error);
  p.put(v.finite);
  return std::move(p.bytes);
}

verdict unpack_verdict(const std::string& bytes) {
  unpacker u(bytes);
  verdict v;
  u.get(v.ok);
  u.get(v.max_rel_err);
  u.get(v.bound);
  u.get(v.error);
  u.get(v.finite);
  return v;
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
