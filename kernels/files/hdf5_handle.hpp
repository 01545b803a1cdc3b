#pragma once
#include <hdf5.h>

#include <string>

namespace pairsum::files {

/// Owns what HDF5 numbers.
class hdf5_handle {
 public:
  hdf5_handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  hdf5_handle(hdf5_handle&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
  hdf5_handle& operator=(hdf5_handle&&) = delete;
  ~hdf5_handle() {
    if (id_ >= 0) close_(id_);
  }
  explicit operator bool() const { return id_ >= 0; }
  operator hid_t() const { return id_; }  // for calls of the library

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// The last words of HDF5: what it tried when it failed.
std::string hdf5_last_words();

}  // namespace pairsum::files
